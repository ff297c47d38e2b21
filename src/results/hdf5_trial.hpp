/// Trial of an HDF5 file: all of it is read in a process of its own first, so that a damaged or crafted file
/// on which HDF5 crashes or hangs is an error of that file.
#pragma once

#include <filesystem>

namespace solidus::results {

/// Throws OutputError where HDF5 crashes on the file, or reads it for longer than 15 s and a second per
/// megabyte. What cannot be read otherwise is no fault: who needs it says so.
void try_to_read(const std::filesystem::path& file);

}  // namespace solidus::results
