/// The formats of mesh files that every program reads: of each file format_NAME.cpp its format_NAME(). The
/// build writes the source of this header (CMakeLists.txt), so that no list names them.
#pragma once

#include <vector>

#include "mesh/files/file_format.hpp"

namespace solidus::mesh {

/// In no particular order: each says its place.
std::vector<FileFormat> built_in_formats();

}  // namespace solidus::mesh
