/// The temperatures of one mesh on another one: the enthalpy is kept.
#include "model/field_mapping.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/keys.hpp"
#include "base/log.hpp"
#include "mesh/raw_mesh.hpp"
#include "mesh/shapes.hpp"
#include "model/case_file.hpp"
#include "model/initial_temperature.hpp"
#include "results/vtu.hpp"

namespace solidus::model {
namespace {

using mesh::Shape;
using ::testing::HasSubstr;

namespace fs = std::filesystem;

mesh::Mesh block(Shape shape, double length, std::vector<int> divisions) {
  mesh::RawMesh raw = mesh::make_block({{length, 0.1}, {}, std::move(divisions), "bar"}, shape);
  mesh::validate_and_orient(raw, "bar");
  return mesh::distribute(raw, {"bar"}, {});
}

material::Material alloy(double range) {
  material::Material m;
  m.name = "alloy";
  m.density = 2500;
  m.conductivity = Table(100.0);
  m.specific_heat = Table({300, 1000}, {900, 1100});
  m.phase_changes = {{"solidification", material::PhaseFraction::linear(900 - range, 900), 4e5, 0.0, true}};
  return m;
}

class FieldMapping : public ::testing::Test {
 protected:
  ~FieldMapping() override { fs::remove_all(folder_); }
  void SetUp() override { fs::create_directories(folder_); }

  /// A case whose bar starts with the field of the file.
  CaseSpec spec(AnalysisKind kind, const std::string& more = {}) const {
    const std::string name = kind == AnalysisKind::axisymmetric ? "axisymmetric" : "plane_strain";
    std::ofstream(folder_ / "case.toml") << "title = \"A bar\"\n[analysis]\nkind = \"" << name << R"("
physics = "heat"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["200 mm", "100 mm"]
divisions = [1, 1]
[time]
end = "10 s"
step = "1 s"
[[body]]
name = "bar"
material = "steel_mould"
initial_temperature = { file = "a.vtu", field = "temperature")"
                                         << more << " }\n";
    return load_case(folder_ / "case.toml").spec;
  }
  template <class T>
  std::vector<double> write(const mesh::Mesh& mesh, const T& temperature,
                            const std::vector<double>& solid_fraction = {}) const {
    std::vector<double> values;
    for (const mesh::Point& x : mesh.x) values.push_back(temperature(x));
    results::FieldSet fields;
    fields.add({"temperature", "K", 1, results::Place::node, values});
    if (!solid_fraction.empty()) fields.add({"solid_fraction", "1", 1, results::Place::node, solid_fraction});
    results::write_vtu(folder_ / "a.vtu", mesh, fields, 0);
    return values;
  }
  static double total(const mesh::Mesh& mesh, AnalysisKind kind, const InitialTemperatures& start) {
    const std::vector<double> w = closed_weights(mesh, 0, kind);
    double sum = 0;
    for (std::size_t i = 0; i < w.size(); ++i) sum += w[i] * start.enthalpy(static_cast<Index>(i), 0);
    return sum;
  }
  static double total(const mesh::Mesh& mesh, AnalysisKind kind, const std::vector<double>& temperature,
                      const material::EnthalpyCurve& curve) {
    const std::vector<double> w = closed_weights(mesh, 0, kind);
    double sum = 0;
    for (std::size_t i = 0; i < w.size(); ++i) sum += w[i] * curve.upper(temperature[i]);
    return sum;
  }

  fs::path folder_ = fs::temp_directory_path() / ("field_mapping_" + std::to_string(getpid()));
};

double wavy(const mesh::Point& x) {
  return 860 + 150 * std::sin(25 * x[0]) * std::cos(20 * x[1]);
}

TEST_F(FieldMapping, KeepsTheEnthalpyOfEveryElementOnEveryOther) {
  for (const AnalysisKind kind : {AnalysisKind::plane_strain, AnalysisKind::axisymmetric})
    for (const Shape from : {Shape::tri3, Shape::quad8})
      for (const Shape to : {Shape::tri3, Shape::tri6, Shape::quad4, Shape::quad8}) {
        const mesh::Mesh source = block(from, 0.2, {13, 7}), target = block(to, 0.2, {8, 9});
        const std::vector<double> values = write(source, wavy);
        const material::Material m = alloy(40);
        const InitialTemperatures start(spec(kind), {m}, target);
        const double had = total(source, kind, values, m.enthalpy()), has = total(target, kind, start);
        EXPECT_NEAR(has / had, 1, 1e-12);
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        EXPECT_GE(start.ranges()[0].low, *low - 1e-9);
        EXPECT_LE(start.ranges()[0].high, *high + 1e-9);
        double worst = 0;
        for (std::size_t i = 0; i < target.x.size(); ++i)
          worst = std::max(worst, std::abs(start.temperature(static_cast<Index>(i), 0) - wavy(target.x[i])));
        EXPECT_LT(worst, 60);  // 25 K/mm over elements of 15 to 25 mm, and a kink of the enthalpy
      }
}

TEST_F(FieldMapping, OnTheSameMeshNothingChanges) {
  const mesh::Mesh mesh = block(Shape::tri3, 0.2, {13, 7});
  const std::vector<double> values = write(mesh, wavy);
  const InitialTemperatures start(spec(AnalysisKind::plane_strain), {alloy(40)}, mesh);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(start.temperature(static_cast<Index>(i), 0), values[i], 1e-8);
}

TEST_F(FieldMapping, AUniformTemperatureStaysUniform) {
  write(block(Shape::tri3, 0.2, {13, 7}), [](const mesh::Point&) { return 777.0; });
  const mesh::Mesh mesh = block(Shape::quad8, 0.2, {3, 2});
  const InitialTemperatures start(spec(AnalysisKind::axisymmetric), {alloy(40)}, mesh);
  EXPECT_NEAR(start.ranges()[0].low, 777, 1e-9);
  EXPECT_NEAR(start.ranges()[0].high, 777, 1e-9);
}

TEST_F(FieldMapping, TheSolidFractionTellsHowFarAnIsothermalChangeHasCome) {
  const mesh::Mesh source = block(Shape::tri3, 0.2, {13, 7}), target = block(Shape::quad4, 0.2, {8, 9});
  const auto front = [](const mesh::Point& x) { return x[0] < 0.1 ? 900 - 1000 * (0.1 - x[0]) : 900.0; };
  std::vector<double> fraction;
  for (const mesh::Point& x : source.x) fraction.push_back(x[0] < 0.1 ? 1.0 : (0.2 - x[0]) / 0.1);
  write(source, front, fraction);
  const material::Material m = alloy(0);
  const InitialTemperatures start(spec(AnalysisKind::plane_strain), {m}, target);
  const std::vector<double> w = closed_weights(source, 0, AnalysisKind::plane_strain);
  double had = 0;
  for (std::size_t i = 0; i < w.size(); ++i)
    had += w[i] * (source.x[i][0] < 0.1 ? m.enthalpy().upper(front(source.x[i]))
                                        : m.enthalpy().lower(900) + (1 - fraction[i]) * 2500 * 4e5);
  EXPECT_NEAR(total(target, AnalysisKind::plane_strain, start) / had, 1, 1e-12);
}

TEST_F(FieldMapping, ABodyOfAnotherShapeIsInterpolatedWithAWarning) {
  write(block(Shape::tri3, 0.4, {26, 7}), wavy);
  const mesh::Mesh mesh = block(Shape::quad4, 0.2, {8, 9});
  logging::clear_warnings();
  const InitialTemperatures start(spec(AnalysisKind::plane_strain), {alloy(40)}, mesh);
  ASSERT_EQ(logging::warnings().size(), 1U);
  EXPECT_THAT(logging::warnings()[0], HasSubstr("its enthalpy is interpolated, not kept"));
  logging::clear_warnings();
}

TEST_F(FieldMapping, UnitsAndDimensionsMustFit) {
  write(block(Shape::tri3, 0.2, {13, 7}), [](const mesh::Point&) { return -5.0; });
  const mesh::Mesh mesh = block(Shape::quad4, 0.2, {8, 9});
  EXPECT_THAT([&] { InitialTemperatures(spec(AnalysisKind::plane_strain), {alloy(40)}, mesh); },
              ::testing::ThrowsMessage<InputError>(HasSubstr("temperatures above 0 K")));
  const InitialTemperatures celsius(spec(AnalysisKind::plane_strain, ", unit = \"degC\""), {alloy(40)}, mesh);
  EXPECT_NEAR(celsius.ranges()[0].low, 268.15, 1e-9);
}

}  // namespace
}  // namespace solidus::model
