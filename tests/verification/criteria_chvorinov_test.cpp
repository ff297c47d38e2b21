/// Chvorinov's rule in sand: the time at which a casting has frozen goes with the square of its modulus V/A.
///
/// A metal that conducts well and freezes isothermally at T_m holds its surface there while the heat
/// q = ΔT b/√(π t), b = √(k ρ C) of the sand, flows off. All latent heat has gone when
///
///   plate     ρL V/A = 2 ΔT b √(t/π)                    N. Chvorinov, Giesserei 27 (1940) 177
///   cylinder  ρL R/2 = ΔT k R/α [2 √(τ/π) + τ/2 − τ^{3/2}/(6 √π) + τ²/16],  τ = α t/R²
///             H. S. Carslaw, J. C. Jaeger, Conduction of Heat in Solids (1959), 13.5 (8), integrated
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "csv.hpp"
#include "freezing_run.hpp"
#include "mesh/making/grid.hpp"
#include "mesh/raw_mesh.hpp"

namespace solidus {
namespace {

constexpr double k_melting = 900, k_cold = 300, k_latent = 1e9;  // [K], [K], [J/m³]
constexpr double k_sand = 0.6, k_sand_capacity = 1.65e6;         // [W/(m K)], [J/(m³ K)]
constexpr double k_diffusivity = k_sand / k_sand_capacity;

// A strip of metal from 0 to `size` in sand, one layer of cells, nodes common where they touch.
mesh::Mesh strip(double size, double h, double sand) {
  mesh::GridAxis x = mesh::uniform_axis(0, size, static_cast<int>(std::lround(size / h)));
  const mesh::GridAxis further = mesh::graded_axis(size, size + sand, h / 2, 10 * h);
  x.insert(x.end(), further.begin() + 1, further.end());
  mesh::RawMesh raw;
  const mesh::GridAxis y = {0, h};
  const auto surface = [](const mesh::Point&, const mesh::Point&) { return std::string(); };
  mesh::add_grid(raw, {{x, y}, mesh::Shape::quad4, "metal", {}, surface});
  mesh::RawGroup& metal = raw.groups.at("metal");
  mesh::RawGroup rest{2, {}};
  for (mesh::RawBlock& block : metal.blocks) {
    mesh::RawBlock inner{block.shape, {}, {}}, outer{block.shape, {}, {}};
    for (std::size_t e = 0; e < block.input_element.size(); ++e) {
      const auto first = block.nodes.begin() + static_cast<std::ptrdiff_t>(4 * e);
      double centre = 0;
      for (auto node = first; node != first + 4; ++node)
        centre += raw.x[static_cast<std::size_t>(*node)][0] / 4;
      mesh::RawBlock& to = centre < size ? inner : outer;
      to.nodes.insert(to.nodes.end(), first, first + 4);
      to.input_element.push_back(block.input_element[e]);
    }
    block = inner;
    rest.blocks.push_back(outer);
  }
  raw.groups["sand"] = rest;
  mesh::validate_and_orient(raw, "strip");
  return mesh::distribute(raw, {"metal", "sand"}, {});
}

double freezing_time(AnalysisKind kind, double size, double end) {
  material::Material sand;
  sand.name = "sand";
  sand.density = 1500;
  sand.conductivity = Table(k_sand);
  sand.specific_heat = Table(k_sand_capacity / 1500);
  const double h = 0.5e-3;
  const mesh::Mesh mesh = strip(size, h, 6 * std::sqrt(k_diffusivity * end));
  verification::Fields fields = verification::freeze(mesh, kind, {verification::light_metal(1000, 0), sand},
                                                     {}, {k_melting, k_cold}, 1.3 * end, end / 400);
  return *std::max_element(fields["solidified_at"].begin(), fields["solidified_at"].end());
}

double plate_time(double half_thickness) {
  const double b = std::sqrt(k_sand * k_sand_capacity);
  return std::numbers::pi / 4 * std::pow(k_latent * half_thickness / ((k_melting - k_cold) * b), 2);
}

double cylinder_time(double radius) {
  const auto heat = [&](double tau) {
    const double root = std::sqrt(std::numbers::pi);
    return (k_melting - k_cold) * k_sand * radius / k_diffusivity *
           (2 * std::sqrt(tau) / root + tau / 2 - std::pow(tau, 1.5) / (6 * root) + tau * tau / 16);
  };
  double low = 0, high = 10;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (heat(middle) < k_latent * radius / 2 ? low : high) = middle;
  }
  return high * radius * radius / k_diffusivity;
}

double slope(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double a = std::log(x[i]), b = std::log(y[i]);
    sx += a, sy += b, sxx += a * a, sxy += a * b;
  }
  const auto n = static_cast<double>(x.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

TEST(ChvorinovsRule, HoldsForPlatesAndCylindersInSand) {
  std::ofstream table = verification::csv(
      "criteria_chvorinov", "modulus[mm],plate[s],plate_exact[s],cylinder[s],cylinder_exact[s]");
  std::vector<double> moduli, plates, cylinders;
  for (const double modulus : {4e-3, 6e-3, 9e-3, 12e-3}) {
    moduli.push_back(modulus);
    const double plate = plate_time(modulus), cylinder = cylinder_time(2 * modulus);
    plates.push_back(freezing_time(AnalysisKind::plane_strain, modulus, plate));
    cylinders.push_back(freezing_time(AnalysisKind::axisymmetric, 2 * modulus, cylinder));
    table << 1e3 * modulus << ',' << plates.back() << ',' << plate << ',' << cylinders.back() << ','
          << cylinder << '\n';
    // The shell of solid metal cools a little, and the steps of the mesh at the interface.
    EXPECT_NEAR(plates.back() / plate, 1, 0.02) << modulus;
    EXPECT_NEAR(cylinders.back() / cylinder, 1, 0.02) << modulus;
    EXPECT_LT(cylinders.back(), 0.9 * plates.back());  // sand around a cylinder takes more than a wall of it
  }
  EXPECT_NEAR(slope(moduli, plates), 2, 0.03);
  EXPECT_NEAR(slope(moduli, cylinders), 2, 0.03);
}

}  // namespace
}  // namespace solidus
