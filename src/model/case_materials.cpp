#include "model/case_materials.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>

#include "material/library.hpp"
#include "model/body_input.hpp"

namespace solidus::model {

namespace fs = std::filesystem;

std::vector<fs::path> material_folders() {
  std::vector<fs::path> folders;
  const auto add = [&folders](const fs::path& folder) {
    std::error_code error;
    if (fs::is_directory(folder, error)) folders.push_back(folder);
  };
  if (const char* listed = std::getenv("SOLIDUS_MATERIALS")) {
    std::istringstream paths(listed);
    for (std::string path; std::getline(paths, path, ':');)
      if (!path.empty()) add(path);
  }
  std::error_code error;
  fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  constexpr int k_levels = 3;  // as far as build/release/solidus lies below the sources
  for (int level = 0; level < k_levels && folder.has_relative_path();
       ++level, folder = folder.parent_path()) {
    add(folder / "share/solidus/materials");
    add(folder / "materials");
  }
  add(SOLIDUS_MATERIALS_DIR);
  return folders;
}

std::vector<material::Material> load_materials(const CaseSpec& spec) {
  const std::vector<fs::path> folders = material_folders();
  std::vector<material::Material> materials;
  for (const BodySpec& body : spec.bodies) {
    materials.push_back(material::find_material(body.material, folders, body.where));
    if (spec.has_mechanics() && !only_conducts(body) && !materials.back().mechanical())
      throw InputError(
          body.where,
          fmt::format("the material '{}' of body '{}' has no elastic properties", body.material, body.name),
          "young_modulus, poisson_ratio and expansion in the material, or physics = \"heat\" of the body");
  }
  return materials;
}

}  // namespace solidus::model
