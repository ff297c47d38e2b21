#include "system/terminal.hpp"

#include <unistd.h>

#include <cstdlib>

namespace solidus {

namespace {

bool trusted = false;

}  // namespace

void trust_terminal() {
  trusted = true;
}

bool is_terminal(int descriptor) {
  const bool by_mpirun = std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr || std::getenv("PMI_SIZE") != nullptr;
  if (by_mpirun && !trusted) return false;
  const char* kind = std::getenv("TERM");
  return isatty(descriptor) == 1 && kind != nullptr && std::string_view(kind) != "dumb";
}

bool has_colours(int descriptor) {
  const char* none = std::getenv("NO_COLOR");
  return (none == nullptr || *none == '\0') && is_terminal(descriptor);
}

std::string painted(std::string_view text, Colour colour, bool wanted) {
  if (!wanted) return std::string(text);
  const char* start = colour == Colour::red     ? "\033[1;31m"
                      : colour == Colour::green ? "\033[1;32m"
                                                : "\033[1m";
  return start + std::string(text) + "\033[0m";
}

}  // namespace solidus
