/// Shells become discrete faces of Gmsh, faces become volumes, volumes are meshed with the sizes of a
/// callback.
#include "mesh/gmsh/faceted_casting.hpp"

#include <gmsh.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "mesh/cgal/remeshed_skin.hpp"
#include "mesh/cgal/united_shells.hpp"
#include "mesh/gmsh/casting_parts.hpp"
#include "mesh/gmsh/faceted_sizes.hpp"
#include "mesh/gmsh/session.hpp"
#include "mesh/gmsh/size_callback.hpp"
#include "mesh/making/closed_shells.hpp"
#include "mesh/making/meshing_outlook.hpp"
#include "mesh/making/meshing_ways.hpp"
#include "mesh/surfaces/skin.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

using Tags = std::vector<int>;

class FacetedMaker {
 public:
  FacetedMaker(const MeshSource& source, const CastingGeometry& geometry, const std::vector<Facets>& parts)
      : source_(source),
        geometry_(geometry),
        way_(way_of(faceted_ways(), geometry.attempt)),
        unit_(source.unit_in_metres) {
    check();
    facets_ = united_shells(closed_shells(parts, source.path), source.path, notes_);
    all_ = facets_;
  }

  void make() {
    regions_of_facets_ = faceted_regions(facets_, geometry_, source_.path);
    sizes_.emplace(facets_, regions_of_facets_, geometry_, way_, unit_);
    tell_outlook(sizes_->outlook(source_.element_order));
    if (way_.skin != SkinOf::gmsh) make_new_skin();
    regions_ = faceted_regions(all_, geometry_, source_.path);
    add_skins();
    make_volumes();
    limit_entities();
    mesh();
  }

  /// Notes on the skin, after make().
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  void make_new_skin() {
    const RemeshedSkin skin = remeshed_skin(
        facets_, {sizes_->sizes_of_shells(), way_.angle, way_.skin == SkinOf::wrap}, source_.path);
    notes_.push_back(deviation_text(skin, unit_));
    all_ = skin.shells;
  }

  [[noreturn]] void refuse(const std::string& what, const std::string& allowed = {}) const {
    throw UnusableGeometry({source_.path}, what, allowed);
  }

  void check() const {
    const char* solids = "a STEP, BREP or IGES file, whose solids can be cut";
    if (!geometry_.risers.empty() || !geometry_.chills.empty() || !geometry_.gatings.empty())
      refuse("[[mesh.riser]], [[mesh.gating]] and [[mesh.chill]] cannot be joined to skins of triangles",
             solids);
    if (geometry_.symmetry) refuse("[mesh.symmetry] cannot cut skins of triangles", solids);
    if (geometry_.mould && std::ranges::count(geometry_.mould->walls, 0.0) > 0)
      refuse("a wall of [mesh.mould] has no thickness, but skins of triangles cannot be cut", solids);
    if (!source_.geometry.groups.empty())
      refuse("[[mesh.group]] with numbers, labels or boxes chooses solids and faces of a CAD program",
             "a rule: owner, normal, plane, nearest");
  }

  /// Whether Gmsh makes faces of the shells and new triangles on these.
  bool classifies() const { return way_.skin == SkinOf::gmsh && way_.angle > 0; }

  /// Gives Gmsh the shells, and learns which of its faces are of which shell.
  void add_skins() {
    faces_.resize(all_.shells.size());
    std::map<Point, std::size_t> shell_at;
    for (std::size_t s = 0; s < all_.shells.size(); ++s) {
      // Nodes of a shell get new tags in the order of their use.
      std::vector<std::size_t> tags, nodes;
      std::vector<double> x;
      std::map<Index, std::size_t> tag_of;
      for (const auto& triangle : all_.shells[s].triangles)
        for (const Index i : triangle) {
          const auto [place, is_new] = tag_of.emplace(i, as_size(i) + 1);
          nodes.push_back(place->second);
          if (!is_new) continue;
          const Point& p = all_.points[as_size(i)];
          shell_at[p] = s;
          tags.push_back(place->second);
          x.insert(x.end(), p.begin(), p.end());
        }
      // The shell becomes a discrete face of Gmsh.
      const int face = gmsh::model::addDiscreteEntity(2);
      gmsh::model::mesh::addNodes(2, face, tags, x);
      constexpr int k_triangle = 2;
      gmsh::model::mesh::addElementsByType(face, k_triangle, {}, nodes);
      if (!classifies()) faces_[s] = {face};
    }
    // Without classification that face is used as it is.
    if (!classifies()) return;
    constexpr double k_pi = 3.14159265358979323846;
    gmsh::model::mesh::classifySurfaces(way_.angle * k_pi / 180, true, true, k_pi);
    gmsh::model::mesh::createGeometry();
    // Classification has made faces of its own: each belongs to the shell that its first node came
    // from.
    gmsh::vectorpair faces;
    gmsh::model::getEntities(faces, 2);
    for (const auto& [dimension, face] : faces) {
      std::vector<std::size_t> tags;
      std::vector<double> x, parametric;
      gmsh::model::mesh::getNodes(tags, x, parametric, 2, face, true);
      const auto shell = x.size() < 3 ? shell_at.end() : shell_at.find({x[0], x[1], x[2]});
      if (shell == shell_at.end()) throw InputError({source_.path}, "a face of the skin was lost on the way");
      faces_[shell->second].push_back(face);
    }
  }

  /// The six faces of the block around everything.
  Tags add_block() const {
    namespace geo = gmsh::model::geo;
    const auto [low, high] = box_with_mould(all_, geometry_, unit_);
    // Corners by the bits of their number: x, y and z, low or high.
    std::array<int, 8> corner{};
    for (std::size_t c = 0; c < 8; ++c)
      corner[c] = geo::addPoint((c & 1U) != 0 ? high[0] : low[0], (c & 2U) != 0 ? high[1] : low[1],
                                (c & 4U) != 0 ? high[2] : low[2]);
    std::map<std::pair<std::size_t, std::size_t>, int> lines;
    // Each edge of the block is made once and used in both senses.
    const auto line = [&](std::size_t from, std::size_t to) {
      const auto key = std::minmax(from, to);
      if (!lines.contains(key)) lines[key] = geo::addLine(corner[key.first], corner[key.second]);
      return from < to ? lines[key] : -lines[key];
    };
    constexpr std::array<std::array<std::size_t, 4>, 6> k_faces = {
        {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
    Tags faces;
    for (const auto& f : k_faces)
      faces.push_back(geo::addPlaneSurface(
          {geo::addCurveLoop({line(f[0], f[1]), line(f[1], f[2]), line(f[2], f[3]), line(f[3], f[0])})}));
    return faces;
  }

  void make_volumes() {
    namespace geo = gmsh::model::geo;
    Tags loop_of;
    // A region lies between its outer shell and those within it; the mould lies around all outer shells.
    for (const Tags& faces : faces_) loop_of.push_back(geo::addSurfaceLoop(faces));
    for (FacetedRegion& region : regions_) {
      Tags loops;
      for (const std::size_t s : region.shells) loops.push_back(loop_of[s]);
      if (region.shells.empty()) {  // the block of mould
        loops.push_back(geo::addSurfaceLoop(add_block()));
        for (std::size_t s = 0; s < all_.shells.size(); ++s)
          if (all_.shells[s].depth == 0) loops.push_back(loop_of[s]);
      }
      region.volume = geo::addVolume(loops);
    }
    // Volumes of one body make one physical group.
    geo::synchronize();
    std::map<std::string, Tags> of_body;
    for (const FacetedRegion& region : regions_) of_body[region.body].push_back(region.volume);
    for (const auto& [body, volumes] : of_body)
      gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, volumes), body);
  }

  /// The largest size of every entity: the least of the bodies that it belongs to.
  void limit_entities() {
    for (const FacetedRegion& region : regions_) {
      const double largest = sizes_->largest(region.body);
      gmsh::vectorpair level = {{3, region.volume}};
      for (int dimension = 3; dimension >= 0; --dimension) {
        for (const auto& [d, tag] : level) {
          const auto [place, is_new] = limit_.emplace(std::pair(d, std::abs(tag)), largest);
          if (!is_new) place->second = std::min(place->second, largest);
        }
        gmsh::vectorpair below;
        if (dimension > 0) gmsh::model::getBoundary(level, below, false, false, false);
        level = below;
      }
    }
  }

  double size_at(int dimension, int tag, const Point& x) const {
    const double largest = limit_.at({dimension, tag});
    if (dimension == 3)
      for (const FacetedRegion& region : regions_)
        if (region.volume == tag) return std::min(largest, sizes_->within(region.body, x));
    return std::min(largest, sizes_->on_skins(x));
  }

  void mesh() {
    using gmsh::option::setNumber;
    // Sizes come from the callback alone; after the first mesh poor elements are improved twice.
    setNumber("Mesh.MeshSizeFromPoints", 0);
    setNumber("Mesh.MeshSizeFromCurvature", 0);
    setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
    setNumber("Mesh.Algorithm", 6);
    setNumber("Mesh.Algorithm3D", way_.volumes);
    setNumber("Mesh.MaxNumThreads3D", 1);
    setNumber("Mesh.OptimizeThreshold", 0.45);
    if (source_.element_order == 2) setNumber("Mesh.SecondOrderIncomplete", 1);
    set_size_callback([&](int dimension, int tag, double x, double y, double z) {
      return limit_.contains({dimension, tag}) ? size_at(dimension, tag, {x, y, z})
                                               : sizes_->on_skins({x, y, z});
    });
    // Mesh, moved nodes of poor elements, and the usual improvement, in this order.
    generate_mesh(3);
    gmsh::model::mesh::optimize("Relocate3D", true);
    gmsh::model::mesh::optimize("", true);
    gmsh::model::mesh::removeSizeCallback();
    gmsh::model::mesh::setOrder(source_.element_order);
    for (const FacetedRegion& region : regions_) {
      // At last every region must have elements.
      std::vector<int> types;
      std::vector<std::vector<std::size_t>> elements, nodes;
      gmsh::model::mesh::getElements(types, elements, nodes, 3, region.volume);
      if (types.empty())
        throw InputError({source_.path}, "Gmsh made no elements in the body '" + region.body + "'");
    }
  }

  const MeshSource& source_;
  const CastingGeometry& geometry_;
  const FacetedWay& way_;
  double unit_;
  std::vector<std::string> notes_;
  ClosedShells facets_;  ///< of the file
  ClosedShells all_;     ///< what is meshed: they, or new triangles in their place
  std::vector<FacetedRegion> regions_of_facets_, regions_;
  std::optional<FacetedSizes> sizes_;
  std::vector<Tags> faces_;                      ///< of each shell
  std::map<std::pair<int, int>, double> limit_;  ///< largest size by dimension and number
};

}  // namespace

RawMesh mesh_faceted_casting(const MeshSource& source, const CastingGeometry& geometry,
                             const std::vector<Facets>& parts) {
  FacetedMaker maker(source, geometry, parts);
  RawMesh mesh = mesh_in_gmsh(source, [&] { maker.make(); });
  mesh.notes.insert(mesh.notes.end(), maker.notes().begin(), maker.notes().end());
  return mesh;
}

std::vector<Facets> facets_of(const RawMesh& mesh, double unit_in_metres) {
  std::vector<Facets> parts;
  for (const auto& [name, group] : mesh.groups) {
    if (group.dimension != mesh.dimension) continue;
    Facets& facets = parts.emplace_back();
    facets.name = name;
    for (const SkinFace& face : skin_of(mesh, name)) {
      std::vector<Point> corners = face.corners;
      for (Point& p : corners)
        for (double& c : p) c /= unit_in_metres;
      for (std::size_t k = 2; k < corners.size(); ++k)
        facets.triangles.push_back({corners[0], corners[k - 1], corners[k]});
    }
  }
  return parts;
}

}  // namespace solidus::mesh
