#include "system/program_path.hpp"

#include <system_error>
#include <utility>

namespace solidus {

namespace {

std::filesystem::path& chosen() {
  static std::filesystem::path program;
  return program;
}

}  // namespace

std::filesystem::path program_path() {
  if (!chosen().empty()) return chosen();
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error);
}

void set_program_path(std::filesystem::path program) {
  chosen() = std::move(program);
}

}  // namespace solidus
