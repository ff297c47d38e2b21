/// One declaration of keys gives explanations, schema and manual; each form walks the same tree.
#include "input/key_docs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "numbers/index_casts.hpp"

namespace solidus {

namespace {

bool is_section(const Key& key) {
  return key.kind == Key::Kind::section || key.kind == Key::Kind::sections ||
         key.kind == Key::Kind::named_sections;
}

/// The heading of a section in the file: [time], [[body]], [phase_change.NAME].
std::string heading(const Key& key, const std::string& path) {
  if (key.kind == Key::Kind::sections) return "[[" + path + "]]";
  return "[" + path + (key.kind == Key::Kind::named_sections ? ".NAME]" : "]");
}

std::string child_path(const std::string& path, const Key& key) {
  return path.empty() ? key.name : path + "." + key.name;
}

/// The path under which the keys of a section are.
std::string inside(const Key& key, const std::string& path) {
  return key.kind == Key::Kind::named_sections ? path + ".NAME" : path;
}

/// "closed | open", unless that is too long for one line.
std::string choices_text(const Key& key) {
  const std::string all = fmt::format("{}", fmt::join(key.allowed, " | "));
  return all.size() <= 60 ? all : "choice";
}

std::string place_text(const Key& key) {
  if (key.place == Key::Place::none) return "";
  return key.place == Key::Place::position ? "constant or function of position"
                                           : "function of position and time";
}

std::string type_text(const Key& key) {
  // The type of a key in words, as the reference and messages have it.
  const auto single = [&]() -> std::string {
    switch (key.kind) {
      case Key::Kind::text:
        return key.allowed.empty() ? "text" : choices_text(key);
      case Key::Kind::integer:
        return "whole number";
      case Key::Kind::number:
        return "number";
      case Key::Kind::boolean:
        return "true or false";
      case Key::Kind::choice:
        return choices_text(key);
      case Key::Kind::quantity:
        return key.unit == "1" ? "number" : fmt::format("quantity [{}]", key.unit);
      case Key::Kind::function: {
        std::vector<std::string> names;
        for (const Argument a : key.arguments) names.emplace_back(name(a));
        const std::string tables =
            names.empty() ? "" : fmt::format(", constant or table of {}", fmt::join(names, " | "));
        const std::string places = place_text(key);
        return fmt::format("quantity [{}]{}{}{}", key.unit, tables,
                           places.empty() ? "" : (names.empty() ? ", " : ", or "), places);
      }
      case Key::Kind::section:
        return "section";
      case Key::Kind::sections:
        return key.single ? "section or sections" : "sections";
      case Key::Kind::named_sections:
        return "named sections";
    }
    return {};
  };
  // A list has its length, where it is fixed.
  if (!key.list) return single();
  if (key.length) return fmt::format("list of {} x {}", key.length, single());
  return (key.single ? single() + " or list of " : "list of ") + single();
}

/// A value as it would be in a file.
std::string value_text(const Value& value) {
  Value table;
  table.set("x", value);
  std::string text = to_toml(table);
  text.erase(0, text.find('=') + 2);
  return text.substr(0, text.find('\n'));
}

std::string range_text(const Key& key) {
  const bool low = std::isfinite(key.lower), high = std::isfinite(key.upper);
  const std::string unit = key.unit.empty() || key.unit == "1" ? "" : " " + key.unit;
  if (low && high)
    return fmt::format("{} {}, <= {}{}", key.lower_open ? ">" : ">=", key.lower, key.upper, unit);
  if (low) return fmt::format("{} {}{}", key.lower_open ? ">" : ">=", key.lower, unit);
  return high ? fmt::format("<= {}{}", key.upper, unit) : "";
}

std::string default_text(const Key& key) {
  if (key.initial) return value_text(*key.initial);
  return key.required ? "required" : "none";
}

std::string when_text(const Key& key) {
  return key.when_key.empty()
             ? ""
             : fmt::format("only with {} = {}", key.when_key, fmt::join(key.when_values, " | "));
}

void explain_key(const Key& key, const std::string& path, std::string& out) {
  // Name, meaning, type and default are always there.
  out += fmt::format("{}\n  {}\n  type:    {}\n  default: {}\n", path, key.doc_text, type_text(key),
                     default_text(key));
  if (const std::string range = range_text(key); !range.empty()) out += "  range:   " + range + "\n";
  // What may be chosen, when the key is used, and how its value is written, as far as it applies.
  for (std::size_t i = 0; i < key.allowed.size(); ++i)
    out += fmt::format("  {}{}{}\n", i == 0 ? "choices: " : "         ", key.allowed[i],
                       i < key.allowed_docs.size() ? "  " + key.allowed_docs[i] : "");
  if (!key.when_key.empty()) out += "  used:    " + when_text(key) + "\n";
  // Quantities and functions get an example with a unit that fits.
  if (key.kind == Key::Kind::quantity && key.unit != "1")
    out += fmt::format("  write:   \"{}\" or any unit of {}\n", units::example(key.unit),
                       units::dimension_name(key.unit));
  if (key.kind == Key::Kind::function && !key.arguments.empty())
    out += fmt::format(
        "  write:   \"{0}\", or {{ of = \"{1}\", argument_unit = \"{2}\", unit = \"{3}\", points = [[x, y], "
        "...] }}\n",
        units::example(key.unit), name(key.arguments.front()), si_unit(key.arguments.front()), key.unit);
  if (key.place != Key::Place::none)
    out += fmt::format(
        "  place:   {{ formula = \"...\", unit = \"{0}\" }} of x, y, z, r [m]{1}, {{ file = \"points.csv\" "
        "}}, "
        "or {{ file = \"field.vtu\", field = \"...\" }}\n",
        key.unit, key.place == Key::Place::position ? "" : " and t [s]");
}

void explain_section(const SectionInfo& info, const std::string& title, const std::string& path,
                     std::string& out) {
  out += fmt::format("{}{}\n", title.empty() ? "" : title + "  ", info.doc);
  // Keys first, each in a line; then the sections within.
  for (const Key& key : info.keys)
    if (!is_section(key))
      out += fmt::format("  {:<24} {:<34} default: {}\n", key.name, type_text(key), default_text(key));
  for (const Key& key : info.keys) {
    if (!is_section(key)) continue;
    const std::string inner = child_path(path, key);
    out += "\n";
    explain_section(*key.section, heading(key, inner), inside(key, inner), out);
  }
}

std::string json_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += '\\', out += c;
    else if (c == '\n')
      out += "\\n";
    else if (static_cast<unsigned char>(c) < 0x20)
      out += ' ';
    else
      out += c;
  }
  return out + '"';
}

std::string json_list(const std::vector<std::string>& texts) {
  std::string out;
  for (const std::string& text : texts) out += (out.empty() ? "" : ", ") + json_text(text);
  return "[" + out + "]";
}

std::string json_limits(const Key& key) {
  std::string out;
  if (std::isfinite(key.lower))
    out += fmt::format(", \"{}\": {}", key.lower_open ? "exclusiveMinimum" : "minimum", key.lower);
  if (std::isfinite(key.upper)) out += fmt::format(", \"maximum\": {}", key.upper);
  return out;
}

std::string schema_of_section(const SectionInfo& info, int depth);

/// The keys of a quantity that varies from place to place, to follow those of a table.
std::string schema_of_place(const Key& key) {
  if (key.place == Key::Place::none) return "";
  std::string keys;
  for (const char* name : {"formula", "file", "column", "field", "length_unit"})
    keys += fmt::format(", \"{}\": {{\"type\": \"string\"}}", name);
  return keys +
         ", \"constants\": {\"type\": \"object\"}, \"moving\": {\"type\": \"array\"}, \"body\": "
         "{\"type\": \"integer\"}, \"outside\": {\"enum\": [\"nearest\", \"error\"]}";
}

std::string schema_of_value(const Key& key, int depth) {
  // The JSON Schema of a value. Quantities are texts with their unit, functions a text or a table with the
  // keys that read_function_table() knows.
  switch (key.kind) {
    case Key::Kind::text:
    case Key::Kind::choice:
      return "\"type\": \"string\"" + (key.allowed.empty() ? "" : ", \"enum\": " + json_list(key.allowed));
    case Key::Kind::integer:
      return "\"type\": \"integer\"" + json_limits(key);
    case Key::Kind::number:
      return "\"type\": \"number\"" + json_limits(key);
    case Key::Kind::boolean:
      return "\"type\": \"boolean\"";
    case Key::Kind::quantity:
      return key.unit == "1" ? "\"type\": [\"number\", \"string\"]" + json_limits(key)
                             : "\"type\": \"string\"";
    case Key::Kind::function: {
      std::vector<std::string> names;
      for (const Argument a : key.arguments) names.emplace_back(name(a));
      const std::string simple = key.unit == "1" ? "[\"number\", \"string\"]" : "\"string\"";
      return fmt::format(
          "\"anyOf\": [{{\"type\": {}}}, {{\"type\": \"object\", \"additionalProperties\": false, "
          "\"properties\": {{"
          "\"value\": {{\"type\": [\"number\", \"string\"]}}, \"points\": {{\"type\": \"array\"}}, \"of\": "
          "{{\"enum\": {}}}, "
          "\"unit\": {{\"type\": \"string\"}}, \"argument_unit\": {{\"type\": \"string\"}}, \"source\": "
          "{{\"type\": "
          "\"string\"}}, \"note\": {{\"type\": \"string\"}}, \"valid\": {{\"type\": \"array\"}}, "
          "\"extrapolation\": {{\"enum\": [\"constant\", \"linear\", \"error\"]}}{}}}}}]",
          simple, json_list(names), schema_of_place(key));
    }
    case Key::Kind::section:
      return schema_of_section(*key.section, depth + 1);
    case Key::Kind::sections: {
      const std::string one = schema_of_section(*key.section, depth + 1);
      const std::string all = "\"type\": \"array\", \"items\": {" + one + "}";
      return key.single ? "\"anyOf\": [{" + one + "}, {" + all + "}]" : all;
    }
    case Key::Kind::named_sections:
      return "\"type\": \"object\", \"additionalProperties\": {" +
             schema_of_section(*key.section, depth + 1) + "}";
  }
  return {};
}

std::string schema_of_section(const SectionInfo& info, int depth) {
  const std::string indent(as_size(2 * depth + 2), ' ');
  std::string properties;
  // Each key becomes a property: its text with its conditions, its type, and the list around it where the key
  // takes one.
  for (const Key& key : info.keys) {
    std::string description = key.doc_text;
    for (const std::string& more : {key.required ? std::string("required") : "", when_text(key)})
      if (!more.empty()) description += (description.empty() ? "" : " ") + ("(" + more + ")");
    std::string value = schema_of_value(key, depth);
    if (key.list) {
      const std::string item = value;
      value = "\"type\": \"array\", \"items\": {" + item + "}";
      if (key.length) value += fmt::format(", \"minItems\": {0}, \"maxItems\": {0}", key.length);
      if (key.single) value = "\"anyOf\": [{" + item + "}, {" + value + "}]";
    }
    properties += fmt::format("{}\n{}{}: {{\"description\": {}, {}}}", properties.empty() ? "" : ",", indent,
                              json_text(key.name), json_text(description), value);
  }
  return "\"type\": \"object\", \"additionalProperties\": false, \"properties\": {" + properties + "}";
}

std::string cell(std::string text) {  // a pipe would end a Markdown cell
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return text;
}

/// Whether several keys of a section have the keys of one and the same section, as the spreads of a card: the
/// manual shows them as rows, and what they have in common once.
bool is_one_of_many(const Key& key, const SectionInfo& info) {
  const auto alike = [&](const Key& other) {
    return other.kind == Key::Kind::section && other.section == key.section;
  };
  return key.kind == Key::Kind::section && std::count_if(info.keys.begin(), info.keys.end(), alike) > 1;
}

void manual_of_section(const SectionInfo& info, const std::string& title, const std::string& path,
                       std::string& out) {
  // A table of the plain keys of a section, then its sections below. Choices follow with their meaning, and a
  // section that holds for many (one of several names) is written once.
  out += fmt::format("## {}\n\n{}\n\n", title, info.doc);
  std::string rows;
  for (const Key& key : info.keys) {
    if (is_one_of_many(key, info))
      rows += fmt::format("| `{}` | table, keys below | none | {} |\n", key.name, cell(key.doc_text));
    if (is_section(key)) continue;
    std::string meaning = key.doc_text;
    for (std::size_t i = 0; i < key.allowed.size(); ++i)
      meaning += fmt::format(
          "{} `{}`{}", i == 0 ? "" : ";", key.allowed[i],
          i < key.allowed_docs.size() && !key.allowed_docs[i].empty() ? " " + key.allowed_docs[i] : "");
    if (const std::string range = range_text(key); !range.empty()) meaning += fmt::format(" ({})", range);
    if (!key.when_key.empty()) meaning += fmt::format(" *{}*", when_text(key));
    rows += fmt::format("| `{}` | {} | {} | {} |\n", key.name, cell(type_text(key)),
                        key.initial ? "`" + cell(value_text(*key.initial)) + "`" : default_text(key),
                        cell(meaning));
  }
  if (!rows.empty()) out += "| key | type | default | meaning |\n|---|---|---|---|\n" + rows + "\n";
  std::vector<const SectionInfo*> shown;
  // Sections of the section come behind its own table; those that hold for many are written once.
  for (const Key& key : info.keys) {
    if (!is_section(key)) continue;
    if (is_one_of_many(key, info)) {
      if (std::find(shown.begin(), shown.end(), key.section.get()) != shown.end()) continue;
      shown.push_back(key.section.get());
      manual_of_section(*key.section, fmt::format("`[{}.KEY]`", path), path + ".KEY", out);
      continue;
    }
    const std::string inner = child_path(path, key);
    manual_of_section(*key.section, "`" + heading(key, inner) + "`", inside(key, inner), out);
  }
}

void add_paths(const SectionInfo& section, const std::string& path, std::vector<std::string>& out) {
  for (const Key& key : section.keys) {
    const std::string inner = child_path(path, key);
    if (!is_section(key))
      out.push_back(inner);
    else
      add_paths(*key.section, key.kind == Key::Kind::section ? inner : inner + ".NAME", out);
  }
}

/// "'a.key' or 'b.key'": keys of any section whose path ends with these words, at most six; else nothing.
std::string paths_that_end_with(const SectionInfo& root, const std::string& words) {
  std::vector<std::string> paths, found;
  add_paths(root, "", paths);
  for (const std::string& path : paths)
    if (path.ends_with("." + words) && found.size() < 6) found.push_back("'" + path + "'");
  return fmt::format("{}", fmt::join(found, " or "));
}

}  // namespace

std::vector<std::string> key_paths(const SectionInfo& root) {
  std::vector<std::string> paths;
  add_paths(root, "", paths);
  return paths;
}

std::string explain(const SectionInfo& root, const std::string& path) {
  // The path is walked from section to section. A name of the user's choice (a condition's, say) stands for
  // the section of that kind.
  std::string out;
  if (path.empty()) {
    explain_section(root, "", "", out);
    return out;
  }
  const SectionInfo* info = &root;
  const Key* key = nullptr;
  std::string walked;
  std::istringstream parts(path);
  // One part of the path at a time, with the section that it is looked for in.
  for (std::string part; std::getline(parts, part, '.');) {
    if (key && key->kind == Key::Kind::named_sections && !info) {  // the name of the user's choice
      info = key->section.get();
      walked += ".NAME";
      key = nullptr;
      continue;
    }
    const Key* next = info ? info->find(part) : nullptr;
    if (!next) {
      // A key alone, without its section, is found by its last word.
      if (walked.empty())
        if (const std::string found = paths_that_end_with(root, path); !found.empty())
          throw InputError({}, fmt::format("there is no key '{}' in the file", path),
                           "did you mean " + found + "?");
      std::vector<std::string> names;
      if (info)
        for (const Key& k : info->keys) names.push_back(k.name);
      throw InputError(
          {},
          fmt::format("there is no key '{}' in {}", part, walked.empty() ? "the file" : "[" + walked + "]"),
          one_of(names, part));
    }
    key = next;
    walked = child_path(walked, *key);
    info = is_section(*key) && key->kind != Key::Kind::named_sections ? key->section.get() : nullptr;
  }
  // A section is explained with all its keys, a key with its type, default and meaning.
  if (!key) {
    explain_section(*info, "[" + walked + "]", walked, out);
  } else if (is_section(*key)) {
    explain_section(*key->section, heading(*key, walked), inside(*key, walked), out);
  } else {
    explain_key(*key, walked, out);
  }
  return out;
}

std::string advice_on_missing(const Key& key) {
  std::string advice = key.doc_text;
  if (!key.when_key.empty())
    advice += fmt::format("{}It is needed with {} = \"{}\".", advice.empty() ? "" : " ", key.when_key,
                          fmt::join(key.when_values, "\" or \""));
  return advice.empty() ? "" : fmt::format("{}: {}", key.name, advice);
}

std::string json_schema(const SectionInfo& root, const std::string& title) {
  return fmt::format(
      "{{\"$schema\": \"http://json-schema.org/draft-07/schema#\", \"title\": {}, \"description\": "
      "{},\n{}}}\n",
      json_text(title), json_text(root.doc), schema_of_section(root, 0));
}

std::string reference_manual(const SectionInfo& root, const std::string& title) {
  std::string out = fmt::format("# {}\n\n", title);
  manual_of_section(root, "Top of the file", "", out);
  out +=
      "Next: [the case file, explained](../guide/case_file.md) · [material cards](../guide/materials.md) · "
      "[a material point](../guide/point.md) · [what a message means](../guide/troubleshooting.md)\n";
  return out;
}

}  // namespace solidus
