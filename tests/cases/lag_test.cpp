/// The lag of a run with defaults, of first order in the step, is reported with its number: by `check` before
/// it, and by the run at its end. Each number is that of a closed form.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "case_folder.hpp"
#include "results/overview.hpp"

namespace {

using solidus::testing::CaseFolder;
using solidus::testing::CaseRun;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// Collects what is printed while it lives.
class Printed {
 public:
  Printed() {
    solidus::logging::set_sink(
        [this](solidus::logging::Level, std::string_view text) { lines.emplace_back(text); });
  }
  ~Printed() { solidus::logging::set_sink({}); }
  Printed(const Printed&) = delete;
  Printed& operator=(const Printed&) = delete;
  /// The number behind a text in one of the lines; NaN where no line has it.
  double number_after(const std::string& text) const {
    for (const std::string& line : lines)
      if (const auto at = line.find(text); at != std::string::npos)
        return std::strtod(line.c_str() + at + text.size(), nullptr);
    return std::nan("");
  }
  std::vector<std::string> lines;
};

std::string steel(double expansion, const std::string& more = "") {
  return fmt::format(
      "density = \"7800 kg/m3\"\nconductivity = \"40 W/m/K\"\nspecific_heat = \"500 J/kg/K\"\n"
      "young_modulus = \"200 GPa\"\npoisson_ratio = 0.3\nexpansion = \"{} 1/K\"\n"
      "expansion_reference = \"20 degC\"\n{}",
      expansion, more);
}

std::string condition(const std::string& kind, const std::string& group, const std::string& values) {
  return fmt::format("[[{0}_condition]]\nname = \"{0} {1}\"\ngroup = \"{1}\"\n{2}\n", kind, group, values);
}
std::string ramp(const std::string& unit, double from, double to, double end) {
  return fmt::format(
      "{{ of = \"time\", argument_unit = \"s\", unit = \"{}\", points = [[0, {}], [{}, {}]] }}", unit, from,
      end, to);
}

/// A block is drawn over another one while both are warmed from 20 to 120 degC in ten steps; their friction
/// falls from 0.45 to 0.15.
std::string rubbing_blocks() {
  std::string text = R"(title = "Warm friction"
[analysis]
kind = "plane_strain"
physics = "thermomechanical"
[mesh]
shape = "two_blocks"
element = "quad4"
[mesh.two_blocks]
lower = ["20 mm", "5 mm"]
lower_divisions = [4, 1]
upper = ["10 mm", "5 mm"]
upper_divisions = [2, 1]
[time]
end = "10 s"
step = "1 s"
[[body]]
name = "upper"
material = "steel.toml"
initial_temperature = "20 degC"
[[body]]
name = "lower"
material = "steel.toml"
initial_temperature = "20 degC"
[[contact]]
name = "interface"
slave = "upper_bottom"
master = "lower_top"
[contact.heat]
conductance = "100000 W/m2/K"
gap_law = "constant"
[contact.friction]
coefficient = { of = "temperature", argument_unit = "degC", points = [[20, 0.45], [120, 0.15]] }
)";
  for (const char* group : {"upper_y_max", "upper_bottom", "lower_top", "lower_y_min"})
    text += condition("thermal", group, "kind = \"temperature\"\ntemperature = " + ramp("degC", 20, 120, 10));
  text += condition("mechanical", "upper_y_max", "kind = \"pressure\"\npressure = \"10 MPa\"");
  text += condition("mechanical", "lower_y_min", "kind = \"displacement\"\nux = \"0 mm\"\nuy = \"0 mm\"");
  text +=
      "[[mechanical_condition]]\nname = \"drawn\"\ngroup = \"upper_y_max\"\nkind = \"displacement\"\nux = " +
      ramp("mm", 0, 0.2, 10) + "\n";
  return text;
}

TEST(Lag, OfMechanicsFirstIsSaidByCheckAndByTheRun) {
  const CaseFolder folder("lag_friction");
  folder.write("steel.toml", steel(1e-9));
  const std::string file = folder.write("rubbing.toml", rubbing_blocks());
  EXPECT_THAT(solidus::results::text(solidus::run::check_run(solidus::setup::load_case(file)).overview),
              HasSubstr("displacements and stresses belong to the temperatures a step before "
                        "(mechanics_first): 1 s of 10 s, 10 % of what changes evenly"));
  const Printed printed;
  const CaseRun run = folder.run("rubbing", rubbing_blocks());
  ASSERT_TRUE(run.finished) << run.reason;
  EXPECT_NEAR(printed.number_after("in the last step, 1 s, displacements changed by "), 10, 0.5);
}

// Tractions of step n have the coefficient of t_n, 0.03 more than that of t_{n+1}.
TEST(Lag, OfFrictionThatFollowsTheTemperatureIsSaidByTheRunWithItsNumber) {
  const CaseFolder folder("lag_coefficient");
  folder.write("steel.toml", steel(1e-9));
  double late = 0, all = 0;
  for (int n = 0; n < 10; ++n) {
    const double before = 0.45 - 0.03 * n, after = before - 0.03;
    late += before * (before / after - 1);
    all += before;
  }
  const Printed printed;
  const CaseRun run = folder.run("kept", rubbing_blocks());
  ASSERT_TRUE(run.finished) << run.reason;
  const double said = printed.number_after("its tractions are ");
  RecordProperty("said", fmt::format("{} % for {:.3g} %", said, 100 * late / all));
  EXPECT_NEAR(said, 100 * late / all, 0.05 * 100 * late / all);
  for (const std::vector<std::string>& other :
       {std::vector<std::string>{"contact.interface.friction.thermal_return_mapping=true"},
        {"coupling.scheme=\"block_iterative\""},
        {"coupling.scheme=\"simultaneous\""}}) {
    const Printed nothing;
    const CaseRun agrees = folder.run("agrees", rubbing_blocks(), other);
    ASSERT_TRUE(agrees.finished) << agrees.reason;
    EXPECT_THAT(nothing.lines, Not(Contains(HasSubstr("its tractions are")))) << other[0];
  }
}

// Blocks that rub make an interface hot which stores heat. With heat first the flash of the step's own heat
// is not the temperature that the coefficient should have had; and printed slip in the thermal phase is not
// to be had there.
TEST(Lag, OfFrictionWithHeatFirstIsThatOfTheHeatThatFlowsAndAdvisesWhatHelps) {
  const CaseFolder folder("lag_flash");
  folder.write("steel.toml", steel(1e-9));
  std::string text = rubbing_blocks();
  text =
      text.substr(0, text.find("[[thermal_condition]]")) +
      condition("mechanical", "upper_y_max", "kind = \"pressure\"\npressure = \"10 MPa\"") +
      condition("mechanical", "lower_y_min", "kind = \"displacement\"\nux = \"0 mm\"\nuy = \"0 mm\"") +
      "[[mechanical_condition]]\nname = \"drawn\"\ngroup = \"upper_y_max\"\nkind = \"displacement\"\nux = " +
      ramp("mm", 0, 5, 0.1) + "\n";
  text.insert(text.find("[contact.friction]"), "[contact.interface]\nheat_capacity = \"500 J/m2/K\"\n");
  const std::vector<std::string> brief = {"time.end=\"0.1 s\"", "time.step=\"0.01 s\"",
                                          "contact.interface.heat.conductance=\"5000 W/m2/K\""};
  const auto with = [&](const std::string& setting) {
    std::vector<std::string> all = brief;
    all.push_back(setting);
    return all;
  };
  const std::string column = "interface_friction_dissipation[J]";
  const CaseRun exact = folder.run("agrees", text, with("coupling.scheme=simultaneous"));
  ASSERT_TRUE(exact.finished) << exact.reason;
  const Printed printed;
  const CaseRun split = folder.run("heat_first", text, with("coupling.order=heat_first"));
  ASSERT_TRUE(split.finished) << split.reason;
  const double off = 100 * (split.history.at(column).back() / exact.history.at(column).back() - 1);
  RecordProperty("said", fmt::format("{} % for {:.3g} %", printed.number_after("its tractions are "), off));
  EXPECT_NEAR(printed.number_after("its tractions are "), off, 0.4 * off);
  EXPECT_THAT(printed.lines, Not(Contains(HasSubstr("thermal_return_mapping"))));
  const CaseRun mapped =
      folder.run("mapped", text, with("contact.interface.friction.thermal_return_mapping=true"));
  ASSERT_TRUE(mapped.finished) << mapped.reason;
  EXPECT_NEAR(mapped.history.at(column).back(), exact.history.at(column).back(),
              0.1 * (split.history.at(column).back() - exact.history.at(column).back()));
}

/// A block that is sheared by Γ without heat that comes or goes; its metal hardens linearly.
std::string sheared_block(int steps) {
  return fmt::format(R"(title = "Shear"
[analysis]
kind = "plane_strain"
physics = "thermomechanical"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["10 mm", "10 mm"]
divisions = [1, 1]
[time]
end = "1 s"
step = "{} s"
[[body]]
name = "block"
material = "hardening.toml"
initial_temperature = "20 degC"
[[probe]]
name = "T"
field = "temperature"
kind = "mean"
group = "block"
unit = "degC"
)",
                     1.0 / steps) +
         condition("mechanical", "y_min", "kind = \"displacement\"\nux = \"0 mm\"\nuy = \"0 mm\"") +
         condition("mechanical", "y_max",
                   "kind = \"displacement\"\nuy = \"0 mm\"\nux = " + ramp("mm", 0, 3, 1));
}

/// The shear stress of the block and its plastic strain at a shear of `strain`, and the work until then by
/// the stresses of the ends of `steps` [Pa], [1], [J/m³].
struct Sheared {
  static constexpr double k_yield = 3e8, k_slope = 2e9, k_modulus = 200e9 / 2.6;
  static double plastic(double strain) {
    const double root3 = std::sqrt(3.0);
    return std::max(0.0, (strain - k_yield / (root3 * k_modulus)) / (root3 + k_slope / (root3 * k_modulus)));
  }
  static double stress(double strain) { return k_modulus * (strain - std::sqrt(3.0) * plastic(strain)); }
  static double work_of_ends(double strain, int steps) {
    double work = 0;
    for (int n = 1; n <= steps; ++n) work += stress(strain * n / steps) * strain / steps;
    return work;
  }
};

// The work of the stresses of the ends of steps is more than the elastic energy and the plastic work, by what
// the run says; of the plastic work what hardening stores (2.118), or all but a share, does not become heat.
struct ShearRun {
  std::string name;
  double share;  ///< of Taylor and Quinney; zero: what hardening does not store
  std::vector<std::string> overrides;
};

class LagOfWork : public ::testing::TestWithParam<ShearRun> {};

TEST_P(LagOfWork, OfStressesIsSaidByTheRunAndHalvesWithTheStep) {
  const double share = GetParam().share;
  const CaseFolder folder("lag_shear_" + GetParam().name);
  constexpr double strain = 0.3, volume = 1e-4, capacity = 7800 * 500;  // [m³] of a metre, [J/(m³ K)]
  folder.write("hardening.toml", steel(1e-12,
                                       "[plasticity]\nflow_stress = \"300 MPa\"\n"
                                       "isotropic_hardening = \"linear\"\nhardening_modulus = \"2 GPa\"\n" +
                                           (share > 0 ? fmt::format("taylor_quinney = {}\n", share) : "")));
  const double xi = Sheared::plastic(strain), hardening = Sheared::k_slope * xi * xi / 2;
  const double flow = Sheared::k_yield * xi + hardening, heat = share > 0 ? share * flow : flow - hardening;
  const double elastic = Sheared::stress(strain) * Sheared::stress(strain) / (2 * Sheared::k_modulus);
  std::vector<double> errors;
  for (const int steps : {20, 40}) {
    const Printed printed;
    const CaseRun run =
        folder.run("shear_" + std::to_string(steps), sheared_block(steps), GetParam().overrides);
    ASSERT_TRUE(run.finished) << run.reason;
    const double excess = Sheared::work_of_ends(strain, steps) - elastic - flow;  // [J/m³]
    errors.push_back(capacity * (run.history.at("T[degC]").back() - 20) - heat);
    const double said = printed.number_after("do the work of whole steps: ");
    RecordProperty(std::to_string(steps) + "_steps",
                   fmt::format("{:.4g} J, said {:.4g} J, closed form {:.4g} J, of {:.4g} J",
                               errors.back() * volume, said, excess * volume, heat * volume));
    EXPECT_NEAR(errors.back(), excess, 0.01 * excess);
    EXPECT_NEAR(said, excess * volume, 0.01 * excess * volume);
    EXPECT_NEAR(printed.number_after("compared with "), heat * volume, 0.01 * heat * volume);
  }
  EXPECT_GT(errors[0] / errors[1], 1.7);  // two but for the step in which the block begins to yield
  EXPECT_LT(errors[0] / errors[1], 2.1);
}
INSTANTIATE_TEST_SUITE_P(
    Schemes, LagOfWork,
    ::testing::Values(ShearRun{"default", 0, {}}, ShearRun{"with_factor", 0.9, {}},
                      ShearRun{"mechanics_first", 0, {"coupling.order=mechanics_first"}},
                      ShearRun{"isothermal", 0, {"coupling.scheme=isothermal"}},
                      ShearRun{"isothermal_mechanics_first",
                               0.9,
                               {"coupling.scheme=isothermal", "coupling.order=mechanics_first"}},
                      ShearRun{"block_iterative", 0.9, {"coupling.scheme=block_iterative"}},
                      ShearRun{"simultaneous", 0.9, {"coupling.scheme=simultaneous"}}),
    [](const auto& of) { return of.param.name; });

// Kelvin: a bar that is pulled without heat cools to Θ_0 exp(−α σ/C_p). What it cools too little is the work
// of the stresses of the ends of steps, σ²/(2 E n), and nothing in schemes of second order.
TEST(Lag, OfTheWorkOfStressesIsWhatABarThatIsPulledCoolsTooLittle) {
  const CaseFolder folder("lag_pull");
  constexpr double k_expansion = 1.2e-5, k_stress = 2e8, k_capacity = 7800 * 500;
  folder.write("steel.toml", steel(k_expansion));
  const std::string text =
      R"(title = "A bar that is pulled without heat"
[analysis]
kind = "axisymmetric"
[mesh]
shape = "block"
element = "quad4"
[mesh.block]
size = ["5 mm", "20 mm"]
divisions = [2, 4]
[time]
end = "1 s"
step = "0.2 s"
[[body]]
name = "bar"
group = "block"
material = "steel.toml"
initial_temperature = "20 degC"
[[probe]]
name = "T"
kind = "mean"
field = "temperature"
group = "block"
unit = "degC"
)" + condition("mechanical", "y_min", "kind = \"displacement\"\nuz = \"0 mm\"") +
      condition("mechanical", "y_max", "kind = \"pressure\"\npressure = " + ramp("MPa", 0, -200, 1));
  const double kelvin = 293.15 * std::expm1(-k_expansion * k_stress / k_capacity);
  const double excess = k_stress * k_stress / (2 * 200e9 * 5) / k_capacity;
  EXPECT_GT(excess, 0.025 * std::abs(kelvin));
  const double joule = k_capacity * std::numbers::pi * 0.005 * 0.005 * 0.02;  // of a kelvin in the bar
  // The isothermal split heats by strains whose thermal part is a step behind, (C_p − C_v)/C_v of the cooling
  // of the last step.
  const double behind = 9 * k_expansion * k_expansion * 200e9 / (3 * (1 - 2 * 0.3)) * 293.15 / k_capacity / 5;
  // @param more, off  what the bar cools too little, and the error allowed of that [K]
  const auto expect = [&](const std::string& name, const std::vector<std::string>& overrides, double more,
                          double off, double lag = 0) {
    const Printed printed;
    const CaseRun run = folder.run(name, text, overrides);
    EXPECT_TRUE(run.finished) << run.reason;
    EXPECT_NEAR(run.history.at("T[degC]").back() - 20, kelvin * (1 + lag) + more, off) << name;
    const double said = printed.number_after("do the work of whole steps: ");
    if (more > 0)
      EXPECT_NEAR(said, more * joule, off * joule) << name;
    else
      EXPECT_TRUE(std::isnan(said)) << name << " says " << said;
    return printed.number_after("of the energy at hand, ");
  };
  const double percent = 0.01 * excess;
  expect("usual", {}, excess, percent);
  expect("isothermal", {"coupling.scheme=isothermal"}, excess, percent, behind);
  expect("alternating", {"coupling.scheme=block_iterative"}, excess, percent);
  expect("together", {"coupling.scheme=simultaneous"}, excess, percent);
  expect("moving", {"dynamics.method=backward_euler"}, excess, percent);
  expect("double_pass", {"coupling.scheme=double_pass"}, 0, 1e-4 * std::abs(kelvin));
  expect("two_stages", {"coupling.scheme=simultaneous", "coupling.integration=sdirk2"}, 0,
         1e-5 * std::abs(kelvin));
  expect("trapezoidal", {"dynamics.method=trapezoidal"}, 0, percent);
  // The excess work of the stresses of the ends of steps is lost, and the first law says so.
  EXPECT_NEAR(expect("entropy", {"coupling.structural_heating=entropy"}, 0, percent), -excess * joule,
              percent * joule);
}

}  // namespace
