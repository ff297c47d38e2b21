/// The block-iterative scheme (coupling/block_iterative.hpp) as the key scheme knows it.
#pragma once

#include <fmt/format.h>

#include "coupling/add_scheme.hpp"
#include "coupling/block_iterative.hpp"

namespace solidus::coupling {

/// [coupling.iteration].
struct IterationKeys {
  using Sweep = IterationOptions::Sweep;
  using Loop = IterationOptions::Loop;
  using Relaxation = RelaxationOptions::Kind;
  enum class Passes { isentropic, isothermal };
  Sweep sweep = Sweep::gauss_seidel;
  Passes passes = Passes::isentropic;
  Loop loop = Loop::nested;
  Relaxation relaxation = Relaxation::none;
  double factor = 1;        ///< of a fixed relaxation, and the first one of Aitken's
  double tolerance = 1e-8;  ///< of temperatures and displacements between two iterates, relative
  int max_iterations = 100;

  bool operator==(const IterationKeys&) const = default;
};

struct BlockIterativeScheme {
  static constexpr std::string_view name = "block_iterative",
                                    doc = "both phases in alternation until they agree";
  IterationKeys iteration;

  static void keys(Section<BlockIterativeScheme>& s) {
    s.section("iteration", &BlockIterativeScheme::iteration, iteration_keys());
  }
  SchemeTraits traits() const {
    return {.mapping = isothermal() ? mechanics::Mapping::isothermal : mechanics::Mapping::isentropic,
            .iterates = true,
            .effort = 8};
  }
  std::optional<Objection> objection(const SchemeContext&) const {
    if (iteration.relaxation == IterationKeys::Relaxation::none && iteration.factor != 1)
      return Objection{"'factor' means nothing without relaxation",
                       "relaxation \"fixed\" or \"aitken\", or no factor"};
    if (iteration.relaxation == IterationKeys::Relaxation::aitken && !isothermal())
      return Objection{
          "relaxation = \"aitken\" is for isothermal passes; isentropic ones converge without it",
          "passes = \"isothermal\", or relaxation \"none\" or \"fixed\""};
    return std::nullopt;
  }
  std::vector<std::string> advice(const Stop& stop) const {
    if (stop.failure == Failure::another_solution) return {};
    std::vector<std::string> advice;
    if (isothermal()) {
      advice.emplace_back(
          "isentropic passes, which converge however strong the coupling is: coupling.iteration.passes");
      if (iteration.relaxation != IterationKeys::Relaxation::aitken)
        advice.emplace_back("coupling.iteration.relaxation = \"aitken\"");
    }
    if (stop.failure != Failure::divergence)
      advice.push_back(
          fmt::format("more iterations: coupling.iteration.max_iterations (now {}), or "
                      "coupling.iteration.tolerance (now {:g})",
                      iteration.max_iterations, iteration.tolerance));
    advice.emplace_back(
        "another scheme: coupling.scheme = \"isentropic\" solves each phase once a step, \"simultaneous\" "
        "solves "
        "both fields at once");
    return advice;
  }
  std::unique_ptr<CouplingScheme> make(const Phases& phases, const SchemeContext&) const {
    return std::make_unique<BlockIterative>(
        phases, IterationOptions{.sweep = iteration.sweep,
                                 .loop = iteration.loop,
                                 .relaxation = {iteration.relaxation, iteration.factor},
                                 .tolerance = iteration.tolerance,
                                 .max_iterations = iteration.max_iterations});
  }

 private:
  bool isothermal() const { return iteration.passes == IterationKeys::Passes::isothermal; }
  static Section<IterationKeys> iteration_keys() {
    // The keys of [coupling.iteration], in the order in which the reference lists them: which state a phase
    // sees, what it holds, how the loops are nested, and when the iteration ends.
    using I = IterationKeys;
    Section<I> s("iteration", "The block-iterative scheme: both phases in alternation until they agree.");
    s.choice("sweep", &I::sweep,
             {{"gauss_seidel", I::Sweep::gauss_seidel, "the newest one"},
              {"jacobi", I::Sweep::jacobi, "that of the iteration before"}})
        .initially("gauss_seidel")
        .doc("Which state of the other phase a phase uses (monograph 4.2, 4.3).");
    s.choice("passes", &I::passes,
             {{"isentropic", I::Passes::isentropic, "the mechanical phase holds the entropy of the iterate"},
              {"isothermal", I::Passes::isothermal, "it holds the temperature of the iterate"}})
        .initially("isentropic")
        .doc("What the mechanical phase holds; both end at the simultaneous solution.");
    s.choice("loop", &I::loop,
             {{"nested", I::Loop::nested, "each phase is solved to its own tolerance"},
              {"single", I::Loop::single,
               "one Newton step of each phase per iteration, and full solves of both phases once they agree; "
               "a step where "
               "that does not converge is solved once more with `nested`, before it is cut"}})
        .initially("nested")
        .doc("How the iterations of the phases and those between them are nested (monograph 4.4).");
    s.choice("relaxation", &I::relaxation,
             {{"none", I::Relaxation::none, "1"},
              {"fixed", I::Relaxation::fixed, "`factor`"},
              {"aitken", I::Relaxation::aitken,
               "isothermal passes only: computed from the last two changes, at first `factor`"}})
        .initially("none")
        .doc("Factor on the change of temperature between two iterates.");
    s.key("factor", &I::factor)
        .initially(1.0)
        .range(1e-3, 2.0)
        .doc(
            "Relaxation factor. Sweeps of Gauss-Seidel converge with factors up to 4/3 where passes are "
            "isentropic, below 2/(1 + delta) where they are isothermal, delta being the coupling number.");
    s.key("tolerance", &I::tolerance)
        .initially(1e-8)
        .range(1e-14, 0.1)
        .doc(
            "The iteration ends when temperature and displacement change by less than this fraction of their "
            "change in the step. Energy is conserved to the tolerances of the phases, whatever this one is.");
    s.key("max_iterations", &I::max_iterations)
        .initially(100)
        .range(1, 10000)
        .doc("Iterations before a step is cut.");
    return s;
  }
};

}  // namespace solidus::coupling
