#include "system/terminal.hpp"

#include <unistd.h>

#include <cstdlib>

namespace solidus {

bool has_colours(int descriptor) {
  const char *none = std::getenv("NO_COLOR"), *kind = std::getenv("TERM");
  if (none != nullptr && *none != '\0') return false;
  // mpirun gives its processes a terminal of their own, wherever their output goes.
  if (std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr || std::getenv("PMI_SIZE") != nullptr) return false;
  return isatty(descriptor) == 1 && kind != nullptr && std::string_view(kind) != "dumb";
}

std::string painted(std::string_view text, Colour colour, bool wanted) {
  if (!wanted) return std::string(text);
  const char* start = colour == Colour::red     ? "\033[1;31m"
                      : colour == Colour::green ? "\033[1;32m"
                                                : "\033[1m";
  return start + std::string(text) + "\033[0m";
}

}  // namespace solidus
