/// The manual page solidus(1), from the declarations of the command line.
#pragma once

#include <string>

#include "app/command_tree.hpp"

namespace solidus::app {

/// In the language of man(7).
std::string manual_page(const CommandTree& tree);

}  // namespace solidus::app
