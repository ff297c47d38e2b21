/// The simultaneous scheme (coupling/simultaneous.hpp) as the key scheme knows it.
#pragma once

#include "coupling/add_scheme.hpp"
#include "coupling/simultaneous.hpp"

namespace solidus::coupling {

struct SimultaneousKeys : SimultaneousOptions {
  static constexpr std::string_view name = "simultaneous", doc = "one Newton iteration for both fields";

  static void keys(Section<SimultaneousKeys>& s) {
    s.choice(
         "integration", static_cast<Integration SimultaneousKeys::*>(&SimultaneousOptions::integration),
         {{"backward_euler", Integration::backward_euler, "first order"},
          {"sdirk2", Integration::sdirk2, "two implicit stages, second order, L-stable (Alexander 1977)"}})
        .initially("backward_euler")
        .doc("Integration in time of the simultaneous scheme.");
    using Solver = linear::CoupledSolverKind;
    s.choice("solver", static_cast<Solver SimultaneousKeys::*>(&SimultaneousOptions::solver),
             {{"automatic", Solver::automatic,
               "direct in two dimensions and below 20 000 unknowns, 3 000 where elements are mixed; "
               "field_split above"},
              {"direct", Solver::direct, "MUMPS, LU"},
              {"field_split", Solver::field_split,
               "GMRES; multigrid on the displacements, incomplete factors on pressures and temperatures"}})
        .initially("automatic")
        .doc("Linear solver of the simultaneous scheme.");
  }

  bool two_stages() const { return integration == Integration::sdirk2; }
  SchemeTraits traits() const {
    return {.mapping = mechanics::Mapping::simultaneous, .second_order = two_stages(), .effort = 2};
  }
  std::optional<Objection> objection(const SchemeContext& c) const {
    if (two_stages() && c.inertia)
      return Objection{"integration = \"sdirk2\" is for quasi-statics",
                       "integration = \"backward_euler\", which leaves inertia to its own integrator"};
    if (two_stages() && c.integration != mechanics::TimeIntegration::backward_euler)
      return Objection{"two integrators of second order in one step",
                       "coupling.integration = \"sdirk2\" or mechanics.integration = \"bdf2\""};
    if (two_stages() && c.as_printed)
      return Objection{"printed forms of sensible heat go with backward Euler",
                       "as_printed = false, or a scheme of first order"};
    return std::nullopt;
  }
  std::vector<std::string> advice(const Stop& stop) const {
    if (stop.failure != Failure::another_solution) return {};
    return {"coupling.scheme = \"isentropic\", whose thermal phase has one solution"};
  }
  std::unique_ptr<CouplingScheme> make(const Phases& phases, const SchemeContext&) const {
    return std::make_unique<SimultaneousScheme>(phases, *this);
  }
};

}  // namespace solidus::coupling
