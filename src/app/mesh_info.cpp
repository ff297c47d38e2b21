/// The verb `mesh-info`: groups, sizes and the worst elements of a mesh.
#include <fmt/format.h>

#include <filesystem>
#include <numbers>

#include "app/verbs.hpp"
#include "build/case_file.hpp"
#include "build/mesh_input.hpp"
#include "input/units.hpp"
#include "mesh/face_rules.hpp"
#include "mesh/quality.hpp"
#include "results/output_error.hpp"
#include "system/errors.hpp"

namespace solidus::app {

namespace {

using mesh::RawMesh;

/// A case gives its mesh; anything else is taken for a mesh file.
bool is_case(const std::filesystem::path& path) {
  return std::filesystem::is_directory(path) || path.extension() == ".toml";
}

RawMesh read(const CaseArguments& arguments, const std::string& unit) {
  if (is_case(arguments.path)) return model::raw_mesh(load_case(arguments).spec);
  if (!units::compatible(unit, "m"))
    throw InputError({"--unit", 0, 0}, fmt::format("'{}' is no unit of length", unit),
                     "\"mm\", \"m\", \"inch\", ...");
  mesh::MeshSource source{arguments.path, units::convert(1, unit, "m")};
  source.trust_script = arguments.trust_script;
  RawMesh mesh = mesh::read_mesh(source);
  mesh::validate_and_orient(mesh, arguments.path);
  return mesh;
}

}  // namespace

ExitCode mesh_info(const CaseArguments& arguments, const std::string& unit) {
  std::string text;
  results::on_first_process([&] {
    const RawMesh mesh = read(arguments, unit);
    text = mesh::to_text(mesh::assess(mesh));
    std::vector<std::string> bodies;
    for (const auto& [name, group] : mesh.groups)
      if (group.dimension == mesh.dimension) bodies.push_back(name);
    constexpr double k_edge = std::numbers::pi / 6;  // neighbours that bend by more begin a face
    text += mesh::to_text(mesh::skin_patches(mesh, bodies, k_edge));
  });
  print(text);
  return k_done;
}

}  // namespace solidus::app
