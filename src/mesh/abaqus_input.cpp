#include "mesh/abaqus_input.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <unordered_map>

#include "mesh/abaqus_elements.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

// Pieces between commas; an empty piece at the end (a comma that continues the line) is left out.
std::vector<std::string> pieces(std::string_view line) {
  std::vector<std::string> parts;
  while (true) {
    const auto comma = line.find(',');
    parts.emplace_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) break;
    line.remove_prefix(comma + 1);
  }
  if (parts.back().empty()) parts.pop_back();
  return parts;
}

struct Keyword {
  std::string name;                               // upper case, without the star
  std::map<std::string, std::string> parameters;  // names in upper case
  const std::string* find(const std::string& parameter) const {
    const auto p = parameters.find(parameter);
    return p == parameters.end() ? nullptr : &p->second;
  }
};

Keyword parse_keyword(std::string_view line) {
  Keyword keyword;
  const auto parts = pieces(line.substr(1));
  if (parts.empty()) return keyword;
  keyword.name = upper(parts[0]);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const auto equals = parts[i].find('=');
    const std::string_view value =
        equals == std::string::npos ? std::string_view{} : std::string_view(parts[i]).substr(equals + 1);
    keyword.parameters[upper(std::string(trimmed(std::string_view(parts[i]).substr(0, equals))))] =
        trimmed(value);
  }
  return keyword;
}

// Names compare without case, and keep the case of their first appearance.
template <class Member>
struct NamedSet {
  std::string name;
  std::vector<Member> members;
};
template <class Member>
using Sets = std::map<std::string, NamedSet<Member>>;

template <class Member>
NamedSet<Member>& set_of(Sets<Member>& sets, const std::string& name) {
  NamedSet<Member>& set = sets[upper(name)];
  if (set.name.empty()) set.name = name;
  return set;
}

struct Element {
  Shape shape;
  std::vector<Index> nodes;
  GlobalIndex number;
};
struct Face {
  Index element;
  int face;  // -1: the element itself
};

class Reader {
 public:
  explicit Reader(double unit) : unit_(unit) {}

  void read(const std::string& path, int depth = 0) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
      throw InputError({path}, "there is no such file of a mesh");
    std::ifstream file(path);
    if (!file) throw InputError({path}, "the mesh file cannot be read");
    if (depth > 20) throw InputError({path}, "*INCLUDE goes around in circles");
    if (++n_files_ > 1000) throw InputError({path}, "*INCLUDE asks for more than 1 000 files");
    const SourceLocation outer = at_;
    at_ = {path, 0, 0};
    std::string line;
    while (std::getline(file, line)) {
      ++at_.line;
      if (line.find('\0') != std::string::npos) fail("this is not a text file");
      const std::string_view text = trimmed(line);
      if (text.empty() || text.starts_with("**")) continue;
      if (text.starts_with("*")) {
        finish_element();
        keyword_ = parse_keyword(text);
        begin(depth);
      } else {
        data(text);
      }
    }
    finish_element();
    at_ = outer;
  }

  RawMesh mesh(const std::string& path);

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& allowed = {}) const {
    throw InputError(at_, what, allowed);
  }
  const std::string& required(const std::string& parameter) const {
    const std::string* value = keyword_.find(parameter);
    if (value == nullptr || value->empty()) fail("*" + keyword_.name + " needs " + parameter + "=…");
    return *value;
  }
  GlobalIndex integer(std::string_view text) const {
    GlobalIndex value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
      fail("'" + std::string(text) + "' is no whole number");
    return value;
  }
  double real(std::string text) const {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == 'D' || c == 'd'; }, 'E');
    const std::size_t sign = text.starts_with("+") ? 1 : 0;
    double value = 0;
    const auto [end, error] = std::from_chars(text.data() + sign, text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
      fail("'" + text + "' is no number");
    return value;
  }
  Index element(GlobalIndex number) const {
    const auto e = element_at_.find(number);
    if (e == element_at_.end()) fail("there is no element " + std::to_string(number) + " up to here");
    return e->second;
  }
  Index node(GlobalIndex number) const {
    const auto n = node_at_.find(number);
    if (n == node_at_.end()) fail("there is no node " + std::to_string(number) + " up to here");
    return n->second;
  }

  void begin(int depth);
  void data(std::string_view line);
  void node_line(const std::vector<std::string>& parts);
  void element_line(const std::vector<std::string>& parts);
  void finish_element() const {
    if (!pending_.empty())
      fail("an element of " + std::to_string(node_count(shape_)) + " nodes ends after " +
           std::to_string(pending_.size() - 1));
  }
  void surface_line(const std::vector<std::string>& parts);
  template <class Find>
  void set_line(const std::vector<std::string>& parts, Sets<Index>& sets, NamedSet<Index>& set, Find find);

  double unit_;
  int n_files_ = 0;
  SourceLocation at_;
  Keyword keyword_;
  Shape shape_ = Shape::point1;       // of the *ELEMENT being read
  std::vector<GlobalIndex> pending_;  // number and nodes of an element that is not complete
  std::vector<Point> x_;
  std::vector<GlobalIndex> input_node_;
  std::unordered_map<GlobalIndex, Index> node_at_, element_at_;
  std::vector<Element> elements_;
  Sets<Index> node_sets_, element_sets_;
  Sets<Face> surfaces_;
};

void Reader::begin(int depth) {
  if (keyword_.name == "INCLUDE") {
    const auto folder = std::filesystem::path(at_.file).parent_path();
    read((folder / required("INPUT")).string(), depth + 1);
    keyword_ = {};
  } else if (keyword_.name == "ELEMENT") {
    const std::string& type = required("TYPE");
    const auto shape = shape_of_abaqus_type(upper(type));
    if (!shape)
      fail("elements of the type '" + type + "' cannot be used",
           "lines, triangles, quads, tetrahedra and hexahedra, linear or quadratic: CPE3, CAX4R, C3D4, "
           "C3D10, C3D8, C3D20R, …");
    shape_ = *shape;
  } else if (keyword_.name == "SURFACE") {
    const std::string* type = keyword_.find("TYPE");
    if (type != nullptr && upper(*type) == "NODE") keyword_.name = "SURFACE OF NODES";
    required("NAME");
  } else if (keyword_.name == "NSET" || keyword_.name == "ELSET") {
    required(keyword_.name);
  }
}

void Reader::data(std::string_view line) {
  const auto parts = pieces(line);
  if (parts.empty()) return;
  if (keyword_.name == "NODE") {
    node_line(parts);
  } else if (keyword_.name == "ELEMENT") {
    element_line(parts);
  } else if (keyword_.name == "NSET") {
    set_line(parts, node_sets_, set_of(node_sets_, required("NSET")),
             [this](GlobalIndex n) { return node(n); });
  } else if (keyword_.name == "ELSET") {
    set_line(parts, element_sets_, set_of(element_sets_, required("ELSET")),
             [this](GlobalIndex e) { return element(e); });
  } else if (keyword_.name == "SURFACE") {
    surface_line(parts);
  } else if (keyword_.name == "INSTANCE") {
    fail("an *INSTANCE that moves its part cannot be read", "a file written without parts and assemblies");
  }  // every other keyword says nothing about the mesh
}

void Reader::node_line(const std::vector<std::string>& parts) {
  if (parts.size() < 3) fail("a node needs its number and at least two coordinates");
  const GlobalIndex number = integer(parts[0]);
  Point x{};
  for (std::size_t i = 0; i < 3 && i + 1 < parts.size(); ++i)
    x[i] = parts[i + 1].empty() ? 0 : unit_ * real(parts[i + 1]);
  if (!node_at_.emplace(number, static_cast<Index>(x_.size())).second)
    fail("node " + std::to_string(number) + " is defined twice",
         "one numbering for all parts: a file written without parts and assemblies");
  if (const std::string* set = keyword_.find("NSET"))
    set_of(node_sets_, *set).members.push_back(static_cast<Index>(x_.size()));
  x_.push_back(x);
  input_node_.push_back(number);
}

void Reader::element_line(const std::vector<std::string>& parts) {
  for (const std::string& part : parts) pending_.push_back(integer(part));
  const auto nn = static_cast<std::size_t>(node_count(shape_));
  if (pending_.size() < nn + 1) return;
  if (pending_.size() > nn + 1)
    fail("element " + std::to_string(pending_[0]) + " has more than the " + std::to_string(nn) +
         " nodes of its type");
  Element e{shape_, {}, pending_[0]};
  const auto order = abaqus_node_order(shape_);
  for (std::size_t a = 0; a < nn; ++a)
    e.nodes.push_back(node(pending_[1 + (order.empty() ? a : static_cast<std::size_t>(order[a]))]));
  if (shape_ == Shape::line3) {  // trusses and beams differ in where they put the mid node
    const auto off_middle = [&](std::size_t mid) {
      double d = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto c = [&](std::size_t a) { return x_[static_cast<std::size_t>(e.nodes[a % 3])][i]; };
        d += std::abs(c(mid) - 0.5 * (c(mid + 1) + c(mid + 2)));
      }
      return d;
    };
    if (off_middle(1) < off_middle(2)) std::swap(e.nodes[1], e.nodes[2]);
  }
  const auto index = static_cast<Index>(elements_.size());
  if (!element_at_.emplace(e.number, index).second)
    fail("element " + std::to_string(e.number) + " is defined twice");
  if (const std::string* set = keyword_.find("ELSET")) set_of(element_sets_, *set).members.push_back(index);
  elements_.push_back(std::move(e));
  pending_.clear();
}

template <class Find>
void Reader::set_line(const std::vector<std::string>& parts, Sets<Index>& sets, NamedSet<Index>& set,
                      Find find) {
  if (keyword_.find("GENERATE") != nullptr) {
    if (parts.size() < 2) fail("GENERATE needs the first and the last number");
    const GlobalIndex first = integer(parts[0]), last = integer(parts[1]),
                      step = parts.size() > 2 ? integer(parts[2]) : 1;
    if (step < 1 || last < first) fail("GENERATE needs rising numbers and a step of at least one");
    for (GlobalIndex n = first; n <= last; n += step) set.members.push_back(find(n));
    return;
  }
  for (const std::string& part : parts) {
    if (part.empty()) continue;
    if (std::isdigit(static_cast<unsigned char>(part[0])) != 0) {
      set.members.push_back(find(integer(part)));
      continue;
    }
    const auto other = sets.find(upper(part));
    if (other == sets.end()) fail("there is no set '" + part + "' up to here");
    const std::vector<Index> members = other->second.members;
    set.members.insert(set.members.end(), members.begin(), members.end());
  }
}

void Reader::surface_line(const std::vector<std::string>& parts) {
  NamedSet<Face>& surface = set_of(surfaces_, required("NAME"));
  if (parts.size() < 2) fail("a surface needs a face for every element or set: 'part, S1'");
  std::vector<Index> members;
  if (std::isdigit(static_cast<unsigned char>(parts[0][0])) != 0) {
    members = {element(integer(parts[0]))};
  } else {
    const auto set = element_sets_.find(upper(parts[0]));
    if (set == element_sets_.end()) fail("there is no element set '" + parts[0] + "' up to here");
    members = set->second.members;
  }
  const std::string label = upper(parts[1]);
  for (const Index e : members) {
    if (label == "SPOS" || label == "SNEG") {
      surface.members.push_back({e, -1});
      continue;
    }
    const Shape shape = elements_[static_cast<std::size_t>(e)].shape;
    const auto face = label.size() == 2 && label[0] == 'S' ? face_of_abaqus_label(shape, label[1] - '0')
                                                           : std::optional<int>{};
    if (!face)
      fail("a " + std::string(name(shape)) + " has no face '" + parts[1] + "'",
           "S1 to S" + std::to_string(face_count(shape)));
    surface.members.push_back({e, *face});
  }
}

void add(RawGroup& group, Shape shape, const std::vector<Index>& nodes, GlobalIndex number) {
  auto block = std::find_if(group.blocks.begin(), group.blocks.end(),
                            [&](const RawBlock& b) { return b.shape == shape; });
  if (block == group.blocks.end()) block = group.blocks.insert(group.blocks.end(), RawBlock{shape, {}, {}});
  block->nodes.insert(block->nodes.end(), nodes.begin(), nodes.end());
  block->input_element.push_back(number);
}

template <class Member>
void sort_out(std::vector<Member>& members) {
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
}

RawMesh Reader::mesh(const std::string& path) {
  RawMesh mesh;
  mesh.dimension = 0;
  for (const Element& e : elements_) mesh.dimension = std::max(mesh.dimension, mesh::dimension(e.shape));
  if (mesh.dimension < 2)
    throw InputError({path},
                     "the mesh has no triangles, quads, tetrahedra or hexahedra: empty, cut off or "
                     "not a mesh",
                     "an Abaqus or CalculiX input file with *NODE and *ELEMENT");
  mesh.x = std::move(x_);
  mesh.input_node = std::move(input_node_);

  const auto add_group = [&mesh](std::string group_name, RawGroup group) {
    if (group.blocks.empty()) return;
    // The same name for elements, nodes and faces is usual in these files.
    if (mesh.groups.contains(group_name)) group_name += "_" + std::to_string(group.dimension) + "d";
    mesh.groups.emplace(group_name, std::move(group));
  };
  std::vector<char> named(elements_.size(), 0);
  for (auto& [key, set] : element_sets_) {
    sort_out(set.members);
    RawGroup group{0, {}};
    for (const Index e : set.members) {
      group.dimension =
          std::max(group.dimension, mesh::dimension(elements_[static_cast<std::size_t>(e)].shape));
      named[static_cast<std::size_t>(e)] = 1;
    }
    // A set of everything means the elements of highest dimension in it.
    for (const Index i : set.members) {
      const Element& e = elements_[static_cast<std::size_t>(i)];
      if (mesh::dimension(e.shape) == group.dimension) add(group, e.shape, e.nodes, e.number);
    }
    add_group(set.name, std::move(group));
  }
  RawGroup rest{mesh.dimension, {}};
  for (std::size_t i = 0; i < elements_.size(); ++i)
    if (named[i] == 0 && mesh::dimension(elements_[i].shape) == mesh.dimension)
      add(rest, elements_[i].shape, elements_[i].nodes, elements_[i].number);
  add_group("body_1", std::move(rest));

  for (const auto& [key, surface] : surfaces_) {
    RawGroup group{mesh.dimension - 1, {}};
    for (const Face& f : surface.members) {
      const Element& e = elements_[static_cast<std::size_t>(f.element)];
      if (mesh::dimension(e.shape) - (f.face < 0 ? 0 : 1) != group.dimension) continue;
      if (f.face < 0) {
        add(group, e.shape, e.nodes, e.number);
        continue;
      }
      std::vector<Index> nodes;
      for (const int a : face_nodes(e.shape, f.face)) nodes.push_back(e.nodes[static_cast<std::size_t>(a)]);
      add(group, face_shape(e.shape), nodes, e.number);
    }
    add_group(surface.name, std::move(group));
  }
  for (auto& [key, set] : node_sets_) {
    sort_out(set.members);
    RawGroup group{0, {}};
    for (const Index i : set.members) add(group, Shape::point1, {i}, 0);
    add_group(set.name, std::move(group));
  }
  return mesh;
}

}  // namespace

RawMesh read_abaqus_input(const std::string& path, double unit_in_metres) {
  Reader reader(unit_in_metres);
  reader.read(path);
  return reader.mesh(path);
}

}  // namespace solidus::mesh
