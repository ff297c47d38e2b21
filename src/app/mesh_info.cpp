/// The verb `mesh-info`: the groups and sizes of a mesh.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>

#include "app/verbs.hpp"
#include "base/errors.hpp"
#include "base/units.hpp"
#include "mesh/raw_mesh.hpp"
#include "model/case_file.hpp"
#include "model/mesh_input.hpp"
#include "results/output_error.hpp"

namespace solidus::app {

namespace {

using mesh::RawMesh;

/// A case gives its mesh; anything else is taken for a mesh file.
bool is_case(const std::filesystem::path& path) {
  return std::filesystem::is_directory(path) || path.extension() == ".toml";
}

RawMesh read(const CaseArguments& arguments, const std::string& unit) {
  if (is_case(arguments.path)) return model::raw_mesh(model::load_case(arguments.path, arguments.set).spec);
  if (!units::compatible(unit, "m"))
    throw InputError({"--unit", 0, 0}, fmt::format("'{}' is no unit of length", unit),
                     "\"mm\", \"m\", \"inch\", ...");
  RawMesh mesh = mesh::read_mesh(arguments.path, units::convert(1, unit, "m"));
  mesh::validate_and_orient(mesh, arguments.path);
  return mesh;
}

std::string kind_of(int dimension, int of_mesh) {
  if (dimension == of_mesh) return "body";
  if (dimension == of_mesh - 1) return "surface";
  return dimension == 0 ? "point" : "line";
}

/// The smallest box around the nodes of a group [mm].
std::string box(const RawMesh& mesh, const mesh::RawGroup& group) {
  constexpr double k_far = std::numeric_limits<double>::max();
  mesh::Point low{k_far, k_far, k_far}, high{-k_far, -k_far, -k_far};
  for (const auto& block : group.blocks)
    for (const Index i : block.nodes)
      for (std::size_t d = 0; d < 3; ++d) {
        const double x = mesh.x[static_cast<std::size_t>(i)][d] * 1000;
        low[d] = std::min(low[d], x);
        high[d] = std::max(high[d], x);
      }
  std::string out;
  for (std::size_t d = 0; d < static_cast<std::size_t>(mesh.dimension); ++d)
    out += fmt::format("{}{:.6g} .. {:.6g}", d == 0 ? "" : ", ", low[d], high[d]);
  return out;
}

std::string report(const RawMesh& mesh) {
  std::string out = fmt::format("{} dimensions, {} nodes\n{:<24} {:<8} {:<28} {}\n", mesh.dimension,
                                mesh.x.size(), "group", "kind", "elements", "extent [mm]");
  for (const auto& [name, group] : mesh.groups) {
    std::map<std::string, Index> elements;
    for (const auto& block : group.blocks)
      elements[std::string(mesh::name(block.shape))] +=
          static_cast<Index>(block.nodes.size()) / mesh::node_count(block.shape);
    std::string counts;
    for (const auto& [shape, n] : elements)
      counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", n, shape);
    out += fmt::format("{:<24} {:<8} {:<28} {}\n", name, kind_of(group.dimension, mesh.dimension), counts,
                       box(mesh, group));
  }
  return out;
}

}  // namespace

ExitCode mesh_info(const CaseArguments& arguments, const std::string& unit) {
  std::string text;
  results::on_first_process([&] { text = report(read(arguments, unit)); });
  print(text);
  return k_done;
}

}  // namespace solidus::app
