/// Materials are looked for in the case's folder and in the library, and must fit what the case does with
/// them.
#include "cases/case_materials.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>

#include "cases/external_laws.hpp"
#include "cases/roles.hpp"
#include "material/cards/library.hpp"
#include "numbers/types.hpp"
#include "system/program_path.hpp"

namespace solidus::cases {

namespace fs = std::filesystem;

std::vector<fs::path> material_folders() {
  std::vector<fs::path> folders;
  // Folders that do not exist are left out without a word: most of the places below are not there.
  const auto add = [&folders](const fs::path& folder) {
    std::error_code error;
    if (fs::is_directory(folder, error)) folders.push_back(folder);
  };
  // The folders of the user come first, then those installed with the program and those of its sources.
  if (const char* listed = std::getenv("SOLIDUS_MATERIALS")) {
    std::istringstream paths(listed);
    for (std::string path; std::getline(paths, path, ':');)
      if (!path.empty()) add(path);
  }
  // From the program upwards, since it may lie in an installation or in a folder of a build.
  fs::path folder = program_path().parent_path();
  constexpr int k_levels = 3;  // as far as build/release/solidus lies below the sources
  for (int level = 0; level < k_levels && folder.has_relative_path();
       ++level, folder = folder.parent_path()) {
    add(folder / "share/solidus/materials");
    add(folder / "materials");
  }
  if (const fs::path sources = SOLIDUS_SOURCES; !sources.empty()) add(sources / "materials");
  return folders;
}

std::vector<material::Material> load_materials(const CaseSpec& spec) {
  const std::vector<fs::path> folders = material_folders();
  std::vector<material::Material> materials;
  for (const BodySpec& body : spec.bodies) {
    materials.push_back(material::find_material(body.material, folders, body.where));
    // What the case varies of the material is applied to its copy.
    if (const auto by = spec.vary.bodies.find(body.name); by != spec.vary.bodies.end())
      material::vary(materials.back(), by->second, spec.vary.where);
    // The material of a chill or a die may melt, but it is no casting that solidifies.
    if (const Role role = role_of(body, materials.back()); !is_poured(role))
      for (material::PhaseChange& change : materials.back().phase_changes) change.solidification = false;
    if (spec.has_mechanics() && !only_conducts(body) && !materials.back().mechanical())
      throw InputError(
          body.where,
          fmt::format("the material '{}' of body '{}' has no elastic properties", body.material, body.name),
          "young_modulus, poisson_ratio and expansion in the material, or physics = \"heat\" of the body");
    if (spec.has_mechanics() && !only_conducts(body)) load_external_law(spec, materials.back());
  }
  return materials;
}

void check_melts(const CaseSpec& spec, const std::vector<material::Material>& materials,
                 const std::vector<double>& highest) {
  // Inertia resists shear while the melt has no stiffness.
  if (!spec.has_mechanics() || spec.dynamics) return;
  for (std::size_t b = 0; b < materials.size(); ++b) {
    const BodySpec& body = spec.bodies[b];
    const material::PhaseChange* freezing = materials[b].solidification();
    // Only a body with mechanics that is all melt at its start and has that model is meant.
    if (only_conducts(body) || freezing == nullptr ||
        materials[b].liquid_model != material::LiquidModel::modified_shear ||
        freezing->fraction.value(highest[b]) > 0)
      continue;
    throw InputError(
        body.where,
        fmt::format("body '{}' starts as a melt at {:.4g} degC, and with liquid_model = "
                    "\"modified_shear\" of '{}' a melt has no stiffness against shear at all: it "
                    "flows away from every load but a uniform pressure",
                    body.name, highest[b] - k_zero_celsius, body.material),
        "liquid_model = \"maxwell\" or \"degenerated\", an initial temperature below the "
        "liquidus, or [dynamics]");
  }
}

}  // namespace solidus::cases
