/// Restrictions that a process sets for itself before it reads foreign files
/// (mesh/making/reader_process.hpp, results/formats/hdf5_reader.hpp).
#pragma once

namespace solidus::sandbox {

/// Limits the memory of this process permanently.
/// @param memory  largest private memory [byte]; 0: no limit. AddressSanitizer, which reserves terabytes,
/// has
///                none
void limit_memory(double memory);

/// Removes the rights of this process to start programs, to write, create, rename or remove files, and to
/// open connections: the system refuses these calls whatever a library tries. Has no effect on kernels or
/// processors without system call filters.
void forbid_all_but_reading();

}  // namespace solidus::sandbox
