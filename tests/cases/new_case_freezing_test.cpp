/// Castings whose case `solidus new` makes freeze when they should: a ball in sand against finite volumes of
/// one dimension.
#include <gmsh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "case_run.hpp"
#include "new_case/new_case.hpp"

namespace {

namespace fs = std::filesystem;

fs::path root() {
  return fs::path(SOLIDUS_BINARY_DIR) / "case_runs" / "new_case_freezing";
}

/// Enthalpy of the alloy of the library, aluminium_alsi7mg, with its own numbers; temperatures in °C.
///
///   h(Θ) = ρ (∫ C dΘ + L (1 − f_S)),  1 − f_S = ((Θ_m − Θ)/(Θ_m − Θ_l))^{1/(k−1)} by Scheil's equation
class Alloy {
 public:
  static double enthalpy(double t) { return k_density * (sensible(t) + k_latent * liquid(t)); }
  /// Temperature and share of liquid at an enthalpy.
  static std::pair<double, double> at(double h) {
    const double solid = k_density * sensible(k_eutectic);
    if (h >= solid && h <= enthalpy(k_eutectic)) return {k_eutectic, (h - solid) / (k_density * k_latent)};
    double low = h > solid ? k_eutectic : -50, high = h > solid ? 900 : k_eutectic;
    for (int i = 0; i < 40; ++i) {
      const double t = 0.5 * (low + high), of = h > solid ? enthalpy(t) : k_density * sensible(t);
      (of < h ? low : high) = t;
    }
    return {low, h > solid ? liquid(low) : 0};
  }
  static double conductivity(double t) {
    constexpr double at[] = {25, 550, 577, 614}, value[] = {159, 150, 145, 65};
    for (int i = 0; i < 3; ++i)
      if (t <= at[i + 1]) return value[i] + (value[i + 1] - value[i]) * (t - at[i]) / (at[i + 1] - at[i]);
    return value[3];
  }

 private:
  static double sensible(double t) {
    const double warm = std::clamp(t, 100.0, 577.0) - 100, slope = (1160.0 - 963.0) / 477;
    return 963 * std::min(t - 100, 0.0) + 963 * warm + 0.5 * slope * warm * warm +
           1160 * std::max(t - 577, 0.0);
  }
  static double liquid(double t) {
    if (t >= 614) return 1;
    return t < k_eutectic ? 0 : std::pow((660 - t) / (660.0 - 614.0), 1 / (0.13 - 1));
  }
  static constexpr double k_density = 2685, k_latent = 389e3, k_eutectic = 577;
};

/// When the centre of a ball in endless green sand is solid [s], by explicit finite volumes around points
/// that lie on the skin and 0.4 mm and more behind it; 1000 W/(m² K) between both.
double ball_is_solid_after(double radius, double start) {
  constexpr int k_metal = 10;
  constexpr double k_sand = 0.607, k_of_sand = 1500.0 * 1130, k_film = 1000;
  std::vector<double> r, sand;
  for (int i = 0; i <= k_metal; ++i) r.push_back(radius * i / k_metal);
  for (double d = 0, step = 0.4e-3; d < 0.15; d += step, step = std::min(1.05 * step, 5e-3))
    sand.push_back(radius + d);
  const auto square = [](double x) { return x * x; };
  const auto volumes = [](const std::vector<double>& x) {
    std::vector<double> v(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double a = i == 0 ? x[0] : 0.5 * (x[i] + x[i - 1]),
                   b = i + 1 == x.size() ? x[i] : 0.5 * (x[i] + x[i + 1]);
      v[i] = (b * b * b - a * a * a) / 3;
    }
    return v;
  };
  const std::vector<double> v = volumes(r), w = volumes(sand);
  std::vector<double> h(r.size(), Alloy::enthalpy(start)), t(r.size(), start), s(sand.size(), 20);
  constexpr double k_step = 0.015;
  double time = 0;
  for (bool liquid = true; liquid && time < 3600; time += k_step) {
    std::vector<double> q(r.size(), 0), p(sand.size(), 0);
    for (std::size_t i = 0; i + 1 < r.size(); ++i) {
      const double flow = Alloy::conductivity(0.5 * (t[i] + t[i + 1])) * square(0.5 * (r[i] + r[i + 1])) *
                          (t[i] - t[i + 1]) / (r[i + 1] - r[i]);
      q[i] -= flow, q[i + 1] += flow;
    }
    const double through = k_film * square(radius) * (t.back() - s.front());
    q.back() -= through, p.front() += through;
    for (std::size_t j = 0; j + 1 < sand.size(); ++j) {
      const double flow =
          k_sand * square(0.5 * (sand[j] + sand[j + 1])) * (s[j] - s[j + 1]) / (sand[j + 1] - sand[j]);
      p[j] -= flow, p[j + 1] += flow;
    }
    liquid = false;
    for (std::size_t i = 0; i < r.size(); ++i) {
      h[i] += k_step * q[i] / v[i];
      const auto [temperature, share] = Alloy::at(h[i]);
      t[i] = temperature;
      liquid = liquid || share > 0;
    }
    for (std::size_t j = 0; j < sand.size(); ++j) s[j] += k_step * p[j] / (w[j] * k_of_sand);
  }
  return time;
}

fs::path ball(double radius_in_mm) {
  fs::create_directories(root());
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add("ball");
  gmsh::model::occ::addSphere(0, 0, 0, radius_in_mm);
  gmsh::model::occ::synchronize();
  gmsh::write((root() / "ball.step").string());
  gmsh::finalize();
  return root() / "ball.step";
}

/// When the last melt of the run's casting froze [s], of its summary.
double froze(const fs::path& run) {
  std::ifstream in(run / "summary.json");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::size_t of = text.find("\"last_melt_froze\""), value = text.find("\"value[s]\"", of);
  return value == std::string::npos ? 0 : std::strtod(text.c_str() + text.find(':', value) + 1, nullptr);
}

TEST(NewCase, OfABallInSandFreezesWithinTwoPerCentOfItsTimeAtSevenTenthsOfTheFineness) {
  solidus::new_case::NewCaseOptions options;
  options.geometry = ball(30);
  options.alloy = "aluminium_alsi7mg";
  options.fineness = 0.7;
  options.folder = root() / "ball";
  fs::remove_all(options.folder);
  const solidus::new_case::NewCaseReport report = solidus::new_case::make_new_case(options);
  solidus::run::RunOptions run;
  run.folder = root() / "run";
  const solidus::run::RunResult result =
      solidus::run::run_case(solidus::setup::load_case(report.file, {}, solidus::cases::Physics::heat), run);
  ASSERT_TRUE(result.finished) << result.reason;
  const double right = ball_is_solid_after(0.03, 695);
  EXPECT_NEAR(right, 337, 0.5);
  EXPECT_NEAR(froze(run.folder), right, 0.02 * right);
}

}  // namespace
