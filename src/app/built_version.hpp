#pragma once

namespace solidus::app {

/// The version that this program was built from (cmake/version.cmake). Its file alone is compiled again with
/// every commit.
const char* built_version();

}  // namespace solidus::app
