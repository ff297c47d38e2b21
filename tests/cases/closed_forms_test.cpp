/// Problems with a closed form that only say what they are: nothing numerical is set. What is asserted of
/// stresses is what elements of this size can have.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "case_folder.hpp"

namespace {

using solidus::testing::at;
using solidus::testing::CaseFolder;
using solidus::testing::CaseRun;

/// Two rings about the axis y, one element high, as a Gmsh file in mm: groups inner, outer, bore, skin, low,
/// high and, where the rings have their own nodes, inner_face and outer_face between them.
std::string two_rings(double bore, double between, double skin, int n_inner, int n_outer, double height,
                      bool apart) {
  std::vector<double> r;
  for (int i = 0; i <= n_inner; ++i) r.push_back(bore + (between - bore) * i / n_inner);
  for (int i = apart ? 0 : 1; i <= n_outer; ++i) r.push_back(between + (skin - between) * i / n_outer);
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n8\n";
  const std::array names{"bore", "skin", "low", "high", "inner_face", "outer_face"};
  for (std::size_t i = 0; i < names.size(); ++i) text += fmt::format("1 {} \"{}\"\n", i + 1, names[i]);
  text += "2 7 \"inner\"\n2 8 \"outer\"\n$EndPhysicalNames\n";
  text += fmt::format("$Nodes\n{}\n", 2 * r.size());
  for (std::size_t i = 0; i < r.size(); ++i)
    text += fmt::format("{} {:.15g} 0 0\n{} {:.15g} {:.15g} 0\n", 2 * i + 1, r[i], 2 * i + 2, r[i], height);
  text += "$EndNodes\n";
  std::string elements;
  int number = 0;
  const auto line = [&](int group, int a, int b) {
    elements += fmt::format("{} 1 2 {} {} {} {}\n", ++number, group, group, a, b);
  };
  const int last = static_cast<int>(r.size()) - 1, middle = n_inner;
  line(1, 2, 1);
  line(2, 2 * last + 1, 2 * last + 2);
  if (apart) {
    line(5, 2 * middle + 1, 2 * middle + 2);
    line(6, 2 * middle + 4, 2 * middle + 3);
  }
  for (int i = 0; i < last; ++i) {
    if (apart && i == middle) continue;
    line(3, 2 * i + 1, 2 * i + 3);
    line(4, 2 * i + 4, 2 * i + 2);
  }
  for (int i = 0; i < last; ++i) {
    if (apart && i == middle) continue;
    const int group = i < middle ? 7 : 8;
    elements += fmt::format("{} 3 2 {} {} {} {} {} {}\n", ++number, group, group, 2 * i + 1, 2 * i + 3,
                            2 * i + 4, 2 * i + 2);
  }
  return text + fmt::format("$Elements\n{}\n{}$EndElements\n", number, elements);
}

std::string metal(double conductivity, double young, double poisson, double expansion,
                  const std::string& more = "") {
  return fmt::format(
      "density = \"7800 kg/m3\"\nconductivity = \"{} W/m/K\"\nspecific_heat = \"500 J/kg/K\"\n"
      "young_modulus = \"{} GPa\"\npoisson_ratio = {}\nexpansion = \"{} 1/K\"\n"
      "expansion_reference = \"20 degC\"\n{}",
      conductivity, young, poisson, expansion, more);
}

const std::string k_axial = R"(
[[mechanical_condition]]
name = "low"
group = "low"
kind = "displacement"
uz = "0 mm"
[[mechanical_condition]]
name = "high"
group = "high"
kind = "displacement"
uz = "0 mm"
)";

std::string probe(const std::string& name, const std::string& field, const std::string& component,
                  double radius, const std::string& unit, const std::string& body) {
  return fmt::format(
      "[[probe]]\nname = \"{}\"\nfield = \"{}\"\ncomponent = \"{}\"\npoint = [\"{} mm\", \"0.5 mm\"]\n"
      "body = \"{}\"\nunit = \"{}\"\n",
      name, field, component, radius, body, unit);
}

/// Solves a x = b by elimination with pivots.
template <std::size_t n>
std::array<double, n> solve(std::array<std::array<double, n>, n> a, std::array<double, n> b) {
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  std::array<double, n> x{};
  for (std::size_t k = n; k-- > 0;) {
    x[k] = b[k];
    for (std::size_t j = k + 1; j < n; ++j) x[k] -= a[k][j] * x[j];
    x[k] /= a[k][k];
  }
  return x;
}

/// A ring of a tube of several, held along the axis: u = m/(1 − ν) (1/r) ∫_a^r (T − T_0) r dr + C r + D/r
/// with m = (1 + ν) α, T − T_0 = A + B ln r (S. P. Timoshenko, J. N. Goodier, Theory of Elasticity, 1951, §
/// 135).
struct Ring {
  double young, poisson, expansion, from, A, B;

  double heat(double r) const {  // ∫ (T − T_0) r dr from `from`
    const auto whole = [&](double x) { return A * x * x / 2 + B * (x * x / 2 * std::log(x) - x * x / 4); };
    return whole(r) - whole(from);
  }
  double swelling() const { return (1 + poisson) * expansion / (1 - poisson); }
  double u(double r, double C, double D) const { return swelling() * heat(r) / r + C * r + D / r; }
  /// The radial stress, the sum of that of the constants C and D and that of the temperature.
  double radial(double r, double C, double D) const {
    const double g = young / (1 + poisson);
    return g * (C / (1 - 2 * poisson) - D / (r * r)) - young * expansion / (1 - poisson) * heat(r) / (r * r);
  }
  double hoop(double r, double C, double D) const {
    const double g = young / (1 + poisson);
    return g * (C / (1 - 2 * poisson) + D / (r * r)) +
           young * expansion / (1 - poisson) * (heat(r) / (r * r) - (A + B * std::log(r)));
  }
};

TEST(ClosedForms, AComposedTubeThatHeatCrossesHasTheStressesOfBothItsMetals) {
  const CaseFolder folder("composed_tube");
  folder.write("rings.msh", two_rings(20, 40, 60, 20, 20, 1, false));
  folder.write("steel.toml", metal(40, 200, 0.3, 1.2e-5));
  folder.write("aluminium.toml", metal(150, 70, 0.33, 2.3e-5));
  const std::string text =
      R"(title = "A steel tube in an aluminium one"
[analysis]
kind = "axisymmetric"
physics = "thermomechanical"
[mesh]
file = "rings.msh"
unit = "mm"
[time]
steady = true
[[body]]
name = "inner"
material = "steel.toml"
initial_temperature = "20 degC"
[[body]]
name = "outer"
material = "aluminium.toml"
initial_temperature = "20 degC"
[[thermal_condition]]
name = "hot"
group = "bore"
kind = "temperature"
temperature = "220 degC"
[[thermal_condition]]
name = "cold"
group = "skin"
kind = "film"
coefficient = "5000 W/m2/K"
ambient = "20 degC"
)" + k_axial +
      probe("T_between", "temperature", "", 40, "degC", "inner") +
      probe("T_skin", "temperature", "", 60, "degC", "outer") +
      probe("u_bore", "displacement", "r", 20, "um", "inner") +
      probe("u_skin", "displacement", "r", 60, "um", "outer") +
      probe("hoop_bore", "nodal_stress", "tt", 20, "MPa", "inner") +
      probe("hoop_steel", "nodal_stress", "tt", 40, "MPa", "inner") +
      probe("hoop_aluminium", "nodal_stress", "tt", 40, "MPa", "outer") +
      probe("radial_between", "nodal_stress", "rr", 40, "MPa", "inner");
  const CaseRun run = folder.run("tube", text);
  ASSERT_TRUE(run.finished) << run.reason;

  constexpr double a = 0.02, b = 0.04, c = 0.06, h = 5000, hot = 200;
  // Heat q per radian and metre through ln(b/a)/k_1 + ln(c/b)/k_2 + 1/(h c).
  const double q = hot / (std::log(b / a) / 40 + std::log(c / b) / 150 + 1 / (h * c));
  const Ring steel{200e9, 0.3, 1.2e-5, a, hot + q / 40 * std::log(a), -q / 40};
  const double between = hot - q / 40 * std::log(b / a);
  const Ring aluminium{70e9, 0.33, 2.3e-5, b, between + q / 150 * std::log(b), -q / 150};
  // σ_r at a and c zero, u and σ_r alike at b: linear in C_1, D_1, C_2, D_2.
  std::array<std::array<double, 4>, 4> matrix{};
  std::array<double, 4> right{};
  const auto equations = [&](const std::array<double, 4>& x) {
    return std::array<double, 4>{steel.radial(a, x[0], x[1]), aluminium.radial(c, x[2], x[3]),
                                 steel.radial(b, x[0], x[1]) - aluminium.radial(b, x[2], x[3]),
                                 1e12 * (steel.u(b, x[0], x[1]) - aluminium.u(b, x[2], x[3]))};
  };
  const auto zero = equations({});
  for (std::size_t j = 0; j < 4; ++j) {
    std::array<double, 4> unit{};
    unit[j] = 1;
    const auto column = equations(unit);
    for (std::size_t i = 0; i < 4; ++i) matrix[i][j] = column[i] - zero[i];
  }
  for (std::size_t i = 0; i < 4; ++i) right[i] = -zero[i];
  const auto x = solve(matrix, right);

  const auto found = [&](const char* name) { return run.history.at(name).back(); };
  const auto expect = [&](const char* name, double exact, double tolerance) {
    RecordProperty(name, fmt::format("{:.6g} for {:.6g}", found(name), exact));
    EXPECT_NEAR(found(name), exact, tolerance) << name;
  };
  expect("T_between[degC]", 20 + between, 0.05);
  expect("T_skin[degC]", 20 + q / (h * c), 0.05);
  expect("u_bore[um]", 1e6 * steel.u(a, x[0], x[1]), 0.05);
  expect("u_skin[um]", 1e6 * aluminium.u(c, x[2], x[3]), 0.05);
  expect("hoop_bore[MPa]", 1e-6 * steel.hoop(a, x[0], x[1]), 3);
  expect("hoop_steel[MPa]", 1e-6 * steel.hoop(b, x[0], x[1]), 1);
  expect("hoop_aluminium[MPa]", 1e-6 * aluminium.hoop(b, x[2], x[3]), 1);
  expect("radial_between[MPa]", 1e-6 * steel.radial(b, x[0], x[1]), 1);
}

/// Melt at its freezing point on a chill whose far side is kept cold, with a resistance between them. Both
/// store next to no sensible heat, so that heat flows as it does in the steady state and, of the thickness s,
///
///   s²/(2 k) + s R = ΔT t/(ρ L),   R = 1/h + l/k_chill.
TEST(ClosedForms, AMeltFreezesOntoAChillAsTheResistanceBetweenThemLetsIt) {
  const CaseFolder folder("chill");
  const std::string card =
      "density = \"7000 kg/m3\"\nconductivity = \"30 W/m/K\"\nspecific_heat = \"1 J/kg/K\"\n";
  folder.write("melt.toml", card + R"(
[[phase_change]]
name = "solidification"
solidification = true
latent_heat = "250 kJ/kg"
[phase_change.fraction]
solidus = "620 degC"
liquidus = "620 degC"
)");
  folder.write("chill.toml",
               "density = \"7000 kg/m3\"\nconductivity = \"40 W/m/K\"\nspecific_heat = \"1 J/kg/K\"\n");
  const CaseRun run = folder.run("freezing", R"(title = "A melt on a chill"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["2 mm", "10 mm"]
lower_divisions = [1, 5]
upper = ["2 mm", "30 mm"]
upper_divisions = [2, 30]
[time]
end = "90 s"
step = "1 s"
[[body]]
name = "upper"
material = "melt.toml"
initial_temperature = "620 degC"
[[body]]
name = "lower"
material = "chill.toml"
initial_temperature = "20 degC"
[[thermal_condition]]
name = "water"
group = "lower_y_min"
kind = "temperature"
temperature = "20 degC"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
[contact.heat]
conductance = "2000 W/m2/K"
gap_law = "constant"
[[probe]]
name = "frozen"
field = "solid_fraction"
kind = "mean"
group = "upper"
unit = "1"
[[probe]]
name = "T_casting"
field = "temperature"
kind = "mean"
group = "upper_bottom"
unit = "degC"
[[probe]]
name = "T_chill"
field = "temperature"
kind = "mean"
group = "lower_top"
unit = "degC"
)");
  ASSERT_TRUE(run.finished) << run.reason;
  constexpr double k = 30, R = 1 / 2000. + 0.01 / 40, drop = 600, heat = 7000 * 250e3;
  for (const double time : {10.0, 30.0, 60.0, 90.0}) {
    const double s = k * (-R + std::sqrt(R * R + 2 * drop * time / (heat * k)));
    const double flux = drop / (s / k + R);
    RecordProperty(
        "at_" + std::to_string(static_cast<int>(time)),
        fmt::format("{:.5g} for {:.5g} mm, {:.5g} for {:.5g} degC", 30 * at(run.history, "frozen[1]", time),
                    1e3 * s, at(run.history, "T_casting[degC]", time), 620 - flux * s / k));
    EXPECT_NEAR(30 * at(run.history, "frozen[1]", time), 1e3 * s, 2e-3 * 1e3 * s) << time;
    EXPECT_NEAR(at(run.history, "T_casting[degC]", time), 620 - flux * s / k, 6) << time;
    EXPECT_NEAR(at(run.history, "T_chill[degC]", time), 20 + flux * 0.01 / 40, 2) << time;
  }
}

/// A ring that is warmed in another one which yields. Both are incompressible but for a rest and held along
/// the axis, and deformation does no heat, so that radial displacements go as 1/r and the outer ring, plastic
/// up to c, has Hill's solution
///
///   p = τ_0 (1 − c²/b² + 2 ln(c/a)),   u(a) = τ_0 c²/(2 G a),   τ_0 = σ_0/√3
///
/// (R. Hill, The Mathematical Theory of Plasticity, 1950, ch. V). The inner one, from i to a, has
/// u(a) = 3/2 α ΔT a − p i² a/(2 G (a² − i²)).
TEST(ClosedForms, AWarmRingExpandsAnotherOneIntoPlasticFlow) {
  const CaseFolder folder("plastic_shrink_fit");
  // With the heat at constant pressure, expansion against 33 000 GPa would take up more than there is.
  const std::string k_held = "specific_heat_at = \"constant_strain\"\n";
  folder.write("rings.msh", two_rings(50, 100, 200, 10, 25, 1, true));
  folder.write("elastic.toml", metal(40, 200, 0.499, 1.2e-5, k_held));
  folder.write("plastic.toml",
               metal(40, 200, 0.499, 1.2e-5, k_held + "[plasticity]\nflow_stress = \"300 MPa\"\n"));
  const auto kept = [](const std::string& group, const std::string& temperature) {
    return fmt::format(
        "[[thermal_condition]]\nname = \"{0}\"\ngroup = \"{0}\"\nkind = \"temperature\"\n"
        "temperature = {1}\n",
        group, temperature);
  };
  constexpr double a = 0.1, b = 0.2, i = 0.05, c = 0.13, G = 200e9 / (2 * 1.499);
  const double shear = 300e6 / std::sqrt(3.0);
  const double pressure = shear * (1 - c * c / (b * b) + 2 * std::log(c / a));
  const double outer = shear * c * c / (2 * G * a);
  const double inner = -pressure * i * i * a / (2 * G * (a * a - i * i));
  const double warm = (outer - inner) / (1.5 * 1.2e-5 * a);
  const std::string ramp = fmt::format(
      "{{ of = \"time\", argument_unit = \"s\", unit = \"degC\", points = [[0, 20], [100000, {:.8g}]] }}",
      20 + warm);
  const CaseRun run =
      folder.run("rings", R"(title = "A shrink fit that yields"
[analysis]
kind = "axisymmetric"
physics = "thermomechanical"
[mesh]
file = "rings.msh"
unit = "mm"
[time]
end = "1e5 s"
step = "5000 s"
[coupling]
structural_heating = "none"
[[body]]
name = "inner"
material = "elastic.toml"
initial_temperature = "20 degC"
[[body]]
name = "outer"
material = "plastic.toml"
initial_temperature = "20 degC"
[[contact]]
name = "fit"
slave = "inner_face"
master = "outer_face"
)" + kept("bore", ramp) + kept("inner_face", ramp) +
                              kept("outer_face", "\"20 degC\"") + kept("skin", "\"20 degC\"") + k_axial +
                              probe("pressure", "contact_pressure", "", 100, "MPa", "inner") +
                              probe("u", "displacement", "r", 100, "um", "outer") +
                              probe("yields", "equivalent_plastic_strain", "", 129, "1", "outer") +
                              probe("elastic", "equivalent_plastic_strain", "", 135, "1", "outer"));
  ASSERT_TRUE(run.finished) << run.reason;
  const auto found = [&](const char* name) { return run.history.at(name).back(); };
  RecordProperty("pressure", fmt::format("{:.6g} for {:.6g}", found("pressure[MPa]"), 1e-6 * pressure));
  RecordProperty("u", fmt::format("{:.6g} for {:.6g}", found("u[um]"), 1e6 * outer));
  EXPECT_NEAR(found("pressure[MPa]"), 1e-6 * pressure, 0.005e-6 * pressure);
  EXPECT_NEAR(found("u[um]"), 1e6 * outer, 0.005e6 * outer);
  EXPECT_GT(found("yields[1]"), 0);
  EXPECT_EQ(found("elastic[1]"), 0);
}

}  // namespace
