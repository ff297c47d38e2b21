/// Any bytes as a case file.
#include "input.hpp"
#include "setup/case_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace solidus;
  const auto file = fuzz::as_file("case.toml", data, size);
  return fuzz::answer([&] { setup::load_case(file).toml(); });
}
