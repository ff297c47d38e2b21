/// Any bytes as a material file.
#include "input.hpp"
#include "material/cards/library.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace solidus;
  const auto file = fuzz::as_file("material.toml", data, size);
  return fuzz::answer([&] { material::load_material(file); });
}
