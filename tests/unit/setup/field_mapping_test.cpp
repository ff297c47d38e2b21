/// The temperatures of one mesh on another one: the enthalpy is kept.
#include "setup/field_mapping.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>

#include "input/keys.hpp"
#include "mesh/making/parametric_meshes.hpp"
#include "mesh/raw_mesh.hpp"
#include "results/formats/field_reader.hpp"
#include "results/formats/vtu.hpp"
#include "setup/case_file.hpp"
#include "setup/initial_temperature.hpp"
#include "system/log.hpp"

namespace solidus::setup {
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
  cases::CaseSpec spec(AnalysisKind kind, const std::string& more = {}) const {
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
    fields.add({"temperature", "K", 1, mesh::FieldPlace::node, values});
    if (!solid_fraction.empty())
      fields.add({"solid_fraction", "1", 1, mesh::FieldPlace::node, solid_fraction});
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

TEST_F(FieldMapping, AFileOfAnotherPlaceIsNamed) {
  mesh::Mesh elsewhere = block(Shape::tri3, 0.2, {13, 7});
  for (mesh::Point& x : elsewhere.x) x[1] += 0.05;
  write(elsewhere, wavy);
  const mesh::Mesh mesh = block(Shape::quad4, 0.2, {8, 9});
  logging::clear_warnings();
  const InitialTemperatures start(spec(AnalysisKind::plane_strain), {alloy(40)}, mesh);
  ASSERT_EQ(logging::warnings().size(), 1U);
  EXPECT_THAT(logging::warnings()[0], HasSubstr("of it lies outside of the grid of"));
  EXPECT_THAT(logging::warnings()[0], HasSubstr("up to 0.05 m away"));
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

/// A box of n[0] × n[1] × n[2] hexahedra as OpenFOAM stores it: faces within first, then those of the
/// boundary.
class FoamBox {
 public:
  FoamBox(std::array<int, 3> n, std::array<double, 3> size) : n_(n), size_(size) {}

  std::vector<mesh::Point> centres() const {
    std::vector<mesh::Point> all;
    for (int k = 0; k < n_[2]; ++k)
      for (int j = 0; j < n_[1]; ++j)
        for (int i = 0; i < n_[0]; ++i)
          all.push_back(
              {size_[0] * (i + 0.5) / n_[0], size_[1] * (j + 0.5) / n_[1], size_[2] * (k + 0.5) / n_[2]});
    return all;
  }
  double cell_volume() const { return size_[0] * size_[1] * size_[2] / (n_[0] * n_[1] * n_[2]); }

  void write_mesh(const fs::path& folder) const {
    fs::create_directories(folder);
    std::vector<std::string> within, outside, owners, outer_owners, neighbours;
    const auto face = [&](std::array<int, 3> cell, int axis, bool upper) {  // normal along +axis if upper
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      std::string text = "4(";
      for (const auto& [da, db] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
        std::array<int, 3> p = cell;
        p[static_cast<std::size_t>(axis)] += upper ? 1 : 0;
        p[static_cast<std::size_t>(a)] += upper ? da : db;
        p[static_cast<std::size_t>(b)] += upper ? db : da;
        text += std::to_string((p[2] * (n_[1] + 1) + p[1]) * (n_[0] + 1) + p[0]) + " ";
      }
      return text + ")";
    };
    const auto number = [&](std::array<int, 3> c) { return (c[2] * n_[1] + c[1]) * n_[0] + c[0]; };
    for (int k = 0; k < n_[2]; ++k)
      for (int j = 0; j < n_[1]; ++j)
        for (int i = 0; i < n_[0]; ++i)
          for (int axis = 0; axis < 3; ++axis) {
            std::array<int, 3> cell{i, j, k}, next = cell;
            ++next[static_cast<std::size_t>(axis)];
            const bool last = next[static_cast<std::size_t>(axis)] == n_[static_cast<std::size_t>(axis)];
            (last ? outside : within).push_back(face(cell, axis, true));
            (last ? outer_owners : owners).push_back(std::to_string(number(cell)));
            if (!last) neighbours.push_back(std::to_string(number(next)));
            if (cell[static_cast<std::size_t>(axis)] > 0) continue;
            outside.push_back(face(cell, axis, false));
            outer_owners.push_back(std::to_string(number(cell)));
          }
    std::vector<std::string> points;
    for (int k = 0; k <= n_[2]; ++k)
      for (int j = 0; j <= n_[1]; ++j)
        for (int i = 0; i <= n_[0]; ++i)
          points.push_back(
              fmt::format("({} {} {})", size_[0] * i / n_[0], size_[1] * j / n_[1], size_[2] * k / n_[2]));
    within.insert(within.end(), outside.begin(), outside.end());
    owners.insert(owners.end(), outer_owners.begin(), outer_owners.end());
    list(folder / "points", "vectorField", points);
    list(folder / "faces", "faceList", within);
    list(folder / "owner", "labelList", owners);
    list(folder / "neighbour", "labelList", neighbours);
  }
  static void write_field(const fs::path& file, const std::vector<double>& values,
                          const char* format = "ascii") {
    fs::create_directories(file.parent_path());
    std::ofstream out(file);
    out.precision(17);
    out << "/* OpenFOAM */\nFoamFile\n{ version 2.0; format " << format
        << "; class volScalarField; object T; }\n"
        << "dimensions [0 0 0 1 0 0 0];  // K\n\ninternalField nonuniform List<scalar>\n"
        << values.size() << "\n(\n";
    for (const double value : values) out << value << "\n";
    out << ")\n;\nboundaryField { walls { type zeroGradient; } }\n";
  }

 private:
  static void list(const fs::path& file, const char* kind, const std::vector<std::string>& entries) {
    std::ofstream out(file);
    out << "FoamFile\n{\n    format ascii;\n    class " << kind << ";\n}\n// * * * //\n"
        << entries.size() << "\n(\n";
    for (const std::string& entry : entries) out << entry << "\n";
    out << ")\n";
  }

  std::array<int, 3> n_;
  std::array<double, 3> size_;
};

TEST_F(FieldMapping, CellsOfOpenFoamKeepTheirEnthalpy) {
  const FoamBox box({7, 5, 4}, {0.2, 0.1, 0.05});
  box.write_mesh(folder_ / "filling/constant/polyMesh");
  std::vector<double> temperature;
  for (const mesh::Point& x : box.centres()) temperature.push_back(wavy(x));
  FoamBox::write_field(folder_ / "filling/0.5/T", temperature);
  cases::CaseSpec with = spec(AnalysisKind::plane_strain);  // for its keys
  with.analysis.kind = AnalysisKind::solid;
  auto place = std::make_shared<PlaceSpec>(*with.bodies[0].initial_temperature.place);
  place->file = (folder_ / "filling/0.5").string();
  place->column = "T";
  with.bodies[0].initial_temperature.place = place;
  const material::Material m = alloy(40);
  double had = 0;
  for (const double t : temperature) had += box.cell_volume() * m.enthalpy().upper(t);
  for (const Shape shape : {Shape::tet4, Shape::hex8, Shape::tet10}) {
    mesh::RawMesh raw = mesh::make_block({{0.2, 0.1, 0.05}, {}, {6, 4, 3}, "bar"}, shape);
    mesh::validate_and_orient(raw, "bar");
    const mesh::Mesh target = mesh::distribute(raw, {"bar"}, {});
    const InitialTemperatures start(with, {m}, target);
    EXPECT_NEAR(total(target, AnalysisKind::solid, start) / had, 1, 1e-12);
    const auto [low, high] = std::minmax_element(temperature.begin(), temperature.end());
    EXPECT_GE(start.ranges()[0].low, *low - 1e-9);
    EXPECT_LE(start.ranges()[0].high, *high + 1e-9);
    double worst = 0;
    for (std::size_t i = 0; i < target.x.size(); ++i)
      worst = std::max(worst, std::abs(start.temperature(static_cast<Index>(i), 0) - wavy(target.x[i])));
    EXPECT_LT(worst, 75);  // cells of 29 × 20 mm, 3 K/mm
  }
}

TEST_F(FieldMapping, FoldersThatCannotBeReadAreNamed) {
  const FoamBox box({2, 1, 1}, {0.2, 0.1, 0.05});
  box.write_mesh(folder_ / "filling/constant/polyMesh");
  const auto complaint = [&](const std::string& field) -> std::string {
    try {
      results::read_field(folder_ / "filling/1", field, -1, 1, {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  FoamBox::write_field(folder_ / "filling/1/T", {900, 800}, "binary");
  EXPECT_THAT(complaint("T"), HasSubstr("foamFormatConvert"));
  FoamBox::write_field(folder_ / "filling/1/T", {900, 800, 700});
  EXPECT_THAT(complaint("T"), HasSubstr("3 values, the mesh 2 cells"));
  EXPECT_THAT(complaint("U"), HasSubstr("allowed: T"));
  FoamBox::write_field(folder_ / "filling/1/T", {900, 800});
  // Eighty million blanks in 80 kB.
  const fs::path packed = folder_ / "filling/1/T.gz";
  {
    const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(packed.c_str(), "wb9"), gzclose);
    const std::string blanks(1'000'000, ' ');
    for (int i = 0; i < 80; ++i) gzwrite(file.get(), blanks.data(), static_cast<unsigned>(blanks.size()));
  }
  fs::rename(folder_ / "filling/1/T", folder_ / "filling/1/U");
  EXPECT_THAT(complaint("T"), HasSubstr("more than 100 times its size"));
  fs::remove(packed);
  fs::rename(folder_ / "filling/1/U", folder_ / "filling/1/T");
  std::ofstream(folder_ / "filling/constant/polyMesh/owner")
      << "FoamFile\n{ format ascii; class labelList; }\n11\n(0 0";
  EXPECT_THAT(complaint("T"),
              testing::AllOf(HasSubstr("owner:3"), HasSubstr("more than the file has room for")));
  fs::remove(folder_ / "filling/constant/polyMesh/owner");
  EXPECT_THAT(complaint("T"), HasSubstr("no file 'owner'"));
  fs::remove_all(folder_ / "filling/constant");
  EXPECT_THAT(complaint("T"), HasSubstr("no time of a case of OpenFOAM"));
}

}  // namespace
}  // namespace solidus::setup
