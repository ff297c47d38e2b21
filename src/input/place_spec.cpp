/// Formula, table and file are three forms of one key; each is read with its own checks.
#include "input/place_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "input/keys.hpp"

namespace solidus {

namespace {

const std::vector<std::string> k_formula_keys = {"formula", "constants", "unit", "moving", "source", "note"};
const std::vector<std::string> k_points_keys = {"file", "column", "moving", "outside", "source", "note"};
const std::vector<std::string> k_field_keys = {"file",   "field",   "body",   "unit", "length_unit",
                                               "moving", "outside", "source", "note"};

std::string text_of(const Value& table, std::string_view name, const Key& key) {
  const Value* value = table.find(name);
  if (value == nullptr) return {};
  if (!value->is_text() || value->text().empty())
    throw InputError(value->where, fmt::format("'{}' of '{}' is {}", name, key.name, value->describe()),
                     "expected a text");
  return value->text();
}

void allow(const Value& table, const Key& key, const std::vector<std::string>& known) {
  for (const auto& entry : table.entries())
    if (std::find(known.begin(), known.end(), entry.key) == known.end())
      throw InputError(entry.where, fmt::format("unknown key '{}' in '{}'", entry.key, key.name),
                       one_of(known, entry.key));
}

/// A quantity of any dimension that case files know, in SI.
double si_value(const Value& value, const std::string& name) {
  if (value.is_number()) return value.number();
  if (!value.is_text())
    throw InputError(value.where, fmt::format("the constant '{}' is {}", name, value.describe()),
                     "a number, or a quantity with its unit: \"2.5 mm/s\"");
  try {
    return units::si_quantity(value.text());
  } catch (const std::invalid_argument& error) {
    throw InputError(value.where, fmt::format("the constant '{}': {}", name, error.what()));
  }
}

Formula::Constants constants_of(const Value& table, const Key& key) {
  // No table of constants is no error: a formula may use coordinates alone.
  Formula::Constants constants;
  const Value* given = table.find("constants");
  if (given == nullptr) return constants;
  if (!given->is_table())
    throw InputError(given->where, fmt::format("'constants' of '{}' is {}", key.name, given->describe()),
                     "a table: { speed = \"2.5 mm/s\" }");
  // Names that the formula knows already cannot be given again, and each constant has its own unit.
  for (const auto& entry : given->entries()) {
    const bool taken =
        std::find(k_place_variables.begin(), k_place_variables.end(), entry.key) != k_place_variables.end();
    if (taken || !Formula::is_name(entry.key))
      throw InputError(entry.where, fmt::format("a constant cannot be called '{}'", entry.key),
                       "letters, digits and underscores; not a variable, a function, pi or e");
    constants[entry.key] = si_value(entry.value, entry.key);
  }
  return constants;
}

void read_formula(const Value& table, const Key& key, bool with_time, PlaceSpec& place) {
  allow(table, key, k_formula_keys);
  const std::string text = text_of(table, "formula", key);
  const SourceLocation where = table.find("formula")->where;
  try {
    place.formula = std::make_shared<const Formula>(text, k_place_variables, constants_of(table, key));
  } catch (const std::invalid_argument& error) {
    throw InputError(where, fmt::format("the formula of '{}': {}", key.name, error.what()));
  }
  if (!with_time && place.formula->uses(k_variable_t))
    throw InputError(where, fmt::format("'{}' has no time, but its formula uses t", key.name),
                     "a formula of the coordinates");
}

void read_velocity(const Value& table, const Key& key, bool with_time, PlaceSpec& place) {
  const Value* moving = table.find("moving");
  if (moving == nullptr) return;
  // Something that moves needs a time, and a velocity of two or three components.
  if (!with_time)
    throw InputError(moving->where, fmt::format("'{}' has no time: it cannot move", key.name), "no 'moving'");
  if (!moving->is_list() || moving->items().size() < 2 || moving->items().size() > 3)
    throw InputError(moving->where, fmt::format("'moving' of '{}' is {}", key.name, moving->describe()),
                     "a velocity, one component a direction: [\"0 mm/s\", \"-2.5 mm/s\"]");
  place.velocity_components = moving->items().size();
  // Each component is a velocity with a unit of its own.
  for (std::size_t i = 0; i < moving->items().size(); ++i) {
    const Value& item = moving->items()[i];
    try {
      if (!item.is_text()) throw std::invalid_argument(item.describe() + " has no unit");
      place.velocity[i] = units::parse_quantity(item.text(), "m/s");
    } catch (const std::invalid_argument& error) {
      throw InputError(item.where, fmt::format("'moving' of '{}': {}", key.name, error.what()));
    }
  }
}

void read_outside(const Value& table, const Key& key, PlaceSpec& place) {
  const std::string text = text_of(table, "outside", key);
  if (!text.empty() && text != "nearest" && text != "error")
    throw InputError(table.find("outside")->where, fmt::format("unknown 'outside': '{}'", text),
                     one_of({"nearest", "error"}, text));
  place.outside_is_error = text == "error";
}

void read_unit(const Value& table, const Key& key, PlaceSpec& place) {
  const std::string text = text_of(table, "unit", key);
  if (text.empty()) return;
  place.unit_given = true;
  try {
    place.unit = units::conversion(text, key.unit, key.temperature);
  } catch (const std::invalid_argument& error) {
    throw InputError(table.find("unit")->where, fmt::format("'unit' of '{}': {}", key.name, error.what()));
  }
}

void read_file(const Value& table, const Key& key, PlaceSpec& place) {
  // The ending of a file, or that it is a folder, says what it holds: points in a table, or a field of
  // another run. Each kind has keys of its own.
  place.file = text_of(table, "file", key);
  const std::string ending = std::filesystem::path(place.file).extension().string();
  if (ending == ".csv") {
    place.kind = PlaceSpec::Kind::points;
    allow(table, key, k_points_keys);
    place.column = text_of(table, "column", key);
    return;
  }
  std::error_code none;
  if (ending != ".vtu" && ending != ".pvtu" && !std::filesystem::is_directory(place.file, none))
    throw InputError(table.find("file")->where,
                     fmt::format("'{}' of '{}' is no file of points or of a field", place.file, key.name),
                     "a .csv, .vtu or .pvtu file, or the folder of a time of OpenFOAM");
  place.kind = PlaceSpec::Kind::field;
  allow(table, key, k_field_keys);
  place.column = text_of(table, "field", key);
  if (place.column.empty())
    throw InputError(table.where, fmt::format("'{}' does not say which field of the file it is", key.name),
                     "field = \"temperature\"");
  // The field of one body, where several overlap in the file.
  if (const Value* body = table.find("body")) {
    if (!body->is_integer() || body->integer() < 0 || body->integer() > 1000000)
      throw InputError(body->where, fmt::format("'body' of '{}' is {}", key.name, body->describe()),
                       "a number of the file's cell data `body`, from 0");
    place.body = static_cast<int>(body->integer());
  }
  // Files have no unit of length, so that it may be said here.
  if (const std::string length = text_of(table, "length_unit", key); !length.empty()) {
    try {
      place.length = units::convert(1.0, length, "m");
    } catch (const std::invalid_argument& error) {
      throw InputError(table.find("length_unit")->where,
                       fmt::format("'length_unit' of '{}': {}", key.name, error.what()));
    }
  }
}

}  // namespace

bool is_place(const Value& table) {
  return table.find("formula") != nullptr || table.find("file") != nullptr;
}

std::shared_ptr<const PlaceSpec> read_place(const Value& table, const Key& key, bool with_time) {
  // The range and unit of the key go with the place, since values are checked only where they are evaluated.
  auto place = std::make_shared<PlaceSpec>();
  place->key = key.name;
  place->key_unit = key.unit;
  place->lower = key.lower, place->upper = key.upper, place->lower_open = key.lower_open;
  place->where = table.where;
  place->with_time = with_time;
  // Exactly one of formula and file, and each has its own keys.
  if (table.find("formula") != nullptr && table.find("file") != nullptr)
    throw InputError(table.where, fmt::format("'{}' has both a formula and a file", key.name), "one of them");
  if (table.find("formula") != nullptr)
    read_formula(table, key, with_time, *place);
  else
    read_file(table, key, *place);
  read_unit(table, key, *place);
  read_outside(table, key, *place);
  read_velocity(table, key, with_time, *place);
  return place;
}

}  // namespace solidus
