// One way to mesh parts and mould, in the reader's process (mesh/making/casting_geometry.hpp).
#include <gmsh.h>

#include <algorithm>
#include <map>
#include <utility>

#include "input/keys.hpp"
#include "mesh/gmsh/casting_mesh.hpp"
#include "mesh/gmsh/casting_parts.hpp"
#include "mesh/gmsh/casting_sizes.hpp"
#include "mesh/gmsh/seam_cuts.hpp"
#include "mesh/gmsh/size_callback.hpp"
#include "mesh/making/casting_geometry.hpp"
#include "mesh/making/meshing_outlook.hpp"
#include "mesh/making/meshing_ways.hpp"
#include "mesh/making/size_field.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

class Mesher {
 public:
  Mesher(const MeshSource& source, const CastingGeometry& geometry, const SolidWay& way)
      : source_(source), geometry_(geometry), way_(way) {
    CastingParts parts = make_parts(source, geometry, way.healing);
    parts_ = std::move(parts.bodies);
    overlap_ = std::move(parts.overlap);
  }

  /// Throws UnusableGeometry where a size is of a body that is not there.
  void check_sizes() const {
    for (const BodySize& s : geometry_.sizes)
      if (std::none_of(parts_.begin(), parts_.end(),
                       [&](const BodyVolumes& p) { return p.name == s.body; })) {
        std::vector<std::string> names;
        for (const BodyVolumes& part : parts_) names.push_back(part.name);
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
        if (!overlap_.empty())
          throw UnusableGeometry({source_.path}, "bodies overlap, and Gmsh could not mesh them: " + overlap_,
                                 "bodies that touch and do not overlap");
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
    for (const BodyVolumes& part : parts_) {
      std::vector<int> tags;
      for (const auto& volume : part.volumes) tags.push_back(volume.second);
      gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, tags), part.name);
    }
  }

 private:
  /// Sizes come from the callback alone, so all other sources of sizes are switched off. One thread and fixed
  /// algorithms make the same mesh every time.
  void set_options() const {
    using gmsh::option::setNumber;
    setNumber("Mesh.MeshSizeFromPoints", 0);
    setNumber("Mesh.MeshSizeFromCurvature", 0);
    setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
    setNumber("Mesh.Algorithm", way_.surfaces);
    setNumber("Mesh.Algorithm3D", way_.volumes);
    setNumber("Mesh.MaxNumThreads3D", 1);
    setNumber("Mesh.OptimizeThreshold", 0.45);
    if (source_.element_order == 2) setNumber("Mesh.SecondOrderIncomplete", 1);
  }

  /// A volume without elements is no success, though Gmsh may call it one.
  void require_elements() const {
    for (const BodyVolumes& part : parts_)
      for (const auto& volume : part.volumes) {
        std::vector<int> types;
        std::vector<std::vector<std::size_t>> elements, nodes;
        gmsh::model::mesh::getElements(types, elements, nodes, 3, volume.second);
        if (types.empty())
          refuse("Gmsh made no elements in the body '" + part.name + "'" + place_of_complaints(parts_));
      }
  }

  void mesh_once() {
    using gmsh::option::setNumber;
    set_options();
    // The background size is coarse enough for the whole, and no coarser than what limits of surfaces allow.
    CastingSizes sizes(parts_, geometry_, way_.scale, source_.unit_in_metres, way_.details);
    const auto& limits = sizes.limits();
    const Extent all = extent_of(all_volumes());
    double coarse = all.diagonal() / (geometry_.sizes.empty() ? 35 : 20);
    for (const auto& [entity, limit] : limits)
      if (entity.first == 2) coarse = std::min(coarse, limit);
    coarse = std::max(coarse, parts_extent() / 40);
    // First a coarse mesh of the surfaces is made, on which walls, curvature and narrow places are measured;
    // from these samples follow the fields of sizes, one for each rate of growth.
    try {
      setNumber("Mesh.MeshSizeMin", coarse);
      setNumber("Mesh.MeshSizeMax", coarse);
      generate_mesh(2);
      const std::vector<SizeSample> sampled = sizes.samples();
      std::map<double, SizeField> fields;
      for (const auto& [volume, growth] : sizes.growth())
        if (!fields.contains(growth)) fields.emplace(growth, SizeField(all.low, all.high, sampled, growth));
      const SizeField* least = fields.empty() ? nullptr : &fields.begin()->second;
      // What is to be expected is told before the expensive part begins.
      if (least != nullptr) {
        MeshingOutlook outlook = sizes.outlook(*least, source_.element_order);
        outlook.overlap = overlap_;  // the log says what it has said once only
        tell_outlook(outlook);
      }
      // The size at a place is the least of the limit of its entity, the background and the field of its
      // volume.
      set_size_callback([&](int dimension, int tag, double x, double y, double z) {
        const auto limit = limits.find({dimension, tag});
        double size = limit != limits.end() ? limit->second : coarse;
        if (least == nullptr) return size;
        const SizeField& field = dimension == 3 ? fields.at(sizes.growth().at(tag)) : *least;
        return std::min(size, field.at({x, y, z}));
      });
      setNumber("Mesh.MeshSizeMin", 0);
      setNumber("Mesh.MeshSizeMax", 1e22);
      // The surfaces are meshed again with these sizes, then the volumes. Rounds of relocation and
      // optimisation follow.
      gmsh::model::mesh::clear();
      generate_mesh(3);
      for (int round = 0; round < way_.rounds; ++round) {
        gmsh::model::mesh::optimize("Relocate3D", true);
        gmsh::model::mesh::optimize("", true);
      }
      gmsh::model::mesh::removeSizeCallback();
      gmsh::model::mesh::setOrder(source_.element_order);
      // Gmsh throws texts. The complaint goes to the user with the bodies and faces in which Gmsh could not
      // go on.
    } catch (const std::string& complaint) {
      const std::string place = place_of_complaints(parts_);
      const bool has_it = place.find(complaint) != std::string::npos;
      refuse("Gmsh could not mesh the geometry" + (has_it ? "" : ": " + complaint) + place);
    }
    require_elements();
  }

  [[noreturn]] void refuse(const std::string& what, const std::string& allowed = {}) const {
    throw InputError({source_.path}, what, allowed);
  }

  double parts_extent() const {
    gmsh::vectorpair parts;
    for (const BodyVolumes& part : parts_)
      if (!geometry_.mould || part.name != geometry_.mould->name)
        parts.insert(parts.end(), part.volumes.begin(), part.volumes.end());
    return extent_of(parts).diagonal();
  }

  const MeshSource& source_;
  const CastingGeometry& geometry_;
  const SolidWay& way_;
  std::vector<BodyVolumes> parts_;
  std::string overlap_;  ///< of CastingParts
};

}  // namespace

void make_casting_mesh(const MeshSource& source, const CastingGeometry& geometry) {
  Mesher mesher(source, geometry, way_of(solid_ways(), geometry.attempt));
  mesher.check_sizes();
  mesher.mesh();
  mesher.make_groups();
}

}  // namespace solidus::mesh
