/// Restrictions that a process which reads foreign files puts on itself before it opens one
/// (mesh/making/reader_process.hpp, results/formats/hdf5_reader.hpp).
#pragma once

namespace solidus::sandbox {

/// Limits this process for good.
/// @param memory  bytes of its own that it may hold; 0: no limit. AddressSanitizer, which reserves terabytes,
/// has
///                none
void limit_memory(double memory);

/// Takes from this process the right to start programs, to write, make, rename or remove files, and to open
/// connections: whatever library fails to hold, the system refuses. A kernel or a processor without system
/// call filters leaves it as it is.
void forbid_all_but_reading();

}  // namespace solidus::sandbox
