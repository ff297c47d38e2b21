/// A source that travels, by a formula of the case file, against the closed form of the line source in a
/// plate, and Rosenthal's quasi-steady one.
///
///   Θ − Θ_0 = q/(4π k) ∫_0^t exp(−|x − x_s(t − s)|²/(4 α s + 2 σ²)) / (s + σ²/(2 α)) ds
///
/// a Gaussian of variance σ² and power q per length [W/m] that moves with v (Carslaw, Jaeger, Conduction of
/// Heat in Solids, 10.7); far from it, long after its start, q/(2π k) exp(−v ξ/(2 α)) K_0(v R/(2 α)).
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "cases/case_materials.hpp"
#include "csv.hpp"
#include "setup/assembly.hpp"
#include "setup/case_file.hpp"
#include "setup/mesh_input.hpp"

namespace solidus {
namespace {

constexpr double k_conductivity = 100, k_capacity = 2.5e6, k_sigma = 0.006, k_speed = 0.005, k_power = 1e5;
constexpr double k_alpha = k_conductivity / k_capacity, k_start = 0.06;

/// The plate is mirrored at y = 0: its half takes half of the power.
double exact(double x, double y, double time) {
  // u = ln(s + s_0) makes the integrand smooth.
  const double s0 = k_sigma * k_sigma / (2 * k_alpha);
  const double from = std::log(s0), to = std::log(time + s0);
  const int n = 4000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double s = std::exp(from + (to - from) * (i + 0.5) / n) - s0;
    const double dx = x - k_start - k_speed * (time - s);
    sum += std::exp(-(dx * dx + y * y) / (4 * k_alpha * (s + s0)));
  }
  return k_power / (4 * std::numbers::pi * k_conductivity) * sum * (to - from) / n;
}

struct Errors {
  double rms = 0, rosenthal = 0;  ///< of the highest temperature
};

Errors run(int n, double dt) {
  const std::filesystem::path folder =
      std::filesystem::path(SOLIDUS_BINARY_DIR) / "case_runs" / "moving_source";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "metal.toml") << R"(title = "Metal"
density = "2500 kg/m3"
conductivity = "100 W/m/K"
specific_heat = "1000 J/kg/K"
)";
  std::ofstream(folder / "case.toml")
      << R"(title = "A line source that travels along the edge of half a plate"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["360 mm", "150 mm"]
divisions = [)"
      << 12 * n << ", " << 5 * n << R"(]
[time]
end = "48 s"
step = ")"
      << dt << R"~( s"
[[body]]
name = "block"
material = "metal.toml"
initial_temperature = "300 K"
[[thermal_condition]]
name = "source"
group = "block"
kind = "source"
[thermal_condition.power]
formula = "q/(2*pi*s^2)*exp(-((x - start)^2 + y^2)/(2*s^2))"
constants = { q = "100 kW/m", s = "6 mm", start = "60 mm" }
moving = ["5 mm/s", "0 mm/s"]
)~";
  setup::Case c = setup::load_case(folder / "case.toml");
  setup::Assembly a;
  a.materials = cases::load_materials(c.spec);
  a.mesh = setup::load_mesh(c.spec);
  setup::build(c.spec, a);
  heat::ThermalState state = a.initial.heat;
  const int steps = static_cast<int>(std::lround(48 / dt));
  for (int i = 1; i <= steps; ++i) {
    heat::ThermalState next;
    a.heat->solve(state, next, i * dt, dt);
    state = next;
  }
  Errors errors;
  double largest = 0;
  int nodes = 0;
  for (std::size_t i = 0; i < a.mesh.x.size(); ++i) {
    const mesh::Point& x = a.mesh.x[i];
    if (x[0] < 0.2 || x[1] > 0.06) continue;  // the plate ends at x = 0
    const double found = state.temperature[i] - 300, should = exact(x[0], x[1], 48);
    errors.rms += (found - should) * (found - should);
    largest = std::max(largest, should);
    ++nodes;
    const double xi = x[0] - k_start - k_speed * 48, distance = std::hypot(xi, x[1]);
    if (distance < 0.03 || distance > 0.045) continue;
    const double quasi_steady = k_power / (2 * std::numbers::pi * k_conductivity) *
                                std::exp(-k_speed * xi / (2 * k_alpha)) *
                                std::cyl_bessel_k(0, k_speed * distance / (2 * k_alpha));
    errors.rosenthal = std::max(errors.rosenthal, std::abs(found - quasi_steady));
  }
  errors.rms = std::sqrt(errors.rms / nodes) / largest;
  errors.rosenthal /= largest;
  return errors;
}

TEST(MovingSource, FollowsTheClosedFormWithSecondOrderAndIsRosenthalsFarAway) {
  const Errors coarse = run(6, 0.8), fine = run(12, 0.2);
  auto csv = verification::csv("moving_source", "h[mm],rms[1],rosenthal[1]");
  csv << "5," << coarse.rms << ',' << coarse.rosenthal << "\n2.5," << fine.rms << ',' << fine.rosenthal
      << '\n';
  // Four times the steps and half the elements: a quarter of the error.
  EXPECT_LT(fine.rms, 0.35 * coarse.rms);
  EXPECT_LT(fine.rms, 0.01);
  EXPECT_LT(fine.rosenthal, 0.03);  // of the highest temperature; the source is not a point
}

}  // namespace
}  // namespace solidus
