/// Properties that code outside of the room of materials has declared, by their keys.
#include "material/added_property.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace solidus::material {

namespace {

struct AddedList {
  std::vector<AddedProperty> properties;
  bool asked = false;  ///< keys have been made of it
};

// A function's own object exists before the objects of other files that add to it.
AddedList& added_list() {
  static AddedList list;
  return list;
}

}  // namespace

const std::vector<AddedProperty>& added_properties() {
  added_list().asked = true;
  return added_list().properties;
}

AddProperty::AddProperty(const AddedProperty& property) : key_(property.key) {
  // Files are linked in any order; sorted keys make the same reference page and the same hash of every build.
  AddedList& list = added_list();
  if (list.asked)
    throw std::logic_error("the material property '" + std::string(key_) +
                           "': added after the keys were made");
  const auto place = std::ranges::lower_bound(list.properties, key_, {}, &AddedProperty::key);
  if (place != list.properties.end() && place->key == key_)
    throw std::logic_error("the material property '" + std::string(key_) + "': there is one of that name");
  list.properties.insert(place, property);
}

const Table* AddProperty::of(const Material& material) const {
  const auto found = material.added.find(key_);
  return found == material.added.end() ? nullptr : &found->second.table;
}

}  // namespace solidus::material
