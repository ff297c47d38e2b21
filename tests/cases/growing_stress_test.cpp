/// Stress in bodies that grow: closed forms of layered bars and of a clamped cube, the first law, restart,
/// processes, births one by one or in layers, what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "case_folder.hpp"

namespace {

using solidus::testing::CaseFolder;
using solidus::testing::CaseRun;
using ::testing::AllOf;
using ::testing::HasSubstr;

const CaseFolder k_here("growing_stress");

constexpr double k_young = 100e9, k_expansion = 2e-5, k_rise = 400;
constexpr double k_base = 0.004, k_layer = 0.002;  // [m]

/// Metal that conducts so well that a bar has one temperature; without a contraction across.
std::string metal(const std::string& more = "") {
  return k_here.write(more.empty() ? "metal.toml" : "yielding.toml",
                      "title = \"metal\"\ndensity = \"4000 kg/m3\"\nconductivity = \"4000 W/m/K\"\n"
                      "specific_heat = \"1000 J/kg/K\"\nyoung_modulus = \"100 GPa\"\npoisson_ratio = 0\n"
                      "expansion = \"2e-5 1/K\"\nexpansion_reference = \"20 degC\"\n" +
                          more);
}

/// A cantilever of layers of 2 mm on a base of 4 mm, held at x = 0, and the deflection of its lower side at
/// three places away from both ends.
struct Bar {
  int layers = 4, along = 24, rows_of_layer = 2;
  std::string element = "quad8", births = "20*(rint((y - 0.005)/0.002) + 1)", material = metal();
  std::string start = "{ formula = \"y < 0.0041 ? 20 : 420\", unit = \"degC\" }";
  std::string conditions, deposition, time = "[time]\nend = \"100 s\"\nstep = \"1 s\"\n";
  double height() const { return k_base + layers * k_layer; }
  std::string text() const {
    std::string text = fmt::format(
        "title = \"A bar of layers\"\n[analysis]\nkind = \"plane_strain\"\n[mesh]\nshape = \"block\"\n"
        "element = \"{}\"\n[mesh.block]\nsize = [\"96 mm\", \"{} m\"]\ndivisions = [{}, {}]\n"
        "[[body]]\nname = \"block\"\nmaterial = \"{}\"\ninitial_temperature = {}\n"
        "[[deposition]]\nname = \"layers\"\nbody = \"block\"\nkind = \"times\"\nbare = \"y_max\"\n"
        "time = {{ formula = \"y < 0.004 ? 0 : {}\" }}\n{}"
        "[[mechanical_condition]]\nname = \"clamp\"\ngroup = \"x_min\"\nkind = \"displacement\"\nux = \"0 "
        "mm\"\nuy = \"0 mm\"\n{}{}",
        element, height(), along, (2 + layers) * rows_of_layer, material, start, births, deposition,
        conditions, time);
    for (const int x : {32, 48, 64})
      text += fmt::format(
          "[[probe]]\nname = \"v{}\"\nfield = \"displacement\"\ncomponent = \"y\"\nunit = \"m\"\npoint = "
          "[\"{} mm\", \"0 mm\"]\n",
          x, x);
    return text;
  }
};

std::string films() {
  std::string text;
  for (const char* group : {"y_min", "y_max"})
    text += fmt::format(
        "[[thermal_condition]]\nname = \"air_{}\"\ngroup = \"{}\"\nkind = \"film\"\ncoefficient = \"20000 "
        "W/m2/K\"\nambient = \"20 degC\"\n",
        group, group);
  return text;
}

/// Curvature of the lower side by second differences, positive where the ends rise.
double curvature(const CaseRun& run, double time) {
  const auto v = [&](const char* name) { return solidus::testing::at(run.history, name, time); };
  return (v("v32[m]") - 2 * v("v48[m]") + v("v64[m]")) / std::pow(0.016, 2);
}

/// The bar as a beam: a layer that is laid on it hot and cools pulls it together on its upper side,
///   Δκ = α ∫ (Θ_b − Θ) (y − y_m) dy / I,  y_m and I of all that is there.
/// Θ_b is that of the nodes at birth: in the middle of old and new metal at their common face, whose
/// quadratic interpolation over the lowest row is Θ + ΔΘ (1 + η/4 − η²/4). At the face of the base the
/// formula of the initial temperature has the new metal cold, and the difference to one is twice that.
double curvature_of_layers(int layers, int rows_of_layer) {
  double total = 0;
  for (int k = 1; k <= layers; ++k) {
    const double height = k_base + k * k_layer, middle = height / 2, inertia = std::pow(height, 3) / 12;
    const double row = k_layer / rows_of_layer, foot = height - k_layer;
    const double all = k_layer * (foot + k_layer / 2 - middle);
    // Over the row the mean of η/4 − η²/4 is −1/12, and that of its product with η is 1/12.
    const double lowest = row * (-(foot + row / 2 - middle) / 12 + row / 2 / 12);
    total += k_expansion * k_rise * (all + (k == 1 ? 2 : 1) * lowest) / inertia;
  }
  return total;
}

TEST(GrowingStress, ABarOfLayersHasTheCurvatureOfItsClosedForm) {
  Bar bar;
  bar.conditions = films();
  const CaseRun run = k_here.run("layers", bar.text());
  ASSERT_TRUE(run.finished) << run.reason;
  const double exact = curvature_of_layers(4, 2), found = curvature(run, 100);
  RecordProperty("percent", std::to_string(100 * std::abs(found / exact - 1)));
  EXPECT_NEAR(found, exact, 1e-4 * exact) << "of " << exact << " 1/m";
}

/// A base that a couple bends, onto which a layer is laid at the same temperature, until 3 s; at 4 s the
/// couple has gone.
Bar bent_bar(const std::string& births) {
  Bar bar;
  bar.layers = 1;
  bar.start = "\"20 degC\"";
  bar.births = births;
  bar.conditions =
      "[[mechanical_condition]]\nname = \"couple\"\ngroup = \"x_max\"\nkind = \"traction\"\nstages = "
      "[\"bent\"]\ntraction = [{ formula = \"y < 0.004 ? 2e10*(0.002 - y) : 0\", unit = \"Pa\" }, \"0 "
      "Pa\"]\n[[stage]]\nname = \"bent\"\nduration = \"3 s\"\n[[stage]]\nname = \"free\"\nduration = \"1 "
      "s\"\n";
  bar.time = "[time]\nstep = \"1 s\"\n";
  return bar;
}

/// The layer is free of stress at κ: it springs back to κ (1 − I_0/I_1).
TEST(GrowingStress, ALayerOnABentBarHoldsItBent) {
  const CaseRun run = k_here.run("bent", bent_bar("2").text());
  ASSERT_TRUE(run.finished) << run.reason;
  const double bent = 2e10 / k_young, share = std::pow(k_base / (k_base + k_layer), 3);
  EXPECT_NEAR(curvature(run, 2), bent, 0.001 * bent);
  EXPECT_NEAR(curvature(run, 3), bent, 0.001 * bent);  // the layer adds nothing at its birth
  EXPECT_NEAR(curvature(run, 4), bent * (1 - share), 0.002 * bent);
}

/// Under a load that stays all elements are laid on the same shape, in whatever order they come.
TEST(GrowingStress, ElementByElementIsAsLayerByLayer) {
  const CaseRun at_once = k_here.run("at_once", bent_bar("2").text());
  const CaseRun one_by_one = k_here.run("one_by_one", bent_bar("1 + 20*x").text());  // until 2.92 s
  ASSERT_TRUE(at_once.finished && one_by_one.finished);
  EXPECT_NEAR(curvature(one_by_one, 4), curvature(at_once, 4), 1e-4 * curvature(at_once, 4));
}

/// A cube that is held on all sides, deposited in layers and heated.
std::string clamped_cube(const std::string& element) {
  std::string text = fmt::format(
      "title = \"A cube that is held\"\n[analysis]\nkind = \"solid\"\n[mesh]\nshape = \"block\"\nelement = "
      "\"{}\"\n[mesh.block]\nsize = [\"10 mm\", \"10 mm\", \"10 mm\"]\ndivisions = [2, 2, 4]\n"
      "[time]\nend = \"20 s\"\nstep = \"1 s\"\n[[body]]\nname = \"block\"\nmaterial = \"{}\"\n"
      "initial_temperature = \"100 degC\"\n[[deposition]]\nname = \"layers\"\nbody = \"block\"\nkind = "
      "\"front\"\nfrom = [\"0 mm\", \"0 mm\", \"3 mm\"]\nnormal = [0, 0, 1]\nspeed = \"1 mm/s\"\n"
      "[[thermal_condition]]\nname = \"heating\"\ngroup = \"block\"\nkind = \"source\"\npower = {{ of = "
      "\"time\", argument_unit = \"s\", unit = \"MW/m3\", points = [[0, 0], [10, 0], [10.001, 80], [20, 80]] "
      "}}\n",
      element,
      k_here.write("cube.toml",
                   "title = \"metal\"\ndensity = \"4000 kg/m3\"\nconductivity = \"400 W/m/K\"\n"
                   "specific_heat = \"1000 J/kg/K\"\nyoung_modulus = \"100 GPa\"\npoisson_ratio = 0.3\n"
                   "expansion = \"2e-5 1/K\"\n"));
  const char* const axes = "xyz";
  for (int i = 0; i < 3; ++i)
    for (const char* side : {"min", "max"})
      text += fmt::format(
          "[[mechanical_condition]]\nname = \"{0}_{1}\"\ngroup = \"{0}_{1}\"\nkind = \"displacement\"\nu{0} "
          "= "
          "\"0 mm\"\n",
          axes[i], side);
  for (const char* component : {"xx", "zz"})
    for (const char* kind : {"minimum", "maximum"})
      text += fmt::format(
          "[[probe]]\nname = \"{0}_{1}\"\nkind = \"{1}\"\nfield = \"stress\"\ncomponent = \"{0}\"\ngroup = "
          "\"block\"\nunit = \"MPa\"\n",
          component, kind);
  text +=
      "[[probe]]\nname = \"T\"\nfield = \"temperature\"\nunit = \"degC\"\npoint = [\"5 mm\", \"5 mm\", \"8 "
      "mm\"]\n";
  return text;
}

TEST(GrowingStress, ACubeThatIsHeldHasItsClosedFormAfterDeposition) {
  for (const char* element : {"hex8", "hex20", "tet10"}) {
    const CaseRun run = k_here.run(std::string("cube_") + element, clamped_cube(element));
    ASSERT_TRUE(run.finished) << run.reason;
    const auto last = [&](const std::string& column) { return run.history.at(column).back(); };
    const double rise = last("T[degC]") - 100;
    EXPECT_GT(rise, 100);
    // −E α ΔΘ/(1 − 2ν); what deformation heats is conducted in the step that follows.
    const double exact = -1e-6 * k_young * k_expansion * rise / (1 - 2 * 0.3);
    for (const char* component : {"xx", "zz"})
      for (const char* kind : {"minimum", "maximum"})
        EXPECT_NEAR(last(fmt::format("{}_{}[MPa]", component, kind)), exact, 2e-4 * std::abs(exact))
            << element << ' ' << component;
    EXPECT_LT(std::abs(last("energy_defect[J]")), 1e-8 * last("heat_exchanged[J]"));
  }
}

/// Hot layers on a bar that yields, as time steps adapt.
Bar yielding() {
  Bar bar;
  bar.layers = 2, bar.element = "quad4", bar.along = 12;
  bar.material = metal("[plasticity]\nflow_stress = \"100 MPa\"\n");
  bar.conditions = films();
  bar.time = "[time]\nend = \"60 s\"\nstep = \"1 s\"\nadaptive = true\n";
  return bar;
}

TEST(GrowingStress, TheFirstLawHoldsWithMetalThatComesAndYields) {
  for (const char* scheme : {"isentropic", "isothermal", "double_pass", "block_iterative"}) {
    const Bar bar = yielding();
    const CaseRun run = k_here.run(std::string("first_law_") + scheme, bar.text(),
                                   {fmt::format("coupling.scheme=\"{}\"", scheme)});
    ASSERT_TRUE(run.finished) << run.reason;
    EXPECT_LT(std::abs(run.history.at("energy_defect[J]").back()),
              1e-8 * run.history.at("heat_exchanged[J]").back())
        << scheme;
    EXPECT_GT(run.history.at("plastic_dissipation[J]").back(), 0) << scheme;
  }
}

TEST(GrowingStress, GoesOnExactlyAfterARestart) {
  k_here.expect_exact_restart("restart", yielding().text(), 8);  // between the births
  k_here.expect_exact_restart("restart_two_step", yielding().text(), 8, {"mechanics.integration=\"bdf2\""});
}

/// Births on both sides of a boundary between processes.
TEST(GrowingStress, TwoProcessesAgreeWithOne) {
  const std::string exact = " --set mechanics.solver='\"direct\"' --set time.adaptive=false";
  const std::string file = k_here.write("two.toml", yielding().text());
  for (const int n : {1, 2}) {
    const std::string command = fmt::format(
        "env -i PATH=\"$PATH\" HOME=\"$HOME\" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 "
        "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1 mpirun -n "
        "{} "
        "--bind-to none --oversubscribe '" SOLIDUS_BINARY_DIR
        "/solidus' run -o '{}' --no-progress '{}'{} "
        ">/dev/null 2>&1",
        n, (k_here.root() / fmt::format("two_{}", n)).string(), file, exact);
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }
  const auto one = solidus::testing::read_csv(k_here.root() / "two_1" / "history.csv"),
             two = solidus::testing::read_csv(k_here.root() / "two_2" / "history.csv");
  for (const char* column : {"v64[m]", "T_max[degC]", "plastic_dissipation[J]", "deposited_mass[kg]"})
    EXPECT_NEAR(two.at(column).back(), one.at(column).back(), 1e-6 * std::abs(one.at(column).back()))
        << column;
}

/// A bar between two walls that is heated until it melts, held, and cooled, all of it at one temperature.
/// @param births      when the elements come [s], a formula
/// @param start       [degC]
/// @param plasticity  lines of the card
std::string remelted_bar(const std::string& name, const std::string& births, int start, const char* heating,
                         const std::string& plasticity) {
  const std::string card = k_here.write(
      name + "_metal.toml",
      "title = \"metal\"\ndensity = \"4000 kg/m3\"\nconductivity = \"400 W/m/K\"\nspecific_heat = \"1000 "
      "J/kg/K\"\nyoung_modulus = \"100 GPa\"\npoisson_ratio = 0.3\nexpansion = \"2e-5 1/K\"\n" +
          plasticity +
          "[[phase_change]]\nname = \"solidification\"\nsolidification = true\nlatent_heat = \"100 "
          "kJ/kg\"\nfraction = { kind = \"linear\", solidus = \"600 degC\", liquidus = \"602 degC\" }\n");
  std::string text = fmt::format(
      "title = \"A bar between two walls melts and freezes again\"\n[analysis]\nkind = \"solid\"\n[mesh]\n"
      "shape = \"block\"\nelement = \"hex8\"\n[mesh.block]\nsize = [\"10 mm\", \"10 mm\", \"10 "
      "mm\"]\ndivisions = [1, 1, 2]\n[time]\nend = \"100 s\"\nstep = \"0.25 s\"\n[[body]]\nname = "
      "\"block\"\nmaterial = \"{}\"\ninitial_temperature = \"{} degC\"\n",
      card, start);
  if (!births.empty())
    text += fmt::format(
        "[[deposition]]\nname = \"metal\"\nbody = \"block\"\nkind = \"times\"\ntime = {{ formula = "
        "\"{}\" }}\n",
        births);
  for (const char* group : {"x_min", "x_max"})
    text += fmt::format(
        "[[thermal_condition]]\nname = \"{0}\"\ngroup = \"{0}\"\nkind = \"temperature\"\ntemperature = {{ of "
        "= \"time\", argument_unit = \"s\", unit = \"degC\", points = [{1}[60, 620], [80, 560], [100, 420]] "
        "}}\n",
        group, heating);
  for (const char* support : {"x_min ux", "x_max ux", "y_min uy", "z_min uz"})
    text += fmt::format(
        "[[mechanical_condition]]\nname = \"{0}\"\ngroup = \"{0}\"\nkind = \"displacement\"\n{1} = \"0 "
        "mm\"\n",
        std::string(support).substr(0, 5), std::string(support).substr(6));
  text +=
      "[[probe]]\nname = \"axial\"\nfield = \"stress\"\ncomponent = \"xx\"\nunit = \"MPa\"\npoint = [\"5 "
      "mm\", \"5 mm\", \"7 mm\"]\n[[probe]]\nname = \"brittle\"\nfield = \"brittle_strain\"\nunit = "
      "\"1\"\npoint = [\"5 mm\", \"5 mm\", \"7 mm\"]\n[[probe]]\nname = \"strain\"\nfield = "
      "\"strain_since_coherency\"\nunit = \"1\"\npoint = [\"5 mm\", \"5 mm\", \"7 mm\"]\n[[probe]]\nname = "
      "\"distortion\"\nfield = \"distortion\"\ncomponent = \"z\"\nunit = \"m\"\nbody = \"block\"\npoint = "
      "[\"10 mm\", \"10 mm\", \"10 mm\"]\n";
  return text;
}
constexpr const char* k_heated = "[0, 20], [40, 620], ";

/// Heating has bent it far beyond the yield stress; what freezes has the stress of its cooling from
/// coherency, as metal that freezes for the first time: E α (Θ_c − Θ), Θ_c within the range of 2 K, up to
/// yield.
TEST(GrowingStress, MetalThatMeltsAgainForgetsItsStress) {
  const std::string yields = "[plasticity]\nflow_stress = \"100 MPa\"\n";
  const CaseRun again = k_here.run("melts_again", remelted_bar("again", "", 20, k_heated, yields)),
                first = k_here.run("melts_first", remelted_bar("first", "", 620, "", yields));
  ASSERT_TRUE(again.finished && first.finished) << again.reason << first.reason;
  const auto at = [](const CaseRun& run, const char* column, double time) {
    return solidus::testing::at(run.history, column, time);
  };
  EXPECT_NEAR(at(again, "axial[MPa]", 38), -100, 0.1);  // yields under the walls
  for (const double time : {70.0, 75.0, 80.0, 100.0})
    EXPECT_NEAR(at(again, "axial[MPa]", time), at(first, "axial[MPa]", time), 0.01) << time << " s";
  const double slope = (at(again, "axial[MPa]", 80) - at(again, "axial[MPa]", 70)) / 30;
  EXPECT_NEAR(slope, 2, 1e-3);  // E α [MPa/K]
  const double coherent = 560 + at(again, "axial[MPa]", 80) / 2;
  EXPECT_GT(coherent, 600);
  EXPECT_LT(coherent, 602);
  EXPECT_NEAR(at(again, "axial[MPa]", 100), 100, 0.1);
  EXPECT_NEAR(at(again, "brittle[1]", 100), at(first, "brittle[1]", 100), 1e-9);
  EXPECT_NEAR(at(again, "strain[1]", 100), at(first, "strain[1]", 100), 1e-7);
}

/// Hardening stays (4.112): ξ at the end is the sum of heating and cooling. The documentation says so.
TEST(GrowingStress, MetalThatMeltsAgainKeepsItsHardening) {
  const std::string hardens =
      "[plasticity]\nflow_stress = \"100 MPa\"\nisotropic_hardening = \"linear\"\nhardening_modulus = \"2 "
      "GPa\"\n";
  const CaseRun run = k_here.run("keeps_hardening", remelted_bar("hardens", "", 20, k_heated, hardens));
  ASSERT_TRUE(run.finished) << run.reason;
  // Beyond yield E α ΔΘ = σ + E ξ, σ = σ_0 + H ξ: in compression up to 600 degC, then in tension.
  const double heating = (2 * 580 - 100) / 102.0e3, cooling = (2 * 180.36 - 100 - 2e3 * heating) / 102.0e3;
  EXPECT_NEAR(solidus::testing::at(run.history, "axial[MPa]", 100), 100 + 2e3 * (heating + cooling), 0.2);
}

/// Criteria of strain begin with the elements: the upper one comes while all is melt, and has the values of a
/// bar that is complete from the start.
TEST(GrowingStress, CriteriaOfStrainFollowNewElements) {
  const std::string yields = "[plasticity]\nflow_stress = \"100 MPa\"\n";
  const std::vector<std::string> fine = {"time.step=\"0.05 s\""};  // ten in the range of 2 K
  const CaseRun whole = k_here.run("criteria_whole", remelted_bar("whole", "", 620, "", yields), fine);
  const std::string text = remelted_bar("grown", "z < 0.005 ? 0 : 20", 620, "", yields);
  const CaseRun grown = k_here.run("criteria_grown", text, fine);
  ASSERT_TRUE(whole.finished && grown.finished) << whole.reason << grown.reason;
  for (const char* column : {"axial[MPa]", "brittle[1]", "strain[1]", "distortion[m]"}) {
    const double value = whole.history.at(column).back();
    EXPECT_GT(std::abs(value), 0) << column;
    EXPECT_NEAR(grown.history.at(column).back(), value, 1e-6 * std::abs(value)) << column;
  }
  // A bar that is held: α ΔΘ of the brittle range, 0.09 of 2 K.
  EXPECT_NEAR(grown.history.at("brittle[1]").back(), 2e-5 * 0.18, 0.2 * 2e-5 * 0.18);
  k_here.expect_exact_restart("criteria_restart", text, 1331, fine);       // as it freezes
  k_here.expect_exact_restart("criteria_restart_early", text, 300, fine);  // before the upper element
}

TEST(GrowingStress, RefusesWhatItCannotYetWithItsPlace) {
  const Bar bar = yielding();
  const std::string text = bar.text();
  EXPECT_THAT(k_here.refusal("simultaneous", text + "[coupling]\nscheme = \"simultaneous\"\n"),
              AllOf(HasSubstr("simultaneous.toml:"), HasSubstr("the simultaneous scheme cannot yet")));
  EXPECT_THAT(k_here.refusal("inertia", text + "[dynamics]\n"), HasSubstr("inertia"));
  Bar mixed = yielding();
  mixed.element = "tri3";
  EXPECT_THAT(k_here.refusal("mixed", mixed.text()),
              AllOf(HasSubstr("mixed.toml:"), HasSubstr("mixed triangles or tetrahedra")));
  std::string relative = text;
  relative.replace(relative.find("ux = "), 5, "relative = true\nux = ");
  EXPECT_THAT(k_here.refusal("relative", relative),
              AllOf(HasSubstr("'clamp'"), HasSubstr("relative = false")));
  std::string mechanics = text;
  mechanics.replace(mechanics.find("[analysis]\n"), 11, "[analysis]\nphysics = \"mechanics\"\n");
  EXPECT_THAT(k_here.refusal("mechanics", mechanics), HasSubstr("thermomechanical"));
}

}  // namespace
