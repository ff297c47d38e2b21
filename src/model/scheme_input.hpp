/// The coupling scheme that a case asks for.
#pragma once

#include <memory>

#include "coupling/phases.hpp"
#include "coupling/scheme.hpp"
#include "mechanics/structural_heat.hpp"
#include "model/case_spec.hpp"

namespace solidus::model {

/// @param phases must outlive the scheme
std::unique_ptr<coupling::CouplingScheme> coupling_scheme(const CaseSpec& spec,
                                                          const coupling::Phases& phases);

/// The form of structural heat; not for structural_heating = "none".
mechanics::StructuralForm structural_form(const CaseSpec& spec);

}  // namespace solidus::model
