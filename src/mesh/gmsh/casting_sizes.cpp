/// A first coarse mesh of the surfaces shows walls, narrow faces and short curves; each of its triangles
/// becomes a sample of the size field.
#include "mesh/gmsh/casting_sizes.hpp"

#include <algorithm>
#include <cmath>

namespace solidus::mesh {

namespace occ = gmsh::model::occ;

const BodySize* size_of(const CastingGeometry& geometry, const std::string& body) {
  for (const BodySize& s : geometry.sizes)
    if (s.body == body) return &s;
  return geometry.sizes.empty() ? nullptr : &geometry.sizes.front();
}

CastingSizes::CastingSizes(const std::vector<BodyVolumes>& parts, const CastingGeometry& geometry,
                           double scale, double unit, bool details)
    : parts_(parts), geometry_(geometry), scale_(scale), unit_(unit), details_(details) {
  limit_entities();
}

/// The largest size of every entity: the least of the bodies that it belongs to.
void CastingSizes::limit_entities() {
  // An entity of several bodies gets the smallest of their sizes.
  const auto note = [&](int dimension, int tag, double limit) {
    const auto [place, is_new] = limit_.emplace(std::pair(dimension, tag), limit);
    if (!is_new) place->second = std::min(place->second, limit);
  };
  for (const BodyVolumes& part : parts_) {
    const BodySize* size = size_of(geometry_, part.name);
    if (size == nullptr) continue;
    for (const auto& volume : part.volumes) {
      // The size of a body holds for its volumes and for everything that bounds them.
      const double limit = scale_ * size->size / unit_;
      note(3, volume.second, limit);
      growth_[volume.second] = size->growth;
      gmsh::vectorpair faces, curves, points;
      gmsh::model::getBoundary({volume}, faces, false, false, false);
      gmsh::model::getBoundary(faces, curves, false, false, false);
      gmsh::model::getBoundary(curves, points, false, false, false);
      for (const auto& list : {faces, curves, points})
        for (const auto& entity : list) note(entity.first, std::abs(entity.second), limit);
    }
  }
}

/// Triangles of the first, coarse mesh of a body's faces, outward, without those between two of its volumes.
std::vector<std::array<Point, 3>> CastingSizes::skin_of(const BodyVolumes& part) const {
  // A face that two volumes of the body share lies inside of it.
  std::map<int, int> volumes_beside;
  for (const auto& volume : part.volumes)
    for (const int face : boundary_of(volume.second)) ++volumes_beside[face];
  std::vector<std::array<Point, 3>> skin;
  std::vector<std::size_t> first{0};  // triangle of each face
  // Triangles of each face stay together, so that its sense can be changed as a whole.
  for (const auto& [face, count] : volumes_beside) {
    if (count > 1) continue;
    std::vector<std::size_t> elements, nodes;
    gmsh::model::mesh::getElementsByType(2, elements, nodes, face);
    for (std::size_t k = 0; k + 2 < nodes.size(); k += 3)
      skin.push_back({x_.at(nodes[k]), x_.at(nodes[k + 1]), x_.at(nodes[k + 2])});
    first.push_back(skin.size());
  }
  // Triangles follow the face and not the volume. Of some of each face it is seen whether they look inward.
  for (std::size_t f = 0; f + 1 < first.size(); ++f) {
    constexpr std::size_t k_votes = 5;
    const std::size_t n = first[f + 1] - first[f], stride = 1 + n / k_votes;
    std::size_t inward = 0, votes = 0;
    for (std::size_t t = first[f]; t < first[f + 1]; t += stride, ++votes)
      inward += looks_inward(skin, t) ? 1U : 0U;
    if (2 * inward > votes)
      for (std::size_t t = first[f]; t < first[f + 1]; ++t) std::swap(skin[t][1], skin[t][2]);
  }
  return skin;
}

void CastingSizes::read_nodes() {
  std::vector<std::size_t> tags;
  std::vector<double> x, parametric;
  gmsh::model::mesh::getNodes(tags, x, parametric);
  x_.clear();
  for (std::size_t i = 0; i < tags.size(); ++i) x_[tags[i]] = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
}

/// Measures the thickness of the walls on a first mesh of the surfaces.
std::vector<SizeSample> CastingSizes::samples() {
  std::vector<SizeSample> all;
  read_nodes();
  for (const BodyVolumes& part : parts_) {
    const BodySize* size = size_of(geometry_, part.name);
    if (size == nullptr) continue;
    // Walls are measured only where the body's size asks for elements across them.
    const auto skin = skin_of(part);
    const std::vector<double> thickness =
        size->across > 0 ? wall_thickness(skin) : std::vector<double>(skin.size(), 0.0);
    const double largest = scale_ * size->size / unit_, smallest = scale_ * size->smallest / unit_;
    for (std::size_t t = 0; t < skin.size(); ++t)
      all.push_back({skin[t], thickness[t] > 0
                                  ? std::clamp(scale_ * thickness[t] / size->across, smallest, largest)
                                  : largest});
  }
  // Details beyond walls: narrow faces and short curves would be lost at that size.
  if (details_) {
    sample_narrow_faces(all);
    sample_short_curves(all);
  }
  return all;
}

MeshingOutlook CastingSizes::outlook(const SizeField& field, int element_order) const {
  // The number of nodes is estimated from the skin of each part, its volume and the growth of sizes inward,
  // before anything is meshed in volume.
  MeshingOutlook o;
  gmsh::vectorpair parts;
  for (const BodyVolumes& part : parts_) {
    const BodySize* size = size_of(geometry_, part.name);
    if (size == nullptr) continue;
    const double largest = scale_ * size->size / unit_;
    double volume = 0;
    // Volumes are those of the geometry itself.
    for (const auto& entity : part.volumes) {
      double one = 0;
      occ::getMass(3, entity.second, one);
      volume += one;
    }
    std::vector<SkinPiece> skin;
    for (const std::array<Point, 3>& t : skin_of(part)) skin.push_back(skin_piece(t, field, largest));
    o.nodes += expected_nodes(skin, volume, largest, size->growth);
    // Mould and cores that are made around the part say nothing of the user's unit; extent and sizes are told
    // of the parts alone.
    const bool made_around = geometry_.mould && (part.name == geometry_.mould->name ||
                                                 part.name.starts_with(geometry_.mould->core));
    if (made_around) continue;
    parts.insert(parts.end(), part.volumes.begin(), part.volumes.end());
    o.volume += volume * unit_ * unit_ * unit_;
    for (const SkinPiece& piece : skin) {
      o.smallest = o.smallest > 0 ? std::min(o.smallest, unit_ * piece.size) : unit_ * piece.size;
      o.largest = std::max(o.largest, unit_ * piece.size);
    }
  }
  if (element_order == 2) o.nodes *= k_nodes_of_second_order;
  if (parts.empty()) parts = all_volumes();
  const Extent all = extent_of(parts);
  for (std::size_t i = 0; i < 3; ++i) o.sides[i] = unit_ * (all.high[i] - all.low[i]);
  return o;
}

/// On a face that is narrower than an element, of the width 2 area / boundary, elements are as small.
void CastingSizes::sample_narrow_faces(std::vector<SizeSample>& all) const {
  constexpr double k_least =
      0.25;  // of the limit: steps of a hundredth of a part would take most of its nodes
  // The width of a face from its area and its boundary, as of a strip.
  for (const auto& [entity, limit] : limit_) {
    if (entity.first != 2) continue;
    double area = 0, around = 0;
    occ::getMass(2, entity.second, area);
    gmsh::vectorpair curves;
    gmsh::model::getBoundary({entity}, curves, false, false, false);
    for (const auto& [dimension, tag] : curves) {
      double length = 0;
      occ::getMass(1, std::abs(tag), length);
      around += length;
    }
    const double width = around > 0 ? 2 * area / around : limit;
    // A face as wide as an element needs nothing.
    if (!(width > 0) || width > limit) continue;
    std::vector<std::size_t> elements, nodes;
    gmsh::model::mesh::getElementsByType(2, elements, nodes, entity.second);
    for (std::size_t k = 0; k + 2 < nodes.size(); k += 3)
      all.push_back(
          {{x_.at(nodes[k]), x_.at(nodes[k + 1]), x_.at(nodes[k + 2])}, std::max(width, k_least * limit)});
  }
}

/// Next to a curve that is shorter than an element, elements are as small as the curve: else they are
/// slivers.
void CastingSizes::sample_short_curves(std::vector<SizeSample>& all) const {
  constexpr double k_least = 0.12;  // of the limit: what is shorter is not worth its elements
  for (const auto& [entity, limit] : limit_) {
    if (entity.first != 1) continue;
    double length = 0;
    occ::getMass(1, entity.second, length);
    if (!(length > 0) || length > limit) continue;
    gmsh::vectorpair ends;
    gmsh::model::getBoundary({entity}, ends, false, false, false);
    for (const auto& [dimension, tag] : ends) {
      std::vector<double> x;
      gmsh::model::getValue(0, std::abs(tag), {}, x);
      const Point p = {x[0], x[1], x[2]};
      all.push_back({{p, p, p}, std::max(length, k_least * limit)});
    }
  }
}

}  // namespace solidus::mesh
