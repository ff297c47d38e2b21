/// Any bytes as a table of points in space and time, and as measured points next to a curve.
#include "input.hpp"
#include "input/point_table.hpp"
#include "point/measured.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace solidus;
  const auto file = fuzz::as_file("table.csv", data, size);
  fuzz::answer([&] {
    const PointTable table(file, "", "W/m2/K", {});
    const std::vector<double> place(table.coordinates().size(), 0.5);
    table.value(place);
    table.outside(place);
  });
  return fuzz::answer([&] { point::read_measured(file, {}); });
}
