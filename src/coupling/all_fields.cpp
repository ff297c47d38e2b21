/// The rooms of physics declare their fields; this list joins them.
#include "coupling/all_fields.hpp"

#include <algorithm>
#include <cassert>

#include "contact/quantities.hpp"
#include "criteria/criterion_kind.hpp"
#include "heat/quantities.hpp"
#include "mechanics/quantities.hpp"

namespace solidus::coupling {

const std::vector<const Quantity*>& all_fields() {
  static const std::vector<const Quantity*> fields = [] {
    std::vector<const Quantity*> all(heat::fields::k_all.begin(), heat::fields::k_all.end());
    all.insert(all.end(), mechanics::fields::k_all.begin(), mechanics::fields::k_all.end());
    all.insert(all.end(), contact::fields::k_all.begin(), contact::fields::k_all.end());
    for (const auto& kind : criteria::criterion_kinds())
      all.insert(all.end(), kind->fields().begin(), kind->fields().end());
    return all;
  }();
  return fields;
}

const Quantity* find_field(std::string_view name) {
  const auto found = std::ranges::find(all_fields(), name, &Quantity::name);
  return found != all_fields().end() ? *found : nullptr;
}

const Quantity& field_of(std::string_view name) {
  const Quantity* found = find_field(name);
  assert(found != nullptr);
  return *found;
}

std::vector<std::string> field_names(bool with_contact) {
  std::vector<std::string> names;
  for (const Quantity* field : all_fields())
    if (with_contact || !field->of_contact()) names.emplace_back(field->name);
  return names;
}

}  // namespace solidus::coupling
