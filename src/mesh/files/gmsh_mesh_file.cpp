/// A scanner that reads text and binary alike, the sections of both versions, and at last the groups of the
/// mesh from what they held.
#include "mesh/files/gmsh_mesh_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string_view>
#include <tuple>
#include <unordered_map>

#include "mesh/files/gmsh_elements.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

/// The bytes of a file and the place that was read up to.
class Bytes {
 public:
  Bytes(std::string path, std::string content) : path_(std::move(path)), content_(std::move(content)) {}

  bool binary = false;

  [[noreturn]] void fail(const std::string& what) const {
    const SourceLocation where{
        path_, binary ? 0 : 1 + static_cast<int>(std::count(content_.begin(), begin() + at_, '\n'))};
    throw InputError(
        where, "the mesh cannot be read: " + what + (binary ? " (byte " + std::to_string(at_) + ")" : ""));
  }

  bool at_end() {
    skip_blanks();
    return at_ >= size();
  }
  std::string_view word() {
    skip_blanks();
    const auto first = at_;
    while (at_ < size() && !blank(content_[index()])) ++at_;
    if (first == at_) fail("the file ends too early");
    return std::string_view(content_).substr(as_size(first), as_size(at_ - first));
  }
  /// The rest of the line, without its end.
  std::string_view line() {
    const auto end = content_.find('\n', index());
    const std::string_view text = std::string_view(content_).substr(
        index(), end == std::string::npos ? std::string::npos : end - index());
    at_ = end == std::string::npos ? size() : static_cast<std::ptrdiff_t>(end) + 1;
    return text;
  }
  /// A number that is written as text.
  template <class T>
  T text() {
    const std::string_view found = word();
    T value{};
    const auto [end, error] = std::from_chars(found.data(), found.data() + found.size(), value);
    if (error != std::errc() || end != found.data() + found.size())
      fail("'" + std::string(found.substr(0, 40)) + "' is no number of the kind that belongs here");
    return value;
  }
  /// A number as bytes; `Stored` is its type in a binary file.
  template <class Stored>
  Stored raw() {
    Stored value{};
    if (size() - at_ < static_cast<std::ptrdiff_t>(sizeof value)) fail("the file ends too early");
    std::memcpy(&value, content_.data() + at_, sizeof value);
    at_ += static_cast<std::ptrdiff_t>(sizeof value);
    return value;
  }
  template <class T>
  T number() {
    return binary ? raw<T>() : text<T>();
  }
  /// A count of things that take at least `bytes` each in what is left of the file.
  std::size_t count(std::int64_t n, std::size_t bytes) const {
    if (n < 0 || static_cast<std::uint64_t>(n) > static_cast<std::uint64_t>(size() - at_) / bytes)
      fail("the file says that it has " + std::to_string(n) + " entries here, more than it has room for");
    return as_size(n);
  }
  void expect(std::string_view name) {
    if (const std::string_view found = word(); found != name)
      fail("'" + std::string(found.substr(0, 40)) + "' is where '" + std::string(name) + "' belongs");
    line();
  }
  /// Goes behind the line that ends a section which is not read.
  void skip_section(const std::string& name) {
    const std::size_t end = content_.find("$End" + name, index());
    if (end == std::string::npos) fail("the section $" + name + " has no end");
    at_ = static_cast<std::ptrdiff_t>(end);
    line();
  }

 private:
  static bool blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  std::string::const_iterator begin() const { return content_.begin(); }
  std::ptrdiff_t size() const { return static_cast<std::ptrdiff_t>(content_.size()); }
  std::size_t index() const { return as_size(at_); }
  void skip_blanks() {
    while (at_ < size() && blank(content_[index()])) ++at_;
  }

  std::string path_, content_;
  std::ptrdiff_t at_ = 0;
};

using EntityKey = std::pair<int, int>;  ///< dimension and tag

/// Elements of one type in an entity.
struct Elements {
  std::vector<std::int64_t> tags, nodes;
};
/// Entity, and of version 2 the physical group that comes with each element.
struct PieceKey {
  int dimension = 0, physical = 0, entity = 0;
  auto operator<=>(const PieceKey&) const = default;
};

class Reader {
 public:
  Reader(const std::string& path, std::string content, double unit)
      : path_(path), file_(path, std::move(content)), unit_(unit) {}

  std::optional<RawMesh> read();

 private:
  bool read_format();
  void read_names();
  void read_entities();
  void read_nodes_2();
  void read_nodes_4();
  void read_elements_2();
  void read_elements_4();
  void add_node(std::int64_t tag, const Point& x);
  void add_element(const PieceKey& piece, int type, std::int64_t tag, const std::vector<std::int64_t>& nodes);
  const GmshElement& element_type(int type) const;

  RawMesh mesh();
  void add_blocks(const PieceKey& piece, const std::unordered_map<std::int64_t, Index>& index,
                  RawGroup& group) const;

  std::string path_;
  Bytes file_;
  double unit_;
  bool version_4_ = false, has_nodes_ = false, has_elements_ = false;
  std::map<EntityKey, std::string> names_;                  // of physical groups
  std::map<EntityKey, std::vector<int>> entity_physicals_;  // of version 4
  std::vector<std::pair<std::int64_t, Point>> nodes_;
  std::set<std::int64_t> node_tags_;
  std::map<PieceKey, std::map<int, Elements>> pieces_;  // by type
};

/// @return whether this reader knows the version
bool Reader::read_format() {
  const std::string version(file_.word());
  const int kind = file_.text<int>();
  const int bytes = file_.text<int>();
  if (kind != 0 && kind != 1) file_.fail("the file is neither text nor binary");
  version_4_ = version == "4.1";
  if (!version_4_ && !version.starts_with("2")) return false;
  file_.line();
  file_.binary = kind == 1;
  if (file_.binary) {
    if (bytes != 8) file_.fail("numbers of " + std::to_string(bytes) + " bytes are not read");
    if (file_.raw<std::int32_t>() != 1)
      file_.fail("the file was written by a machine with the other order of bytes");
  }
  file_.expect("$EndMeshFormat");
  return true;
}

void Reader::read_names() {
  const std::size_t n = file_.count(file_.text<std::int64_t>(), 5);
  for (std::size_t i = 0; i < n; ++i) {
    const int dimension = file_.text<int>(), tag = file_.text<int>();
    const std::string_view rest = file_.line();
    const std::size_t first = rest.find('"'), last = rest.rfind('"');
    if (first == std::string_view::npos || last == first) file_.fail("a physical name is not in quotes");
    names_[{dimension, tag}] = std::string(rest.substr(first + 1, last - first - 1));
  }
  file_.expect("$EndPhysicalNames");
}

void Reader::read_entities() {
  // Four counts first, one for each dimension.
  std::size_t n[4];
  for (std::size_t& of_dimension : n) of_dimension = file_.count(file_.number<std::int64_t>(), 8);
  // Of each entity only the physical groups matter; boxes and boundaries are passed over.
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::size_t i = 0; i < n[dimension]; ++i) {
      const int tag = file_.number<std::int32_t>();
      for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) file_.number<double>();
      std::vector<int>& physicals = entity_physicals_[{dimension, tag}];
      const std::size_t n_physicals = file_.count(file_.number<std::int64_t>(), 2);
      for (std::size_t k = 0; k < n_physicals; ++k)
        physicals.push_back(std::abs(file_.number<std::int32_t>()));
      if (dimension == 0) continue;
      const std::size_t n_boundary = file_.count(file_.number<std::int64_t>(), 2);
      for (std::size_t k = 0; k < n_boundary; ++k) file_.number<std::int32_t>();
    }
  file_.expect("$EndEntities");
}

void Reader::add_node(std::int64_t tag, const Point& x) {
  if (!node_tags_.insert(tag).second) file_.fail("node " + std::to_string(tag) + " is there twice");
  nodes_.emplace_back(tag, x);
}

void Reader::read_nodes_2() {
  const std::size_t n = file_.count(file_.text<std::int64_t>(), 8);
  if (file_.binary) file_.line();
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t tag = file_.number<std::int32_t>();
    Point x{};
    for (double& coordinate : x) coordinate = file_.number<double>();
    add_node(tag, x);
  }
  file_.expect("$EndNodes");
}

void Reader::read_nodes_4() {
  // Numbers of the whole mesh are in front, and are not trusted for memory.
  const std::size_t n_blocks = file_.count(file_.number<std::int64_t>(), 8);
  for (int k = 0; k < 3; ++k) file_.number<std::int64_t>();  // number of nodes, least and largest tag
  // Each block belongs to an entity and has first all tags and then all coordinates.
  for (std::size_t b = 0; b < n_blocks; ++b) {
    const int dimension = file_.number<std::int32_t>();
    file_.number<std::int32_t>();
    const int parametric = file_.number<std::int32_t>();
    const std::size_t n = file_.count(file_.number<std::int64_t>(), 8);
    std::vector<std::int64_t> tags(n);
    for (std::int64_t& tag : tags) tag = file_.number<std::int64_t>();
    for (const std::int64_t tag : tags) {
      // Parametric coordinates are behind the others and say nothing here.
      Point x{};
      for (double& coordinate : x) coordinate = file_.number<double>();
      if (parametric != 0)
        for (int k = 0; k < dimension; ++k) file_.number<double>();
      add_node(tag, x);
    }
  }
  file_.expect("$EndNodes");
}

const GmshElement& Reader::element_type(int type) const {
  const GmshElement* found = gmsh_element(type);
  if (found == nullptr) file_.fail("it has elements of the type number " + std::to_string(type));
  return *found;
}

void Reader::add_element(const PieceKey& piece, int type, std::int64_t tag,
                         const std::vector<std::int64_t>& nodes) {
  Elements& elements = pieces_[piece][type];
  elements.tags.push_back(tag);
  elements.nodes.insert(elements.nodes.end(), nodes.begin(), nodes.end());
}

void Reader::read_elements_2() {
  // The format of binary files needs the end of the line before the first byte.
  const std::size_t n = file_.count(file_.text<std::int64_t>(), 8);
  if (file_.binary) file_.line();
  std::vector<std::int64_t> nodes;
  for (std::size_t i = 0; i < n;) {
    // Text: tag, type, number of tags, tags, nodes. Binary: a head for several elements of a type.
    std::int64_t tag = file_.binary ? 0 : file_.text<std::int32_t>();
    const int type = file_.number<std::int32_t>();
    const GmshElement& element = element_type(type);
    const std::size_t in_block = file_.binary ? file_.count(file_.raw<std::int32_t>(), 4) : 1;
    if (in_block == 0) file_.fail("a block of elements is empty");
    const std::size_t n_tags = file_.count(file_.number<std::int32_t>(), 2);
    for (std::size_t k = 0; k < in_block; ++k, ++i) {
      if (file_.binary) tag = file_.raw<std::int32_t>();
      // The first tag is the physical group, the second the entity of the geometry.
      PieceKey piece{element.dimension, 0, 0};
      for (std::size_t t = 0; t < n_tags; ++t) {
        const int value = file_.number<std::int32_t>();
        if (t == 0) piece.physical = std::abs(value);
        if (t == 1) piece.entity = value;
      }
      nodes.clear();
      for (int a = 0; a < element.n_nodes; ++a) nodes.push_back(file_.number<std::int32_t>());
      add_element(piece, type, tag, nodes);
    }
  }
  file_.expect("$EndElements");
}

void Reader::read_elements_4() {
  // As above: counts that the blocks themselves repeat.
  const std::size_t n_blocks = file_.count(file_.number<std::int64_t>(), 8);
  for (int k = 0; k < 3; ++k) file_.number<std::int64_t>();
  std::vector<std::int64_t> nodes;
  // Each block has elements of one type of one entity, which its dimension must fit.
  for (std::size_t b = 0; b < n_blocks; ++b) {
    const int dimension = file_.number<std::int32_t>(), entity = file_.number<std::int32_t>();
    const int type = file_.number<std::int32_t>();
    const std::size_t n = file_.count(file_.number<std::int64_t>(), 4);
    const GmshElement& element = element_type(type);
    if (element.dimension != dimension)
      file_.fail("elements of the type '" + element.name + "' are in an entity of dimension " +
                 std::to_string(dimension));
    // Tag and nodes of each element, in binary as in text.
    for (std::size_t i = 0; i < n; ++i) {
      const std::int64_t tag = file_.number<std::int64_t>();
      nodes.clear();
      for (int a = 0; a < element.n_nodes; ++a) nodes.push_back(file_.number<std::int64_t>());
      add_element({dimension, 0, entity}, type, tag, nodes);
    }
  }
  file_.expect("$EndElements");
}

std::optional<RawMesh> Reader::read() {
  bool known = false;
  // Sections in any order, except that the format comes first; what is not needed is passed over, and what
  // this reader does not know is left to Gmsh.
  while (!file_.at_end()) {
    const std::string word(file_.word());
    if (!word.starts_with('$')) file_.fail("'" + word.substr(0, 40) + "' is where a section begins");
    const std::string section = word.substr(1);
    // The bytes of a binary section begin behind its line.
    if (section != "MeshFormat") file_.line();
    if (section == "MeshFormat") {
      if (!read_format()) return std::nullopt;
      known = true;
    } else if (section == "Comments") {
      file_.skip_section(section);
    } else if (!known || section == "ParametricNodes" || section == "PartitionedEntities") {
      return std::nullopt;
    } else if (section == "PhysicalNames") {
      read_names();
    } else if (section == "Entities") {
      read_entities();
    } else if (section == "Nodes") {
      version_4_ ? read_nodes_4() : read_nodes_2();
      has_nodes_ = true;
    } else if (section == "Elements") {
      version_4_ ? read_elements_4() : read_elements_2();
      has_elements_ = true;
    } else {
      file_.skip_section(section);
    }
  }
  // A file without nodes or elements was cut off.
  if (!has_nodes_ || !has_elements_)
    file_.fail(std::string("the file ends before its ") + (has_nodes_ ? "elements" : "nodes"));
  return mesh();
}

void Reader::add_blocks(const PieceKey& piece, const std::unordered_map<std::int64_t, Index>& index,
                        RawGroup& group) const {
  // Elements of one shape go into one block, their nodes by the numbers of this mesh.
  for (const auto& [type, elements] : pieces_.at(piece)) {
    const GmshElement& element = element_type(type);
    if (!element.shape)
      throw InputError({path_}, "the mesh has elements of the type '" + element.name + "'",
                       k_shapes_of_meshes);
    // The block of this shape in the group, or a new one.
    auto block = std::find_if(group.blocks.begin(), group.blocks.end(),
                              [&](const RawBlock& b) { return b.shape == *element.shape; });
    if (block == group.blocks.end())
      block = group.blocks.insert(group.blocks.end(), RawBlock{*element.shape, {}, {}});
    for (const std::int64_t node : elements.nodes) {
      const auto found = index.find(node);
      if (found == index.end())
        throw InputError(
            {path_}, "an element refers to node " + std::to_string(node) + ", which the mesh does not have");
      block->nodes.push_back(found->second);
    }
    for (const std::int64_t tag : elements.tags)
      block->input_element.push_back(static_cast<GlobalIndex>(tag));
  }
}

RawMesh Reader::mesh() {
  RawMesh mesh;
  mesh.dimension = 0;
  // The bodies are the elements of the highest dimension.
  for (const auto& [piece, elements] : pieces_) mesh.dimension = std::max(mesh.dimension, piece.dimension);
  if (mesh.dimension < 2)
    throw InputError(
        {path_}, "the mesh has no triangles, quads, tetrahedra or hexahedra: empty, cut off or not a mesh");

  // Nodes in the order of their tags.
  std::sort(nodes_.begin(), nodes_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::set<std::int64_t> used;  // version 2 lists nodes that belong to nothing
  if (!version_4_)
    for (const auto& [piece, types] : pieces_)
      for (const auto& [type, elements] : types) used.insert(elements.nodes.begin(), elements.nodes.end());
  std::unordered_map<std::int64_t, Index> index;
  index.reserve(nodes_.size());
  // In version 2 nodes that no element uses are left out: they are points of the geometry.
  for (const auto& [tag, x] : nodes_) {
    if (!version_4_ && !used.contains(tag)) continue;
    index.emplace(tag, as_index(mesh.x.size()));
    mesh.x.push_back({unit_ * x[0], unit_ * x[1], unit_ * x[2]});
    mesh.input_node.push_back(static_cast<GlobalIndex>(tag));
  }

  // Physical groups collect their elements; bodies without a group get a number as their name.
  std::map<EntityKey, std::vector<PieceKey>> groups;
  std::vector<PieceKey> without;
  for (const auto& [piece, types] : pieces_) {
    std::vector<int> physicals;
    if (piece.physical != 0) physicals = {piece.physical};
    if (const auto entity = entity_physicals_.find({piece.dimension, piece.entity});
        entity != entity_physicals_.end())
      physicals = entity->second;
    for (const int physical : physicals) groups[{piece.dimension, physical}].push_back(piece);
    if (physicals.empty() && piece.dimension == mesh.dimension) without.push_back(piece);
  }
  // Each physical group becomes a group of the mesh, by its name or by a number.
  for (const auto& [key, pieces] : groups) {
    const auto& [dimension, physical] = key;
    const auto named = names_.find(key);
    std::string name = named == names_.end() ? std::string() : named->second;
    if (name.empty()) name = "group_" + std::to_string(dimension) + "d_" + std::to_string(physical);
    RawGroup group{dimension, {}};
    for (const PieceKey& piece : pieces) add_blocks(piece, index, group);
    // The same name for a body and its boundary would be ambiguous.
    if (mesh.groups.contains(name)) name += "_" + std::to_string(dimension) + "d";
    mesh.groups.emplace(name, std::move(group));
  }
  // What belongs to no group still is a body, so that a mesh without any groups can be used.
  int number = 0;
  for (const PieceKey& piece : without) {
    RawGroup group{piece.dimension, {}};
    add_blocks(piece, index, group);
    mesh.groups.emplace("body_" + std::to_string(++number), std::move(group));
  }
  return mesh;
}

}  // namespace

std::optional<RawMesh> read_gmsh_mesh_file(const std::string& path, double unit_in_metres) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return Reader(path, std::move(content).str(), unit_in_metres).read();
}

}  // namespace solidus::mesh
