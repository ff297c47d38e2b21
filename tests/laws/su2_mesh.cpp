// A format of meshes that no file of src/, python/ and web/ names: those of SU2, without comments.
#include <algorithm>
#include <fstream>
#include <sstream>

#include "mesh/files/file_format.hpp"

namespace solidus::mesh {
namespace {

bool begins(std::string_view head) {
  return head.starts_with("NDIME=");
}

/// The shape of a type of elements, which has the numbers of VTK.
Shape shape_of(int type, const std::string& path) {
  switch (type) {
    case 3:
      return Shape::line2;
    case 5:
      return Shape::tri3;
    case 9:
      return Shape::quad4;
    case 10:
      return Shape::tet4;
    case 12:
      return Shape::hex8;
    default:
      throw InputError({path}, "elements of type " + std::to_string(type) + " are not read",
                       "3, 5, 9, 10 or 12");
  }
}

/// An element a line: its type, its nodes, and a number that is passed over.
void read_elements(std::istream& file, const std::string& path, std::size_t n, RawGroup& group) {
  std::string line;
  std::getline(file, line);
  for (std::size_t i = 0; i < n && std::getline(file, line); ++i) {
    std::istringstream numbers(line);
    int type = 0;
    numbers >> type;
    const Shape shape = shape_of(type, path);
    auto block = std::ranges::find(group.blocks, shape, &RawBlock::shape);
    if (block == group.blocks.end()) block = group.blocks.insert(block, RawBlock{shape, {}, {}});
    for (int k = 0; k < node_count(shape); ++k) numbers >> block->nodes.emplace_back(-1);
    if (!numbers) throw InputError({path}, "the element '" + line + "' has too few nodes");
    block->input_element.push_back(static_cast<GlobalIndex>(i));
  }
}

void read_points(std::istream& file, std::size_t n, double unit_in_metres, RawMesh& mesh) {
  std::string line;
  std::getline(file, line);
  for (std::size_t i = 0; i < n && std::getline(file, line); ++i) {
    std::istringstream numbers(line);
    Point x{};
    for (int d = 0; d < mesh.dimension; ++d) numbers >> x[static_cast<std::size_t>(d)];
    for (double& coordinate : x) coordinate *= unit_in_metres;
    mesh.x.push_back(x);
    mesh.input_node.push_back(static_cast<GlobalIndex>(i));
  }
}

void check_nodes(const RawMesh& mesh, const std::string& path) {
  for (const auto& [name, group] : mesh.groups)
    for (const RawBlock& block : group.blocks)
      for (const Index node : block.nodes)
        if (node < 0 || static_cast<std::size_t>(node) >= mesh.x.size())
          throw InputError({path},
                           "'" + name + "' has the node " + std::to_string(node) + ", which is not there");
}

std::optional<RawMesh> read(const std::string& path, double unit_in_metres) {
  std::ifstream file(path);
  RawMesh mesh;
  std::string word, marker;
  while (file >> word) {
    std::size_t n = 0;
    if (word == "MARKER_TAG=")
      file >> marker;
    else
      file >> n;
    if (!file) throw InputError({path}, "nothing follows '" + word + "'");
    if (word == "NDIME=") mesh.dimension = static_cast<int>(n);
    if (word == "NPOIN=") read_points(file, n, unit_in_metres, mesh);
    const bool body = word == "NELEM=";
    if (!body && word != "MARKER_ELEMS=") continue;
    RawGroup& group = mesh.groups[body ? "body" : marker];
    group.dimension = body ? mesh.dimension : mesh.dimension - 1;
    read_elements(file, path, n, group);
  }
  check_nodes(mesh, path);
  return mesh;
}

FileFormat su2() {
  return {.name = "SU2",
          .place = 95,
          .endings = {".su2"},
          .begins = &begins,
          .begins_with = "'NDIME='",
          .told = ".su2",
          .read = &read};
}

const AddFileFormat k_su2{su2()};

}  // namespace
}  // namespace solidus::mesh
