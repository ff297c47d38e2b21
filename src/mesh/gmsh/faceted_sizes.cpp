/// Depth tells metal from cavities; sizes follow from the walls of each region, and the number of nodes
/// from areas and volumes over sizes.
#include "mesh/gmsh/faceted_sizes.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "input/keys.hpp"

namespace solidus::mesh {

namespace {

std::string tidy(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '-'; }, '_');
  return name;
}

double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Splits triangles until no edge is longer than a length: walls are measured from their centres.
void add_pieces(const std::array<Point, 3>& t, double longest, std::vector<std::array<Point, 3>>& pieces) {
  std::size_t k = 0;
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i)
    if (const double length = distance(t[i], t[(i + 1) % 3]); length > most) most = length, k = i;
  if (most <= longest) {
    pieces.push_back(t);
    return;
  }
  const Point &a = t[k], &b = t[(k + 1) % 3], &c = t[(k + 2) % 3];
  const Point middle = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
  add_pieces({a, middle, c}, longest, pieces);
  add_pieces({middle, b, c}, longest, pieces);
}

void check_sizes(const std::vector<FacetedRegion>& regions, const CastingGeometry& geometry,
                 const std::string& path) {
  for (const BodySize& size : geometry.sizes)
    if (std::ranges::none_of(regions, [&](const FacetedRegion& r) { return r.body == size.body; })) {
      std::vector<std::string> names;
      for (const FacetedRegion& r : regions) names.push_back(r.body);
      throw UnusableGeometry(
          {path}, "[[mesh.size]] is of the body '" + size.body + "', which the geometry does not have",
          one_of(names, size.body));
    }
}

}  // namespace

std::vector<FacetedRegion> faceted_regions(const ClosedShells& all, const CastingGeometry& geometry,
                                           const std::string& path) {
  std::vector<FacetedRegion> regions;
  std::map<std::string, int> outer;
  int number = 0, cavities = 0, cavity = 0;
  // Names are used only where one outer shell has them; else bodies are numbered.
  for (const Shell& shell : all.shells) {
    if (shell.depth % 2 == 0) ++outer[tidy(shell.name)];
    cavities += shell.depth % 2;
  }
  // A shell at an even depth is metal; at an odd depth it is a cavity, which becomes a core where there is a
  // mould.
  for (std::size_t s = 0; s < all.shells.size(); ++s) {
    const bool metal = all.shells[s].depth % 2 == 0;
    if (!metal && !geometry.mould) continue;
    FacetedRegion region;
    const std::string name = tidy(all.shells[s].name);
    if (metal)
      region.body = name.empty() || outer[name] > 1 ? "body_" + std::to_string(++number) : name;
    else
      region.body = geometry.mould->core + (cavities > 1 ? "_" + std::to_string(++cavity) : "");
    // The region's own shell, and the shells directly within it.
    region.shells = {s};
    for (std::size_t inner = 0; inner < all.shells.size(); ++inner)
      if (all.shells[inner].around == static_cast<int>(s)) region.shells.push_back(inner);
    regions.push_back(region);
  }
  if (geometry.mould) regions.push_back({geometry.mould->name, {}, 0});
  check_sizes(regions, geometry, path);
  return regions;
}

ShellBox box_of_shells(const ClosedShells& all) {
  ShellBox box{all.points.front(), all.points.front()};
  for (const Point& p : all.points)
    for (std::size_t i = 0; i < 3; ++i)
      box.low[i] = std::min(box.low[i], p[i]), box.high[i] = std::max(box.high[i], p[i]);
  return box;
}

ShellBox box_with_mould(const ClosedShells& all, const CastingGeometry& geometry, double unit) {
  ShellBox box = box_of_shells(all);
  if (geometry.mould)
    for (std::size_t i = 0; i < 3; ++i) {
      box.low[i] -= geometry.mould->walls[2 * i] / unit;
      box.high[i] += geometry.mould->walls[2 * i + 1] / unit;
    }
  return box;
}

FacetedSizes::FacetedSizes(const ClosedShells& all, const std::vector<FacetedRegion>& regions,
                           const CastingGeometry& geometry, const FacetedWay& way, double unit)
    : all_(all),
      regions_(regions),
      geometry_(geometry),
      way_(way),
      unit_(unit),
      coarse_(0),
      box_(box_with_mould(all, geometry, unit)) {
  coarse_ = distance(box_.low, box_.high) / 35;
  const std::vector<SizeSample> samples = sample_walls();
  for (const FacetedRegion& region : regions)
    if (!fields_.contains(growth(region.body)))
      fields_.emplace(growth(region.body), SizeField(box_.low, box_.high, samples, growth(region.body)));
}

const BodySize* FacetedSizes::size_of(const std::string& body) const {
  for (const BodySize& s : geometry_.sizes)
    if (s.body == body) return &s;
  return geometry_.sizes.empty() ? nullptr : &geometry_.sizes.front();
}

double FacetedSizes::largest(const std::string& body) const {
  const BodySize* size = size_of(body);
  return size != nullptr ? way_.scale * size->size / unit_ : coarse_;
}

double FacetedSizes::growth(const std::string& body) const {
  constexpr double k_usual = 0.4;
  const BodySize* size = size_of(body);
  return size != nullptr ? size->growth : k_usual;
}

/// Measures the walls of all bodies that have skins of their own, and keeps these.
std::vector<SizeSample> FacetedSizes::sample_walls() {
  std::vector<SizeSample> samples;
  // Long triangles are cut into pieces, or a wall would be measured at one place alone.
  const double longest_piece = distance(box_.low, box_.high) / 100;
  for (const FacetedRegion& region : regions_) {
    if (region.shells.empty()) continue;
    const BodySize* size = size_of(region.body);
    const double most = largest(region.body);
    std::vector<std::array<Point, 3>> skin;
    for (std::size_t i = 0; i < region.shells.size(); ++i)
      for (auto corners : corners_of(all_, all_.shells[region.shells[i]])) {
        // Shells within the region bound it from inside: their triangles are turned.
        if (i > 0) std::swap(corners[0], corners[1]);
        add_pieces(corners, std::max(most, longest_piece), skin);
      }
    // Where elements across a wall are asked for, the wall's thickness decides the size.
    const double across = size != nullptr ? size->across : 0;
    const std::vector<double> thickness =
        across > 0 ? wall_thickness(skin) : std::vector<double>(skin.size(), 0.0);
    const double least = size != nullptr ? way_.scale * size->smallest / unit_ : most;
    for (std::size_t t = 0; t < skin.size(); ++t)
      samples.push_back(
          {skin[t], thickness[t] > 0 ? std::clamp(way_.scale * thickness[t] / across, least, most) : most});
    skins_[region.body] = std::move(skin);
  }
  return samples;
}

double FacetedSizes::volume_of(const FacetedRegion& region) const {
  double volume = 0;
  for (const std::size_t s : region.shells)
    volume += (s == region.shells.front() ? 1 : -1) * enclosed_volume(all_, all_.shells[s]);
  if (!region.shells.empty()) return volume;
  volume = 1;  // the block: its box without what the outermost shells enclose
  for (std::size_t i = 0; i < 3; ++i) volume *= box_.high[i] - box_.low[i];
  for (const Shell& shell : all_.shells)
    if (shell.depth == 0) volume -= enclosed_volume(all_, shell);
  return volume;
}

std::vector<SkinPiece> FacetedSizes::pieces_of(const std::vector<std::array<Point, 3>>& skin,
                                               double largest) const {
  std::vector<SkinPiece> pieces;
  for (const std::array<Point, 3>& t : skin)
    pieces.push_back(skin_piece(t, fields_.begin()->second, largest));
  return pieces;
}

std::vector<double> FacetedSizes::sizes_of_shells() const {
  std::vector<double> sizes;
  const SizeField& field = fields_.begin()->second;
  // No element is larger than the size of any region at the shell.
  for (std::size_t s = 0; s < all_.shells.size(); ++s) {
    double most = coarse_;
    for (const FacetedRegion& region : regions_)
      if (std::ranges::count(region.shells, s) > 0) most = std::min(most, largest(region.body));
    // The one size that gives as many triangles as the field of sizes asks for.
    double area = 0, triangles = 0;
    for (const std::array<Point, 3>& t : corners_of(all_, all_.shells[s])) {
      const SkinPiece piece = skin_piece(t, field, most);
      area += piece.area;
      triangles += piece.area / (piece.size * piece.size);
    }
    sizes.push_back(triangles > 0 ? std::sqrt(area / triangles) : most);
  }
  return sizes;
}

MeshingOutlook FacetedSizes::outlook(int element_order) const {
  MeshingOutlook o;
  // For each region the nodes that its skin and volume will have, and the sides and sizes of elements of the
  // parts.
  for (const FacetedRegion& region : regions_) {
    const double most = largest(region.body), volume = volume_of(region);
    std::vector<SkinPiece> pieces;
    // Parts have a skin of their own, which gives size and number of its triangles.
    if (const auto skin = skins_.find(region.body); skin != skins_.end()) {
      pieces = pieces_of(skin->second, most);
      if (all_.shells[region.shells.front()].depth % 2 == 0) {  // a part and no core
        o.volume += volume * unit_ * unit_ * unit_;
        for (const SkinPiece& piece : pieces) {
          o.smallest = o.smallest > 0 ? std::min(o.smallest, unit_ * piece.size) : unit_ * piece.size;
          o.largest = std::max(o.largest, unit_ * piece.size);
        }
      }
    } else {  // the block around them, whose elements grow from the skins that it encloses
      for (const Shell& shell : all_.shells)
        if (shell.depth == 0) {
          const std::vector<SkinPiece> more = pieces_of(corners_of(all_, shell), most);
          pieces.insert(pieces.end(), more.begin(), more.end());
        }
    }
    o.nodes += expected_nodes(pieces, volume, most, growth(region.body));
  }
  // Nodes in the middles of edges multiply them.
  if (element_order == 2) o.nodes *= k_nodes_of_second_order;
  const ShellBox parts = box_of_shells(all_);
  for (std::size_t i = 0; i < 3; ++i) o.sides[i] = unit_ * (parts.high[i] - parts.low[i]);
  return o;
}

}  // namespace solidus::mesh
