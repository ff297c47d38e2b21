#include "mesh/gmsh/faceted_casting.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "input/keys.hpp"
#include "mesh/closed_shells.hpp"
#include "mesh/gmsh/casting_parts.hpp"
#include "mesh/gmsh/session.hpp"
#include "mesh/gmsh/size_callback.hpp"
#include "mesh/meshing_outlook.hpp"
#include "mesh/meshing_ways.hpp"
#include "mesh/size_field.hpp"
#include "mesh/skin.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

using Tags = std::vector<int>;

/// One volume, which several shells may bound.
struct Region {
  std::string body;
  std::vector<std::size_t> shells;
  int volume = 0;
};

std::string tidy(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '-'; }, '_');
  return name;
}

/// Splits triangles until no edge is longer than a length: walls are measured from their centres.
void add_pieces(const std::array<Point, 3>& t, double longest, std::vector<std::array<Point, 3>>& pieces) {
  std::size_t k = 0;
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point &a = t[i], &b = t[(i + 1) % 3];
    const double length = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
    if (length > most) most = length, k = i;
  }
  if (most <= longest) {
    pieces.push_back(t);
    return;
  }
  const Point &a = t[k], &b = t[(k + 1) % 3], &c = t[(k + 2) % 3];
  const Point middle = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
  add_pieces({a, middle, c}, longest, pieces);
  add_pieces({middle, b, c}, longest, pieces);
}

class FacetedMaker {
 public:
  FacetedMaker(const MeshSource& source, const CastingGeometry& geometry, const std::vector<Facets>& parts)
      : source_(source),
        geometry_(geometry),
        way_(way_of(faceted_ways(), geometry.attempt)),
        unit_(source.unit_in_metres),
        all_(closed_shells(parts, source.path)),
        faces_(all_.shells.size()) {}

  void make() {
    check();
    add_skins();
    name_bodies();
    make_volumes();
    mesh();
  }

 private:
  [[noreturn]] void refuse(const std::string& what, const std::string& allowed = {}) const {
    throw UnusableGeometry({source_.path}, what, allowed);
  }

  void check() const {
    const char* solids = "a STEP, BREP or IGES file, whose solids can be cut";
    if (geometry_.riser) refuse("[mesh.riser] cannot be joined to skins of triangles", solids);
    if (geometry_.symmetry) refuse("[mesh.symmetry] cannot cut skins of triangles", solids);
    if (geometry_.mould && std::ranges::count(geometry_.mould->walls, 0.0) > 0)
      refuse("a wall of [mesh.mould] has no thickness, but skins of triangles cannot be cut", solids);
    if (!source_.geometry.groups.empty())
      refuse("[[mesh.group]] with numbers, labels or boxes chooses solids and faces of a CAD program",
             "a rule: owner, normal, plane, nearest");
  }

  /// Gives Gmsh the shells, and learns which of its faces are of which shell.
  void add_skins() {
    std::map<Point, std::size_t> shell_at;
    for (std::size_t s = 0; s < all_.shells.size(); ++s) {
      std::vector<std::size_t> tags, nodes;
      std::vector<double> x;
      std::map<Index, std::size_t> tag_of;
      for (const auto& triangle : all_.shells[s].triangles)
        for (const Index i : triangle) {
          const auto [place, is_new] = tag_of.emplace(i, static_cast<std::size_t>(i) + 1);
          nodes.push_back(place->second);
          if (!is_new) continue;
          const Point& p = all_.points[static_cast<std::size_t>(i)];
          shell_at[p] = s;
          tags.push_back(place->second);
          x.insert(x.end(), p.begin(), p.end());
        }
      const int face = gmsh::model::addDiscreteEntity(2);
      gmsh::model::mesh::addNodes(2, face, tags, x);
      constexpr int k_triangle = 2;
      gmsh::model::mesh::addElementsByType(face, k_triangle, {}, nodes);
      if (way_.angle <= 0) faces_[s] = {face};
    }
    if (way_.angle <= 0) return;
    constexpr double k_pi = 3.14159265358979323846;
    gmsh::model::mesh::classifySurfaces(way_.angle * k_pi / 180, true, true, k_pi);
    gmsh::model::mesh::createGeometry();
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

  /// A shell of even depth bounds a body from outside, those in it from inside; odd ones bound cavities.
  void name_bodies() {
    std::map<std::string, int> outer;
    for (const Shell& shell : all_.shells)
      if (shell.depth % 2 == 0) ++outer[tidy(shell.name)];
    int number = 0, cavities = 0, cavity = 0;
    for (const Shell& shell : all_.shells) cavities += shell.depth % 2;
    for (std::size_t s = 0; s < all_.shells.size(); ++s) {
      const bool metal = all_.shells[s].depth % 2 == 0;
      if (!metal && !geometry_.mould) continue;
      Region region;
      const std::string name = tidy(all_.shells[s].name);
      if (metal)
        region.body = name.empty() || outer[name] > 1 ? "body_" + std::to_string(++number) : name;
      else
        region.body = geometry_.mould->core + (cavities > 1 ? "_" + std::to_string(++cavity) : "");
      region.shells = {s};
      for (std::size_t inner = 0; inner < all_.shells.size(); ++inner)
        if (all_.shells[inner].around == static_cast<int>(s)) region.shells.push_back(inner);
      regions_.push_back(region);
    }
    for (const BodySize& size : geometry_.sizes)
      if (std::ranges::none_of(regions_, [&](const Region& r) { return r.body == size.body; }) &&
          !(geometry_.mould && geometry_.mould->name == size.body)) {
        std::vector<std::string> names;
        for (const Region& r : regions_) names.push_back(r.body);
        if (geometry_.mould) names.push_back(geometry_.mould->name);
        refuse("[[mesh.size]] is of the body '" + size.body + "', which the geometry does not have",
               one_of(names, size.body));
      }
  }

  /// The six faces of the block around everything.
  Tags add_block() {
    namespace geo = gmsh::model::geo;
    Point low = all_.points.front(), high = low;
    for (const Point& p : all_.points)
      for (std::size_t i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] -= geometry_.mould->walls[2 * i] / unit_;
      high[i] += geometry_.mould->walls[2 * i + 1] / unit_;
    }
    low_ = low, high_ = high;
    std::array<int, 8> corner{};
    for (std::size_t c = 0; c < 8; ++c)
      corner[c] = geo::addPoint((c & 1U) != 0 ? high[0] : low[0], (c & 2U) != 0 ? high[1] : low[1],
                                (c & 4U) != 0 ? high[2] : low[2]);
    std::map<std::pair<std::size_t, std::size_t>, int> lines;
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
    for (const Tags& faces : faces_) loop_of.push_back(geo::addSurfaceLoop(faces));
    for (Region& region : regions_) {
      Tags loops;
      for (const std::size_t s : region.shells) loops.push_back(loop_of[s]);
      region.volume = geo::addVolume(loops);
    }
    if (geometry_.mould) {
      Tags loops = {geo::addSurfaceLoop(add_block())};
      for (std::size_t s = 0; s < all_.shells.size(); ++s)
        if (all_.shells[s].depth == 0) loops.push_back(loop_of[s]);
      regions_.push_back({geometry_.mould->name, {}, geo::addVolume(loops)});
    } else {
      low_ = high_ = all_.points.front();
      for (const Point& p : all_.points)
        for (std::size_t i = 0; i < 3; ++i)
          low_[i] = std::min(low_[i], p[i]), high_[i] = std::max(high_[i], p[i]);
    }
    geo::synchronize();
    std::map<std::string, Tags> of_body;
    for (const Region& region : regions_) of_body[region.body].push_back(region.volume);
    for (const auto& [body, volumes] : of_body)
      gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, volumes), body);
  }

  const BodySize* size_of(const std::string& body) const {
    for (const BodySize& s : geometry_.sizes)
      if (s.body == body) return &s;
    return geometry_.sizes.empty() ? nullptr : &geometry_.sizes.front();
  }

  double extent() const { return std::hypot(high_[0] - low_[0], high_[1] - low_[1], high_[2] - low_[2]); }

  /// The largest size of every entity, and the samples of the skins.
  std::vector<SizeSample> limits_and_samples(double coarse) {
    std::vector<SizeSample> samples;
    for (const Region& region : regions_) {
      const BodySize* size = size_of(region.body);
      const double largest = size != nullptr ? way_.scale * size->size / unit_ : coarse;
      growth_[region.volume] = size != nullptr ? size->growth : 0.4;
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
      if (region.shells.empty()) continue;  // the block: its skin is that of the others
      std::vector<std::array<Point, 3>> skin;
      for (std::size_t i = 0; i < region.shells.size(); ++i)
        for (auto corners : corners_of(all_, all_.shells[region.shells[i]])) {
          if (i > 0) std::swap(corners[0], corners[1]);
          add_pieces(corners, std::max(largest, extent() / 100), skin);
        }
      const double across = size != nullptr ? size->across : 0;
      const std::vector<double> thickness =
          across > 0 ? wall_thickness(skin) : std::vector<double>(skin.size(), 0.0);
      const double smallest = size != nullptr ? way_.scale * size->smallest / unit_ : largest;
      for (std::size_t t = 0; t < skin.size(); ++t)
        samples.push_back({skin[t], thickness[t] > 0
                                        ? std::clamp(way_.scale * thickness[t] / across, smallest, largest)
                                        : largest});
      skins_[region.volume] = std::move(skin);
    }
    return samples;
  }

  /// The outlook on the mesh, after limits_and_samples().
  MeshingOutlook outlook(const SizeField& field) const {
    MeshingOutlook o;
    Point low = all_.points.front(), high = low;
    for (const Point& p : all_.points)
      for (std::size_t i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
    double of_shells = 0;  // all that the outermost shells enclose
    for (const Shell& shell : all_.shells)
      if (shell.depth == 0) of_shells += enclosed_volume(all_, shell);
    for (const Region& region : regions_) {
      const double largest = limit_.at({3, region.volume});
      std::vector<SkinPiece> pieces;
      double volume = 0;
      if (const auto skin = skins_.find(region.volume); skin != skins_.end()) {
        for (const std::size_t s : region.shells)
          volume += (s == region.shells.front() ? 1 : -1) * enclosed_volume(all_, all_.shells[s]);
        for (const std::array<Point, 3>& t : skin->second) pieces.push_back(skin_piece(t, field, largest));
        if (all_.shells[region.shells.front()].depth % 2 == 0) {  // a part and no core
          o.volume += volume * unit_ * unit_ * unit_;
          for (const SkinPiece& piece : pieces) {
            o.smallest = o.smallest > 0 ? std::min(o.smallest, unit_ * piece.size) : unit_ * piece.size;
            o.largest = std::max(o.largest, unit_ * piece.size);
          }
        }
      } else {  // the block around them, whose elements grow from the skins that it encloses
        volume = (high_[0] - low_[0]) * (high_[1] - low_[1]) * (high_[2] - low_[2]) - of_shells;
        for (std::size_t s = 0; s < all_.shells.size(); ++s)
          if (all_.shells[s].depth == 0)
            for (const std::array<Point, 3>& t : corners_of(all_, all_.shells[s]))
              pieces.push_back(skin_piece(t, field, largest));
      }
      o.nodes += expected_nodes(pieces, volume, largest, growth_.at(region.volume));
    }
    if (source_.element_order == 2) o.nodes *= k_nodes_of_second_order;
    for (std::size_t i = 0; i < 3; ++i) o.sides[i] = unit_ * (high[i] - low[i]);
    return o;
  }

  void mesh() {
    using gmsh::option::setNumber;
    setNumber("Mesh.MeshSizeFromPoints", 0);
    setNumber("Mesh.MeshSizeFromCurvature", 0);
    setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
    setNumber("Mesh.Algorithm", 6);
    setNumber("Mesh.Algorithm3D", way_.volumes);
    setNumber("Mesh.MaxNumThreads3D", 1);
    setNumber("Mesh.OptimizeThreshold", 0.45);
    if (source_.element_order == 2) setNumber("Mesh.SecondOrderIncomplete", 1);
    const double coarse = extent() / 35;
    const std::vector<SizeSample> samples = limits_and_samples(coarse);
    std::map<double, SizeField> fields;
    for (const auto& [volume, growth] : growth_)
      if (!fields.contains(growth)) fields.emplace(growth, SizeField(low_, high_, samples, growth));
    const SizeField& least = fields.begin()->second;
    tell_outlook(outlook(least));
    set_size_callback([&](int dimension, int tag, double x, double y, double z) {
      const auto limit = limit_.find({dimension, tag});
      const double size = limit != limit_.end() ? limit->second : coarse;
      const auto growth = growth_.find(tag);
      const SizeField& field = dimension == 3 && growth != growth_.end() ? fields.at(growth->second) : least;
      return std::min(size, field.at({x, y, z}));
    });
    generate_mesh(3);
    gmsh::model::mesh::optimize("Relocate3D", true);
    gmsh::model::mesh::optimize("", true);
    gmsh::model::mesh::removeSizeCallback();
    gmsh::model::mesh::setOrder(source_.element_order);
    for (const Region& region : regions_) {
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
  ClosedShells all_;
  std::vector<Tags> faces_;  ///< of each shell
  std::vector<Region> regions_;
  Point low_{}, high_{};
  std::map<std::pair<int, int>, double> limit_;             ///< largest size by dimension and number
  std::map<int, double> growth_;                            ///< by volume
  std::map<int, std::vector<std::array<Point, 3>>> skins_;  ///< by volume, without the block
};

}  // namespace

RawMesh mesh_faceted_casting(const MeshSource& source, const CastingGeometry& geometry,
                             const std::vector<Facets>& parts) {
  return mesh_in_gmsh(source, [&] { FacetedMaker(source, geometry, parts).make(); });
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
