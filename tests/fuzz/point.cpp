/// Any bytes as a point file.
#include "input.hpp"
#include "point/point_case.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace solidus;
  const auto file = fuzz::as_file("point.toml", data, size);
  return fuzz::answer([&] { point::make_point_case(load_document(file), {}); });
}
