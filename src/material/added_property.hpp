/// Properties of a material that the code which uses them declares in its own file, as criteria and laws
/// declare themselves:
///
///   const material::AddProperty k_limit({.key = "limit_fraction", .unit = "1", .least = 0.5,
///                                          .greatest = 1, .doc = "Solid fraction at which grains bridge."});
///   …
///   const Table* given = k_limit.of(material);   // null: the card has none
///
/// The key then stands on the first level of every material file, as density does: a number or a table over
/// temperature, with unit, source and validity. Reading with its checks, `explain`, the schema, the reference
/// page, the tables of `materials`, the warning where a run leaves the range of the data, and what a
/// checkpoint is held to follow from the declaration.
#pragma once

#include <limits>
#include <string_view>
#include <vector>

#include "material/material.hpp"

namespace solidus::material {

struct AddedProperty {
  std::string_view key;   ///< "limit_fraction"
  std::string_view unit;  ///< SI; "1" for a number
  /// The least and the greatest value, in SI, both allowed.
  double least = -std::numeric_limits<double>::infinity(), greatest = std::numeric_limits<double>::infinity();
  std::string_view doc;  ///< sentences of the reference page; they say what holds where the key is left out
};

/// Those that were added, in the order of their keys.
const std::vector<AddedProperty>& added_properties();

/// Adds a property while the program starts, as an object at namespace scope.
class AddProperty {
 public:
  /// @param property  its texts live as long as the program
  /// Throws std::logic_error where another property has the key, and once keys have been made of the list.
  explicit AddProperty(const AddedProperty& property);
  /// Over absolute temperature; null where the card of the material does not give it.
  const Table* of(const Material& material) const;

 private:
  std::string_view key_;
};

}  // namespace solidus::material
