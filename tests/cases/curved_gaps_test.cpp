/// Heat between curved faces: facets of two meshes on one cylinder, radiation across wide gaps.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>

#include "case_folder.hpp"

namespace {

const solidus::testing::CaseFolder k_here("curved_gaps");

const std::string k_metal = R"(title = "A metal"
density = "7800 kg/m3"
conductivity = "200 W/m/K"
specific_heat = "600 J/kg/K"
)";

/// A quarter of a disc (r0 to r1) in a quarter of a ring (r2 to r3) [mm], each with its own number of faces
/// along the quarter; the centre may lie far from the origin.
std::string rings(const std::array<double, 4>& r, int inner, int outer, double centre = 0) {
  std::string geo = fmt::format("c = {};\n", centre);
  const auto ring = [&](int first, double r0, double r1, int faces, const char* name) {
    geo += fmt::format(
        "Point({0}) = {{c, 0, 0}};\n"
        "Point({1}) = {{c + {6}, 0, 0}}; Point({2}) = {{c + {7}, 0, 0}};\n"
        "Point({3}) = {{c, {7}, 0}}; Point({4}) = {{c, {6}, 0}};\n"
        "Line({1}) = {{{1}, {2}}}; Circle({2}) = {{{2}, {0}, {3}}}; Line({3}) = {{{3}, {4}}};\n"
        "Circle({4}) = {{{4}, {0}, {1}}};\n"
        "Curve Loop({0}) = {{{1}, {2}, {3}, {4}}}; Plane Surface({0}) = {{{0}}};\n"
        "Transfinite Curve {{{2}, {4}}} = {5} + 1; Transfinite Curve {{{1}, {3}}} = 11;\n"
        "Transfinite Surface {{{0}}}; Recombine Surface {{{0}}};\n"
        "Physical Surface(\"{8}\") = {{{0}}}; Physical Curve(\"{8}_out\") = {{{2}}};\n"
        "Physical Curve(\"{8}_in\") = {{{4}}};\n",
        first, first + 1, first + 2, first + 3, first + 4, faces, r0, r1, name);
  };
  ring(100, r[0], r[1], inner, "part");
  ring(200, r[2], r[3], outer, "mould");
  return geo;
}

/// The same as whole rings, meshed by triangles; faces are those of a quarter.
std::string whole_rings(const std::array<double, 4>& r, int inner, int outer) {
  std::string geo = "Point(1) = {0, 0, 0};\nMesh.MeshSizeMax = 2;\n";
  const auto circle = [&](int first, double radius, int faces) {
    geo += fmt::format(
        "Point({0}) = {{{4}, 0, 0}}; Point({1}) = {{0, {4}, 0}}; Point({2}) = {{-{4}, 0, 0}}; "
        "Point({3}) = {{0, -{4}, 0}};\n"
        "Circle({0}) = {{{0}, 1, {1}}}; Circle({1}) = {{{1}, 1, {2}}}; Circle({2}) = {{{2}, 1, {3}}}; "
        "Circle({3}) = {{{3}, 1, {0}}};\n"
        "Transfinite Curve {{{0}, {1}, {2}, {3}}} = {5} + 1; Curve Loop({0}) = {{{0}, {1}, {2}, {3}}};\n",
        first, first + 1, first + 2, first + 3, radius, faces);
  };
  circle(10, r[0], inner);
  circle(20, r[1], inner);
  circle(30, r[2], outer);
  circle(40, r[3], outer);
  const auto named = [&](const std::string& body, int in, int out) {
    geo += fmt::format(
        "Plane Surface({1}) = {{{2}, {1}}}; Physical Surface(\"{0}\") = {{{1}}};\n"
        "Physical Curve(\"{0}_in\") = {{{1}, {3}, {4}, {5}}}; "
        "Physical Curve(\"{0}_out\") = {{{2}, {6}, {7}, {8}}};\n",
        body, in, out, in + 1, in + 2, in + 3, out + 1, out + 2, out + 3);
  };
  named("part", 10, 20);
  named("mould", 30, 40);
  return geo;
}

std::string rings_case(const std::string& mesh, const std::string& kind, const std::string& contact,
                       double hot, double cold) {
  return fmt::format(R"(title = "A disc in a ring"
[analysis]
kind = "{}"
physics = "heat"
[mesh]
file = "{}"
unit = "mm"
[time]
steady = true
[[body]]
name = "part"
material = "metal.toml"
initial_temperature = "{} K"
[[body]]
name = "mould"
material = "metal.toml"
initial_temperature = "{} K"
[[thermal_condition]]
name = "core"
group = "part_in"
kind = "temperature"
temperature = "{} K"
[[thermal_condition]]
name = "outside"
group = "mould_out"
kind = "temperature"
temperature = "{} K"
{}
[[probe]]
name = "Ti"
field = "temperature"
kind = "mean"
group = "part_out"
unit = "K"
)",
                     kind, mesh, hot, cold, hot, cold, contact);
}

double fitted(const std::string& name, int inner, int outer, const std::string& interface,
              double centre = 0) {
  k_here.write("metal.toml", k_metal);
  k_here.write(name + ".geo", rings({4, 20, 20, 50}, inner, outer, centre));
  const auto run = k_here.run(name, rings_case(name + ".geo", "plane_strain", interface, 773.15, 293.15));
  EXPECT_TRUE(run.finished) << run.reason;
  return run.history.at("Ti[K]").back();
}

const std::string k_fit_laws = R"(conductance = "2000 W/m2/K"
gap_law = "gas"
gas_conductivity = "0.05 W/m/K"
)";
const std::string k_contact = R"([[contact]]
name = "fit"
slave = "part_out"
master = "mould_in"
[contact.heat]
)" + k_fit_laws,
                  k_interface = R"([[interface]]
bodies = ["part", "mould"]
[interface.heat]
)" + k_fit_laws;

/// 397.35 °C is the closed form of the cylinder that both meshes stand for.
TEST(CurvedFit, ConductsAsTheCylinderThatItsFacetsStandFor) {
  const double right = 397.35 + 273.15;
  EXPECT_NEAR(fitted("fit_6_8", 6, 8, k_contact), right, 2);
  EXPECT_NEAR(fitted("fit_8_6", 8, 6, k_contact), right, 2);
  EXPECT_NEAR(fitted("fit_6_8_interface", 6, 8, k_interface), right, 2);
  EXPECT_NEAR(fitted("fit_24_31", 24, 31, k_contact), right, 0.5);
}

TEST(CurvedFit, FindsItsPartnersFarFromTheOrigin) {
  EXPECT_NEAR(fitted("fit_far", 6, 8, k_contact, 1e5), fitted("fit_near", 6, 8, k_contact), 1e-6);
}

/// A drawn gap of a tenth of a millimetre, into which facets reach by a quarter of it, stays what it is.
TEST(CurvedFit, KeepsAGapThatIsDrawn) {
  k_here.write("metal.toml", k_metal);
  k_here.write("drawn.geo", rings({4, 20, 20.1, 50}, 6, 8));
  const auto run = k_here.run("drawn", rings_case("drawn.geo", "plane_strain", k_contact, 773.15, 293.15));
  ASSERT_TRUE(run.finished) << run.reason;
  // Resistances of a metre of the whole, over 2π: metal, the gap with the gas in it, metal.
  const double k = 200, gap = 0.02 * std::log(20.1 / 20), h = 0.05 / (gap + 0.05 / 2000),
               of_part = std::log(20.0 / 4) / k, of_gap = 1 / (0.02 * h), of_mould = std::log(50 / 20.1) / k;
  EXPECT_NEAR(run.history.at("Ti[K]").back(), 773.15 - 480 * of_part / (of_part + of_gap + of_mould), 4);
}

/// Concentric cylinders: q' = 2π r_1 σ (T_1⁴ − T_2⁴)/(1/ε_1 + (r_1/r_2)(1/ε_2 − 1)) between the skins' own
/// temperatures, which the conduction through both makes a little less than those that are held.
double radiated(double e1, double e2) {
  constexpr double k_sigma = 5.670374419e-8, k = 200;
  const double r1 = 0.02, r2 = 0.04, factor = 1 / (1 / e1 + r1 / r2 * (1 / e2 - 1));
  double q = 0;  // by bisection, per radian
  for (double low = 0, high = 1e5; high - low > 1e-9 * high;) {
    q = 0.5 * (low + high);
    const double t1 = 1000 - q * std::log(2.0) / k, t2 = 300 + q * std::log(50.0 / 40) / k;
    (r1 * k_sigma * factor * (std::pow(t1, 4) - std::pow(t2, 4)) > q ? low : high) = q;
  }
  return q;
}

double radiation_between(const std::string& name, const std::string& kind, const std::string& mesh,
                         bool part_is_slave, double part_emissivity, double mould_emissivity,
                         const std::string& groups = "") {
  k_here.write("metal.toml", k_metal);
  k_here.write(name + ".geo", mesh);
  const std::string contact = fmt::format(
      R"([[contact]]
name = "gap"
slave = "{}"
master = "{}"
search_distance = "30 mm"
[contact.heat]
conductance = "1e-6 W/m2/K"
gap_law = "constant"
slave_emissivity = {}
master_emissivity = {}
)",
      part_is_slave ? "part_out" : "mould_in", part_is_slave ? "mould_in" : "part_out",
      part_is_slave ? part_emissivity : mould_emissivity, part_is_slave ? mould_emissivity : part_emissivity);
  const auto run = k_here.run(name, rings_case(name + ".geo", kind, groups + contact, 1000, 300));
  EXPECT_TRUE(run.finished) << run.reason;
  return std::abs(run.history.at("contact_heat[W]").back());
}

TEST(RadiationAcrossACurvedGap, IsThatOfConcentricCylindersWhateverSideIsTheSlave) {
  for (const auto& [e1, e2] : {std::pair(0.8, 0.3), std::pair(1.0, 1.0), std::pair(0.2, 0.9)}) {
    const double right = radiated(e1, e2) * 2 * std::numbers::pi;
    for (const bool part_is_slave : {true, false})
      EXPECT_NEAR(radiation_between(fmt::format("plane_{}_{}", e1, part_is_slave), "plane_strain",
                                    whole_rings({10, 20, 40, 50}, 30, 36), part_is_slave, e1, e2),
                  right, 1e-3 * right)
          << e1 << part_is_slave;
  }
}

/// Quarters of two tubes, 12 mm high, each in tetrahedra of its own.
const std::string k_quarter_tubes = R"(SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 12, 20, Pi/2}; Cylinder(2) = {0, 0, 0, 0, 0, 12, 10, Pi/2};
a() = BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(11) = {0, 0, 0, 0, 0, 12, 50, Pi/2}; Cylinder(12) = {0, 0, 0, 0, 0, 12, 40, Pi/2};
b() = BooleanDifference{ Volume{11}; Delete; }{ Volume{12}; Delete; };
Physical Volume("part") = {a()}; Physical Volume("mould") = {b()};
MeshSize{ PointsOf{ Volume{a()}; } } = 2.5;
MeshSize{ PointsOf{ Volume{b()}; } } = 4;
)";

std::string skins_of_quarter_tubes() {
  std::string groups;
  for (const auto& [name, body, at] :
       {std::tuple("part_in", "part", 7.07), std::tuple("part_out", "part", 14.14),
        std::tuple("mould_in", "mould", 28.28), std::tuple("mould_out", "mould", 35.36)})
    groups += fmt::format(
        "[[mesh.group]]\nname = \"{}\"\nowner = \"{}\"\nnearest = [\"{} mm\", \"{} mm\", \"6 mm\"]\n", name,
        body, at, at);
  return groups;
}

/// Where both bodies end at planes of symmetry, their facets lean past each other's ends: the same heat
/// crosses all the same, for each metre of the skin that its facets have.
TEST(RadiationAcrossACurvedGap, IsThatOfTubesOfWhichAQuarterIsModelled) {
  const double right = radiated(0.8, 0.3) * 0.5 * std::numbers::pi * 0.012;
  for (const bool part_is_slave : {true, false})
    EXPECT_NEAR(radiation_between(fmt::format("quarter_tubes_{}", part_is_slave), "solid", k_quarter_tubes,
                                  part_is_slave, 0.8, 0.3, skins_of_quarter_tubes()),
                right, 2.5e-3 * right)
        << part_is_slave;
}

/// The same of quarters of rings in the plane.
TEST(RadiationAcrossACurvedGap, IsThatOfRingsOfWhichAQuarterIsModelled) {
  const double right = radiated(0.8, 0.3) * 0.5 * std::numbers::pi;
  for (const bool part_is_slave : {true, false})
    EXPECT_NEAR(radiation_between(fmt::format("quarter_rings_{}", part_is_slave), "plane_strain",
                                  rings({10, 20, 40, 50}, 20, 23), part_is_slave, 0.8, 0.3),
                right, 1e-3 * right)
        << part_is_slave;
}

}  // namespace
