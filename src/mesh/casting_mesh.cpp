// One way to mesh parts and mould, in the reader's process (mesh/casting_geometry.hpp).
#include <gmsh.h>

#include <algorithm>
#include <map>

#include "input/keys.hpp"
#include "mesh/casting_geometry.hpp"
#include "mesh/casting_parts.hpp"
#include "mesh/casting_sizes.hpp"
#include "mesh/seam_cuts.hpp"
#include "mesh/size_field.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

/// A way to mesh.
struct Way {
  const char* what;
  int surfaces = 6, volumes = 1;  ///< Gmsh's numbers of algorithms: frontal, Delaunay
  double healing = 0;             ///< tolerance, of the extent of the parts; 0: none
  double scale = 1;               ///< of all sizes
  int rounds = 1;                 ///< of optimisation
  bool details = true;            ///< smaller elements at narrow faces and short curves
  bool cuts = false;              ///< bodies are cut along the seams of faces that cannot be meshed
};
// Elements that become as small as a narrow face is may themselves be what is poor: the second way leaves
// them out. Cutting helps where Gmsh finds no mesh of a closed face, and else gives what the first way gave.
constexpr Way k_ways[] = {
    {"as the file is, Delaunay"},
    {"without smaller elements at narrow faces", 6, 1, 0, 1, 4, false},
    {"HXT", 6, 10},
    {"elements of 0.9 of the size", 6, 1, 0, 0.9, 4},
    {"healed, elements of 0.8 of the size", 6, 1, 1e-5, 0.8, 4},
    {"bodies cut along the seams of closed faces", 6, 1, 0, 1, 4, true, true},
    {"healed more, surfaces by MeshAdapt, elements of 0.7 of the size", 1, 1, 1e-4, 0.7, 4},
    {"surfaces by Delaunay, HXT, elements of half the size", 5, 10, 0, 0.5, 4},
    {"healed much, elements of half the size", 6, 1, 1e-3, 0.5, 4}};

class Mesher {
 public:
  Mesher(const MeshSource& source, const CastingGeometry& geometry, const Way& way)
      : source_(source), geometry_(geometry), way_(way), parts_(make_parts(source, geometry, way.healing)) {}

  /// Throws UnusableGeometry where a size is of a body that is not there.
  void check_sizes() const {
    for (const BodySize& s : geometry_.sizes)
      if (std::none_of(parts_.begin(), parts_.end(),
                       [&](const GeometryBody& p) { return p.name == s.body; })) {
        std::vector<std::string> names;
        for (const GeometryBody& part : parts_) names.push_back(part.name);
        throw UnusableGeometry(
            {source_.path}, "[[mesh.size]] is of the body '" + s.body + "', which the geometry does not have",
            one_of(names, s.body));
      }
  }

  /// Meshes; where Gmsh complains of closed faces and the way has it so, cuts the bodies there and tries
  /// again.
  void mesh() {
    constexpr int k_most_cuts = 3;
    for (int cuts = 0;; ++cuts) {
      try {
        mesh_once();
        return;
      } catch (const InputError&) {
        if (!way_.cuts || cuts == k_most_cuts || !cut_along_seams(parts_, surfaces_at_fault())) throw;
        gmsh::model::mesh::clear();
        gmsh::logger::stop();  // what is complained of so far is mended
        gmsh::logger::start();
      }
    }
  }

  /// Names the volumes of each body, once: they change with every cut, and Gmsh keeps the names of groups
  /// that are taken away.
  void make_groups() const {
    for (const GeometryBody& part : parts_) {
      std::vector<int> tags;
      for (const auto& volume : part.volumes) tags.push_back(volume.second);
      gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, tags), part.name);
    }
  }

 private:
  void mesh_once() {
    using gmsh::option::setNumber;
    setNumber("Mesh.MeshSizeFromPoints", 0);
    setNumber("Mesh.MeshSizeFromCurvature", 0);
    setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
    setNumber("Mesh.Algorithm", way_.surfaces);
    setNumber("Mesh.Algorithm3D", way_.volumes);
    setNumber("Mesh.MaxNumThreads3D", 1);
    setNumber("Mesh.OptimizeThreshold", 0.45);
    if (source_.element_order == 2) setNumber("Mesh.SecondOrderIncomplete", 1);
    CastingSizes sizes(parts_, geometry_, way_.scale, source_.unit_in_metres, way_.details);
    const auto& limits = sizes.limits();
    const Extent all = extent_of(all_volumes());
    double coarse = all.diagonal() / (geometry_.sizes.empty() ? 35 : 20);
    for (const auto& [entity, limit] : limits)
      if (entity.first == 2) coarse = std::min(coarse, limit);
    coarse = std::max(coarse, parts_extent() / 40);
    try {
      setNumber("Mesh.MeshSizeMin", coarse);
      setNumber("Mesh.MeshSizeMax", coarse);
      generate_mesh(2);
      const std::vector<SizeSample> sampled = sizes.samples();
      std::map<double, SizeField> fields;
      for (const auto& [volume, growth] : sizes.growth())
        if (!fields.contains(growth)) fields.emplace(growth, SizeField(all.low, all.high, sampled, growth));
      const SizeField* least = fields.empty() ? nullptr : &fields.begin()->second;
      gmsh::model::mesh::setSizeCallback([&](int dimension, int tag, double x, double y, double z) {
        const auto limit = limits.find({dimension, tag});
        double size = limit != limits.end() ? limit->second : coarse;
        if (least == nullptr) return size;
        const SizeField& field = dimension == 3 ? fields.at(sizes.growth().at(tag)) : *least;
        return std::min(size, field.at({x, y, z}));
      });
      setNumber("Mesh.MeshSizeMin", 0);
      setNumber("Mesh.MeshSizeMax", 1e22);
      gmsh::model::mesh::clear();
      generate_mesh(3);
      for (int round = 0; round < way_.rounds; ++round) {
        gmsh::model::mesh::optimize("Relocate3D", true);
        gmsh::model::mesh::optimize("", true);
      }
      gmsh::model::mesh::removeSizeCallback();
      gmsh::model::mesh::setOrder(source_.element_order);
    } catch (const std::string& complaint) {
      const std::string place = place_of_complaints(parts_);
      const bool has_it = place.find(complaint) != std::string::npos;
      refuse("Gmsh could not mesh the geometry" + (has_it ? "" : ": " + complaint) + place);
    }
    for (const GeometryBody& part : parts_)
      for (const auto& volume : part.volumes) {
        std::vector<int> types;
        std::vector<std::vector<std::size_t>> elements, nodes;
        gmsh::model::mesh::getElements(types, elements, nodes, 3, volume.second);
        if (types.empty())
          refuse("Gmsh made no elements in the body '" + part.name + "'" + place_of_complaints(parts_));
      }
  }

  [[noreturn]] void refuse(const std::string& what, const std::string& allowed = {}) const {
    throw InputError({source_.path}, what, allowed);
  }

  double parts_extent() const {
    gmsh::vectorpair parts;
    for (const GeometryBody& part : parts_)
      if (!geometry_.mould || part.name != geometry_.mould->name)
        parts.insert(parts.end(), part.volumes.begin(), part.volumes.end());
    return extent_of(parts).diagonal();
  }

  const MeshSource& source_;
  const CastingGeometry& geometry_;
  const Way& way_;
  std::vector<GeometryBody> parts_;
};

}  // namespace

int n_meshing_attempts() {
  return static_cast<int>(std::size(k_ways));
}

int n_cheap_meshing_attempts() {
  constexpr double k_fine = 0.8;
  return static_cast<int>(std::count_if(std::begin(k_ways), std::end(k_ways),
                                        [](const Way& w) { return w.scale >= k_fine && !w.cuts; }));
}

std::string meshing_attempt(int attempt) {
  return k_ways[static_cast<std::size_t>(attempt)].what;
}

void make_casting_mesh(const MeshSource& source, const CastingGeometry& geometry) {
  const auto attempt = std::min(static_cast<std::size_t>(geometry.attempt), std::size(k_ways) - 1);
  Mesher mesher(source, geometry, k_ways[attempt]);
  mesher.check_sizes();
  mesher.mesh();
  mesher.make_groups();
}

}  // namespace solidus::mesh
