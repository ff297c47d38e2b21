/// Grade of certainty of a value of the material library, from the words in its source text
/// (docs/guide/materials.md).
#pragma once

#include <string>
#include <string_view>

namespace solidus::material {

struct Material;

/// The grades that a source text names: "checked: …", "handbook: …", "estimate: …". One text may name
/// several, as where cold values come from a standard and hot ones are estimates.
struct SourceGrades {
  bool checked =
      false;  ///< the number was compared with the source, or with a public copy or quotation of it
  bool handbook = false;  ///< quoted from a source that could not be opened
  bool estimate = false;  ///< derived from related materials, rounded, or chosen
  bool any() const { return checked || handbook || estimate; }
};

SourceGrades grades_of(std::string_view source);

/// "c", "h", "e", several of them ("c e"), or "-" where the text names none.
std::string grade_letters(const SourceGrades& grades);

/// A line of the guide's table of the library: the grades of the groups of properties of a card, in Markdown:
/// | `name` | title | density | conductivity | specific heat | elastic | expansion | freezing | flow |
/// casting |
std::string grade_row(const Material& material);

}  // namespace solidus::material
