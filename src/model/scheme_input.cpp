#include "model/scheme_input.hpp"

#include <stdexcept>

#include "base/errors.hpp"
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

}  // namespace

std::unique_ptr<coupling::CouplingScheme> coupling_scheme(const CaseSpec& spec,
                                                          const coupling::Phases& phases) {
  using Scheme = CouplingSpec::Scheme;
  if (!spec.coupled()) return std::make_unique<coupling::IsothermalSplit>(phases);
  switch (spec.coupling.scheme) {
    case Scheme::isentropic:
      return std::make_unique<coupling::IsentropicSplit>(phases);
    case Scheme::isothermal:
      return std::make_unique<coupling::IsothermalSplit>(phases);
    case Scheme::simultaneous:
      return std::make_unique<coupling::SimultaneousScheme>(phases, simultaneous_options(spec.coupling));
    case Scheme::double_pass:
    case Scheme::block_iterative:
      break;
  }
  throw InputError(spec.coupling.where, "this coupling scheme is not there yet",
                   "isentropic, isothermal, simultaneous");
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
