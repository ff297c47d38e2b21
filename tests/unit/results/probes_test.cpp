#include "results/tables/probes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/making/parametric_meshes.hpp"
#include "mesh/raw_mesh.hpp"
#include "parallel/parallel.hpp"
#include "results/output/output_error.hpp"
#include "system/processes.hpp"

namespace solidus::results {
namespace {

using mesh::Mesh;
using mesh::Point;

// A block [1, 3] × [0, 1] m (x is the radius where it is axisymmetric) with a temperature that is linear in
// space, a displacement (x², −y) and the number of each cell's first node as a field of cells. The expected
// values are integrals by hand; linear fields are exact up to round-off.
struct Block : ::testing::Test {
  Mesh mesh;
  std::vector<double> temperature, displacement, first_node;
  FieldSet fields;

  Block() {
    mesh::OneBlock block;
    block.size = {2, 1};
    block.origin = {1, 0};
    block.divisions = {8, 5};
    const int rank = processes::rank();
    mesh::RawMesh raw;
    if (rank == 0) raw = mesh::make_block(block, mesh::Shape::tri3);
    mesh = mesh::distribute(raw, {"block"}, {});
    for (const Point& x : mesh.x) {
      temperature.push_back(at(x));
      displacement.insert(displacement.end(), {x[0] * x[0], -x[1]});
    }
    for (const mesh::ElementBlock& b : mesh.blocks)
      for (Index e = 0; e < b.size(); ++e)
        first_node.push_back(static_cast<double>(b.input_element[static_cast<std::size_t>(e)]));
    fields.add({"temperature", "K", 1, mesh::FieldPlace::node, temperature});
    fields.add({"displacement", "m", 2, mesh::FieldPlace::node, displacement});
    fields.add({"number", "1", 1, mesh::FieldPlace::cell, first_node});
  }

  static double at(const Point& x) { return 300 + 20 * x[0] - 7 * x[1]; }
  double value(const Probe& probe, AnalysisKind kind = AnalysisKind::plane_strain) const {
    return Probes(mesh, kind, {probe}, fields).values(fields).front();
  }
  std::string message(const Probe& probe) const {
    try {
      Probes(mesh, AnalysisKind::plane_strain, {probe}, fields);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
  static PointProbe point(const std::string& unit, const Point& x) {
    return {{{"T", unit}, "temperature", 0, {"case.toml", 3, 1}}, x, -1};
  }
  static GroupProbe group(const std::string& name, Statistic statistic, const std::string& unit = "K") {
    return {{{"T", unit}, "temperature", 0, {"case.toml", 3, 1}}, name, statistic};
  }
};

TEST_F(Block, PointTakesTheInterpolatedValueInItsUnit) {
  for (const Point& x : {Point{1.37, 0.81, 0}, Point{1, 0, 0}, Point{3, 1, 0}, Point{2, 0.4, 0}}) {
    EXPECT_NEAR(value(point("K", x)), at(x), 1e-10);
    EXPECT_NEAR(value(point("degC", x)), at(x) - 273.15, 1e-10);
  }
}

TEST_F(Block, PointTakesAComponentOrTheMagnitude) {
  PointProbe probe{{{"u", "mm"}, "displacement", 1, {}}, {2, 0.6, 0}, -1};
  EXPECT_NEAR(value(probe), -600, 1e-9);
  probe.component = k_magnitude;  // at a node, x = 2: exact
  EXPECT_NEAR(value(probe), 1000 * std::hypot(4.0, 0.6), 1e-9);
}

TEST_F(Block, PointOfACellFieldTakesTheElementAroundIt) {
  const PointProbe probe{{{"n", "1"}, "number", 0, {}}, {1.05, 0.02, 0}, -1};
  const double n = value(probe);
  EXPECT_EQ(n, std::floor(n)) << "one element's value, no mixture";
  EXPECT_GE(n, 1);
}

TEST_F(Block, MeanOverABodyWeighsByVolume) {
  EXPECT_NEAR(value(group("block", Statistic::mean)), at({2, 0.5, 0}), 1e-10);
  // Axisymmetric: the mean radius by volume is (∫r² dr)/(∫r dr) = (26/3)/4.
  EXPECT_NEAR(value(group("block", Statistic::mean), AnalysisKind::axisymmetric), at({26.0 / 12, 0.5, 0}),
              1e-10);
}

TEST_F(Block, MeanOverASurfaceWeighsByArea) {
  EXPECT_NEAR(value(group("x_max", Statistic::mean)), at({3, 0.5, 0}), 1e-10);
  EXPECT_NEAR(value(group("y_max", Statistic::mean), AnalysisKind::axisymmetric), at({26.0 / 12, 1, 0}),
              1e-10);
}

TEST_F(Block, IntegralHasTheUnitOfFieldTimesMeasure) {
  EXPECT_NEAR(value(group("block", Statistic::integral, "K m3")), 2 * at({2, 0.5, 0}), 1e-9);
  const double area = 2 * std::numbers::pi * 3;  // of the whole revolution
  EXPECT_NEAR(value(group("x_max", Statistic::integral, "K m2"), AnalysisKind::axisymmetric),
              area * at({3, 0.5, 0}), 1e-8);
  EXPECT_NE(message(group("block", Statistic::integral, "K")).find("does not fit"), std::string::npos);
}

TEST_F(Block, ExtremesAreThoseOfTheNodesOfTheGroup) {
  EXPECT_NEAR(value(group("block", Statistic::minimum)), at({1, 1, 0}), 1e-12);
  EXPECT_NEAR(value(group("block", Statistic::maximum)), at({3, 0, 0}), 1e-12);
  EXPECT_NEAR(value(group("x_min", Statistic::maximum)), at({1, 0, 0}), 1e-12);
  const GroupProbe cells{{{"n", "1"}, "number", 0, {}}, "block", Statistic::maximum};
  EXPECT_GE(value(cells), 80);  // 8 × 5 cells cut in two
}

TEST_F(Block, MeanAndIntegralOfAFieldOfElementsWeighByVolume) {
  FieldSet of_cells;
  of_cells.add({"x", "m", 1, mesh::FieldPlace::cell, {}, [&] {
                  std::vector<double> centres;
                  for (const mesh::ElementBlock& b : mesh.blocks)
                    for (Index e = 0; e < b.size(); ++e) {
                      double sum = 0;
                      for (int a = 0; a < 3; ++a)
                        sum += mesh.x[static_cast<std::size_t>(b.element(e)[a])][0] / 3;
                      centres.push_back(sum);
                    }
                  return centres;
                }});
  const auto asked = [](Statistic statistic, const char* unit, const char* group = "block") {
    return std::vector<Probe>{GroupProbe{{{"x", unit}, "x", 0, {}}, group, statistic}};
  };
  const auto value_of = [&](AnalysisKind kind, const std::vector<Probe>& probes) {
    return Probes(mesh, kind, probes, of_cells).values(of_cells)[0];
  };
  EXPECT_NEAR(value_of(AnalysisKind::plane_strain, asked(Statistic::mean, "m")), 2, 1e-12);
  EXPECT_NEAR(value_of(AnalysisKind::plane_strain, asked(Statistic::integral, "m m3")), 4, 1e-12);
  // On a side the elements behind its faces: two corners of theirs on it, the third a cell of 0.25 m inside.
  const double behind = 3 - 0.25 / 3;
  for (const Statistic statistic : {Statistic::mean, Statistic::minimum, Statistic::maximum})
    EXPECT_NEAR(value_of(AnalysisKind::plane_strain, asked(statistic, "m", "x_max")), behind, 1e-12);
  EXPECT_NEAR(value_of(AnalysisKind::axisymmetric, asked(Statistic::integral, "m m2", "x_max")),
              2 * std::numbers::pi * 3 * behind, 1e-10);
  // ∫ r² dr/∫ r dr, but for what elements of 0.25 m average out
  EXPECT_NEAR(value_of(AnalysisKind::axisymmetric, asked(Statistic::mean, "m")), 26. / 12, 2e-3);
}

// Not held in between: the next row computes it again, and sees what has changed.
TEST_F(Block, ComputedFieldIsComputedOnceARow) {
  const auto in_cells = [](const char* name, Statistic statistic) {
    return GroupProbe{{{name, "1"}, "number", 0, {}}, "block", statistic};
  };
  const std::vector<Probe> asked = {in_cells("low", Statistic::minimum), point("K", {2, 0.5, 0}),
                                    in_cells("high", Statistic::maximum)};
  int computed = 0;
  FieldSet lazy;
  lazy.add({"temperature", "K", 1, mesh::FieldPlace::node, temperature});
  lazy.add({"number", "1", 1, mesh::FieldPlace::cell, {}, [&] {
              ++computed;
              return first_node;
            }});
  const Probes probes(mesh, AnalysisKind::plane_strain, asked, lazy);
  EXPECT_EQ(computed, 0);
  EXPECT_EQ(probes.values(lazy), probes.values(fields));
  EXPECT_EQ(computed, 1);
  for (double& n : first_node) n += 1000;
  EXPECT_EQ(probes.values(lazy), probes.values(fields));
  EXPECT_EQ(computed, 2);
}

// To compute it may be collective, so that processes without a node of the probe take part.
TEST_F(Block, FieldThatBodiesDifferInIsReadForTheBodyOfTheProbeByAllProcesses) {
  FieldSet lazy;
  lazy.add({"temperature",
            "K",
            1,
            mesh::FieldPlace::node,
            {},
            [&] {
              parallel::global_sum(1.0);
              return std::vector<double>(mesh.x.size(), 500.0);
            },
            {},
            false,
            [&](int body) {
              parallel::global_sum(1.0);
              return std::vector<double>(mesh.x.size(), 600.0 + body);
            }});
  ASSERT_GT(mesh.surfaces.count("x_min"), 0u);
  const std::vector<Probe> asked = {point("K", {1, 0, 0}), group("block", Statistic::maximum),
                                    group("x_min", Statistic::mean)};
  const Probes probes(mesh, AnalysisKind::plane_strain, asked, lazy);
  const std::vector<double> values = probes.values(lazy);
  EXPECT_EQ(values[0], 600);
  EXPECT_EQ(values[1], 600);
  EXPECT_NEAR(values[2], 500, 1e-9);
}

TEST_F(Block, CombinationsAreTakenBeforeUnitsAreShown) {
  PointProbe inner = point("degC", {1, 0.5, 0}), outer = point("K", {3, 0.5, 0});
  inner.column.name = "inner";
  outer.column.name = "outer";
  const LinearProbe drop{{"drop", "degC"}, {{1, "outer"}, {-1, "inner"}}, {}};
  const LinearProbe mean{{"mean", "degC"}, {{0.5, "outer"}, {0.5, "inner"}}, {}};
  const Probes probes(mesh, AnalysisKind::plane_strain, {inner, outer, drop, mean}, fields);
  const auto values = probes.values(fields);
  EXPECT_NEAR(values[2], 40, 1e-10) << "a difference has no zero point";
  EXPECT_NEAR(values[3], at({2, 0.5, 0}) - 273.15, 1e-10) << "a mean has one";
  EXPECT_EQ(probes.columns()[2].header(), "drop[degC]");
}

TEST_F(Block, ErrorsNameTheProbeAndWhatThereIs) {
  EXPECT_EQ(message(point("K", {3.5, 0.5, 0})),
            "case.toml:3:1: probe 'T': the point (3.5, 0.5, 0) m lies outside the mesh\n"
            "  the nearest element is 0.5 m away");
  EXPECT_NE(message(group("wall", Statistic::mean)).find("there is no group 'wall'\n  groups: block, x_max"),
            std::string::npos)
      << message(group("wall", Statistic::mean));
  PointProbe probe = point("K", {2, 0.5, 0});
  probe.field = "temprature";
  EXPECT_NE(
      message(probe).find("there is no field 'temprature'\n  fields: temperature, displacement, number"),
      std::string::npos);
  EXPECT_NE(message(point("mm", {2, 0.5, 0})).find("the unit 'mm' does not fit"), std::string::npos);
  EXPECT_NE(message(LinearProbe{{"gap", "mm"}, {{1, "a"}}, {}}).find("there is no probe 'a' before it"),
            std::string::npos);
}

TEST_F(Block, PointJustOutsideIsTakenAtTheNearestPlace) {
  // 1 % of an element of 0.25 m: a chord below its arc.
  EXPECT_NEAR(value(point("K", {3.0025, 0.5, 0})), at({3, 0.5, 0}), 1e-8);
}

TEST_F(Block, ValueThatIsNotANumberIsRefused) {
  for (double& t : temperature) t = std::numeric_limits<double>::quiet_NaN();
  for (const Probe& probe :
       {Probe(point("K", {2, 0.5, 0})), Probe(group("block", Statistic::mean)),
        Probe(group("block", Statistic::maximum)), Probe(group("block", Statistic::minimum))}) {
    const Probes probes(mesh, AnalysisKind::plane_strain, {probe}, fields);
    EXPECT_THROW(probes.values(fields), NotFiniteError);
  }
}

TEST(ComponentIndex, KnowsTheNamesOfTheAnalysis) {
  using enum AnalysisKind;
  EXPECT_EQ(component_index("", 1, solid), 0);
  EXPECT_EQ(component_index("y", 2, plane_strain), 1);
  EXPECT_EQ(component_index("z", 2, axisymmetric), 1);
  EXPECT_EQ(component_index("z", 3, solid), 2);
  EXPECT_EQ(component_index("zz", 6, axisymmetric), 1);
  EXPECT_EQ(component_index("tt", 6, axisymmetric), 2);
  EXPECT_EQ(component_index("zz", 6, plane_strain), 2);
  EXPECT_EQ(component_index("magnitude", 3, solid), k_magnitude);
  EXPECT_THROW(component_index("z", 2, plane_strain), std::invalid_argument);
  EXPECT_THROW(component_index("x", 1, solid), std::invalid_argument);
}

TEST_F(Block, GlobalRepeatsAColumnOfTheRunTimesAFactor) {
  const std::vector<Reading> globals = {{{"cycle", "1"}, 7}, {{"contact_force", "N"}, 98000}};
  const GlobalProbe pass{{"pass", ""}, "cycle", 1, {}};
  const GlobalProbe force{{"normal_force", "kN"}, "contact_force", 0.01, {}};
  const LinearProbe both{{"none", "N"}, {{1, "normal_force"}, {-1, "normal_force"}}, {}};
  const Probes probes(mesh, AnalysisKind::plane_strain, {pass, force, both}, fields, globals);
  EXPECT_EQ(probes.columns()[0].header(), "pass");
  EXPECT_EQ(probes.columns()[1].header(), "normal_force[kN]");
  const std::vector<double> values = probes.values(fields, globals);
  EXPECT_EQ(values[0], 7);
  EXPECT_NEAR(values[1], 0.98, 1e-15);
  EXPECT_EQ(values[2], 0);
}

TEST_F(Block, GlobalSaysWhichColumnsThereAre) {
  EXPECT_NE(message(GlobalProbe{{"pass", ""}, "cycle", 1, {}}).find("history.csv has no column 'cycle'"),
            std::string::npos);
}

}  // namespace
}  // namespace solidus::results
