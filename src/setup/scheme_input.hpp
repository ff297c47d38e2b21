/// The coupling scheme that a case asks for.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cases/case_spec.hpp"
#include "coupling/phases.hpp"
#include "coupling/scheme.hpp"
#include "coupling/scheme_kind.hpp"
#include "material/material.hpp"
#include "mechanics/structural_heat.hpp"
#include "setup/initial_temperature.hpp"

namespace solidus::setup {

/// Whether a body that deforms keeps strain of a temperature that was not its own: it can be molten in the
/// run (it starts above its solidus, or something that it exchanges heat with is as hot, or a flux or a
/// source heats without a bound), or it yields while temperatures differ by more than a kelvin. The heat of
/// friction alone is not counted.
/// @param start  of every body
bool keeps_strain(const cases::CaseSpec& spec, const std::vector<material::Material>& materials,
                  std::span<const InitialTemperatureRange> start);

/// The case as schemes see it.
/// @param keeps_strain  keeps_strain() of the case
coupling::SchemeContext scheme_context(const cases::CaseSpec& spec, bool keeps_strain);
/// Whether displacements and stresses of a step belong to the temperatures at its start: a sequential split
/// that does mechanics first, without inertia.
bool lags_a_step(const cases::CaseSpec& spec, bool keeps_strain);
/// Whether the case could ask for the printed thermal phase of friction (thermal_return_mapping) with the
/// scheme and the order of phases that it has.
/// @param keeps_strain  keeps_strain() of the case
bool may_map_slip_again(const cases::CaseSpec& spec, bool keeps_strain);
/// Whether surfaces slip in a step after its heat has been conducted: a split with heat first.
bool slips_after_heat(const cases::CaseSpec& spec, bool keeps_strain);

/// @param phases must outlive the scheme
/// @param keeps_strain  keeps_strain() of the case
std::unique_ptr<coupling::CouplingScheme> coupling_scheme(const cases::CaseSpec& spec,
                                                          const coupling::Phases& phases, bool keeps_strain);

/// The form of structural heat; not for structural_heating = "none".
mechanics::StructuralForm structural_form(const cases::CaseSpec& spec);

}  // namespace solidus::setup
