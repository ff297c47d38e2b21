// The text format of Medit: P. Frey, MEDIT: an interactive mesh visualization software, INRIA technical
// report 0253 (2001). A section is a keyword, the number of its entries, and a line for each of them.
#include "mesh/files/medit_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "mesh/shape_table.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

struct Section {
  std::string_view keyword;
  Shape shape;
};
// "Hexaedra" is the keyword of Medit's first versions.
constexpr std::array k_sections{
    Section{"Edges", Shape::line2},          Section{"EdgesP2", Shape::line3},
    Section{"Triangles", Shape::tri3},       Section{"TrianglesP2", Shape::tri6},
    Section{"Quadrilaterals", Shape::quad4}, Section{"Tetrahedra", Shape::tet4},
    Section{"TetrahedraP2", Shape::tet10},   Section{"Hexahedra", Shape::hex8},
    Section{"Hexaedra", Shape::hex8},        Section{"Prisms", Shape::wedge6},
    Section{"Pentahedra", Shape::wedge6},    Section{"Pyramids", Shape::pyramid5},
};

/// Marks and normals of vertices and faces, which change no mesh.
bool says_nothing(std::string_view keyword) {
  for (const std::string_view begin :
       {"Required", "Corner", "Ridges", "Normal", "Tangent", "Geometry", "Identifier", "AngleOfCornerBound",
        "BoundingBox", "Hole", "SubDomain"})
    if (keyword.starts_with(begin)) return true;
  return false;
}

class Reader {
 public:
  Reader(const std::string& path, double unit) : file_(path), at_{path, 0, 0}, unit_(unit) {
    if (!file_) throw InputError({path}, "the mesh file cannot be read");
  }

  RawMesh mesh() {
    while (!ended_ && next_line()) section();
    make_groups();
    if (!unread_.empty()) {
      std::string all;
      for (const std::string& name : unread_) all += (all.empty() ? "" : ", ") + name;
      mesh_.notes.push_back("sections that are not read and may say something of the mesh: " + all);
    }
    return std::move(mesh_);
  }

 private:
  struct Element {
    Shape shape;
    GlobalIndex number, body;
    std::array<Index, 20> nodes;
  };

  [[noreturn]] void fail(const std::string& what, const std::string& allowed = {}) const {
    throw InputError(at_, what, allowed);
  }
  bool next_line();
  void require_line(std::string_view keyword);
  template <class T>
  T number(std::size_t word) const;
  std::size_t count_of(std::string_view keyword);
  void section();
  void vertices();
  void elements(const Section& section);
  void check_numbers(const Section& section) const;
  void make_groups();

  std::ifstream file_;
  SourceLocation at_;
  double unit_;
  std::string line_;
  std::vector<std::string_view> words_;  ///< of the line, without a comment
  bool ended_ = false, has_vertices_ = false;
  std::size_t dimensions_ = 3;  ///< coordinates of a vertex
  RawMesh mesh_;
  std::vector<Element> elements_;
  std::set<std::string> unread_;
};

/// The words of the next line that has any; false at the end of the file.
bool Reader::next_line() {
  words_.clear();
  while (words_.empty() && std::getline(file_, line_)) {
    ++at_.line;
    if (line_.find('\0') != std::string::npos) fail("this is not a text file");
    const std::string_view line = std::string_view(line_).substr(0, line_.find('#'));
    for (std::size_t at = 0; (at = line.find_first_not_of(" \t\r", at)) != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
      words_.push_back(line.substr(at, end - at));
      at = end;
    }
  }
  return !words_.empty();
}

void Reader::require_line(std::string_view keyword) {
  if (!next_line()) fail(fmt::format("the file ends within {}", keyword));
}

template <class T>
T Reader::number(std::size_t word) const {
  const std::string_view text = words_[word];
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(static_cast<double>(value)))
    fail(fmt::format("'{}' is no number of the kind that belongs here", text.substr(0, 40)));
  return value;
}

/// The number behind a keyword, on its line or on the next one.
std::size_t Reader::count_of(std::string_view keyword) {
  std::size_t word = 1;
  if (words_.size() < 2) {
    require_line(keyword);
    word = 0;
  }
  if (words_.size() != word + 1) fail(fmt::format("{} has no number of its entries", keyword), "one number");
  const auto n = number<GlobalIndex>(word);
  if (n < 0) fail(fmt::format("{} has {} entries", keyword, n));
  return as_size(n);
}

void Reader::section() {
  const std::string keyword(words_[0]);
  // Entries of sections that are not read are passed over here: they begin with no letter.
  const char first = keyword[0];
  const bool is_word = (first >= 'A' && first <= 'Z') || (first >= 'a' && first <= 'z');
  if (!is_word) return;
  if (keyword == "End") {
    ended_ = true;
    return;
  }
  if (keyword == "MeshVersionFormatted") {
    count_of(keyword);
    return;
  }
  if (keyword == "Dimension") {
    dimensions_ = count_of(keyword);
    if (dimensions_ != 2 && dimensions_ != 3) fail(fmt::format("Dimension is {}", dimensions_), "2 or 3");
    return;
  }
  if (keyword == "Vertices") return vertices();
  for (const Section& s : k_sections)
    if (keyword == s.keyword) return elements(s);
  // Elements of an order that no section above has are not passed over: a part of the mesh would be gone.
  for (const std::string_view begin : {"Edges", "Triangles", "Quadrilaterals", "Tetrahedra", "Hexahedra",
                                       "Prisms", "Pentahedra", "Pyramids"})
    if (keyword.starts_with(begin) && keyword.find("Ordering") == std::string::npos)
      fail(fmt::format("elements of the section {} are not read", keyword),
           "Triangles, Quadrilaterals, Tetrahedra, Hexahedra, Prisms, Pyramids, TrianglesP2, TetrahedraP2");
  if (!says_nothing(keyword)) unread_.insert(keyword);
}

void Reader::vertices() {
  if (has_vertices_) fail("the file has two sections of Vertices", "one");
  has_vertices_ = true;
  const std::size_t n = count_of("Vertices");
  for (std::size_t i = 0; i < n; ++i) {
    require_line("Vertices");
    if (words_.size() != dimensions_ + 1)
      fail(fmt::format("the line has {} numbers", words_.size()),
           fmt::format("{} coordinates and the number of the vertex's group", dimensions_));
    Point x{};
    for (std::size_t k = 0; k < dimensions_; ++k) x[k] = unit_ * number<double>(k);
    mesh_.x.push_back(x);
    mesh_.input_node.push_back(static_cast<GlobalIndex>(i) + 1);
  }
}

/// A line has the nodes of its section and one number more.
void Reader::check_numbers(const Section& section) const {
  const auto n = as_size(node_count(section.shape));
  if (words_.size() == n + 1) return;
  const std::string needed = fmt::format("{} nodes and the number of the body or surface", n);
  if (order(section.shape) == 1 && words_.size() > n + 1)
    fail(fmt::format("the line of {} has {} numbers: so Gmsh writes elements of second order, and those who "
                     "read them take a node for the body",
                     section.keyword, words_.size()),
         needed + ": write a mesh of first order, or write .msh or .unv");
  fail(fmt::format("the line of {} has {} numbers", section.keyword, words_.size()), needed);
}

void Reader::elements(const Section& section) {
  const std::size_t n = count_of(section.keyword), n_nodes = as_size(node_count(section.shape));
  if (!has_vertices_) fail(fmt::format("{} come before Vertices", section.keyword), "Vertices first");
  // The nodes between corners of a tetrahedron are in the order of VTK.
  const Places order = row_of(section.shape).vtk_nodes;
  for (std::size_t i = 0; i < n; ++i) {
    require_line(section.keyword);
    check_numbers(section);
    Element e{section.shape, static_cast<GlobalIndex>(i) + 1, number<GlobalIndex>(n_nodes), {}};
    for (std::size_t a = 0; a < n_nodes; ++a) {
      const auto node = number<GlobalIndex>(a);
      if (node < 1 || node > static_cast<GlobalIndex>(mesh_.x.size()))
        fail(fmt::format("an element refers to vertex {}", node), fmt::format("1 to {}", mesh_.x.size()));
      e.nodes[order.empty() ? a : as_size(order[a])] = as_index(node - 1);
    }
    elements_.push_back(e);
  }
}

/// Bodies and surfaces, by the numbers behind the nodes.
void Reader::make_groups() {
  mesh_.dimension = 0;
  for (const Element& e : elements_) mesh_.dimension = std::max(mesh_.dimension, mesh::dimension(e.shape));
  if (mesh_.dimension < 2)
    throw InputError(
        {at_.file}, "the mesh has no triangles, quads, tetrahedra or hexahedra: empty, cut off or not a mesh",
        "a file of Medit with Vertices and Tetrahedra, Hexahedra, Triangles, …");
  for (const Element& e : elements_) {
    const int d = mesh::dimension(e.shape);
    if (d < mesh_.dimension - 1) continue;
    const std::string kind = d == mesh_.dimension ? "body_" : "surface_";
    RawGroup& group = mesh_.groups[kind + std::to_string(e.body)];
    group.dimension = d;
    auto block = std::ranges::find(group.blocks, e.shape, &RawBlock::shape);
    if (block == group.blocks.end()) block = group.blocks.insert(block, RawBlock{e.shape, {}, {}});
    block->nodes.insert(block->nodes.end(), e.nodes.begin(), e.nodes.begin() + node_count(e.shape));
    block->input_element.push_back(e.number);
  }
}

}  // namespace

RawMesh read_medit_file(const std::string& path, double unit_in_metres) {
  return Reader(path, unit_in_metres).mesh();
}

}  // namespace solidus::mesh
