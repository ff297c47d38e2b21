/// The modulus of a place by its freezing time: a plate whose thickness is known says it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "case_folder.hpp"
#include "case_run.hpp"

namespace {

using solidus::testing::read_csv;

const solidus::testing::CaseFolder k_here("plate_thickness");

/// Half of a plate on a block of sand, in strips of one element.
std::string half_plate(double half, double end) {
  return fmt::format(R"(title = "Half of a plate on sand"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["4 mm", "150 mm"]
upper = ["4 mm", "{} mm"]
lower_divisions = [1, 60]
upper_divisions = [1, 10]
[[body]]
name = "sand"
group = "lower"
role = "mould"
material = "furan_sand"
initial_temperature = "20 degC"
[[body]]
name = "plate"
group = "upper"
material = "aluminium_alsi7mg"
initial_temperature = "680 degC"
[[contact]]
name = "skin"
slave = "upper_bottom"
master = "lower_top"
penalty = "1e13 N/m3"
[contact.heat]
conductance = "1000 W/m2/K"
gap_law = "constant"
[time]
until = "solid"
end = "{} s"
step = "1 s"
adaptive = true
[[probe]]
name = "middle"
kind = "point"
field = "plate_thickness"
point = ["2 mm", "{} mm"]
unit = "mm"
[[probe]]
name = "zone"
kind = "point"
field = "feeding_zone"
point = ["2 mm", "150.5 mm"]
unit = "1"
)",
                     half, end, 150 + half);
}

// The estimate knows one dimension, as a plate does: it and the run differ by cells, steps and the curve of
// freezing alone.
TEST(PlateThickness, IsThatOfThePlate) {
  for (const double half : {5.0, 15.0}) {
    const std::string name = fmt::format("half_{:g}", half);
    const auto run = k_here.run(name, half_plate(half, 3600));
    ASSERT_TRUE(run.finished) << run.reason;
    const solidus::testing::Columns history = read_csv(k_here.root() / name / "history.csv");
    EXPECT_EQ(history.at("middle[mm]").front(), 0);  // melt has no time of freezing
    EXPECT_NEAR(history.at("middle[mm]").back(), 2 * half, 0.05 * 2 * half);
    EXPECT_EQ(history.at("zone[1]").back(), 1);  // the pool that all of the plate was
  }
}

}  // namespace
