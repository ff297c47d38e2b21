/// Integrity check of a file that HDF5 wrote: a checksum over all of it, in the first bytes, which HDF5
/// leaves to its user (the user block).
#pragma once

#include <cstddef>
#include <filesystem>

namespace solidus::results {

inline constexpr std::size_t k_user_block = 512;  ///< bytes in front of the data of HDF5

/// Writes size and checksum of everything behind the user block into it, and brings the file to the disk.
/// Throws OutputError.
void write_checksum(const std::filesystem::path& file);

/// Throws OutputError if the file is not, byte for byte, as write_checksum() found it.
void check_checksum(const std::filesystem::path& file);

}  // namespace solidus::results
