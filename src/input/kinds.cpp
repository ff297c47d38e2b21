/// A kind is checked when it is added: its name, its doc and its keys must not clash with those that are
/// there.
#include "input/kinds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace solidus {

namespace {

bool same(const Key& a, const Key& b) {
  const auto initial = [](const Key& key) { return key.initial ? key.initial->describe() : std::string(); };
  return a.kind == b.kind && a.unit == b.unit && a.doc_text == b.doc_text && a.lower == b.lower &&
         a.upper == b.upper && a.lower_open == b.lower_open && a.required == b.required && a.list == b.list &&
         a.single == b.single && a.arguments == b.arguments && a.allowed == b.allowed &&
         initial(a) == initial(b);
}

}  // namespace

void check_kind(const std::string& family, const std::string& name, const SectionInfo& keys,
                const std::string& other_name, const SectionInfo& other_keys) {
  const auto refuse = [&](const std::string& why) {
    throw std::logic_error(fmt::format("the {} '{}': {}", family, name, why));
  };
  if (name == other_name) refuse("the name is taken");
  for (const Key& key : keys.keys)
    if (const Key* other = other_keys.find(key.name); other != nullptr && !same(key, *other))
      refuse(fmt::format("'{}' declares the key '{}' otherwise", other_name, key.name));
}

void SectionInfo::check_new(const std::string& key) const {
  if (find(key) != nullptr) throw std::logic_error("[" + name + "] has the key '" + key + "' twice");
}

void SectionInfo::add_kind(const std::string& chosen_by, const std::string& kind,
                           const SectionInfo& of_kind) {
  for (const Key& key : of_kind.keys) {
    // A kind's keys have the kind for their condition, so that they cannot have another.
    if (!key.when_key.empty())
      throw std::logic_error(
          fmt::format("the key '{}' of the kind '{}' has a condition of its own", key.name, kind));
    const auto there =
        std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.name == key.name; });
    // A key of several kinds is listed once, with all kinds that have it; one of the whole section may not be
    // one of a kind too.
    if (there == keys.end()) {
      keys.push_back(key);
      keys.back().when_key = chosen_by;
      keys.back().when_values = {kind};
    } else if (there->when_key == chosen_by) {
      there->when_values.push_back(kind);
    } else {
      throw std::logic_error(
          fmt::format("the key '{}' of the kind '{}' is one of the section too", key.name, kind));
    }
  }
}

}  // namespace solidus
