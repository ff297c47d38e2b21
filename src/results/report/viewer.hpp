/// The page without data: viewer, styles and licences (web/report/built/viewer.html, kept in the program).
#pragma once

#include <string_view>

namespace solidus::results {

std::string_view viewer();

}  // namespace solidus::results
