#include "system/version.hpp"

#include <utility>

namespace solidus {

namespace {
std::string& version() {
  static std::string kept = SOLIDUS_VERSION;
  return kept;
}
}  // namespace

const std::string& program_version() {
  return version();
}

void set_program_version(std::string given) {
  version() = std::move(given);
}

}  // namespace solidus
