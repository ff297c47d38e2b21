/// Makes the specifications of friction and wear (contact/) from [contact.friction] and [contact.wear].
#pragma once

#include "cases/friction_spec.hpp"
#include "contact/interface/friction.hpp"
#include "contact/interface/wear.hpp"

namespace solidus::setup {

/// Throws InputError for errors that the check of a single key cannot find: a unit of the wrong dimension,
/// curves that do not fit, coefficients that make no law (contact/interface/friction_coefficient.hpp).
contact::FrictionParameters friction_spec(const cases::FrictionSpec& spec);

contact::WearParameters wear_spec(const cases::WearSpec& spec);

}  // namespace solidus::setup
