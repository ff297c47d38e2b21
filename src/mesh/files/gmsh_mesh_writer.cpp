/// MSH 2.2: a section of names, one of nodes, one of elements with the number of their group.
#include "mesh/files/gmsh_mesh_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "mesh/shape_table.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

int gmsh_type(Shape shape) {
  return std::ranges::find(k_shape_rows, shape, &ShapeRow::shape)->gmsh;
}

/// A group with its number, which is that of its name in the file.
struct NumberedGroup {
  const std::string* name;
  const RawGroup* group;
  int number;
};

std::vector<NumberedGroup> numbered(const RawMesh& mesh, const std::set<std::string>& left_out) {
  std::vector<NumberedGroup> groups;
  for (const auto& [name, group] : mesh.groups) {
    if (left_out.contains(name) || group.blocks.empty()) continue;
    if (name.find('"') != std::string::npos)
      throw InputError({name, 0, 0}, "the name of a group has a quotation mark, which no .msh file can hold",
                       "a name without it");
    groups.push_back({&name, &group, static_cast<int>(groups.size()) + 1});
  }
  return groups;
}

std::size_t count_elements(const std::vector<NumberedGroup>& groups) {
  std::size_t count = 0;
  for (const NumberedGroup& g : groups)
    for (const RawBlock& block : g.group->blocks)
      count += block.nodes.size() / as_size(node_count(block.shape));
  return count;
}

}  // namespace

std::string gmsh_mesh_text(const RawMesh& mesh, const std::set<std::string>& left_out) {
  const std::vector<NumberedGroup> groups = numbered(mesh, left_out);
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  const auto out = std::back_inserter(text);
  // Names of the groups with their dimension and number.
  fmt::format_to(out, "$PhysicalNames\n{}\n", groups.size());
  for (const NumberedGroup& g : groups)
    fmt::format_to(out, "{} {} \"{}\"\n", g.group->dimension, g.number, *g.name);
  // Coordinates by the shortest text that gives the same number again.
  fmt::format_to(out, "$EndPhysicalNames\n$Nodes\n{}\n", mesh.x.size());
  for (std::size_t i = 0; i < mesh.x.size(); ++i)
    fmt::format_to(out, "{} {} {} {}\n", i + 1, mesh.x[i][0], mesh.x[i][1], mesh.x[i][2]);
  // Elements: number, type, two tags (the group twice), nodes. The order of nodes is Gmsh's already.
  fmt::format_to(out, "$EndNodes\n$Elements\n{}\n", count_elements(groups));
  std::size_t number = 0;
  for (const NumberedGroup& g : groups)
    for (const RawBlock& block : g.group->blocks) {
      const auto nodes = as_size(node_count(block.shape));
      for (std::size_t at = 0; at + nodes <= block.nodes.size(); at += nodes) {
        fmt::format_to(out, "{} {} 2 {} {}", ++number, gmsh_type(block.shape), g.number, g.number);
        for (std::size_t a = 0; a < nodes; ++a) fmt::format_to(out, " {}", block.nodes[at + a] + 1);
        text += '\n';
      }
    }
  return text + "$EndElements\n";
}

}  // namespace solidus::mesh
