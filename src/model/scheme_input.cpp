#include "model/scheme_input.hpp"

#include <algorithm>
#include <stdexcept>

#include "coupling/block_iterative.hpp"
#include "coupling/double_pass.hpp"
#include "coupling/guarded_scheme.hpp"
#include "coupling/isentropic.hpp"
#include "coupling/isothermal.hpp"
#include "coupling/simultaneous.hpp"

namespace solidus::model {

namespace {

coupling::SimultaneousOptions simultaneous_options(const CouplingSpec& spec) {
  using Integration = coupling::SimultaneousOptions::Integration;
  const bool two_stages = spec.integration == CouplingSpec::Integration::sdirk2;
  return {two_stages ? Integration::sdirk2 : Integration::backward_euler, spec.solver};
}

coupling::IterationOptions iteration_options(const IterationSpec& spec) {
  return {.sweep = spec.sweep,
          .loop = spec.loop,
          .relaxation = {spec.relaxation, spec.factor},
          .tolerance = spec.tolerance,
          .max_iterations = spec.max_iterations};
}

}  // namespace

coupling::PhaseOrder phase_order(const CaseSpec& spec, bool melts) {
  using Heating = CouplingSpec::StructuralHeating;
  using coupling::PhaseOrder;
  const CouplingSpec& c = spec.coupling;
  if (c.order) return *c.order;
  const bool rubs =
      std::any_of(spec.contacts.begin(), spec.contacts.end(), [](const auto& pair) { return pair.friction; });
  const bool printed = c.as_printed || c.structural_heating == Heating::literal ||
                       c.structural_heating == Heating::temperature;
  return (rubs && !melts) || printed || spec.dynamics ? PhaseOrder::mechanics_first : PhaseOrder::heat_first;
}

bool lags_a_step(const CaseSpec& spec, bool melts) {
  using Scheme = CouplingSpec::Scheme;
  const Scheme scheme = spec.coupling.scheme;
  return spec.coupled() && !spec.dynamics && (scheme == Scheme::isentropic || scheme == Scheme::isothermal) &&
         phase_order(spec, melts) == coupling::PhaseOrder::mechanics_first;
}

namespace {

std::unique_ptr<coupling::CouplingScheme> bare_scheme(const CaseSpec& spec, const coupling::Phases& phases) {
  using Scheme = CouplingSpec::Scheme;
  if (!spec.coupled()) return std::make_unique<coupling::IsothermalSplit>(phases);
  switch (spec.coupling.scheme) {
    case Scheme::isentropic:
      return std::make_unique<coupling::IsentropicSplit>(phases,
                                                         phase_order(spec, phases.coherency != nullptr));
    case Scheme::isothermal:
      return std::make_unique<coupling::IsothermalSplit>(phases,
                                                         phase_order(spec, phases.coherency != nullptr));
    case Scheme::simultaneous:
      return std::make_unique<coupling::SimultaneousScheme>(phases, simultaneous_options(spec.coupling));
    case Scheme::block_iterative:
      return std::make_unique<coupling::BlockIterative>(phases, iteration_options(spec.coupling.iteration));
    case Scheme::double_pass:
      return std::make_unique<coupling::DoublePass>(phases);
  }
  throw std::logic_error("no such coupling scheme");
}

}  // namespace

std::unique_ptr<coupling::CouplingScheme> coupling_scheme(const CaseSpec& spec,
                                                          const coupling::Phases& phases) {
  return std::make_unique<coupling::GuardedScheme>(bare_scheme(spec, phases), phases);
}

mechanics::StructuralForm structural_form(const CaseSpec& spec) {
  using Heating = CouplingSpec::StructuralHeating;
  switch (spec.coupling.structural_heating) {
    case Heating::energy:
      return mechanics::StructuralForm::energy;
    case Heating::entropy:
      return mechanics::StructuralForm::entropy;
    case Heating::literal:
      return mechanics::StructuralForm::literal;
    case Heating::temperature:
      return mechanics::StructuralForm::temperature;
    case Heating::none:
      break;
  }
  throw std::logic_error("deformation exchanges no heat in this case");
}

}  // namespace solidus::model
