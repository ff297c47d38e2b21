/// The fields that a run can have, of all rooms of physics (quantities/quantity.hpp).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "quantities/quantity.hpp"

namespace solidus::coupling {

using quantities::Quantity;

/// Every field that a case can name, those of criteria that were added too, in the order of the reference
/// page. No two have one name.
const std::vector<const Quantity*>& all_fields();
/// Null: there is no such field.
const Quantity* find_field(std::string_view name);
/// The name must be one of the list.
const Quantity& field_of(std::string_view name);
/// Names for the choices of a key; those of contact surfaces, whose files always have all of them, on demand.
std::vector<std::string> field_names(bool with_contact);

}  // namespace solidus::coupling
