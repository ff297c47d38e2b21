/// Niyama's number of a taper: a thin plate whose thickness d(x) grows linearly, cooled from both faces by a
/// film so weak that each section has one temperature, and so long that none flows along it.
///
///        d(0) ┌──────────────────────┐ d(L)        C d/2 dT/dt = −h (T − T_a),  C = ρ c + ρ L/(T_L − T_S)
///             └──────────────────────┘             T = T_a + (T_L − T_a) e^{−t/τ},  τ = C d/(2 h)
///
/// At T_e, with λ = ln((T_L − T_a)/(T_e − T_a)): t_e = λ τ, Ṫ = (T_e − T_a)/τ, G = (T_e − T_a) λ τ′/τ, so
/// Ny = G/√Ṫ = √(T_e − T_a) λ τ′/√τ.
#include <gtest/gtest.h>

#include <cmath>

#include "csv.hpp"
#include "freezing_run.hpp"
#include "strip.hpp"

namespace solidus {
namespace {

constexpr double k_length = 1.0, k_thin = 8e-3, k_thick = 16e-3;
constexpr double k_film = 20, k_ambient = 300, k_range = 40;

double thickness(double x) {
  return k_thin + (k_thick - k_thin) * x / k_length;
}

TEST(NiyamaOfATaper, IsTheClosedForm) {
  const mesh::Mesh mesh =
      verification::block(mesh::Shape::quad4, {k_length, 1.0}, {100, 4}, [](const mesh::Point& x) {
        return mesh::Point{x[0], thickness(x[0]) * (x[1] - 0.5), 0};
      });
  heat::ThermalConditions conditions;
  for (const char* side : {"y_min", "y_max"})
    conditions.films.push_back({side, side, {Table(k_film)}, Table(k_ambient)});
  const double capacity = 2500.0 * 1000 + 2500.0 * 4e5 / k_range;  // while freezing [J/(m³ K)]
  const auto tau = [&](double x) { return capacity * thickness(x) / (2 * k_film); };
  const double slope = tau(k_length) - tau(0);  // per metre
  const double level = 900 - 0.9 * k_range - k_ambient, lambda = std::log((900 - k_ambient) / level);
  const double end = 1.3 * tau(k_length) * std::log((900 - k_ambient) / (900 - k_range - k_ambient));
  verification::Fields fields =
      verification::freeze(mesh, AnalysisKind::plane_strain, {verification::light_metal(100, k_range)},
                           conditions, {900.0}, end, end / 1000);
  std::ofstream table = verification::csv("criteria_taper", "x[mm],niyama[1],niyama_exact[1]");
  for (std::size_t i = 0; i < mesh.x.size(); ++i) {
    const double x = mesh.x[i][0];
    // The middle plane, where nothing flows across. At the ends heat flows along the plate: over √(k t/C) =
    // 40 mm by then.
    if (x < 0.2 || x > 0.8 || std::abs(mesh.x[i][1]) > 1e-9) continue;
    const double rate = level / tau(x), gradient = level * lambda * slope / (k_length * tau(x));
    const double exact = gradient / std::sqrt(rate);
    table << 1e3 * x << ',' << fields["niyama"][i] << ',' << exact << '\n';
    EXPECT_NEAR(fields["cooling_rate"][i] / rate, 1, 0.02) << x;
    EXPECT_NEAR(fields["niyama"][i] / exact, 1, 0.03) << x;
    EXPECT_NEAR(fields["local_solidification_time"][i] /
                    (tau(x) * std::log((900 - k_ambient) / (900 - k_range - k_ambient))),
                1, 0.02)
        << x;
  }
}

}  // namespace
}  // namespace solidus
