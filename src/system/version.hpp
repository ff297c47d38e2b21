/// The version that results and messages name.
#pragma once

#include <string>

namespace solidus {

/// The version of the program: that of the project unless set_version() was called.
const std::string& program_version();
/// Call this first in main(): programs know the commit that they were built from, libraries do not, so that
/// they need not be linked anew with each commit.
void set_program_version(std::string version);

}  // namespace solidus
