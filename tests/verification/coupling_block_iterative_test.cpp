/// The block-iterative scheme on the thick-walled cylinder of monograph 7.1: what its passes agree on is the
/// simultaneous solution of the reference program (reference/README.md), by every combination of sweep,
/// passes, loop and relaxation that theory says converges (docs/theory/coupling.md); how many iterations each
/// takes; and that a casting that freezes in its mould converges too.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "casting_bodies.hpp"
#include "system/errors.hpp"
#include "thick_cylinder.hpp"

namespace solidus {
namespace {

using coupling::IterationOptions;
using mechanics::Mapping;
using mechanics::StructuralForm;
using verification::Coupled;
using verification::CoupledRun;
using verification::cylinder;
using verification::Surfaces;
using verification::Variant;
using Sweep = IterationOptions::Sweep;
using Loop = IterationOptions::Loop;
using Relaxing = coupling::RelaxationOptions::Kind;

constexpr double k_step = 10;  // [s]

/// Of Newton's method in the mechanical passes, relative to the forces. The isentropic mapping finds Θ̄ to
/// 1e-8 K, which is 3e-9 of the pressure at six times the expansion.
constexpr double k_mechanics = 1e-8;

/// Half of the step suits all: the largest ratio of the isothermal passes is two (α × 6 at 593 K).
constexpr double k_half = 0.5;

Coupled iterated(const Variant& v, const IterationOptions& options) {
  Coupled c = cylinder(v);
  c.iteration = options;
  return c;
}

struct Result {
  std::map<int, Surfaces> at;  ///< [s]
  CoupledRun run;
  std::string failure;  ///< the reason of a step that was rejected

  double iterations() const {  ///< mean of all steps
    double sum = 0;
    for (const int n : run.iterations) sum += n;
    return sum / static_cast<double>(run.iterations.size());
  }
};

Result march(const Coupled& c, int n_steps) {
  Result r;
  try {
    r.run = verification::march(c, n_steps * k_step, n_steps, [&](const coupling::State& state) {
      r.at[static_cast<int>(std::lround(state.time))] = verification::surfaces(c.mesh, state);
    });
  } catch (const StepRejected& rejected) {
    r.failure = rejected.reason() + ": " + rejected.where();
  }
  return r;
}

/// The largest differences in displacement [mm] and temperature [K].
struct Difference {
  double u = 0, temperature = 0;
};
Difference difference(const Surfaces& a, const Surfaces& b) {
  Difference d;
  for (std::size_t i = 0; i < 2; ++i) {
    d.u = std::max(d.u, std::abs(a.u[i] - b.u[i]));
    d.temperature = std::max(d.temperature, std::abs(a.temperature[i] - b.temperature[i]));
  }
  return d;
}

std::string name(const Variant& v) {
  return std::string(v.plastic ? "tp" : "te") + "," + std::to_string(v.expansion_factor);
}

TEST(BlockIterative, AgreesOnTheSimultaneousSolutionOfTheReferenceInBothForms) {
  auto out = verification::table("coupling_block_iterative",
                                 "form,law,expansion_factor,u[mm],T[K],iterations,first_law[heat exchanged]");
  for (const auto form : {StructuralForm::energy, StructuralForm::entropy})
    for (const bool plastic : {false, true})
      for (const int factor : {1, 6}) {
        const Variant v{plastic, factor, Mapping::isentropic, form};
        const bool energy = form == StructuralForm::energy;
        SCOPED_TRACE(name(v) + (energy ? ", energy" : ", entropy"));
        Coupled c = iterated(v, {});
        c.mechanics_tolerance = k_mechanics;
        const Result r = march(c, 100);
        ASSERT_EQ(r.failure, "");
        Difference worst;
        for (const int time : {10, 100, 1000}) {
          const Difference d = difference(
              r.at.at(time),
              verification::reference(v, energy ? "simultaneous_energy" : "simultaneous_enthalpy", time));
          EXPECT_LT(d.u, 1e-5) << time << " s";
          EXPECT_LT(d.temperature, 1e-3) << time << " s";
          worst = {std::max(worst.u, d.u), std::max(worst.temperature, d.temperature)};
        }
        // By equilibrium of the last mechanical pass and the balance of the last thermal one.
        if (energy) {
          EXPECT_LT(r.run.worst_defect(), 1e-8 * r.run.exchanged());
        }
        out << (energy ? "energy," : "entropy,") << name(v) << "," << worst.u << "," << worst.temperature
            << "," << r.iterations() << "," << r.run.worst_defect() / r.run.exchanged() << "\n";
      }
}

struct Combination {
  Sweep sweep;
  Mapping passes;
  Loop loop;
  Relaxing relaxation;

  IterationOptions options() const {
    IterationOptions options;
    options.sweep = sweep;
    options.loop = loop;
    options.relaxation = {relaxation, relaxation == Relaxing::fixed ? k_half : 1};
    options.max_iterations = 200;
    return options;
  }
  /// Isothermal passes: the ratio of an iteration, two at α × 6, must be below one, or relaxed.
  bool converges(int expansion_factor) const {
    return passes == Mapping::isentropic || expansion_factor == 1 || relaxation != Relaxing::none;
  }
  std::string name() const {
    return std::string(sweep == Sweep::jacobi ? "jacobi," : "gauss_seidel,") +
           (passes == Mapping::isentropic ? "isentropic," : "isothermal,") +
           (loop == Loop::single ? "single," : "nested,") +
           (relaxation == Relaxing::none    ? "none"
            : relaxation == Relaxing::fixed ? "fixed"
                                            : "aitken");
  }
};

std::vector<Combination> all_combinations() {
  std::vector<Combination> all;
  for (const Sweep sweep : {Sweep::gauss_seidel, Sweep::jacobi})
    for (const Mapping passes : {Mapping::isentropic, Mapping::isothermal})
      for (const Loop loop : {Loop::nested, Loop::single})
        for (const Relaxing relaxation : {Relaxing::none, Relaxing::fixed, Relaxing::aitken})
          if (passes == Mapping::isothermal || relaxation != Relaxing::aitken)
            all.push_back({sweep, passes, loop, relaxation});
  return all;
}

TEST(BlockIterative, EveryCombinationThatConvergesReachesTheSameSolution) {
  auto out =
      verification::table("coupling_block_iterative_combinations",
                          "law,expansion_factor,sweep,passes,loop,relaxation,u[mm],T[K],iterations,end");
  constexpr int n_steps = 10, end = 100;
  for (const bool plastic : {false, true})
    for (const int factor : {1, 6}) {
      const Variant base{plastic, factor, Mapping::isentropic, StructuralForm::energy};
      const Surfaces expected = verification::reference(base, "simultaneous_energy", end);
      for (const Combination& c : all_combinations()) {
        SCOPED_TRACE(name(base) + "," + c.name());
        Variant v = base;
        v.mapping = c.passes;
        const Result r = march(iterated(v, c.options()), n_steps);
        out << name(v) << "," << c.name() << ",";
        if (c.converges(factor)) {
          EXPECT_EQ(r.failure, "");
          if (!r.failure.empty()) {
            out << ",,," << r.failure << "\n";
            continue;
          }
          const Difference d = difference(r.at.at(end), expected);
          EXPECT_LT(d.u, 1e-5);
          EXPECT_LT(d.temperature, 1e-3);
          EXPECT_LT(r.run.worst_defect(), 1e-8 * r.run.exchanged());
          out << d.u << "," << d.temperature << "," << r.iterations() << ",\n";
        } else {
          EXPECT_EQ(r.failure.rfind("coupling: the iteration between the phases diverges", 0), 0U)
              << r.failure;
          out << ",,,diverges\n";
        }
      }
    }
}

// Latent heat, straining, viscous flow, and an interface whose heat transfer follows its gap. Steps of 2 s,
// in which a quarter of the casting freezes. Both kinds of passes and the splits' phases held at t_n (4.81).
TEST(BlockIterative, ACastingThatFreezesInItsMouldEndsAlikeWithBothKindsOfPasses) {
  std::vector<std::vector<double>> temperatures;
  for (const Mapping passes : {Mapping::isentropic, Mapping::isothermal}) {
    Coupled c = verification::casting(0);
    c.form = StructuralForm::energy;
    c.mapping = passes;
    c.iteration.emplace();
    const CoupledRun run = verification::march(c, 16, 8);
    EXPECT_LT(run.worst_defect(), 1e-8 * run.exchanged());
    for (const int n : run.iterations)
      EXPECT_LT(n, 65);  // the fractions of phase changes follow the iterates
    temperatures.push_back(run.end.heat.temperature);
  }
  for (std::size_t i = 0; i < temperatures[0].size(); ++i)
    EXPECT_NEAR(temperatures[0][i], temperatures[1][i], 1e-4);
}

}  // namespace
}  // namespace solidus
