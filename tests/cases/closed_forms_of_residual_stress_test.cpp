/// A problem with a closed form whose stresses stay: a ball that a source of heat makes yield, and that cools
/// again. Nothing numerical is set.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "case_folder.hpp"
#include "quarter_ball.hpp"

namespace {

using solidus::testing::at;
using solidus::testing::CaseFolder;
using solidus::testing::CaseRun;

/// A free ball of the radius b in steady state, with q heat per volume and time, T = T_middle − q r²/(6 k).
/// While it is elastic σ_θ − σ_r = D r² with D = 2 E α/(5 (1 − ν)) q/(6 k) (S. P. Timoshenko, J. N. Goodier,
/// Theory of Elasticity, 1951, § 136): it yields from its skin to the radius c = √(Y/D), where σ_θ − σ_r is
/// the yield stress Y and equilibrium asks for σ_r = 2 Y ln(r/b); within, σ_r = 2 Y ln(c/b) + D (r² − c²).
/// Without the source all of it unloads elastically while D b² < 2 Y. The stresses of a free body have no
/// mean, nor has plastic flow a volume, so that the skin moves by b α times the mean of the rise, whatever
/// has yielded.
struct YieldingBall {
  double b = 0.05, q = 22.4e6, k = 40, h = 5000, young = 200e9, poisson = 0.3, alpha = 1.2e-5, yield = 200e6;

  double drop(double r) const { return q * r * r / (6 * k); }
  double skin() const { return 20 + q * b / (3 * h); }
  double middle() const { return skin() + drop(b); }
  double slope() const { return 2 * young * alpha / (5 * (1 - poisson)) * q / (6 * k); }  // D
  double front() const { return std::sqrt(yield / slope()); }                             // c
  /// σ_θ [Pa]
  double hot(double r) const {
    const double c = front();
    if (r >= c) return 2 * yield * std::log(r / b) + yield;
    return 2 * yield * std::log(c / b) + slope() * (r * r - c * c) + slope() * r * r;
  }
  double cold(double r) const { return hot(r) - slope() * (2 * r * r - b * b); }
  double moves() const { return b * alpha * (skin() - 20 + drop(b) * 2 / 5); }
};

/// Triangles of a size [mm] in a quarter of the ball's section.
CaseRun heated_ball(const CaseFolder& folder, const std::string& name, double size,
                    const std::vector<std::string>& overrides = {}) {
  folder.write(name + ".geo", solidus::testing::quarter_ball(size));
  return folder.run(name,
                    fmt::format(R"(title = "A ball is heated within, yields and cools"
[analysis]
kind = "axisymmetric"
physics = "thermomechanical"
[mesh]
file = "{}.geo"
unit = "mm"
[time]
step = "1 s"
adaptive = true
[[stage]]
name = "hot"
duration = "300 s"
[[stage]]
name = "cold"
duration = "300 s"
[[body]]
name = "ball"
material = "steel.toml"
initial_temperature = "20 degC"
[[thermal_condition]]
name = "water"
group = "skin"
kind = "film"
coefficient = "5000 W/m2/K"
ambient = "20 degC"
[[thermal_condition]]
name = "source"
group = "ball"
kind = "source"
power = "22.4 MW/m3"
stages = ["hot"]
[[mechanical_condition]]
name = "equator"
group = "equator"
kind = "displacement"
uz = "0 mm"
)",
                                name) +
                        solidus::testing::probe_on_equator("T_middle", "temperature", "", 0, "degC") +
                        solidus::testing::probe_on_equator("T_skin", "temperature", "", 50, "degC") +
                        solidus::testing::probe_on_equator("s_0", "nodal_stress", "tt", 0, "MPa") +
                        solidus::testing::probe_on_equator("s_30", "nodal_stress", "tt", 30, "MPa") +
                        solidus::testing::probe_on_equator("s_50", "nodal_stress", "tt", 50, "MPa") +
                        solidus::testing::probe_on_equator("u", "displacement", "r", 50, "um"),
                    overrides);
}

TEST(ClosedFormsOfResidualStress, ABallThatAHeatSourceMadeYieldKeepsTheStressesOfItsFlow) {
  const CaseFolder folder("closed_forms_yielding_ball");
  folder.write("steel.toml",
               "density = \"7800 kg/m3\"\nconductivity = \"40 W/m/K\"\nspecific_heat = \"500 J/kg/K\"\n"
               "young_modulus = \"200 GPa\"\npoisson_ratio = 0.3\nexpansion = \"1.2e-5 1/K\"\n"
               "expansion_reference = \"20 degC\"\n[plasticity]\nflow_stress = \"200 MPa\"\n");
  const YieldingBall ball;
  ASSERT_LT(ball.front(), 0.8 * ball.b);
  ASSERT_LT(ball.slope() * ball.b * ball.b, 2 * ball.yield);
  std::vector<std::array<double, 2>> worst;  // within and at the skin [MPa]
  for (const auto& [name, size] : {std::pair{"coarse", 5.0}, std::pair{"fine", 2.5}}) {
    const CaseRun run = heated_ball(folder, name, size);
    ASSERT_TRUE(run.finished) << run.reason;
    const auto off = [&](const std::string& column, double time, double exact) {
      return std::abs(at(run.history, column, time) - exact);
    };
    EXPECT_LT(off("T_middle[degC]", 300, ball.middle()), 1.2);  // of 308 K
    EXPECT_LT(off("T_skin[degC]", 300, ball.skin()), 0.1);
    EXPECT_LT(off("u[um]", 300, 1e6 * ball.moves()), 0.2) << "of 101";
    EXPECT_LT(off("u[um]", 600, 0), 0.1);
    auto& [within, skin] = worst.emplace_back();
    for (const int r : {0, 30}) {
      const std::string column = fmt::format("s_{}[MPa]", r);
      within = std::max({within, off(column, 300, 1e-6 * ball.hot(1e-3 * r)),
                         off(column, 600, 1e-6 * ball.cold(1e-3 * r))});
    }
    EXPECT_LT(off("s_50[MPa]", 300, 1e-6 * ball.hot(ball.b)), 4) << "of 200: it yields there";
    skin = off("s_50[MPa]", 600, 1e-6 * ball.cold(ball.b));
  }
  EXPECT_LT(worst[1][0], 1.2);
  EXPECT_LT(worst[1][0], 0.45 * worst[0][0]);
  // Algebraic sub-scales hold the pressure of triangles even where it has a gradient, at a boundary to first
  // order in the size of the elements: 16 and 8 of −120 MPa. Orthogonal ones do not.
  EXPECT_LT(worst[1][1], 9);
  EXPECT_LT(worst[1][1], 0.6 * worst[0][1]);
  const CaseRun orthogonal = heated_ball(folder, "orthogonal", 2.5, {"mechanics.stabilisation=orthogonal"});
  ASSERT_TRUE(orthogonal.finished) << orthogonal.reason;
  EXPECT_NEAR(at(orthogonal.history, "s_50[MPa]", 600), 1e-6 * ball.cold(ball.b), 5);
}

}  // namespace
