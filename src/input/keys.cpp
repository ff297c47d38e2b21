#include "input/keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "input/gone_keys.hpp"
#include "input/key_docs.hpp"
#include "input/place_spec.hpp"

namespace solidus {

namespace {

/// Number of single-letter edits between two texts (Levenshtein 1966); neighbours swapped count as one.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = last;
    last = row;
  }
  return last[b.size()];
}

[[noreturn]] void wrong_type(const Value& value, const Key& key, const std::string& expected) {
  throw InputError(value.where, fmt::format("'{}' is {}", key.name, value.describe()),
                   "expected " + expected);
}

std::string quantity_example(const Key& key) {
  return key.unit == "1" ? "a number"
                         : fmt::format("{} with its unit: \"{}\"", units::dimension_name(key.unit),
                                       units::example(key.unit));
}

std::string range_text(const Key& key) {
  const std::string unit = key.unit.empty() || key.unit == "1" ? "" : " " + key.unit;
  const bool low = std::isfinite(key.lower), high = std::isfinite(key.upper);
  if (low && high)
    return fmt::format("{} {} and at most {}{}", key.lower_open ? "above" : "at least", key.lower, key.upper,
                       unit);
  if (low) return fmt::format("{} {}{}", key.lower_open ? "above" : "at least", key.lower, unit);
  return fmt::format("at most {}{}", key.upper, unit);
}

/// Beyond this no quantity is physical, and products of a few such numbers overflow.
double largest_magnitude(std::string_view unit) {
  return unit == "K" ? 1e6 : 1e25;
}

double checked_magnitude(double number, const Value& value, const Key& key, std::string_view unit) {
  if (std::abs(number) <= largest_magnitude(unit)) return number;
  throw InputError(value.where,
                   fmt::format("'{}' is {}, which is beyond all physics", key.name, value.describe()),
                   fmt::format("at most {:g} {}", largest_magnitude(unit), unit));
}

double checked_range(double number, const Value& value, const Key& key) {
  if (!std::isfinite(number))
    throw InputError(value.where, fmt::format("'{}' is {}", key.name, value.describe()), "a finite number");
  if (number < key.lower || number > key.upper || (key.lower_open && number <= key.lower))
    throw InputError(value.where,
                     fmt::format("'{}' is {}, which is out of range", key.name, value.describe()),
                     "allowed: " + range_text(key));
  return number;
}

/// A number with the unit of the declaration, from "90 s" or, where no unit is needed, 0.3.
/// @param unit_beside the unit that is elsewhere for bare numbers; may be empty
double read_quantity(const Value& value, const Key& key, std::string_view unit,
                     std::string_view unit_beside) {
  try {
    if (value.is_text())
      return checked_magnitude(units::parse_quantity(value.text(), unit, key.temperature), value, key, unit);
    if (!value.is_number()) wrong_type(value, key, quantity_example(key));
    if (!unit_beside.empty())
      return checked_magnitude(units::convert(value.number(), unit_beside, unit, key.temperature), value, key,
                               unit);
    if (unit == "1") return checked_magnitude(value.number(), value, key, unit);
  } catch (const std::invalid_argument& error) {
    throw InputError(value.where, fmt::format("'{}': {}", key.name, error.what()));
  }
  throw InputError(value.where, fmt::format("'{}' is {} without a unit", key.name, value.describe()),
                   fmt::format("write it as text with its unit: \"{}\"", units::example(unit)));
}

std::string text_of(const Value& table, std::string_view name, const Key& key) {
  const Value* value = table.find(name);
  if (!value) return {};
  if (!value->is_text())
    throw InputError(value->where, fmt::format("'{}' of '{}' is {}", name, key.name, value->describe()),
                     "expected a text");
  return value->text();
}

Argument argument_of(const Value& table, const Key& key) {
  std::vector<std::string> names;
  for (const Argument a : key.arguments) names.emplace_back(name(a));
  const std::string text = text_of(table, "of", key);
  if (text.empty() && key.arguments.size() == 1) return key.arguments.front();
  if (text.empty())
    throw InputError(table.where, fmt::format("the table '{}' does not name its argument", key.name),
                     "add of = \"...\", " + one_of(names));
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end())
    throw InputError(table.find("of")->where,
                     fmt::format("'{}' cannot be a function of '{}'", key.name, text), one_of(names, text));
  return key.arguments[static_cast<std::size_t>(found - names.begin())];
}

Extrapolation extrapolation_of(const Value& table, const Key& key) {
  const std::string text = text_of(table, "extrapolation", key);
  if (text.empty() || text == "constant") return Extrapolation::constant;
  if (text == "linear") return Extrapolation::linear;
  if (text == "error") return Extrapolation::error;
  throw InputError(table.find("extrapolation")->where, fmt::format("unknown extrapolation '{}'", text),
                   one_of({"constant", "linear", "error"}, text));
}

Table points_of(const Value& table, const Key& key, Argument of) {
  const Value& points = *table.find("points");
  if (!points.is_list() || points.items().empty())
    throw InputError(points.where, fmt::format("'points' of '{}' is {}", key.name, points.describe()),
                     "a list of pairs: [[argument, value], ...]");
  const std::string unit = text_of(table, "unit", key), argument_unit = text_of(table, "argument_unit", key);
  Key argument = key;  // for messages: the number next to 'key' that is its argument
  argument.name = fmt::format("{} of {}", name(of), key.name);
  argument.temperature = units::Temperature::absolute;
  std::vector<double> x, y;
  for (const Value& pair : points.items()) {
    if (!pair.is_list() || pair.items().size() != 2)
      throw InputError(pair.where, fmt::format("a point of '{}' is {}", key.name, pair.describe()),
                       "[argument, value]");
    const Value &at = pair.items()[0], &is = pair.items()[1];
    x.push_back(read_quantity(at, argument, si_unit(of), argument_unit));
    y.push_back(checked_range(read_quantity(is, key, key.unit, unit), is, key));
    if (x.size() > 1 && !(x.back() > x[x.size() - 2]))
      throw InputError(at.where,
                       fmt::format("point {} of '{}' is not beyond the one before it", x.size(), key.name),
                       fmt::format("the {} must increase from point to point", name(of)));
  }
  try {
    return Table(std::move(x), std::move(y), extrapolation_of(table, key));
  } catch (const std::invalid_argument& error) {
    throw InputError(points.where, fmt::format("'{}': {}", key.name, error.what()));
  }
}

Function read_function_table(const Value& table, const Key& key) {
  if (key.place == Key::Place::none && is_place(table))
    throw InputError(
        table.where, fmt::format("'{}' is a formula or a file, which this key does not take", key.name),
        "a number or a table of points; for parts of their own groups of faces ([[mesh.group]])");
  if (key.place != Key::Place::none && is_place(table)) {
    Function result;
    result.place = read_place(table, key, key.place == Key::Place::position_and_time);
    return result;
  }
  const std::vector<std::string> known = {"value",         "points", "unit",  "of",  "argument_unit",
                                          "extrapolation", "source", "valid", "note"};
  for (const auto& entry : table.entries())
    if (std::find(known.begin(), known.end(), entry.key) == known.end())
      throw InputError(entry.where,
                       fmt::format("unknown key '{}' in the table-valued quantity '{}'", entry.key, key.name),
                       one_of(known, entry.key));
  const Value *value = table.find("value"), *points = table.find("points");
  // Exactly one of value and points is asked for; a value allows none of the keys that describe points.
  if ((value == nullptr) == (points == nullptr))
    throw InputError(
        table.where, fmt::format("'{}' has {}", key.name, value ? "both a value and points" : "no value"),
        fmt::format(
            "{}{}",
            key.arguments.empty() ? "value = ..." : "either value = ... or points = [[argument, value], ...]",
            key.place == Key::Place::none ? "" : ", or a formula or a file"));
  Function result;
  result.source = text_of(table, "source", key);
  text_of(table, "note", key);
  if (points) {
    if (key.arguments.empty())
      throw InputError(points->where, fmt::format("'{}' must be constant", key.name), "value = ...");
    result.of = argument_of(table, key);
    result.table = points_of(table, key, result.of);
  } else {
    for (const char* other : {"of", "argument_unit", "extrapolation"})
      if (const Value* useless = table.find(other))
        throw InputError(useless->where,
                         fmt::format("'{}' means nothing for the constant '{}'", other, key.name));
    result.table =
        Table(checked_range(read_quantity(*value, key, key.unit, text_of(table, "unit", key)), *value, key));
  }
  if (const Value* valid = table.find("valid")) {
    const Argument of =
        result.of == Argument::constant && !key.arguments.empty() ? key.arguments.front() : result.of;
    if (of == Argument::constant || !valid->is_list() || valid->items().size() != 2)
      throw InputError(valid->where, fmt::format("'valid' of '{}' is {}", key.name, valid->describe()),
                       "the first and last argument: [\"20 degC\", \"600 degC\"]");
    Key end = key;
    end.name = "valid", end.temperature = units::Temperature::absolute;
    std::array<double, 2> ends{};
    for (std::size_t i = 0; i < 2; ++i) ends[i] = read_quantity(valid->items()[i], end, si_unit(of), {});
    if (!(ends[0] < ends[1]))
      throw InputError(valid->where, fmt::format("'valid' of '{}' does not increase", key.name));
    result.valid = ends;
  }
  return result;
}

}  // namespace

std::string_view name(Argument argument) {
  constexpr std::array<std::string_view, 6> names = {"constant", "time",     "temperature",
                                                     "gap",      "pressure", "strain"};
  return names[static_cast<std::size_t>(argument)];
}

std::string_view si_unit(Argument argument) {
  constexpr std::array<std::string_view, 6> names = {"1", "s", "K", "m", "Pa", "1"};
  return names[static_cast<std::size_t>(argument)];
}

std::string nearest_name(std::string_view wrong, const std::vector<std::string>& names) {
  std::string nearest;
  std::size_t fewest = std::max<std::size_t>(2, wrong.size() / 3) + 1;
  for (const std::string& candidate : names) {
    const std::size_t n = edits(wrong, candidate);
    if (n < fewest && n < std::max(wrong.size(), candidate.size())) {
      fewest = n;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string one_of(const std::vector<std::string>& names, std::string_view found) {
  if (names.empty()) return "there are none";
  const std::string near = found.empty() ? "" : nearest_name(found, names);
  return fmt::format("{}{}: {}", near.empty() ? "" : fmt::format("did you mean '{}'? ", near),
                     names.size() == 1 ? "allowed" : "one of", fmt::join(names, ", "));
}

Key& Key::initially(Value value) {
  value.where.file = fmt::format("default of '{}'", name);
  if (value.is_list())
    for (Value& item : value.items()) item.where = value.where;
  initial = std::move(value);
  required = false;
  return *this;
}

Key& Key::range(double least, double greatest) {
  lower = least;
  upper = greatest;
  return *this;
}

Key& Key::positive() {
  lower = 0;
  lower_open = true;
  return *this;
}

Key& Key::choices(std::vector<std::string> texts) {
  allowed = std::move(texts);
  return *this;
}

Key& Key::when(std::string key, std::vector<std::string> values) {
  when_key = std::move(key);
  when_values = std::move(values);
  return *this;
}

namespace keys {

const std::string& choice_text(const Value& value, const Key& key) {
  if (!value.is_text()) wrong_type(value, key, "a text, " + one_of(key.allowed));
  if (!key.allowed.empty() &&
      std::find(key.allowed.begin(), key.allowed.end(), value.text()) == key.allowed.end())
    throw InputError(value.where, fmt::format("'{}' is {}", key.name, value.describe()),
                     one_of(key.allowed, value.text()));
  return value.text();
}

void read(const Value& value, const Key& key, std::string& out) {
  if (!value.is_text()) wrong_type(value, key, "a text in quotes");
  out = choice_text(value, key);
}

void read(const Value& value, const Key& key, bool& out) {
  if (!value.is_boolean()) wrong_type(value, key, "true or false");
  out = value.boolean();
}

void read(const Value& value, const Key& key, std::int64_t& out) {
  if (!value.is_integer()) wrong_type(value, key, "a whole number");
  out = value.integer();
  checked_range(static_cast<double>(out), value, key);
}

void read(const Value& value, const Key& key, int& out) {
  std::int64_t wide = 0;
  read(value, key, wide);
  if (wide < std::numeric_limits<int>::min() || wide > std::numeric_limits<int>::max())
    throw InputError(value.where, fmt::format("'{}' is {}, which is too large", key.name, value.describe()));
  out = static_cast<int>(wide);
}

void read(const Value& value, const Key& key, double& out) {
  if (key.kind == Key::Kind::quantity) {
    out = read_quantity(value, key, key.unit, {});
  } else {
    if (!value.is_number()) wrong_type(value, key, "a number");
    out = value.number();
  }
  checked_range(out, value, key);
}

void read(const Value& value, const Key& key, Function& out) {
  if (value.is_table()) {
    out = read_function_table(value, key);
  } else {
    out = Function{};
    out.table = Table(checked_range(read_quantity(value, key, key.unit, {}), value, key));
  }
  out.where = value.where;
}

void read(const Value& value, const Key& key, Table& out) {
  assert(key.place == Key::Place::none && "a place needs a Function");
  Function function;
  read(value, key, function);
  out = std::move(function.table);
}

const Value::List& list_items(const Value& value, const Key& key) {
  if (!value.is_list())
    wrong_type(value, key, key.length ? fmt::format("a list of {} values", key.length) : "a list: [ ... ]");
  if (key.length && value.items().size() != key.length)
    wrong_type(value, key, fmt::format("a list of {} values", key.length));
  return value.items();
}

}  // namespace keys

const Key* SectionInfo::find(std::string_view key) const {
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.name == key; });
  return found == keys.end() ? nullptr : &*found;
}

namespace {

/// "[mesh.parameters]" and "x" -> "[mesh.parameters.x]"; the top of a file is "".
std::string inner_path(const std::string& path, const std::string& name, bool repeated) {
  std::string inside = path;
  inside.erase(0, inside.find_first_not_of('['));
  inside.erase(std::min(inside.size(), inside.find(']')));
  inside += (inside.empty() ? "" : ".") + name;
  return repeated ? "[[" + inside + "]]" : "[" + inside + "]";
}

Value completed_key(const Value& value, const Key& key, const std::string& path) {
  const bool repeated = key.kind == Key::Kind::sections;
  const std::string inner = inner_path(path, key.name, repeated);
  if (key.kind == Key::Kind::section) return key.section->completed(value, inner);
  if (key.kind == Key::Kind::sections) {
    Value result = key.single && value.is_table() ? Value::list({value}) : value;
    if (!result.is_list())
      throw InputError(value.where, fmt::format("'{}' is {}", key.name, value.describe()),
                       fmt::format("any number of sections, each headed {}", inner));
    for (Value& item : result.items()) item = key.section->completed(item, inner);
    return result;
  }
  if (key.kind == Key::Kind::named_sections) {
    if (!value.is_table())
      throw InputError(value.where, fmt::format("'{}' is {}", key.name, value.describe()),
                       fmt::format("sections headed {}", inner_path(inner, "NAME", false)));
    Value result = value;
    for (auto& entry : result.entries())
      entry.value = key.section->completed(entry.value, inner_path(inner, entry.key, false));
    return result;
  }
  return value;
}

}  // namespace

Value SectionInfo::completed(const Value& table, const std::string& path) const {
  const std::string section = path.empty() ? "the file" : path.front() == '[' ? path : "[" + path + "]";
  if (!table.is_table())
    throw InputError(table.where, fmt::format("{} is {}", section, table.describe()),
                     "expected a section with keys");
  for (const auto& entry : table.entries()) {
    if (find(entry.key)) continue;
    if (const auto missing = missing_key(name, entry.key))
      throw InputError(entry.where, fmt::format("the key '{}' of {} {}", entry.key, section, missing->state),
                       std::string(missing->instead));
    std::vector<std::string> names;
    for (const Key& key : keys) names.push_back(key.name);
    throw InputError(entry.where, fmt::format("unknown key '{}' in {}", entry.key, section),
                     one_of(names, entry.key));
  }
  Value result;
  result.where = table.where;
  result.written_inline = table.written_inline;
  for (const Key& key : keys) {
    const Value* value = table.find(key.name);
    if (!key.when_key.empty()) {
      const Value* kind = result.find(key.when_key);
      const std::string text = kind ? keys::choice_text(*kind, *find(key.when_key)) : std::string();
      if (std::find(key.when_values.begin(), key.when_values.end(), text) == key.when_values.end()) {
        // A variant that chose another kind drops the keys that it inherited for the old one.
        const bool dropped = value && kind && kind->laid_over && value->where.file != kind->where.file;
        if (value && !dropped)
          throw InputError(
              value->where,
              kind ? fmt::format("'{}' does not belong to {} with {} = \"{}\"", key.name, section,
                                 key.when_key, text)
                   : fmt::format("'{}' does not belong to {} without '{}'", key.name, section, key.when_key),
              fmt::format("it needs {} = {}", key.when_key, fmt::join(key.when_values, " or ")));
        continue;
      }
    }
    if (value)
      result.set(key.name, completed_key(*value, key, path));
    else if (key.required)
      throw InputError(table.where, fmt::format("the key '{}' is missing in {}", key.name, section),
                       advice_on_missing(key));
    else if (key.initial) {
      Value initial = *key.initial;
      if (initial.where.file.empty())
        initial.where = table.where;  // an absent section: point to what holds it
      result.set(key.name, completed_key(initial, key, path));
    }
  }
  return result;
}

}  // namespace solidus
