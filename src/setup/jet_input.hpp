/// Jets become films of the case, and metal loses heat in its shot sleeve.
#pragma once

#include <optional>

#include "cases/case_spec.hpp"
#include "material/material.hpp"

namespace solidus::setup {

/// Adds a [[thermal_condition]] of kind film for every [[jet]]. Throws InputError beyond the range of its
/// correlation.
void add_jets(cases::CaseSpec& spec);
/// Checks that each [[shot_sleeve]] belongs to one body of one temperature. Throws InputError.
void check_shot_sleeves(const cases::CaseSpec& spec);
/// The temperature with which a body is in the die at the start [K]: that of the case, less what its sleeve
/// takes. Tells what it does. Throws InputError for metal that is solid before it is in the die.
double temperature_in_die(const cases::CaseSpec& spec, const cases::BodySpec& body,
                          const material::Material& material);

}  // namespace solidus::setup
