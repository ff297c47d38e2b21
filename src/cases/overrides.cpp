/// Documents are laid over each other key by key; sections of a list are matched by name.
#include "cases/overrides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "input/keys.hpp"
#include "input/toml_limits.hpp"

namespace solidus::cases {

namespace {

bool is_section(const Value& value) {
  return value.is_table() && !value.written_inline;
}

bool is_section_list(const Value& value) {
  return value.is_list() && !value.items().empty() &&
         std::all_of(value.items().begin(), value.items().end(), is_section);
}

std::string name_of(const Value& section) {
  const Value* name = section.find("name");
  return name && name->is_text() ? name->text() : std::string();
}

void lay_list_over(Value& base, const Value& over) {
  for (const Value& item : over.items()) {
    const std::string name = name_of(item);
    const auto same = std::find_if(base.items().begin(), base.items().end(),
                                   [&](const Value& old) { return !name.empty() && name_of(old) == name; });
    if (same == base.items().end())
      base.items().push_back(item);
    else
      lay_over(*same, item);
  }
}

/// The section of a list that a path component names, "part" or "2".
Value& pick(Value& list, const std::string& part, const std::string& path, const SourceLocation& where) {
  std::vector<std::string> names;
  for (Value& item : list.items()) {
    names.push_back(name_of(item));
    if (names.back() == part) return item;
  }
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
  if (error == std::errc() && end == part.data() + part.size() && number >= 1 &&
      number <= list.items().size())
    return list.items()[number - 1];
  // Sections without a name are picked by their number.
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i].empty()) names[i] = std::to_string(i + 1);
  throw InputError(where, fmt::format("there is no '{}' among the sections [[{}]]", part, path),
                   one_of(names, part));
}

}  // namespace

void lay_over(Value& base, const Value& over) {
  // Sections merge key by key and lists of sections by name; anything else is replaced.
  for (const auto& [key, where, value] : over.entries()) {
    Value* old = base.find(key);
    if (old && is_section(*old) && is_section(value))
      lay_over(*old, value);
    else if (old && is_section_list(*old) && is_section_list(value))
      lay_list_over(*old, value);
    else if (old)
      (*old = value).laid_over = true;
    else
      base.entries().push_back({key, where, value});
  }
}

void apply_override(Value& base, const std::string& assignment) {
  // The path is walked part by part through the tree of the case: a part of a list names one of its sections,
  // a part of a table a key. Sections that are not there yet are made, and the value is parsed as in a file.
  constexpr std::size_t k_shown = 200;
  const std::string shown = assignment.size() > k_shown ? assignment.substr(0, k_shown) + "..." : assignment;
  const SourceLocation where{"--set " + shown, 0, 0};
  // What is left of the first equals sign is a path, what is right of it a value.
  const std::size_t equals = assignment.find('=');
  const auto trimmed = [](std::string text) {
    text.erase(0, text.find_first_not_of(" \t"));
    text.erase(text.find_last_not_of(" \t") + 1);
    return text;
  };
  const std::string path = trimmed(assignment.substr(0, equals));
  // A text that is no assignment is refused before anything is changed.
  if (equals == std::string::npos || path.empty())
    throw InputError(where, "this is no assignment",
                     "--set path=value, for example --set time.step=\"0.5 s\"");

  // Included files are merged already when assignments are applied.
  if (path == "include")
    throw InputError(where, "'include' holds in a case file only", "a case file that includes both");
  if (std::count(path.begin(), path.end(), '.') >= k_most_key_parts)
    throw InputError(where, "the path has too many parts", fmt::format("at most {}", k_most_key_parts));
  // The place in the tree, and the path so far for messages.
  Value* place = &base;
  std::string walked;
  for (std::size_t begin = 0;;) {
    const std::size_t dot = path.find('.', begin);
    const std::string part = path.substr(begin, dot == std::string::npos ? dot : dot - begin);
    // A list has sections with names; the part picks one of them, and the path has to go on to a key.
    if (part.empty()) throw InputError(where, fmt::format("the path '{}' has an empty part", path));
    if (place->is_list()) {
      place = &pick(*place, part, walked, where);
      if (dot == std::string::npos)
        throw InputError(where, fmt::format("the path '{}' names a section, not a key", path), "append .KEY");
    } else {
      if (!place->is_table())
        throw InputError(
            where, fmt::format("'{}' is {}, so there is no '{}' in it", walked, place->describe(), part));
      // The last part is the key. Its value is marked as laid over, so that messages name the command line.
      if (dot == std::string::npos) {
        place->set(part, parse_value(trimmed(assignment.substr(equals + 1)), where.file)).laid_over = true;
        return;
      }
      Value* next = place->find(part);
      if (!next) {
        Value section;
        section.where = where;
        next = &place->set(part, std::move(section));
      }
      place = next;
      walked += (walked.empty() ? "" : ".") + part;
    }
    begin = dot + 1;
  }
}

}  // namespace solidus::cases
