/// What a foreign HDF5 file would make a library read: the MED library asks no data set how large it is.
#pragma once

#include <cstddef>
#include <string>

namespace solidus::mesh {

/// The bytes of the largest data set of a file as numbers of 8 bytes or, where its elements are larger, as
/// they are. Whoever reads a data set whole into a buffer of so many bytes keeps to the buffer.
/// Throws InputError for a file that HDF5 does not open and for data that lie in other files.
std::size_t largest_data_set(const std::string& path);

}  // namespace solidus::mesh
