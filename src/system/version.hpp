/// The version that results and messages name.
#pragma once

#include <string>

namespace solidus {

/// The version of the program: that of the project unless set_program_version() was called.
const std::string& program_version();
/// Call this first in main(): programs know the commit that they were built from, libraries do not, so that
/// they need not be linked again with each commit.
/// The reader of meshes compares it with its own (same_build).
void set_program_version(std::string version);
/// Whether two versions can be of the same build. One that names no commit (behind a '+') is that of a
/// program that links the libraries: it agrees with every commit of its version.
bool same_build(const std::string& one, const std::string& other);

}  // namespace solidus
