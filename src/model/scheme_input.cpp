#include "model/scheme_input.hpp"

#include "base/errors.hpp"
#include "coupling/isentropic.hpp"
#include "coupling/isothermal.hpp"

namespace solidus::model {

std::unique_ptr<coupling::CouplingScheme> coupling_scheme(const CaseSpec& spec,
                                                          const coupling::Phases& phases) {
  using Scheme = CouplingSpec::Scheme;
  if (!spec.coupled()) return std::make_unique<coupling::IsothermalSplit>(phases);
  switch (spec.coupling.scheme) {
    case Scheme::isentropic:
      return std::make_unique<coupling::IsentropicSplit>(phases);
    case Scheme::isothermal:
      return std::make_unique<coupling::IsothermalSplit>(phases);
    case Scheme::double_pass:
    case Scheme::block_iterative:
    case Scheme::simultaneous:
      break;
  }
  throw InputError(spec.coupling.where, "this coupling scheme is not there yet", "isentropic, isothermal");
}

mechanics::StructuralForm structural_form(const CaseSpec& spec) {
  using Heating = CouplingSpec::StructuralHeating;
  switch (spec.coupling.structural_heating) {
    case Heating::energy:
      return mechanics::StructuralForm::energy;
    case Heating::entropy:
      return mechanics::StructuralForm::entropy;
    case Heating::literal:
    case Heating::temperature:
    case Heating::none:
      break;
  }
  throw InputError(spec.coupling.where, "this form is not there yet", "energy, entropy");
}

}  // namespace solidus::model
