/// The path of the executable, or of the one that a host program has named.
#include "system/program_path.hpp"

#include <errno.h>  // program_invocation_name
#include <sys/auxv.h>

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
  // The system loads a program and an interpreter for it, whose address it tells. Where it tells none, the
  // loader was started as a program that loads this one, and would be what /proc names.
  if (getauxval(AT_BASE) == 0) return std::filesystem::absolute(program_invocation_name, error);
  return std::filesystem::read_symlink("/proc/self/exe", error);
}

void set_program_path(std::filesystem::path program) {
  chosen() = std::move(program);
}

}  // namespace solidus
