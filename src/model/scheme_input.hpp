/// The coupling scheme that a case asks for.
#pragma once

#include <memory>

#include "coupling/phase_order.hpp"
#include "coupling/phases.hpp"
#include "coupling/scheme.hpp"
#include "mechanics/structural_heat.hpp"
#include "model/case_spec.hpp"

namespace solidus::model {

/// Returns the order of the phases of a sequential split: as the case says, or heat first unless friction
/// between bodies that do not melt, inertia or a printed form of structural heat forbids it.
/// @param melts  something that deforms does
coupling::PhaseOrder phase_order(const CaseSpec& spec, bool melts);
/// Whether displacements and stresses of a step belong to the temperatures at its start: a sequential split
/// that does mechanics first, without inertia.
bool lags_a_step(const CaseSpec& spec, bool melts);

/// @param phases must outlive the scheme
std::unique_ptr<coupling::CouplingScheme> coupling_scheme(const CaseSpec& spec,
                                                          const coupling::Phases& phases);

/// The form of structural heat; not for structural_heating = "none".
mechanics::StructuralForm structural_form(const CaseSpec& spec);

}  // namespace solidus::model
