/// Contact of bodies that grow: the gap of a bar that grows up to a wall, the weight of a block that is laid
/// on a support, heat through the contact of what was born, the first law, restart, processes, what is
/// refused.
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

const CaseFolder k_here("growing_contact");

constexpr double k_expansion = 2e-5, k_rise = 400, k_density = 4000, k_heat = 1000;

/// Metal that conducts so well that a layer has one temperature; without a contraction across.
std::string metal(const std::string& more = "") {
  return k_here.write(more.empty() ? "metal.toml" : "yielding.toml",
                      "title = \"metal\"\ndensity = \"4000 kg/m3\"\nconductivity = \"4000 W/m/K\"\n"
                      "specific_heat = \"1000 J/kg/K\"\nyoung_modulus = \"100 GPa\"\npoisson_ratio = 0\n"
                      "expansion = \"2e-5 1/K\"\nexpansion_reference = \"20 degC\"\n" +
                          more);
}

std::string condition(const std::string& name, const std::string& group, const std::string& component) {
  return fmt::format(
      "[[mechanical_condition]]\nname = \"{}\"\ngroup = \"{}\"\nkind = \"displacement\"\n{} = \"0 mm\"\n",
      name, group, component);
}

std::string film(const std::string& group, double coefficient) {
  return fmt::format(
      "[[thermal_condition]]\nname = \"film_{0}\"\ngroup = \"{0}\"\nkind = \"film\"\ncoefficient = \"{1} "
      "W/m2/K\"\nambient = \"20 degC\"\n",
      group, coefficient);
}

/// Two blocks, one above the other, of which one is laid down in layers of 2 mm.
struct Blocks {
  std::string element = "quad4", material = metal(), analysis;  ///< further lines of [analysis]
  std::string upper_time = "0", lower_time = "0";               ///< of birth, by y [m]
  std::string upper_start = "\"420 degC\"", lower_start = "\"20 degC\"";
  double lower = 0.010, upper = 0.008;  ///< heights [m]
  std::string contact = "conductance = \"20 kW/m2/K\"\ngap_law = \"constant\"\n";
  std::string time = "[time]\nend = \"60 s\"\nstep = \"1 s\"\n", more;

  std::string body(const char* name, const std::string& start, const std::string& time_of_birth) const {
    std::string text = fmt::format(
        "[[body]]\nname = \"{0}\"\nmaterial = \"{1}\"\ninitial_temperature = {2}\n", name, material, start);
    if (time_of_birth != "0")
      text += fmt::format(
          "[[deposition]]\nname = \"of_{0}\"\nbody = \"{0}\"\nkind = \"times\"\ntime = {{ formula = \"{1}\" "
          "}}\n",
          name, time_of_birth);
    return text;
  }
  std::string text() const {
    return fmt::format(
               "title = \"Two blocks, one of which grows\"\n[analysis]\nkind = "
               "\"plane_strain\"\n{}[mesh]\nshape = "
               "\"two_blocks\"\nelement = \"{}\"\n[mesh.two_blocks]\nlower = [\"10 mm\", \"{} m\"]\n"
               "lower_divisions = [4, 5]\nupper = [\"10 mm\", \"{} m\"]\nupper_divisions = [3, 4]\n"
               "[criteria]\nfollow = false\n",
               analysis, element, lower, upper) +
           body("upper", upper_start, upper_time) + body("lower", lower_start, lower_time) +
           "[[contact]]\nname = \"joint\"\nslave = \"upper_bottom\"\nmaster = \"lower_top\"\n" +
           (contact.empty() ? "" : "[contact.heat]\n" + contact) + time + more;
  }
};

std::string gap_probe() {
  return "[[probe]]\nname = \"gap\"\nfield = \"gap\"\nbody = \"upper\"\npoint = [\"0 mm\", \"10 mm\"]\nunit "
         "= "
         "\"um\"\n";
}

double last(const CaseRun& run, const std::string& column) {
  return run.history.at(column).back();
}

/// A bar of two rows grows from its foot up to a wall, which its last layer touches when it comes. The
/// earlier ones are cold and short by then: what opens is the contraction of the last layer alone, that of
/// all of it less a quarter for the row that begins as hot as the mean of old and new metal at its foot.
TEST(GrowingContact, ABarThatGrowsUpToAWallLeavesTheGapOfItsLastLayer) {
  Blocks bar;
  bar.lower_time = "30*rint((y - 0.001)/0.002)";  // at 0, 30, … 120 s
  bar.lower_start = "\"420 degC\"", bar.upper_start = "\"20 degC\"";
  bar.contact.clear();  // no heat
  bar.time = "[time]\nend = \"150 s\"\nstep = \"1 s\"\n";
  bar.more = condition("foot", "lower_y_min", "uy") + condition("side", "lower_x_min", "ux") +
             condition("other_side", "lower_x_max", "ux") + condition("wall", "upper_y_max", "uy") +
             condition("wall_side", "upper_x_min", "ux") + film("lower_y_min", 50000) + gap_probe();
  const CaseRun run = k_here.run("bar", bar.text());
  ASSERT_TRUE(run.finished) << run.reason;
  const double exact = 1e6 * k_expansion * k_rise * 0.002 * (1 - 0.25);
  EXPECT_NEAR(last(run, "gap[um]"), exact, 1e-3 * exact);
}

/// A block laid on a support layer by layer presses on it with the weight that is there.
TEST(GrowingContact, ABlockLaidOnASupportPressesWithItsWeight) {
  for (const char* element : {"quad4", "quad8", "tri6"}) {
    Blocks block;
    block.element = element;
    block.upper_time = "5*rint((y - 0.011)/0.002) + 5";  // at 5, 10, 15, 20 s
    block.upper_start = "\"20 degC\"";
    block.time = "[time]\nend = \"25 s\"\nstep = \"1 s\"\n";
    block.analysis = "gravity = \"10 m/s2\"\n";
    block.more = condition("foot", "lower_y_min", "uy") + condition("side", "lower_x_min", "ux") +
                 condition("upper_side", "upper_x_min", "ux");
    const CaseRun run = k_here.run(std::string("weight_") + element, block.text());
    ASSERT_TRUE(run.finished) << run.reason;
    const double layer = k_density * 10 * 0.010 * 0.002;  // per metre [N]
    for (const int n : {1, 2, 3, 4})
      EXPECT_NEAR(solidus::testing::at(run.history, "joint_normal_force[N]", 5.0 * n + 4), n * layer,
                  1e-6 * layer)
          << element << ' ' << n;
  }
}

/// A layer that comes hot onto a cold support gives it its heat through the contact from then on.
TEST(GrowingContact, HeatPassesThroughTheContactOfWhatWasBorn) {
  Blocks layer;
  layer.analysis = "physics = \"heat\"\n";
  layer.upper_time = "4";
  layer.contact = "conductance = \"2000 W/m2/K\"\ngap_law = \"constant\"\n";
  layer.time = "[time]\nend = \"14 s\"\nstep = \"0.1 s\"\n";
  layer.more = film("lower_y_min", 1e8) +
               "[[probe]]\nname = \"T\"\nfield = \"temperature\"\nkind = \"mean\"\ngroup = \"upper\"\nunit = "
               "\"degC\"\n";
  const CaseRun run = k_here.run("heat", layer.text());
  ASSERT_TRUE(run.finished) << run.reason;
  // Conductance of the contact and of half of either block in series.
  const double h = 1 / (1 / 2000.0 + 0.010 / 4000), rate = h / (k_density * k_heat * 0.008);
  EXPECT_NEAR(last(run, "T[degC]"), 20 + 400 * std::exp(-10 * rate), 0.5);
}

/// Estimates of a casting that is not there at the start are those with all of its contact, and finite.
TEST(GrowingContact, ACastingThatComesWhollyLaterIsMeasuredWithAllOfItsContact) {
  Blocks layer;
  layer.analysis = "physics = \"heat\"\n";
  layer.upper_time = "4";
  layer.upper_start = "\"700 degC\"";
  layer.time = "[time]\nend = \"6 s\"\nstep = \"1 s\"\n";
  layer.more = film("lower_y_min", 1000);
  std::string text = layer.text();
  const std::string card = "material = \"" + layer.material + "\"";
  text.replace(text.find(card), card.size(), "material = \"aluminium_99_7\"");
  const CaseRun run = k_here.run("comes_later", text);  // a summary with an infinite modulus would be refused
  EXPECT_TRUE(run.finished) << run.reason;
}

/// Hot layers on a support, with friction, as time steps adapt; the metal yields.
Blocks laid(const std::string& steps = "adaptive = true\n") {
  Blocks block;
  block.analysis = "gravity = \"10 m/s2\"\n";
  block.material = metal("[plasticity]\nflow_stress = \"100 MPa\"\n");
  block.upper_time = "5*rint((y - 0.011)/0.002) + 2.5";
  block.time = "[time]\nend = \"30 s\"\nstep = \"0.5 s\"\n" + steps;
  block.contact =
      "conductance = \"20 kW/m2/K\"\ngap_law = \"gas\"\ngas_conductivity = \"0.05 W/m/K\"\n"
      "[contact.friction]\ncoefficient = 0.2\n";
  block.more = condition("foot", "lower_y_min", "uy") + condition("side", "lower_x_min", "ux") +
               condition("upper_side", "upper_x_min", "ux") + film("lower_y_min", 20000) +
               film("upper_x_max", 500) + gap_probe();
  return block;
}

const std::vector<std::string> k_slides = {"contact.joint.formulation=\"large_sliding\"",
                                           "contact.joint.interface.heat_capacity=\"500 J/m2/K\""};

TEST(GrowingContact, TheFirstLawHoldsWithContactThatComes) {
  for (const char* scheme : {"isentropic", "isothermal", "double_pass", "block_iterative"}) {
    const CaseRun run = k_here.run(std::string("first_law_") + scheme, laid().text(),
                                   {fmt::format("coupling.scheme=\"{}\"", scheme)});
    ASSERT_TRUE(run.finished) << run.reason;
    EXPECT_LT(std::abs(last(run, "energy_defect[J]")), 1e-8 * last(run, "heat_exchanged[J]")) << scheme;
  }
  // An interface that stores heat comes with what it stores; a slave that grows slides on a master that does
  // not.
  const CaseRun run = k_here.run("first_law_slides", laid().text(), k_slides);
  ASSERT_TRUE(run.finished) << run.reason;
  EXPECT_LT(std::abs(last(run, "energy_defect[J]")), 1e-8 * last(run, "heat_exchanged[J]"));
}

TEST(GrowingContact, GoesOnExactlyAfterARestart) {
  k_here.expect_exact_restart("restart", laid().text(), 12);  // between the births
  k_here.expect_exact_restart("restart_slides", laid().text(), 12, {k_slides[0]});
}

/// Births on both sides of a boundary between processes, contact across it.
TEST(GrowingContact, TwoProcessesAgreeWithOne) {
  const std::string file = k_here.write("two.toml", laid("").text());
  for (const int n : {1, 2}) {
    const std::string command = fmt::format(
        "env -i PATH=\"$PATH\" HOME=\"$HOME\" OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 "
        "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1 mpirun -n "
        "{} --bind-to none --oversubscribe '" SOLIDUS_BINARY_DIR
        "/solidus' run -o '{}' --no-progress '{}' --set mechanics.solver='\"direct\"' >/dev/null 2>&1",
        n, (k_here.root() / fmt::format("two_{}", n)).string(), file);
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
  }
  const auto one = solidus::testing::read_csv(k_here.root() / "two_1" / "history.csv"),
             two = solidus::testing::read_csv(k_here.root() / "two_2" / "history.csv");
  for (const char* column : {"gap[um]", "T_max[degC]", "heat_exchanged[J]", "deposited_mass[kg]"})
    EXPECT_NEAR(two.at(column).back(), one.at(column).back(), 1e-6 * std::abs(one.at(column).back()))
        << column;
}

TEST(GrowingContact, RefusesWhatItCannotYetWithItsPlace) {
  const std::string text = laid("").text();
  const auto with = [&](const std::string& line) {
    std::string changed = text;
    const std::string place = "master = \"lower_top\"\n";
    return changed.insert(changed.find(place) + place.size(), line);
  };
  EXPECT_THAT(k_here.refusal("means", with("integration = \"mortar\"\n")),
              AllOf(HasSubstr("means.toml:"), HasSubstr("'joint'"), HasSubstr("mortar")));
  std::string slides = with("formulation = \"large_sliding\"\n");
  const std::string sides = "slave = \"upper_bottom\"\nmaster = \"lower_top\"\n";
  slides.replace(slides.find(sides), sides.size(), "slave = \"lower_top\"\nmaster = \"upper_bottom\"\n");
  EXPECT_THAT(k_here.refusal("slides", slides),
              AllOf(HasSubstr("slides.toml:"), HasSubstr("large sliding cannot follow")));
}

}  // namespace
