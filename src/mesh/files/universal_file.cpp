// I-DEAS universal files: datasets 164, 2411, 2412, 2420 and 2477, and the older ones that they replace.
#include "mesh/files/universal_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <vector>

#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

/// Descriptors of elements, as ranges: plane stress, plane strain, plates, membranes, axisymmetric solids and
/// thin shells have the same ones ten apart.
std::optional<Shape> shape_of_descriptor(GlobalIndex descriptor) {
  switch (descriptor) {
    case 11:
    case 21:
    case 22:
      return Shape::line2;
    case 23:
    case 24:
      return Shape::line3;
    case 111:
      return Shape::tet4;
    case 118:
      return Shape::tet10;
    case 112:
      return Shape::wedge6;
    case 115:
      return Shape::hex8;
    case 116:
      return Shape::hex20;
    default:
      break;
  }
  if (descriptor < 41 || descriptor > 95) return std::nullopt;
  switch (descriptor % 10) {
    case 1:
      return Shape::tri3;
    case 2:
      return Shape::tri6;
    case 4:
      return Shape::quad4;
    case 5:
      return Shape::quad8;
    default:
      return std::nullopt;
  }
}
bool is_beam(GlobalIndex descriptor) {
  return descriptor == 11 || (descriptor >= 21 && descriptor <= 24);
}

/// Where our node of each place in the file is: corners and the nodes between them alternate there.
std::span<const int> order_of(Shape shape) {
  static constexpr std::array<int, 3> k_line3{0, 2, 1};
  static constexpr std::array<int, 6> k_tri6{0, 3, 1, 4, 2, 5};
  static constexpr std::array<int, 8> k_quad8{0, 4, 1, 5, 2, 6, 3, 7};
  static constexpr std::array<int, 10> k_tet10{0, 4, 1, 5, 2, 6, 7, 9, 8, 3};
  static constexpr std::array<int, 20> k_hex20{0,  8,  1, 11, 2, 13, 3, 9,  10, 12,
                                               14, 15, 4, 16, 5, 18, 6, 19, 7,  17};
  static constexpr std::array<int, 8> k_same{0, 1, 2, 3, 4, 5, 6, 7};
  switch (shape) {
    case Shape::line3:
      return k_line3;
    case Shape::tri6:
      return k_tri6;
    case Shape::quad8:
      return k_quad8;
    case Shape::tet10:
      return k_tet10;
    case Shape::hex20:
      return k_hex20;
    default:
      return std::span(k_same).first(as_size(node_count(shape)));
  }
}

struct Element {
  Shape shape;
  GlobalIndex number, property;
  std::array<Index, 20> nodes;
};

struct Group {
  std::string name;
  std::vector<GlobalIndex> nodes, elements;
  SourceLocation at;
};

class Reader {
 public:
  Reader(const std::string& path, double unit) : file_(path), at_{path, 0, 0}, unit_(unit) {
    if (!file_) throw InputError({path}, "the mesh file cannot be read");
  }

  RawMesh mesh() {
    while (next_line()) {
      if (text() != "-1") fail("a dataset begins with a line of -1");
      if (!next_line()) break;
      dataset(integer(0));
    }
    make_groups();
    note_unit();
    if (!unread_.empty()) {
      std::string all;
      for (const GlobalIndex number : unread_) all += (all.empty() ? "" : ", ") + std::to_string(number);
      mesh_.notes.push_back("datasets that are not read and may say something of the mesh: " + all);
    }
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& allowed = {}) const {
    throw InputError(at_, what, allowed);
  }
  bool next_line() {
    if (!std::getline(file_, line_)) return false;
    ++at_.line;
    if (line_.find('\0') != std::string::npos) fail("this is not a text file");
    return true;
  }
  std::string text() const {
    const auto first = line_.find_first_not_of(" \t\r");
    if (first == std::string::npos) return {};
    return line_.substr(first, line_.find_last_not_of(" \t\r") - first + 1);
  }
  /// The next line of the dataset; false at its end.
  bool more() {
    if (!next_line()) fail("the file ends inside of a dataset");
    split();
    return !(words_.size() == 1 && words_[0] == "-1");
  }
  void require_line() {
    if (!more()) fail("the dataset ends inside of a record");
  }
  /// Words between blanks; numbers of ten digits fill their columns and touch.
  void split() {
    words_.clear();
    const std::string_view line(line_);
    for (std::size_t at = 0; (at = line.find_first_not_of(" \t\r", at)) != std::string_view::npos;) {
      const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
      words_.push_back(line.substr(at, end - at));
      at = end;
    }
  }
  GlobalIndex integer(std::size_t i) {
    if (i == 0) split();
    return whole(i);
  }
  GlobalIndex whole(std::size_t i) const {
    if (i >= words_.size()) fail(fmt::format("the line has {} numbers, {} are needed", words_.size(), i + 1));
    GlobalIndex value = 0;
    const auto [end, error] = std::from_chars(words_[i].data(), words_[i].data() + words_[i].size(), value);
    if (error != std::errc{} || end != words_[i].data() + words_[i].size())
      fail(fmt::format("'{}' is no whole number", words_[i]));
    return value;
  }
  double real(std::size_t i) const {
    if (i >= words_.size()) fail(fmt::format("the line has {} numbers, {} are needed", words_.size(), i + 1));
    std::string word(words_[i]);
    std::replace_if(
        word.begin(), word.end(), [](char c) { return c == 'D' || c == 'd'; }, 'E');
    const std::size_t sign = word.starts_with("+") ? 1 : 0;
    double value = 0;
    const auto [end, error] = std::from_chars(word.data() + sign, word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
      fail("'" + word + "' is no number");
    return value;
  }

  void dataset(GlobalIndex number);
  void units();
  void systems();
  void nodes(bool one_line);
  void elements(bool old);
  void groups(std::size_t words_per_entity);
  void add_node(GlobalIndex number, GlobalIndex system, std::size_t first);
  void make_groups();
  void add_group(std::string name, RawGroup group);
  void note_unit();

  std::ifstream file_;
  SourceLocation at_;
  double unit_;
  std::string line_;
  std::vector<std::string_view> words_;
  RawMesh mesh_;
  std::optional<double> says_unit_;      ///< metres of the unit that dataset 164 names
  std::set<GlobalIndex> moved_systems_;  ///< that are not the global one
  std::unordered_map<GlobalIndex, Index> node_at_, element_at_;
  std::vector<Element> elements_;
  std::vector<Group> groups_;
  std::set<GlobalIndex> unread_;
};

void Reader::dataset(GlobalIndex number) {
  switch (number) {
    case 164:
      return units();
    case 2420:
      return systems();
    case 15:
      return nodes(true);
    case 781:
    case 2411:
      return nodes(false);
    case 780:
      return elements(true);
    case 2412:
      return elements(false);
    case 2429:
    case 2430:
    case 2432:
      return groups(2);
    case 2435:
    case 2452:
    case 2467:
    case 2477:
      return groups(4);
    case 71:
      fail("elements in dataset 71 are not read here", "dataset 2412");
    default:
      break;
  }
  // Headers, materials, and results.
  constexpr std::array<GlobalIndex, 15> k_silent{55,   56,   57,   58,   82,   151,  1710, 1700,
                                                 1703, 2400, 2414, 2437, 2448, 2470, 3008};
  if (std::ranges::find(k_silent, number) == k_silent.end()) unread_.insert(number);
  while (next_line())
    if (text() == "-1") return;
}

void Reader::units() {
  require_line();
  require_line();
  // SI units are those of the file over the factor.
  if (const double factor = real(0); factor > 0) says_unit_ = 1 / factor;
  while (more()) {
  }
}

// Each system: number, type and colour; a name; three rows of axes and one of the origin.
void Reader::systems() {
  require_line();  // of the part
  require_line();  // its name
  while (more()) {
    const GlobalIndex number = whole(0), type = words_.size() > 1 ? whole(1) : 0;
    if (!next_line()) fail("the file ends inside of a dataset");
    bool global = type == 0;
    for (int row = 0; row < 4; ++row) {
      require_line();
      for (std::size_t i = 0; i < 3; ++i)
        global = global && std::abs(real(i) - (static_cast<int>(i) == row ? 1 : 0)) < 1e-12;
    }
    if (!global) moved_systems_.insert(number);
  }
}

void Reader::add_node(GlobalIndex number, GlobalIndex system, std::size_t first) {
  if (moved_systems_.contains(system))
    fail(fmt::format("node {} is given in the coordinate system {}, which is not the global one", number,
                     system),
         "a file with nodes in global coordinates");
  if (!node_at_.emplace(number, as_index(mesh_.x.size())).second)
    fail(fmt::format("node {} is defined twice", number));
  mesh_.x.push_back({unit_ * real(first), unit_ * real(first + 1), unit_ * real(first + 2)});
  mesh_.input_node.push_back(number);
}

void Reader::nodes(bool one_line) {
  while (more()) {
    const GlobalIndex number = whole(0), system = whole(1);
    if (!one_line) require_line();
    add_node(number, system, one_line ? 4 : 0);
  }
}

void Reader::elements(bool old) {
  // One line of numbers, one more for beams, then those of nodes. The older data set has other columns.
  while (more()) {
    const GlobalIndex number = whole(0), descriptor = whole(1);
    const GlobalIndex property = old ? whole(3) : whole(2), n = old ? whole(7) : whole(5);
    const std::optional<Shape> shape = shape_of_descriptor(descriptor);
    if (!shape && (descriptor == 113 || descriptor == 114 || descriptor == 101 || descriptor == 102))
      fail(fmt::format("element {} is a wedge of second order or a thick shell (descriptor {})", number,
                       descriptor),
           "triangles, quads, tetrahedra, hexahedra, and wedges of first order");
    if (n < 1 || n > 100) fail(fmt::format("element {} has {} nodes", number, n));
    if (is_beam(descriptor)) require_line();
    std::vector<GlobalIndex> given;
    while (static_cast<GlobalIndex>(given.size()) < n) {
      require_line();
      for (std::size_t i = 0; i < words_.size() && static_cast<GlobalIndex>(given.size()) < n; ++i)
        given.push_back(whole(i));
    }
    if (!shape) {  // springs, masses, rigid elements and others
      unread_.insert(old ? 780 : 2412);
      continue;
    }
    if (n != node_count(*shape))
      fail(fmt::format("element {} of descriptor {} has {} nodes", number, descriptor, n),
           std::to_string(node_count(*shape)));
    Element e{*shape, number, property, {}};
    const std::span<const int> order = order_of(*shape);
    for (std::size_t i = 0; i < given.size(); ++i) {
      const auto node = node_at_.find(given[i]);
      if (node == node_at_.end())
        fail(fmt::format("element {} refers to node {}, which is not there", number, given[i]));
      e.nodes[as_size(order[i])] = node->second;
    }
    if (!element_at_.emplace(number, as_index(elements_.size())).second)
      fail(fmt::format("element {} is defined twice", number));
    elements_.push_back(e);
  }
}

// A group: its number, sets that belong to it, and the number of its entities; its name; their types and
// numbers.
void Reader::groups(std::size_t words_per_entity) {
  constexpr GlobalIndex k_node = 7, k_element = 8;
  while (more()) {
    if (words_.size() < 2) fail("the group has no number of entities");
    const GlobalIndex number = whole(0), n = whole(words_.size() - 1);
    const SourceLocation at = at_;
    if (!next_line()) fail("the file ends inside of a dataset");
    Group group{text(), {}, {}, at};
    if (group.name.empty()) group.name = "group_" + std::to_string(number);
    for (GlobalIndex done = 0; done < n;) {
      require_line();
      if (words_.size() < words_per_entity) fail("a member of the group '" + group.name + "' is cut off");
      for (std::size_t i = 0; i + words_per_entity <= words_.size() && done < n;
           i += words_per_entity, ++done)
        if (const GlobalIndex type = whole(i); type == k_node)
          group.nodes.push_back(whole(i + 1));
        else if (type == k_element)
          group.elements.push_back(whole(i + 1));
    }
    groups_.push_back(std::move(group));
  }
}

void add(const Element& e, RawGroup& group) {
  auto block = std::ranges::find(group.blocks, e.shape, &RawBlock::shape);
  if (block == group.blocks.end()) block = group.blocks.insert(block, RawBlock{e.shape, {}, {}});
  block->nodes.insert(block->nodes.end(), e.nodes.begin(), e.nodes.begin() + node_count(e.shape));
  block->input_element.push_back(e.number);
}

void Reader::add_group(std::string name, RawGroup group) {
  if (group.blocks.empty()) return;
  if (mesh_.groups.contains(name)) name += "_" + std::to_string(group.dimension) + "d";
  const std::string first = name;
  for (int k = 2; mesh_.groups.contains(name); ++k) name = first + "_" + std::to_string(k);
  mesh_.groups.emplace(name, std::move(group));
}

void Reader::make_groups() {
  mesh_.dimension = 0;
  for (const Element& e : elements_) mesh_.dimension = std::max(mesh_.dimension, mesh::dimension(e.shape));
  if (mesh_.dimension < 2)
    throw InputError(
        {at_.file}, "the mesh has no triangles, quads, tetrahedra or hexahedra: empty, cut off or not a mesh",
        "a universal file with datasets 2411 and 2412");
  std::vector<char> named(elements_.size(), 0);
  for (Group& group : groups_) {
    std::vector<Index> members;
    GlobalIndex missing = 0;
    for (const GlobalIndex number : group.elements)
      if (const auto e = element_at_.find(number); e != element_at_.end())
        members.push_back(e->second);
      else
        ++missing;
    if (missing > 0)
      mesh_.notes.push_back(fmt::format("{}: the group '{}' names {} elements that are not read or not there",
                                        group.at.text(), group.name, missing));
    std::ranges::sort(members);
    members.erase(std::unique(members.begin(), members.end()), members.end());
    RawGroup of_elements{0, {}};
    for (const Index i : members) {
      named[as_size(i)] = 1;
      of_elements.dimension = std::max(of_elements.dimension, mesh::dimension(elements_[as_size(i)].shape));
    }
    for (const Index i : members)
      if (const Element& e = elements_[as_size(i)]; mesh::dimension(e.shape) == of_elements.dimension)
        add(e, of_elements);
    add_group(group.name, std::move(of_elements));
    RawGroup of_nodes{0, {}};
    std::ranges::sort(group.nodes);
    group.nodes.erase(std::unique(group.nodes.begin(), group.nodes.end()), group.nodes.end());
    for (const GlobalIndex number : group.nodes) {
      const auto node = node_at_.find(number);
      if (node == node_at_.end())
        throw InputError(group.at,
                         fmt::format("the group '{}' names node {}, which is not there", group.name, number));
      if (of_nodes.blocks.empty()) of_nodes.blocks.push_back({Shape::point1, {}, {}});
      of_nodes.blocks[0].nodes.push_back(node->second);
      of_nodes.blocks[0].input_element.push_back(number);
    }
    add_group(group.name, std::move(of_nodes));
  }
  // Elements of no group: by their property.
  std::map<std::pair<int, GlobalIndex>, RawGroup> rest;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const Element& e = elements_[i];
    const int d = mesh::dimension(e.shape);
    if (named[i] != 0 || d < mesh_.dimension - 1 || d < 1) continue;
    RawGroup& group = rest[{d, e.property}];
    group.dimension = d;
    add(e, group);
  }
  for (auto& [key, group] : rest)
    add_group(fmt::format("group_{}d_{}", key.first, key.second), std::move(group));
}

void Reader::note_unit() {
  if (!says_unit_ || std::abs(*says_unit_ / unit_ - 1) < 1e-6) return;
  double longest = 0;
  for (std::size_t i = 0; i < 3 && !mesh_.x.empty(); ++i) {
    const auto [low, high] = std::ranges::minmax(mesh_.x, {}, [&](const Point& x) { return x[i]; });
    longest = std::max(longest, high[i] - low[i]);
  }
  mesh_.notes.push_back(
      fmt::format("dataset 164 names a unit of length of {:g} m, and lengths are taken in units of {:g} m as "
                  "told: the mesh is "
                  "{:g} mm long, by its own word it would be {:g} mm",
                  *says_unit_, unit_, 1e3 * longest, 1e3 * longest * *says_unit_ / unit_));
}

}  // namespace

RawMesh read_universal_file(const std::string& path, double unit_in_metres) {
  return Reader(path, unit_in_metres).mesh();
}

}  // namespace solidus::mesh
