// The MED library's functions have the names of its documentation: MED 4.1, "Le modèle de données MED".
#include "mesh/med/read_med.hpp"

#include <fmt/format.h>
#include <med.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "input/units.hpp"
#include "mesh/files/med_cells.hpp"
#include "mesh/files/vtk_cells.hpp"
#include "mesh/med/hdf5_extents.hpp"
#include "mesh/shape_table.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

/// A text of fixed width, without what is behind its end and blanks.
std::string text_of(const char* from, std::size_t width) {
  std::string text(from, std::find(from, from + width, '\0'));
  text.erase(text.find_last_not_of(' ') + 1);
  return text.erase(0, std::min(text.find_first_not_of(' '), text.size()));
}

class File {
 public:
  explicit File(const std::string& path) : id_(MEDfileOpen(path.c_str(), MED_ACC_RDONLY)) {
    if (id_ < 0)
      throw InputError({path},
                       "the MED library cannot open the file: no MED file, damaged, or of a later version");
  }
  ~File() { MEDfileClose(id_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  operator med_idt() const { return id_; }  // NOLINT: stands for the number

 private:
  med_idt id_;
};

/// The solids and faces that Solidus does not have, with MED's names.
constexpr std::array<std::pair<med_geometry_type, const char*>, 11> k_refused{{{MED_TRIA7, "TRIA7"},
                                                                               {MED_QUAD9, "QUAD9"},
                                                                               {MED_PYRA13, "PYRA13"},
                                                                               {MED_PENTA15, "PENTA15"},
                                                                               {MED_PENTA18, "PENTA18"},
                                                                               {MED_HEXA27, "HEXA27"},
                                                                               {MED_OCTA12, "OCTA12"},
                                                                               {MED_POLYGON, "POLYGON"},
                                                                               {MED_POLYGON2, "POLYGON2"},
                                                                               {MED_POLYHEDRON, "POLYHEDRON"},
                                                                               {MED_SEG4, "SEG4"}}};

Shape shape_of(const MedCell& cell) {
  for (const ShapeRow& row : k_shape_rows)
    if (row.vtk == cell.vtk) return row.shape;
  throw std::logic_error("a cell of MED without a shape");
}

/// One mesh of the file, at its first step.
struct Step {
  std::string name;
  med_int space = 0, number = MED_NO_DT, iteration = MED_NO_IT;
};

/// Elements or nodes of the mesh with one shape and family.
struct Member {
  Shape shape;
  std::vector<Index> nodes;
  InputNumbers numbers;
};
using Family = std::vector<Member>;  ///< a member a shape

class Reader {
 public:
  Reader(const std::string& path, double unit)
      : path_(path), unit_(unit), buffer_bytes_(largest_data_set(path)), file_(path) {}

  RawMesh mesh();

 private:
  void check_version() const;
  void take_mesh(int number);
  Step step_of(int number);
  void take_nodes(const Step& step);
  void take_cells(const Step& step, const MedCell& cell);
  void refuse_others(const Step& step) const;
  void make_groups(const Step& step);
  void add_groups();
  void note_unit(const std::string& axis_units);
  std::map<med_int, std::vector<std::string>> families_of(const Step& step) const;

  /// A buffer for n numbers or, where a data set of the file is larger than it ought to be, for that.
  template <class Number>
  std::vector<Number> buffer(std::size_t n) const {
    return std::vector<Number>(std::max(n, buffer_bytes_ / sizeof(Number) + 1));
  }
  std::size_t count(const Step& step, med_entity_type entity, med_geometry_type type, med_data_type data,
                    med_connectivity_mode mode) const {
    med_bool changed = MED_FALSE, transformed = MED_FALSE;
    const med_int n = MEDmeshnEntity(file_, step.name.c_str(), step.number, step.iteration, entity, type,
                                     data, mode, &changed, &transformed);
    return as_size(std::max<med_int>(n, 0));
  }
  using ReadNumbers = med_err(med_idt, const char*, med_int, med_int, med_entity_type, med_geometry_type,
                              med_int*);
  /// Families or numbers of entities; empty where the file has none.
  std::vector<med_int> numbers(const Step& step, med_entity_type entity, med_geometry_type type,
                               med_data_type data, ReadNumbers* read, std::size_t n) const;
  [[noreturn]] void fail(const std::string& what, const std::string& allowed = "") const {
    throw InputError({path_}, what, allowed);
  }

  const std::string& path_;
  double unit_;
  std::size_t buffer_bytes_;
  File file_;
  RawMesh mesh_;
  std::size_t first_node_ = 0;          ///< of the mesh that is being read
  std::map<med_int, Family> families_;  ///< of that mesh
  std::map<med_int, Family> of_nodes_;
  /// Groups by their name in the file, and of each the mesh it is of.
  std::map<std::string, std::vector<std::pair<std::string, RawGroup>>> found_;
  std::vector<std::string> meshes_;  ///< that hold elements
};

std::vector<med_int> Reader::numbers(const Step& step, med_entity_type entity, med_geometry_type type,
                                     med_data_type data, ReadNumbers* read, std::size_t n) const {
  if (count(step, entity, type, data, MED_NODAL) != n) return {};
  std::vector<med_int> values = buffer<med_int>(n);
  if (read(file_, step.name.c_str(), step.number, step.iteration, entity, type, values.data()) < 0) return {};
  values.resize(n);
  return values;
}

void Reader::check_version() const {
  med_int major = 0, minor = 0, release = 0;
  if (MEDfileNumVersionRd(file_, &major, &minor, &release) < 0) fail("the file says no version of MED");
  if (major < 3)
    fail(fmt::format("the file is of version {}.{} of MED", major, minor),
         "version 3 or 4, as Salome 7 and later write it");
}

Step Reader::step_of(int number) {
  // MED writes names into buffers of fixed length. What is read here is what the rest depends on: space,
  // kind, axes, unit, and the computation step.
  Step step;
  med_int dimension = 0, n_steps = 0;
  med_mesh_type type = MED_UNDEF_MESH_TYPE;
  med_sorting_type sorting = MED_SORT_UNDEF;
  med_axis_type axes = MED_UNDEF_AXIS_TYPE;
  const auto n_axes = as_size(std::clamp<med_int>(MEDmeshnAxis(file_, number), 3, 100));
  std::string name(MED_NAME_SIZE + 1, '\0'), description(MED_COMMENT_SIZE + 1, '\0'),
      time_unit(MED_SNAME_SIZE + 1, '\0'), axis(n_axes * MED_SNAME_SIZE + 1, '\0'),
      unit(n_axes * MED_SNAME_SIZE + 1, '\0');
  if (MEDmeshInfo(file_, number, name.data(), &step.space, &dimension, &type, description.data(),
                  time_unit.data(), &sorting, &n_steps, &axes, axis.data(), unit.data()) < 0)
    fail(fmt::format("mesh {} of the file cannot be read: the file is damaged", number));
  step.name = text_of(name.data(), MED_NAME_SIZE);
  // Only unstructured meshes in Cartesian axes are meshes of elements.
  if (type != MED_UNSTRUCTURED_MESH)
    fail("the mesh '" + step.name + "' is a structured grid", "a mesh of elements with their nodes");
  if (axes != MED_CARTESIAN && axes != MED_UNDEF_AXIS_TYPE)
    fail("the mesh '" + step.name + "' is in cylindrical or spherical coordinates", "Cartesian ones");
  if (step.space < 2 || step.space > 3)
    fail(fmt::format("the mesh '{}' has {} coordinates a node", step.name, step.space), "2 or 3");
  note_unit(text_of(unit.data(), MED_SNAME_SIZE));
  // Of several computation steps the first one is read, and a note says so.
  med_float time = 0;
  if (n_steps > 0 &&
      MEDmeshComputationStepInfo(file_, step.name.c_str(), 1, &step.number, &step.iteration, &time) < 0)
    fail("the steps of the mesh '" + step.name + "' cannot be read: the file is damaged");
  if (n_steps > 1)
    mesh_.notes.push_back(fmt::format("the mesh '{}' has {} computation steps, of which the first is read",
                                      step.name, n_steps));
  return step;
}

// Programs write it or not, whatever their lengths are.
void Reader::note_unit(const std::string& axis_units) {
  if (axis_units.empty()) return;
  double metres = 0;
  try {
    metres = units::convert(1, axis_units, "m");
  } catch (const std::exception&) {  // NOLINT: a word that names no length
    return;
  }
  if (std::abs(metres / unit_ - 1) < 1e-6) return;
  mesh_.notes.push_back(fmt::format(
      "the file names {} as its unit of length, and lengths are taken in units of {:g} m as told (mesh.unit, "
      "--unit)",
      axis_units, unit_));
}

void Reader::take_nodes(const Step& step) {
  // Coordinates of all nodes at once, in the order x, y, z of each.
  const std::size_t n = count(step, MED_NODE, MED_NONE, MED_COORDINATE, MED_NO_CMODE);
  const auto dimension = as_size(step.space);
  std::vector<med_float> x = buffer<med_float>(dimension * n);
  if (n == 0 || MEDmeshNodeCoordinateRd(file_, step.name.c_str(), step.number, step.iteration,
                                        MED_FULL_INTERLACE, x.data()) < 0)
    fail("the nodes of the mesh '" + step.name + "' cannot be read: the file is damaged");
  first_node_ = mesh_.x.size();
  const std::vector<med_int> own = numbers(step, MED_NODE, MED_NONE, MED_NUMBER, MEDmeshEntityNumberRd, n);
  // Nodes of a family other than zero belong to groups of nodes.
  const std::vector<med_int> family =
      numbers(step, MED_NODE, MED_NONE, MED_FAMILY_NUMBER, MEDmeshEntityFamilyNumberRd, n);
  for (std::size_t i = 0; i < n; ++i) {
    Point at{};
    for (std::size_t k = 0; k < dimension; ++k) at[k] = unit_ * x[dimension * i + k];
    mesh_.x.push_back(at);
    // Numbers of several meshes would be there twice.
    const bool has_own = !own.empty() && first_node_ == 0;
    mesh_.input_node.push_back(has_own ? own[i] : static_cast<GlobalIndex>(first_node_ + i) + 1);
    if (family.empty() || family[i] == 0) continue;
    Family& points = of_nodes_[family[i]];
    if (points.empty()) points.push_back({Shape::point1, {}, {}});
    points.front().nodes.push_back(as_index(first_node_ + i));
    points.front().numbers.push_back(mesh_.input_node[first_node_ + i]);
  }
}

void Reader::take_cells(const Step& step, const MedCell& cell) {
  // Cells of one shape are read together: connectivity, their own numbers, and the family that each belongs
  // to.
  const std::size_t n = count(step, MED_CELL, cell.med, MED_CONNECTIVITY, MED_NODAL);
  if (n == 0) return;
  const Shape shape = shape_of(cell);
  const std::size_t per = cell.order.size(), n_nodes = mesh_.x.size() - first_node_;
  std::vector<med_int> given = buffer<med_int>(per * n);
  if (MEDmeshElementConnectivityRd(file_, step.name.c_str(), step.number, step.iteration, MED_CELL, cell.med,
                                   MED_NODAL, MED_FULL_INTERLACE, given.data()) < 0)
    fail(fmt::format("the {} of the mesh '{}' cannot be read: the file is damaged", cell.name, step.name));
  const std::vector<med_int> own = numbers(step, MED_CELL, cell.med, MED_NUMBER, MEDmeshEntityNumberRd, n);
  const std::vector<med_int> family =
      numbers(step, MED_CELL, cell.med, MED_FAMILY_NUMBER, MEDmeshEntityFamilyNumberRd, n);
  const std::span<const int> vtk = vtk_node_order(shape);
  mesh_.dimension = std::max(mesh_.dimension, cell.dimension);
  // Groups are made of families later, so cells are collected by family and shape. Nodes are put into VTK's
  // order on the way, and each number is checked.
  for (std::size_t e = 0; e < n; ++e) {
    Family& members = families_[family.empty() ? 0 : family[e]];
    auto member = std::ranges::find(members, shape, &Member::shape);
    if (member == members.end()) member = members.insert(member, Member{shape, {}, {}});
    const std::size_t begin = member->nodes.size();
    member->nodes.resize(begin + per);
    for (std::size_t i = 0; i < per; ++i) {
      const med_int node = given[per * e + i];
      if (node < 1 || as_size(node) > n_nodes)
        fail(fmt::format("{} {} of the mesh '{}' has the node {}, and there are {}", cell.name, e + 1,
                         step.name, node, n_nodes));
      const auto place = as_size(vtk[as_size(cell.order[i])]);
      member->nodes[begin + place] = as_index(first_node_ + as_size(node) - 1);
    }
    member->numbers.push_back(own.empty() ? static_cast<GlobalIndex>(e) + 1 : own[e]);
  }
}

void Reader::refuse_others(const Step& step) const {
  for (const auto& [type, name] : k_refused) {
    const bool many = type == MED_POLYGON || type == MED_POLYGON2 || type == MED_POLYHEDRON;
    // Of polygons and polyhedra the lists of beginnings have one entry more than there are cells.
    const std::size_t n = count(step, MED_CELL, type, many ? MED_INDEX_NODE : MED_CONNECTIVITY, MED_NODAL);
    if (n > (many ? 1U : 0U))
      fail(fmt::format("the mesh '{}' has elements of the type {}", step.name, name),
           "TRIA3, TRIA6, QUAD4, QUAD8, TETRA4, TETRA10, HEXA8, HEXA20, PENTA6 and PYRA5");
  }
  for (const MedCell& cell : med_cells())
    if (count(step, MED_CELL, cell.med, MED_CONNECTIVITY, MED_DESCENDING) > 0)
      fail(fmt::format("the {} of the mesh '{}' are given by their faces", cell.name, step.name),
           "elements given by their nodes");
}

std::map<med_int, std::vector<std::string>> Reader::families_of(const Step& step) const {
  std::map<med_int, std::vector<std::string>> groups;
  // A family stands for a combination of groups; elements name their family alone.
  const med_int n = MEDnFamily(file_, step.name.c_str());
  for (int i = 1; i <= n; ++i) {
    const med_int n_groups = MEDnFamilyGroup(file_, step.name.c_str(), i);
    if (n_groups < 0) fail(fmt::format("family {} of the mesh '{}' cannot be read", i, step.name));
    constexpr auto k_width = as_size(MED_LNAME_SIZE);
    std::string family(MED_NAME_SIZE + 1, '\0');
    std::vector<char> names = buffer<char>(k_width * as_size(n_groups) + 1);
    med_int number = 0;
    if (MEDfamilyInfo(file_, step.name.c_str(), i, family.data(), &number, names.data()) < 0)
      fail(fmt::format("family {} of the mesh '{}' cannot be read", i, step.name));
    for (std::size_t g = 0; g < as_size(n_groups); ++g)
      groups[number].push_back(text_of(names.data() + k_width * g, k_width));
  }
  return groups;
}

void add(const Member& member, RawGroup& group) {
  auto block = std::ranges::find(group.blocks, member.shape, &RawBlock::shape);
  if (block == group.blocks.end()) block = group.blocks.insert(block, RawBlock{member.shape, {}, {}});
  block->nodes.insert(block->nodes.end(), member.nodes.begin(), member.nodes.end());
  for (std::size_t i = 0; i < member.numbers.size(); ++i) block->input_element.push_back(member.numbers[i]);
}

void Reader::make_groups(const Step& step) {
  const auto groups = families_of(step);
  std::map<std::pair<std::string, int>, RawGroup> named;  // by name and dimension
  // Elements without a group are kept if they are of the body or of its boundary, by the name of the mesh.
  int highest = 0;
  for (const auto& [number, family] : families_)
    for (const Member& member : family) highest = std::max(highest, mesh::dimension(member.shape));
  const auto put = [&](const std::string& name, const Member& member) {
    const int d = mesh::dimension(member.shape);
    RawGroup& group = named.try_emplace({name, d}, RawGroup{d, {}}).first->second;
    add(member, group);
  };
  // Cells first, then nodes that have a family of their own.
  for (const std::map<med_int, Family>* families : {&families_, &of_nodes_})
    for (const auto& [number, family] : *families) {
      const auto of = groups.find(number);
      const bool in_group = of != groups.end() && !of->second.empty();
      for (const Member& member : family) {
        if (in_group)
          for (const std::string& name : of->second) put(name, member);
        else if (const int d = mesh::dimension(member.shape); d >= 2 && d >= highest - 1)
          put(d == highest ? step.name : fmt::format("{}_{}d", step.name, d), member);
      }
    }
  // The highest dimension of a name keeps it; the map has it last.
  std::set<std::string> taken;
  for (auto group = named.rbegin(); group != named.rend(); ++group) {
    const auto& [name, d] = group->first;
    const std::string full = taken.insert(name).second ? name : fmt::format("{}_{}d", name, d);
    found_[full].emplace_back(step.name, std::move(group->second));
  }
}

void Reader::take_mesh(int number) {
  const Step step = step_of(number);
  refuse_others(step);
  families_.clear();
  of_nodes_.clear();
  const std::size_t n_before = mesh_.x.size();
  if (count(step, MED_NODE, MED_NONE, MED_COORDINATE, MED_NO_CMODE) == 0) return;
  take_nodes(step);
  for (const MedCell& cell : med_cells()) take_cells(step, cell);
  if (families_.empty()) {
    mesh_.x.resize(n_before);
    mesh_.input_node.resize(n_before);
    return;
  }
  meshes_.push_back(step.name);
  make_groups(step);
}

void Reader::add_groups() {
  for (auto& [name, groups] : found_)
    for (auto& [mesh, group] : groups) {
      std::string full = groups.size() > 1 ? mesh + "." + name : name;
      while (mesh_.groups.contains(full)) full += "_";
      mesh_.groups.emplace(full, std::move(group));
    }
}

RawMesh Reader::mesh() {
  check_version();
  mesh_.dimension = 0;
  const med_int n = MEDnMesh(file_);
  for (int i = 1; i <= n; ++i) take_mesh(i);
  if (mesh_.dimension < 2)
    fail("the mesh has no triangles, quads, tetrahedra or hexahedra: empty or not a mesh",
         "a MED file with a mesh");
  if (meshes_.size() > 1) {
    std::string names;
    for (const std::string& name : meshes_) names += (names.empty() ? "'" : ", '") + name + "'";
    mesh_.notes.push_back(fmt::format("the file holds {} meshes, {}; all are read", meshes_.size(), names));
  }
  add_groups();
  return std::move(mesh_);
}

}  // namespace

RawMesh read_med_file(const std::string& path, double unit_in_metres) {
  return Reader(path, unit_in_metres).mesh();
}

}  // namespace solidus::mesh
