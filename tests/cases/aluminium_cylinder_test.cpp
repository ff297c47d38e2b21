/// Monograph 7.3: what figures 7.19–7.22 and the text say of the aluminium cylinder, and the first law along
/// the way.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "case_run.hpp"
#include "system/errors.hpp"

namespace {

using solidus::testing::at;
using solidus::testing::CaseRun;
using solidus::testing::run;

// A coarser mesh and a shorter time for what does not depend on either.
const std::vector<std::string> k_small{"mesh.cylinder_in_mould.element_size=\"2.5 mm\"",
                                       "mesh.cylinder_in_mould.mould_element_size=\"5 mm\"",
                                       "time.end=\"20 s\"", "output.times=[\"20 s\"]"};

CaseRun small(const std::string& name, std::vector<std::string> more) {
  more.insert(more.begin(), k_small.begin(), k_small.end());
  return run("cases/aluminium_cylinder", name, more);
}

double relative_defect(const CaseRun& r) {
  return std::abs(r.history.at("energy_defect[J]").back()) / r.history.at("heat_exchanged[J]").back();
}

TEST(AluminiumCylinder, ShowsWhatTheMonographShows) {
  const CaseRun r = run("cases/aluminium_cylinder", "aluminium_cylinder");
  ASSERT_TRUE(r.finished) << r.reason;
  const auto& h = r.history;
  // The centre's plateau at the freezing point, "up to 15 s approximately"; the bottom of our mould ends it
  // somewhat before the 14.4 s of a long cylinder.
  for (const double t : {5.0, 8.0, 12.0}) EXPECT_NEAR(at(h, "T_center[degC]", t), 659.7, 0.5) << t;
  EXPECT_LT(at(h, "T_center[degC]", 17), 600);
  // It cools from there on without a notch, as the last of the metal.
  const std::vector<double>&center = h.at("T_center[degC]"), &surface = h.at("T_casting_surface[degC]");
  for (std::size_t n = 1; n < center.size(); ++n) {
    EXPECT_LT(center[n], center[n - 1] + 0.01) << n << " s";
    EXPECT_GT(center[n], surface[n]) << n << " s";
  }
  // The casting's surface falls fast, the mould's rises and both draw together.
  EXPECT_LT(at(h, "T_casting_surface[degC]", 10), 640);
  EXPECT_GT(at(h, "T_mould_surface[degC]", 10), 300);
  EXPECT_LT(at(h, "T_casting_surface[degC]", 90) - at(h, "T_mould_surface[degC]", 90),
            0.3 * (at(h, "T_casting_surface[degC]", 10) - at(h, "T_mould_surface[degC]", 10)));
  // The gap is of order 0.08 mm at 90 s.
  EXPECT_GE(at(h, "gap[mm]", 90), 0.06);
  EXPECT_LE(at(h, "gap[mm]", 90), 0.10);
  EXPECT_NEAR(h.at("solid_fraction[1]").back(), 1.0, 1e-12);
  // No temperature leaves the range of the initial ones: the closed rule, whatever the front does.
  EXPECT_LE(*std::max_element(h.at("T_max[degC]").begin(), h.at("T_max[degC]").end()), 670 + 1e-9);
  // The casting rests on the mould with the casting's weight, to the 0.1 % of Newton's criterion in each of
  // its nodes.
  const double weight = 2650 * 9.81 * std::numbers::pi * 0.015 * 0.015 * 0.07;
  EXPECT_NEAR(h.at("contact_force[N]").back(), weight, 0.02 * weight);
}

// A step of first order in place of one of second, because a melt at rest on its plateau was extrapolated
// beyond its hottest node by what the iteration had left, was a jump of 1.5 K in two steps (decision 0016).
TEST(AluminiumCylinder, FreezesAsWithTightTolerances) {
  const std::vector<std::string> start{"time.end=\"10 s\"", "output.times=[\"10 s\"]"};
  std::vector<std::string> converged = start;
  converged.insert(converged.end(), {"heat.tolerance=1e-11", "mechanics.tolerance=1e-10",
                                     "mechanics.displacement_tolerance=1e-7"});
  const CaseRun usual = run("cases/aluminium_cylinder", "default_tolerances", start),
                tight = run("cases/aluminium_cylinder", "tight_tolerances", converged);
  ASSERT_TRUE(usual.finished && tight.finished);
  for (const char* probe :
       {"T_center[degC]", "T_casting_surface[degC]", "T_mould_surface[degC]", "gap[mm]"}) {
    const auto &found = usual.history.at(probe), &exact = tight.history.at(probe);
    ASSERT_EQ(found.size(), exact.size());
    const auto [least, greatest] = std::minmax_element(exact.begin(), exact.end());
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_NEAR(found[i], exact[i], 1e-4 * (*greatest - *least)) << probe << ", " << i << " s";
  }
}

// Only the bottom stays in contact: it slides inwards under the casting's weight.
TEST(AluminiumCylinder, FrictionActsWhereTheCastingRests) {
  const CaseRun free = small("free", {}),
                rubbing = run("cases/aluminium_cylinder/friction.toml", "friction", k_small);
  ASSERT_TRUE(free.finished && rubbing.finished);
  const auto& h = rubbing.history;
  EXPECT_EQ(h.at("interface_sticking_fraction[1]").back(), 0);
  EXPECT_NEAR(h.at("interface_friction_force[N]").back(), 0.2 * h.at("contact_force[N]").back(), 1e-9);
  // A quarter of a newton does not hold the casting.
  EXPECT_NEAR(h.at("gap[mm]").back(), free.history.at("gap[mm]").back(), 1e-6);
  EXPECT_LT(relative_defect(rubbing), 1e-8);
}

TEST(AluminiumCylinder, TheGapIsWhatKeepsItWarm) {
  const CaseRun gap = small("gap", {}),
                constant = run("cases/aluminium_cylinder/h_const.toml", "h_const", k_small);
  ASSERT_TRUE(gap.finished && constant.finished);
  EXPECT_GT(at(gap.history, "T_center[degC]", 20), at(constant.history, "T_center[degC]", 20) + 40);
}

TEST(AluminiumCylinder, EntropyFormLosesHeatAtFirstOrderInTheStep) {
  // Over a fixed time the defects of second order per step sum up to first order.
  std::vector<double> defect;
  for (const char* step : {"2 s", "1 s", "0.5 s"}) {
    const CaseRun r = small(std::string("entropy_") + step[0], {std::string("time.step=\"") + step + "\"",
                                                                "coupling.structural_heating=\"entropy\""});
    ASSERT_TRUE(r.finished) << r.reason;
    defect.push_back(std::abs(r.history.at("energy_defect[J]").back()));
  }
  for (std::size_t i = 1; i < defect.size(); ++i) {
    const double order = std::log2(defect[i - 1] / defect[i]);
    EXPECT_GT(order, 0.6) << defect[i - 1] << " " << defect[i];  // still rising to 1 at these steps
    EXPECT_LT(order, 1.3);
  }
}

TEST(AluminiumCylinder, EnergyFormClosesTheFirstLaw) {
  const CaseRun r = small("energy", {"coupling.structural_heating=\"energy\""});
  ASSERT_TRUE(r.finished) << r.reason;
  // Newton's criterion of the thermal phase, 1e-9 of the heat moved, allows this defect.
  EXPECT_LT(relative_defect(r), 1e-8);
}

/// The largest difference of a column over all rows.
double difference(const CaseRun& a, const CaseRun& b, const std::string& column) {
  const auto &x = a.history.at(column), &y = b.history.at(column);
  EXPECT_EQ(x.size(), y.size());
  double largest = 0;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
    largest = std::max(largest, std::abs(x[i] - y[i]));
  return largest;
}

/// 𝓛 of 2.24 with contact: what surrounds the cylinder is insulated, its weight is a dead load. Residuals
/// and rounding may raise it; in this case they are a small part of what it falls by.
void expect_falling(const CaseRun& r) {
  const auto& h = r.history.at("lyapunov[J]");
  const auto& slack = r.steps.at("lyapunov_tolerance[J]");
  const auto& produced = r.history.at("entropy_production[J/K]");
  ASSERT_EQ(h.size(), slack.size() + 1);
  for (std::size_t i = 1; i < h.size(); ++i) {
    EXPECT_LE(h[i] - h[i - 1], slack[i - 1]) << "step " << i;
    EXPECT_LT(slack[i - 1], 0.01 * (h[i - 1] - h[i])) << "step " << i;
    EXPECT_GT(produced[i], produced[i - 1]) << "step " << i;
  }
}

// Figure 7.21: aluminium is weakly coupled, what is left is the error of a step of 1 s.
TEST(AluminiumCylinder, BothSplitsSuperpose) {
  for (const std::string file : {"isentropic.toml", "plastic.toml"}) {
    std::vector<std::string> more = k_small;
    more.push_back("coupling.structural_heating=\"energy\"");
    more.push_back("coupling.scheme=\"isothermal\"");
    const CaseRun isothermal = run("cases/aluminium_cylinder/" + file, "isothermal_" + file, more);
    more.back() = "coupling.scheme=\"isentropic\"";
    const CaseRun isentropic = run("cases/aluminium_cylinder/" + file, "isentropic_" + file, more);
    ASSERT_TRUE(isothermal.finished && isentropic.finished) << isothermal.reason << isentropic.reason;
    for (const char* column : {"T_center[degC]", "T_casting_surface[degC]", "T_mould_surface[degC]"})
      EXPECT_LT(difference(isothermal, isentropic, column), 0.3) << file << " " << column;  // of 200 K
    EXPECT_LT(difference(isothermal, isentropic, "gap[mm]"), 2e-4) << file;                 // of 0.05 mm
    for (const char* column : {"u_casting_surface[mm]", "u_mould_surface[mm]"})
      EXPECT_LT(difference(isothermal, isentropic, column), 1e-4) << file << " " << column;  // of 0.026 mm
    EXPECT_LT(relative_defect(isentropic), 1e-8) << file;
    expect_falling(isentropic);
  }
}

TEST(AluminiumCylinder, PlasticMetalYieldsWhereElasticMetalCarriesStress) {
  const CaseRun r = run("cases/aluminium_cylinder/plastic.toml", "plastic", k_small);
  ASSERT_TRUE(r.finished) << r.reason;
  const auto& h = r.history;
  // At 20 s the casting is between 520 and 560 °C, where 1 to 2 MPa are its flow stress; the overstress of
  // the rate comes on top.
  EXPECT_GT(h.at("von_mises_max[MPa]").back(), 0.5);
  EXPECT_LT(h.at("von_mises_max[MPa]").back(), 8.0);
  EXPECT_GT(h.at("plastic_strain_max[percent]").back(), 0.02);
  EXPECT_LT(h.at("plastic_strain_max[percent]").back(), 1.0);
  EXPECT_TRUE(
      std::is_sorted(h.at("plastic_strain_max[percent]").begin(), h.at("plastic_strain_max[percent]").end()));
  EXPECT_GT(h.at("plastic_dissipation[J]").back(), 0);
  EXPECT_GT(h.at("hardening_energy[J]").back(), 0);
}

TEST(AluminiumCylinder, EnergyFormClosesTheFirstLawWithPlasticity) {
  std::vector<std::string> more = k_small;
  more.push_back("coupling.structural_heating=\"energy\"");
  const CaseRun r = run("cases/aluminium_cylinder/plastic.toml", "plastic_energy", more);
  ASSERT_TRUE(r.finished) << r.reason;
  EXPECT_LT(relative_defect(r), 1e-8);
}

TEST(AluminiumCylinder, WithoutPlasticityThereAreNoPlasticFields) {
  std::vector<std::string> more = k_small;
  more.push_back("output.fields=[\"flow_stress\"]");
  EXPECT_THROW(run("cases/aluminium_cylinder", "no_plastic_fields", more), solidus::InputError);
}

TEST(AluminiumCylinder, WithoutStructuralHeatTheBalanceClosesForAnyStep) {
  for (const char* step : {"0.5 s", "20 s"}) {
    const CaseRun r = small("none", {"coupling.scheme=\"isothermal\"", "coupling.structural_heating=\"none\"",
                                     std::string("time.step=\"") + step + "\""});
    ASSERT_TRUE(r.finished) << r.reason;
    EXPECT_LT(relative_defect(r), 1e-8);
  }
}

}  // namespace
