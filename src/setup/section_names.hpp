/// Names of the sections of one kind.
#pragma once

#include <fmt/format.h>

#include <set>
#include <string>
#include <vector>

#include "system/errors.hpp"

namespace solidus::setup {

/// Throws InputError where a section has no name, or two have the same.
/// @param heading  "[[probe]]"
template <class S>
void check_names(const std::vector<S>& sections, const std::string& heading) {
  std::set<std::string> seen;
  for (const S& s : sections) {
    if (s.name.empty()) throw InputError(s.where, fmt::format("a {} has an empty name", heading));
    if (!seen.insert(s.name).second)
      throw InputError(s.where, fmt::format("the name '{}' is used by two {} sections", s.name, heading),
                       "each needs a name of its own");
  }
}

}  // namespace solidus::setup
