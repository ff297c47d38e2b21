/// A bar that is heated: free it grows without stress, clamped at its ends it carries σ = −E(Θ) e(Θ), with
/// the thermal strain of 2.51, e = α(Θ)(Θ − Θ_ref) − α(Θ_0)(Θ_0 − Θ_ref). Modulus and expansion vary with
/// temperature, so both are functions of the temperature alone, whatever the way there.
#include <gtest/gtest.h>

#include "mechanics_bodies.hpp"

namespace solidus {
namespace {

using mesh::Shape;
using test::Body;
using test::Lattice;
using test::Solved;

constexpr double k_start = 300, k_end = 500, k_reference = 293.15;  // [K]

double young(double t) {
  return 2e11 - (t - 300) * 4e10 / 200;
}
double expansion(double t) {
  return 1e-5 + (t - 300) * 0.4e-5 / 200;
}
double free_strain(double t) {
  return expansion(t) * (t - k_reference) - expansion(k_start) * (k_start - k_reference);
}

Body bar(Shape shape, AnalysisKind kind) {
  material::Material m = test::elastic_material(2e11, 0.3);
  m.young_modulus = Table({300, 500}, {2e11, 1.6e11});
  m.expansion = Table({300, 500}, {1.0e-5, 1.4e-5});
  m.expansion_reference = k_reference;
  Lattice lattice{.shape = shape, .cells = {2, 3, 2}, .size = {0.1, 0.3, 0.1}, .distortion = 0.1};
  Body body(lattice, kind, m);
  body.hold("bottom", 1);
  if (kind == AnalysisKind::solid) {  // no rigid motion, nothing else
    body.hold("left", 0);
    body.hold("back", 2);
  }
  return body;
}

const std::vector<std::pair<Shape, AnalysisKind>> k_bars{
    {Shape::tri3, AnalysisKind::axisymmetric},  {Shape::tri6, AnalysisKind::axisymmetric},
    {Shape::quad4, AnalysisKind::axisymmetric}, {Shape::quad8, AnalysisKind::axisymmetric},
    {Shape::tet4, AnalysisKind::solid},         {Shape::tet10, AnalysisKind::solid},
    {Shape::hex8, AnalysisKind::solid},         {Shape::hex20, AnalysisKind::solid}};

/// Mean, and largest deviation from a number, of a component of stress or strain over all elements.
struct Spread {
  double mean = 0, deviation = 0;
};
Spread spread(const Body& body, const std::vector<std::vector<std::array<double, 6>>>& fields, std::size_t i,
              double exact) {
  double sum = 0, count = 0, worst = 0;
  for (std::size_t b = 0; b < fields.size(); ++b)
    for (Index e = 0; e < body.mesh.blocks[b].n_counted; ++e) {
      const double value = fields[b][static_cast<std::size_t>(e)][i];
      sum += value;
      count += 1;
      worst = std::max(worst, std::abs(value - exact));
    }
  return {parallel::global_sum(sum) / parallel::global_sum(count), parallel::global_max(worst)};
}

struct Fields {
  std::vector<std::vector<std::array<double, 6>>> stress, strain;
  explicit Fields(const test::Solved& solved) {
    for (auto& block : test::element_fields(solved)) {
      stress.push_back(block.stress);
      strain.push_back(block.strain);
    }
  }
};

/// Heats in ten steps and hands every state to `look`(row, T, fields).
template <class Look>
void heat_up(Body& body, Look look) {
  body.temperature.assign(body.mesh.x.size(), k_start);
  Solved solved(body);
  for (int step = 1; step <= 10; ++step) {
    const double t = k_start + (k_end - k_start) * step / 10;
    body.temperature.assign(body.mesh.x.size(), t);
    solved.step(body, step, 1);
    look(static_cast<std::size_t>(step - 1), t, Fields(solved));
  }
}

using Rows = std::vector<std::vector<double>>;

void write(const std::string& name, const std::string& exact, const std::string& unit, const Rows& rows) {
  std::string header = "Temperature[K]," + exact;
  for (const auto& [shape, kind] : k_bars) header += "," + std::string(mesh::name(shape)) + unit;
  auto out = verification::table(name, header);
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) out << row[i] << (i + 1 < row.size() ? "," : "\n");
}

TEST(FreeBar, GrowsByItsThermalStrainWithoutStress) {
  Rows rows(10);
  for (const auto& [shape, kind] : k_bars) {
    Body body = bar(shape, kind);
    heat_up(body, [&](std::size_t row, double t, const Fields& fields) {
      const double exact = free_strain(t);
      if (rows[row].empty()) rows[row] = {t, 1e3 * exact};
      rows[row].push_back(1e3 * spread(body, fields.strain, 1, exact).mean);
      for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_LT(spread(body, fields.strain, i, i < 3 ? exact : 0).deviation, 1e-9 * exact);
        // of the stress that the clamped bar has
        EXPECT_LT(spread(body, fields.stress, i, 0).deviation, 1e-9 * young(t) * exact);
      }
    });
  }
  write("mechanics_free_bar", "exact_strain[1e-3]", "[1e-3]", rows);
}

TEST(ClampedBar, CarriesTheModulusTimesItsThermalStrain) {
  Rows rows(10);
  for (const auto& [shape, kind] : k_bars) {
    Body body = bar(shape, kind);
    body.hold("top", 1);
    heat_up(body, [&](std::size_t row, double t, const Fields& fields) {
      const double exact = -young(t) * free_strain(t);
      if (rows[row].empty()) rows[row] = {t, 1e-6 * exact};
      const Spread axial = spread(body, fields.stress, 1, exact);
      rows[row].push_back(1e-6 * axial.mean);
      EXPECT_LT(axial.deviation, 1e-9 * std::abs(exact));
      for (std::size_t i : {0u, 2u, 3u, 4u, 5u})
        EXPECT_LT(spread(body, fields.stress, i, 0).deviation, 1e-9 * std::abs(exact));
    });
  }
  write("mechanics_clamped_bar", "exact_stress[MPa]", "[MPa]", rows);
}

}  // namespace
}  // namespace solidus
