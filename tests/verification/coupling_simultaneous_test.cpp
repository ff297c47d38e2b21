/// The simultaneous scheme against the reference program of section 7.1, its first law, and the splits where
/// metal freezes in a mould.
#include <gtest/gtest.h>

#include <map>

#include "casting_bodies.hpp"
#include "thick_cylinder.hpp"

namespace solidus {
namespace {

using mechanics::Mapping;
using mechanics::StructuralForm;
using verification::Coupled;
using verification::CoupledRun;
using verification::cylinder;
using verification::Surfaces;
using verification::Variant;

constexpr double k_end = 1000;  // [s]

std::map<int, Surfaces> march(const Coupled& c, CoupledRun& run, int n_steps) {
  std::map<int, Surfaces> at;
  run = verification::march(c, k_end, n_steps, [&](const coupling::State& state) {
    const int time = static_cast<int>(std::lround(state.time));
    if (time == 10 || time == 100 || time == 1000) at[time] = verification::surfaces(c.mesh, state);
  });
  return at;
}

/// Every number of the reference's histories at 10, 100 and 1000 s.
void expect_reference(const Variant& v, const std::string& scheme, std::ofstream& out) {
  SCOPED_TRACE(scheme + (v.plastic ? ", plastic, " : ", elastic, ") + std::to_string(v.expansion_factor));
  CoupledRun run;
  const auto at = march(cylinder(v), run, 100);
  double worst_u = 0, worst_t = 0;
  for (const auto& [time, here] : at) {
    const Surfaces there = verification::reference(v, scheme, time);
    for (std::size_t i = 0; i < 2; ++i) {
      worst_u = std::max(worst_u, std::abs(here.u[i] - there.u[i]));
      worst_t = std::max(worst_t, std::abs(here.temperature[i] - there.temperature[i]));
    }
  }
  EXPECT_EQ(at.size(), 3U);
  EXPECT_LT(worst_u, 1e-5);  // [mm]
  EXPECT_LT(worst_t, 1e-3);  // [K]
  out << scheme << "," << (v.plastic ? "tp" : "te") << "," << v.expansion_factor << "," << worst_u << ","
      << worst_t << "," << run.worst_defect() / run.exchanged() << "\n";
}

constexpr const char* k_columns = "scheme,law,expansion_factor,u[mm],T[K],first_law[heat exchanged]";

TEST(SimultaneousScheme, GivesTheReferenceInEveryVariant) {
  auto out = verification::table("coupling_simultaneous", k_columns);
  for (const bool plastic : {false, true})
    for (const int factor : {1, 6}) {
      expect_reference({plastic, factor, Mapping::simultaneous, StructuralForm::energy},
                       "simultaneous_energy", out);
      expect_reference({plastic, factor, Mapping::simultaneous, StructuralForm::entropy},
                       "simultaneous_enthalpy", out);
    }
}

TEST(SimultaneousScheme, ClosesTheFirstLawForAnyStepAndCouplingInTheEnergyForm) {
  for (const auto integration : {coupling::SimultaneousOptions::Integration::backward_euler,
                                 coupling::SimultaneousOptions::Integration::sdirk2})
    for (const bool plastic : {false, true})
      for (const int factor : {1, 6})
        for (const int n_steps : {100, 10, 1}) {
          Coupled c = cylinder({plastic, factor, Mapping::simultaneous, StructuralForm::energy});
          c.simultaneous.integration = integration;
          const CoupledRun run = verification::march(c, k_end, n_steps);
          EXPECT_LT(run.worst_defect(), 1e-8 * run.exchanged()) << factor << " " << n_steps;
          EXPECT_LT(std::abs(run.defect()), 1e-8 * run.exchanged()) << factor << " " << n_steps;
        }
}

// Chill, latent heat, straining, viscous flow of the mushy zone and an interface that parts: 16 s.
TEST(SimultaneousScheme, ClosesTheFirstLawWhereMetalFreezesInAMould) {
  for (const double pressure : {0.0, 5e6})
    for (const int n_steps : {8, 64}) {
      Coupled c = verification::casting(pressure);
      c.mapping = Mapping::simultaneous;
      c.form = StructuralForm::energy;
      const CoupledRun run = verification::march(c, 16, n_steps);
      EXPECT_LT(run.worst_defect(), 1e-8 * run.exchanged()) << n_steps;
    }
}

TEST(SimultaneousScheme, AndTheSplitsTendToTheSameCasting) {
  auto out = verification::table("coupling_simultaneous_casting", "step[s],T[K],u[mm]");
  std::vector<double> difference;
  for (const int n_steps : {16, 32, 64, 128}) {
    std::vector<coupling::State> ends;
    for (const Mapping mapping : {Mapping::isentropic, Mapping::simultaneous}) {
      Coupled c = verification::casting(0);
      c.mapping = mapping;
      c.form = StructuralForm::energy;
      ends.push_back(verification::march(c, 16, n_steps).end);
    }
    double t = 0, u = 0;
    for (std::size_t i = 0; i < ends[0].heat.temperature.size(); ++i)
      t = std::max(t, std::abs(ends[0].heat.temperature[i] - ends[1].heat.temperature[i]));
    for (std::size_t i = 0; i < ends[0].mechanics.displacement.size(); ++i)
      u = std::max(u, std::abs(ends[0].mechanics.displacement[i] - ends[1].mechanics.displacement[i]));
    difference.push_back(t);
    out << 16.0 / n_steps << "," << t << "," << u * 1e3 << "\n";
  }
  for (std::size_t i = 1; i < difference.size(); ++i) EXPECT_LT(difference[i], 0.8 * difference[i - 1]) << i;
  EXPECT_LT(difference.back(), 2.0);  // [K], of 440
}

}  // namespace
}  // namespace solidus
