/// Any bytes as a case file.
#include "build/case_file.hpp"
#include "input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace solidus;
  const auto file = fuzz::as_file("case.toml", data, size);
  return fuzz::answer([&] { model::load_case(file).toml(); });
}
