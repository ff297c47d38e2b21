#include "system/version.hpp"

#include <cstddef>
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

bool same_build(const std::string& one, const std::string& other) {
  const std::size_t a = one.find('+'), b = other.find('+');
  const bool both_name_commits = a != std::string::npos && b != std::string::npos;
  return both_name_commits ? one == other : one.substr(0, a) == other.substr(0, b);
}

}  // namespace solidus
