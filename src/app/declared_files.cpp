/// The kinds of files by name, with the section that each begins with.
#include "app/declared_files.hpp"

#include "cases/case_keys.hpp"
#include "material/cards/library.hpp"
#include "point/spec.hpp"

namespace solidus::app {

void ChosenFile::add_options(CLI::App& verb) {
  CLI::Option* of_material =
      verb.add_flag("--material", material, "Keys of a material file instead of a case file");
  verb.add_flag("--point", point, "Keys of a point file instead of a case file")->excludes(of_material);
}

ChosenFile::Declared ChosenFile::declared() const {
  if (material)
    return {material::material_section().info(), "Reference: the material file", "Solidus material"};
  if (point) return {point::point_section().info(), "Reference: the point file", "Solidus point"};
  return {cases::case_keys().info(), "Reference: the case file", "Solidus case"};
}

}  // namespace solidus::app
