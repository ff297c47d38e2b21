// Reads and meshes with Gmsh (mesh/gmsh/session.hpp).
#include <fmt/format.h>
#include <gmsh.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <new>
#include <sstream>
#include <unordered_map>

#include "input/keys.hpp"
#include "mesh/files/file_format.hpp"
#include "mesh/files/gmsh_elements.hpp"
#include "mesh/gmsh/casting_mesh.hpp"
#include "mesh/gmsh/closed_solids.hpp"
#include "mesh/gmsh/curved_faces.hpp"
#include "mesh/gmsh/drawn_faces.hpp"
#include "mesh/gmsh/geometry_groups.hpp"
#include "mesh/gmsh/session.hpp"
#include "mesh/making/casting_geometry.hpp"
#include "mesh/making/meshing_outlook.hpp"
#include "mesh/raw_mesh.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

/// OpenCASCADE writes banners and complaints to the standard streams, whatever Gmsh's verbosity.
class Silence {
 public:
  Silence() : out_(std::cout.rdbuf(nothing_.rdbuf())), error_(std::cerr.rdbuf(nothing_.rdbuf())) {}
  ~Silence() {
    std::cout.rdbuf(out_);
    std::cerr.rdbuf(error_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  std::ostringstream nothing_;
  std::streambuf *out_, *error_;
};

/// Gmsh's state is global: one session at a time, closed whatever happens.
class Session {
 public:
  /// @param constants  what DefineConstant of a .geo script takes instead of its own values
  explicit Session(const std::map<std::string, double>& constants = {}) {
    gmsh::initialize(0, nullptr, false);
    for (const auto& [name, value] : constants) gmsh::onelab::setNumber(name, {value});
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.Verbosity", 0);
    gmsh::logger::start();
  }
  ~Session() {
    gmsh::onelab::clear();  // constants and the log outlive finalize()
    gmsh::logger::stop();
    gmsh::finalize();
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Returns the errors and warnings of Gmsh, in its words.
  static std::string complaints() {
    std::vector<std::string> log;
    gmsh::logger::get(log);
    std::string text;
    for (const std::string& line : log)
      if (line.starts_with("Error")) text += (text.empty() ? "" : "; ") + line;
    return text;
  }

 private:
  Silence silence_;
};

/// A file in memory, with a name that Gmsh can open as long as this lives.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& text) : descriptor_(memfd_create("script", 0)) {
    if (descriptor_ < 0 ||
        ::write(descriptor_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
      throw std::bad_alloc();
  }
  ~MemoryFile() { ::close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

/// Whether the last line of a file has no end: of such a line Gmsh 4.8 and 4.13 run the first statement
/// alone, unless another script includes the file.
bool has_open_line(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file || file.tellg() <= 0) return false;
  file.seekg(-1, std::ios::end);
  const int last = file.get();
  return last != '\n' && last != '\r';
}

void open_in_gmsh(const std::string& path, FileHolds holds) {
  if (holds != FileHolds::script || !has_open_line(path)) return gmsh::open(path);
  const std::string whole = std::filesystem::absolute(path).string();
  const char quote = whole.find('"') == std::string::npos ? '"' : '\'';
  const MemoryFile around("Include " + (quote + whole) + quote + ";\n");
  gmsh::open(around.path());
}

void open(const std::string& path, FileHolds holds) {
  const std::string advice = common_formats();
  try {
    open_in_gmsh(path, holds);
  } catch (const std::string& complaint) {
    throw InputError({path}, "the mesh cannot be read: " + complaint, advice);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw InputError({path}, std::string("the mesh cannot be read: ") + e.what(), advice);
  } catch (...) {  // the CAD kernel's own exceptions
    throw InputError({path}, "the mesh cannot be read", advice);
  }
  // A damaged .msh does not make open() throw; its log is the only sign.
  if (const std::string complaints = Session::complaints(); !complaints.empty())
    throw InputError({path}, "the mesh cannot be read: " + complaints, advice);
}

/// The constants that a .geo script declares: DefineConstant[ size = {8, Name "size"} ].
std::vector<std::string> declared_constants(const std::string& path) {
  const Session session;
  open(path, FileHolds::script);
  std::vector<std::string> names;
  gmsh::onelab::getNames(names);
  std::erase_if(names, [](const std::string& name) {
    return name.starts_with("Gmsh/") || name.starts_with("ONELAB/");
  });
  return names;
}

/// Gmsh sets any name without a word: a misspelt one would change nothing.
void check_constants(const std::string& path, const std::map<std::string, double>& constants) {
  if (constants.empty()) return;
  const std::vector<std::string> declared = declared_constants(path);
  for (const auto& [name, value] : constants)
    if (std::find(declared.begin(), declared.end(), name) == declared.end())
      throw InputError({path}, "the script declares no constant '" + name + "'",
                       declared.empty() ? "DefineConstant[ " + name + " = {value, Name \"" + name + "\"} ];"
                                        : one_of(declared, name));
}

/// The outlook on a mesh of the geometry that Gmsh has. Throws std::string where Gmsh complains. The
/// sizes of a script are its own, and then nothing is expected of the number of nodes.
MeshingOutlook outlook_of(const MeshSource& source, FileHolds holds) {
  namespace occ = gmsh::model::occ;
  MeshingOutlook o;
  const double unit = source.unit_in_metres;
  Point low{}, high{};
  // The sides of the box, where they are numbers at all.
  gmsh::model::getBoundingBox(-1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
  for (std::size_t i = 0; i < 3; ++i)
    if (high[i] > low[i] && std::isfinite(high[i] - low[i])) o.sides[i] = unit * (high[i] - low[i]);
  gmsh::vectorpair volumes;
  if (holds == FileHolds::shapes) occ::getEntities(volumes, 3);
  // Volume and area of each solid tell how many nodes its mesh will have.
  for (const auto& [dimension, tag] : volumes) {
    double volume = 0, area = 0;
    occ::getMass(dimension, tag, volume);
    o.volume += volume * unit * unit * unit;
    if (!(source.element_size > 0)) continue;
    gmsh::vectorpair faces;
    gmsh::model::getBoundary({{dimension, tag}}, faces, false, false, false);
    for (const auto& [surface, number] : faces) {
      double one = 0;
      occ::getMass(surface, std::abs(number), one);
      area += one;
    }
    const double size = source.size_factor * source.element_size / unit;
    o.nodes += expected_nodes({{area, size}}, volume, size, 0);
  }
  if (o.nodes > 0) o.smallest = o.largest = source.size_factor * source.element_size;
  if (source.element_order == 2) o.nodes *= k_nodes_of_second_order;
  return o;
}

/// The centre of the solids that Gmsh has; nothing where it has none, or where it cannot measure them.
std::optional<Point> centre_of_solids(double unit) {
  namespace occ = gmsh::model::occ;
  // Centre by volume over all solids; what cannot be measured has none.
  Point moment{};
  double whole = 0;
  try {
    gmsh::vectorpair volumes;
    occ::getEntities(volumes, 3);
    for (const auto& [dimension, tag] : volumes) {
      double volume = 0;
      Point centre{};
      occ::getMass(dimension, tag, volume);
      occ::getCenterOfMass(dimension, tag, centre[0], centre[1], centre[2]);
      whole += volume;
      for (std::size_t i = 0; i < 3; ++i) moment[i] += volume * centre[i];
    }
  } catch (const std::string&) {
    return {};
  }
  // Scaled to metres, and divided by the whole volume.
  if (!(whole > 0)) return {};
  for (double& x : moment) x *= unit / whole;
  return moment;
}

void generate(const std::string& path, double size, double size_factor, int element_order) {
  try {
    // A script may have set a factor of its own.
    if (size_factor != 1) {
      double of_script = 1;
      gmsh::option::getNumber("Mesh.MeshSizeFactor", of_script);
      gmsh::option::setNumber("Mesh.MeshSizeFactor", of_script * size_factor);
    }
    if (size > 0) {
      gmsh::option::setNumber("Mesh.MeshSizeMax", size);
      gmsh::option::setNumber("Mesh.MeshSizeMin",
                              size);  // else Gmsh's default, a tenth of the model, may win
    }
    if (element_order == 2) gmsh::option::setNumber("Mesh.SecondOrderIncomplete", 1);
    gmsh::vectorpair volumes;
    gmsh::model::getEntities(volumes, 3);
    gmsh::model::mesh::generate(volumes.empty() ? 2 : 3);
    gmsh::model::mesh::setOrder(element_order);
  } catch (const std::string& complaint) {
    throw InputError({path}, "Gmsh could not mesh the geometry: " + complaint);
  }
}

std::unordered_map<std::size_t, Index> read_nodes(double unit, RawMesh& mesh) {
  std::vector<std::size_t> tags;
  std::vector<double> x, parametric;
  gmsh::model::mesh::getNodes(tags, x, parametric);
  std::unordered_map<std::size_t, Index> index;
  index.reserve(tags.size());
  // In the order of their numbers: the same mesh however the file is sorted.
  std::vector<std::size_t> order(tags.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return tags[a] < tags[b]; });
  for (const std::size_t i : order) {
    if (!index.emplace(tags[i], as_index(mesh.x.size())).second) continue;
    mesh.x.push_back({unit * x[3 * i], unit * x[3 * i + 1], unit * x[3 * i + 2]});
    mesh.input_node.push_back(static_cast<GlobalIndex>(tags[i]));
  }
  return index;
}

void read_entity(const std::string& path, int dimension, int entity,
                 const std::unordered_map<std::size_t, Index>& index, RawGroup& group) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> elements, nodes;
  // Elements of one type come as one list of tags and one of nodes.
  gmsh::model::mesh::getElements(types, elements, nodes, dimension, entity);
  // Elements of one shape go into one block, their nodes by the numbers of this mesh.
  for (std::size_t t = 0; t < types.size(); ++t) {
    // A type that is not ours is named in the words of Gmsh.
    const GmshElement* const element = gmsh_element(types[t]);
    if (element == nullptr || !element->shape) {
      std::string name;
      int d = 0, order = 0, n = 0, primary = 0;
      std::vector<double> local;
      gmsh::model::mesh::getElementProperties(types[t], name, d, order, n, local, primary);
      throw InputError({path}, "the mesh has elements of the type '" + name + "'", k_shapes_of_meshes);
    }
    auto block = std::find_if(group.blocks.begin(), group.blocks.end(),
                              [&](const RawBlock& b) { return b.shape == *element->shape; });
    if (block == group.blocks.end())
      block = group.blocks.insert(group.blocks.end(), RawBlock{*element->shape, {}, {}});
    for (const std::size_t tag : nodes[t]) {
      const auto found = index.find(tag);
      if (found == index.end())
        throw InputError(
            {path}, "an element refers to node " + std::to_string(tag) + ", which the mesh does not have");
      block->nodes.push_back(found->second);
    }
    for (const std::size_t tag : elements[t]) block->input_element.push_back(static_cast<GlobalIndex>(tag));
  }
}

// Physical groups by name; entities without any become body_1, body_2, … so that a plain mesh of one body
// works as it is.
void read_groups(const std::string& path, const std::unordered_map<std::size_t, Index>& index,
                 RawMesh& mesh) {
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups);
  for (const auto& [dimension, tag] : groups) {
    std::string name;
    gmsh::model::getPhysicalName(dimension, tag, name);
    if (name.empty()) name = "group_" + std::to_string(dimension) + "d_" + std::to_string(tag);
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, entities);
    RawGroup group{dimension, {}};
    for (const int entity : entities) read_entity(path, dimension, entity, index, group);
    if (group.blocks.empty()) continue;
    // The same name for a body and its boundary would be ambiguous.
    if (mesh.groups.contains(name)) name += "_" + std::to_string(dimension) + "d";
    mesh.groups.emplace(name, std::move(group));
  }
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, mesh.dimension);
  int number = 0;
  for (const auto& [dimension, entity] : entities) {
    std::vector<int> tags;
    gmsh::model::getPhysicalGroupsForEntity(dimension, entity, tags);
    if (!tags.empty()) continue;
    RawGroup group{dimension, {}};
    read_entity(path, dimension, entity, index, group);
    if (!group.blocks.empty()) mesh.groups.emplace("body_" + std::to_string(++number), std::move(group));
  }
}

int mesh_dimension() {
  for (int d = 3; d > 1; --d) {
    std::vector<int> types;
    gmsh::model::mesh::getElementTypes(types, d);
    if (!types.empty()) return d;
  }
  return 0;
}

void name_groups(const MeshSource& source, FileHolds holds) {
  try {
    if (holds == FileHolds::shapes) close_to_solids_unless_plane(source);
    make_geometry_groups(source.path, source.geometry, source.unit_in_metres, holds == FileHolds::shapes);
  } catch (const std::exception&) {
    throw;
  } catch (const std::string& complaint) {
    throw InputError({source.path}, "the geometry cannot be read: " + complaint);
  } catch (...) {  // the CAD kernel's own exceptions
    throw InputError({source.path}, "the geometry cannot be read");
  }
}

/// With the CAD kernel's own exceptions as messages.
void make_casting(const MeshSource& source, const std::function<void()>& make) {
  try {
    make();
  } catch (const std::exception&) {
    throw;
  } catch (const std::string& complaint) {
    throw InputError({source.path}, "the geometry cannot be meshed: " + complaint);
  } catch (...) {
    throw InputError({source.path}, "the geometry cannot be meshed: the CAD kernel gave up");
  }
}

/// The mesh that Gmsh has.
/// @param has_geometry  whether Gmsh has made it of a geometry
RawMesh mesh_of_session(const MeshSource& source, bool has_geometry) {
  RawMesh mesh;
  mesh.dimension = mesh_dimension();
  if (mesh.dimension == 0)
    throw InputError(
        {source.path},
        "the mesh has no triangles, quads, tetrahedra or hexahedra: empty, cut off or not a mesh",
        common_formats());
  // Nodes first, then groups by their numbers, then what only a geometry can tell.
  const auto index = read_nodes(source.unit_in_metres, mesh);
  read_groups(source.path, index, mesh);
  if (has_geometry && mesh.dimension == 3 && source.element_order == 1)
    enclose_curved_volume(index, source.unit_in_metres, mesh);
  if (has_geometry && mesh.dimension == 3) {
    try {
      mesh.drawn_faces = drawn_faces(index, k_smooth_bend, source.unit_in_metres);
    } catch (const std::string& complaint) {
      mesh.notes.push_back("which facets are of one drawn face is not known (" + complaint +
                           "): rules of faces go by the facets of the mesh");
    }
  }
  return mesh;
}

/// Options that a script sets and that change a mesh where Gmsh saves it, or that the case decides.
std::vector<std::string> notes_of_options(const MeshSource& source) {
  std::vector<std::string> notes;
  double scaling = 1, order = 1;
  gmsh::option::getNumber("Mesh.ScalingFactor", scaling);
  gmsh::option::getNumber("Mesh.ElementOrder", order);
  if (scaling != 1)
    notes.push_back(
        fmt::format("the script sets Mesh.ScalingFactor to {:g}, by which Gmsh multiplies lengths where it "
                    "saves a mesh; here they "
                    "are taken as the script draws them, in the unit of the file (mesh.unit, --unit)",
                    scaling));
  if (const int wanted = source.element_order; order != wanted && order != 1)
    notes.push_back(
        fmt::format("the script sets Mesh.ElementOrder to {:g}; the order of the elements is {}, which "
                    "mesh.order decides",
                    order, wanted));
  return notes;
}

}  // namespace

RawMesh mesh_in_gmsh(const MeshSource& source, const std::function<void()>& make) {
  const Session session;
  gmsh::model::add("casting");
  make_casting(source, make);
  return mesh_of_session(source, false);
}

RawMesh read_with_gmsh(const MeshSource& source, FileHolds holds, const CastingGeometry* casting) {
  const std::string& path = source.path;
  check_constants(path, source.constants);
  const Session session(source.constants);
  open(path, holds);
  // A casting makes its bodies first; a geometry is meshed as it is; anything else is read.
  if (casting != nullptr) {
    make_casting(source, [&] { make_casting_mesh(source, *casting); });
  } else if (is_geometry(holds)) {
    name_groups(source, holds);
    try {
      tell_outlook(outlook_of(source, holds));
    } catch (const std::string&) {  // NOLINT: a geometry that cannot be measured can perhaps be meshed
    }
    generate(path, source.element_size / source.unit_in_metres, source.size_factor, source.element_order);
  }
  RawMesh mesh = mesh_of_session(source, casting != nullptr || is_geometry(holds));
  if (holds == FileHolds::script)
    for (std::string& note : notes_of_options(source)) mesh.notes.push_back(std::move(note));
  if (holds == FileHolds::shapes) mesh.centre_of_volume = centre_of_solids(source.unit_in_metres);
  return mesh;
}

}  // namespace solidus::mesh
