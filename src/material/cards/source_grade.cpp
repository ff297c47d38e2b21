/// Grades are words with a colon in the text of a source; a group of properties has every grade that one of
/// its sources has.
#include "material/cards/source_grade.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "material/material.hpp"

namespace solidus::material {
namespace {

/// Whether "word:" is in the text, in upper or lower case, not as the end of another word.
bool names(std::string_view text, std::string_view word) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
  };
  // Each place of the word is looked at, since an earlier one may be the end of another word.
  for (auto from = text.begin(); from != text.end();) {
    const auto at = std::search(from, text.end(), word.begin(), word.end(), same);
    if (at == text.end()) return false;
    const auto behind = at + static_cast<std::ptrdiff_t>(word.size());
    const bool begins = at == text.begin() || std::isalpha(static_cast<unsigned char>(*(at - 1))) == 0;
    if (begins && behind != text.end() && *behind == ':') return true;
    from = at + 1;
  }
  return false;
}

struct Group {
  std::vector<std::string> properties;  ///< or the beginnings of their names, "plasticity."
  bool phase_changes = false;
};

const std::array<Group, 8> k_groups{{{{"density"}},
                                     {{"conductivity"}},
                                     {{"specific_heat"}},
                                     {{"young_modulus", "poisson_ratio"}},
                                     {{"expansion"}},
                                     {{}, true},
                                     {{"plasticity.", "granular", "granular."}},
                                     {{"casting"}}}};

bool belongs(const PropertyNote& note, const Group& group, const Material& material) {
  if (group.phase_changes)
    return std::any_of(material.phase_changes.begin(), material.phase_changes.end(),
                       [&](const PhaseChange& change) { return change.name == note.property; });
  return std::any_of(group.properties.begin(), group.properties.end(), [&](const std::string& name) {
    return name.back() == '.' ? note.property.starts_with(name) : note.property == name;
  });
}

}  // namespace

SourceGrades grades_of(std::string_view source) {
  return {names(source, "checked"), names(source, "handbook"), names(source, "estimate")};
}

std::string grade_letters(const SourceGrades& grades) {
  std::string letters;
  if (grades.checked) letters += "c ";
  if (grades.handbook) letters += "h ";
  if (grades.estimate) letters += "e ";
  if (letters.empty()) return "-";
  letters.pop_back();
  return letters;
}

std::string grade_row(const Material& material) {
  std::string row = "| `" + material.name + "` | " + material.title + " |";
  for (const Group& group : k_groups) {
    SourceGrades sum;
    for (const PropertyNote& note : material.notes) {
      if (!belongs(note, group, material)) continue;
      const SourceGrades one = grades_of(note.source);
      sum = {sum.checked || one.checked, sum.handbook || one.handbook, sum.estimate || one.estimate};
    }
    row += " " + (sum.any() ? grade_letters(sum) : std::string("-")) + " |";
  }
  return row;
}

}  // namespace solidus::material
