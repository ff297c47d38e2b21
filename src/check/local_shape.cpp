/// Pieces of the skin are shared out to the deepest place and to others around it; the mould behind them is
/// shared likewise.
#include "check/local_shape.hpp"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <functional>
#include <numeric>
#include <span>
#include <utility>

#include "check/body_measures.hpp"
#include "mesh/block_part.hpp"
#include "mesh/body_faces.hpp"
#include "mesh/nearest_point.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::check {

namespace {

/// How far mould counts beyond the ball, over the depth of the place.
constexpr double k_mould = 6;
/// Parts of a skin by the mould behind it.
constexpr std::size_t k_layers = 3;
/// Points of the mould whose nearest face is looked for.
constexpr double k_most_points = 4e5;

/// A face of the skin.
struct Piece {
  mesh::Point centre{};
  double area = 0, inside = 0;  ///< whole and in the ball [m²]
  double mould = 0;             ///< whose nearest face it is [m³]
};

double squared_distance(const mesh::Point& a, const mesh::Point& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

using TreePoint = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;

TreePoint tree_point(const mesh::Point& x) {
  return {x[0], x[1], x[2]};
}

struct Ball {
  mesh::Point centre{};
  double radius = 0;
  bool has(const mesh::Point& x) const { return squared_distance(x, centre) <= radius * radius; }
};

mesh::Point centre_of(const mesh::Mesh& mesh, std::span<const Index> vertices) {
  mesh::Point centre{};
  for (const Index v : vertices)
    for (std::size_t d = 0; d < 3; ++d)
      centre[d] += mesh.x[as_size(v)][d] / static_cast<double>(vertices.size());
  return centre;
}

/// Points that stand for equal parts of an element or a face: its centre, and halfway from there to each of
/// its vertices.
template <class Visit>
void each_sample(const mesh::Mesh& mesh, std::span<const Index> vertices, const Visit& visit) {
  const mesh::Point centre = centre_of(mesh, vertices);
  visit(centre);
  for (const Index v : vertices) {
    mesh::Point x = mesh.x[as_size(v)];
    for (std::size_t d = 0; d < 3; ++d) x[d] = 0.5 * (x[d] + centre[d]);
    visit(x);
  }
}

double share_inside(const mesh::Mesh& mesh, std::span<const Index> vertices, const Ball& ball) {
  double inside = 0;
  each_sample(mesh, vertices, [&](const mesh::Point& x) { inside += ball.has(x) ? 1 : 0; });
  return inside / static_cast<double>(vertices.size() + 1);
}

/// Calls visit(vertices, volume) for the elements of a body that this process counts.
template <class Visit>
void each_element(const mesh::Mesh& mesh, AnalysisKind kind, std::size_t body, const Visit& visit) {
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (block.body != static_cast<int>(body)) continue;
    const auto vertices = as_size(mesh::vertex_count(block.shape));
    mesh::for_parts(block, [&](const mesh::ElementBlock& part, Index) {
      const mesh::BlockGeometry geometry(mesh, part, kind, mesh::stiffness_rule(part.shape));
      for (Index e = 0; e < part.n_counted; ++e)
        visit(std::span(part.element(e), vertices), element_volume(geometry, e));
    });
  }
}

/// The faces of a part of the skin of a body: all processes' that lie within a radius of the ball's centre,
/// and the whole area.
std::vector<Piece> pieces_of(const mesh::Mesh& mesh, AnalysisKind kind, std::size_t body,
                             const SkinPlace& skin, const Ball& ball, double radius, double& all) {
  std::vector<double> mine;
  const Ball near{ball.centre, radius};
  double area_of_all = 0;
  // Each face gives its whole area to the sum and, where it is near, its centre and what part of it
  // lies in the ball.
  const auto add = [&](std::span<const Index> vertices) {
    const double area = skin_area(mesh, vertices, kind);
    area_of_all += area;
    const mesh::Point centre = centre_of(mesh, vertices);
    if (!near.has(centre)) return;
    mine.insert(mine.end(),
                {centre[0], centre[1], centre[2], area, area * share_inside(mesh, vertices, ball)});
  };
  // Without a surface of its own the skin is what two bodies share.
  if (skin.surface.empty()) {
    mesh::each_body_face(mesh, [&](const mesh::BodyFace& face, std::span<const mesh::BodyFace> same) {
      if (face.body == static_cast<int>(body) && std::ranges::any_of(same, [&](const mesh::BodyFace& o) {
            return o.body == static_cast<int>(*skin.other);
          }))
        add(face.vertices());
    });
  } else if (const auto found = mesh.surfaces.find(skin.surface); found != mesh.surfaces.end()) {
    for (const mesh::ElementBlock& faces : found->second.faces)
      for (Index f = 0; f < faces.n_counted && faces.body == static_cast<int>(body); ++f)
        add(std::span(faces.element(f), as_size(mesh::vertex_count(faces.shape))));
  }
  all = parallel::global_sum(area_of_all);
  // Five numbers a face go through the exchange of plain numbers.
  constexpr std::size_t k_numbers = 5;
  const std::vector<double> numbers = processes::gather(mine);
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i + k_numbers <= numbers.size(); i += k_numbers)
    pieces.push_back({{numbers[i], numbers[i + 1], numbers[i + 2]}, numbers[i + 3], numbers[i + 4]});
  return pieces;
}

using Tree =
    boost::geometry::index::rtree<std::pair<TreePoint, std::size_t>, boost::geometry::index::quadratic<16>>;

Tree tree_of(const std::vector<Piece>& pieces) {
  std::vector<Tree::value_type> centres;
  for (std::size_t i = 0; i < pieces.size(); ++i) centres.emplace_back(tree_point(pieces[i].centre), i);
  return Tree(centres);
}

/// Gives the volume of a body within a radius of the ball's centre to the nearest pieces.
void share_mould(const mesh::Mesh& mesh, AnalysisKind kind, std::size_t mould, const Ball& near,
                 std::vector<Piece>& pieces) {
  // The faces' centres in a tree, since there may be many points of the mould for each.
  std::vector<mesh::Point> centres;
  for (const Piece& piece : pieces) centres.push_back(piece.centre);
  const mesh::NearestPoint nearest(centres);
  // A first pass counts the points, so that the second can take every so many and stay below the
  // bound.
  double points = 0;
  each_element(mesh, kind, mould, [&](std::span<const Index> vertices, double) {
    points += near.has(centre_of(mesh, vertices)) ? static_cast<double>(vertices.size() + 1) : 0.0;
  });
  const auto every = static_cast<std::size_t>(1 + points / k_most_points);
  std::vector<double> volumes(pieces.size(), 0.0);
  std::size_t number = 0, face = 0;  // that of the last point, which is near
  each_element(mesh, kind, mould, [&](std::span<const Index> vertices, double volume) {
    // A sample of the elements stands for all of them.
    if (number++ % every != 0) return;
    // Each sample carries an equal part of its element's volume.
    const double part = volume * static_cast<double>(every) / static_cast<double>(vertices.size() + 1);
    each_sample(mesh, vertices, [&](const mesh::Point& x) {
      if (!near.has(x)) return;
      face = nearest.find(x, face);
      volumes[face] += part;
    });
  });
  processes::sum(volumes);
  for (std::size_t i = 0; i < pieces.size(); ++i) pieces[i].mould = volumes[i];
}

/// Spreads the mould evenly over the faces around each: heat in it goes sideways as far as it goes in.
void spread_mould(double radius, std::vector<Piece>& pieces) {
  const Tree tree = tree_of(pieces);
  std::vector<double> spread;
  for (const Piece& piece : pieces) {
    // All faces within the radius share the mould that is nearest to any of them, by their areas.
    const Ball ball{piece.centre, radius};
    mesh::Point low = piece.centre, high = piece.centre;
    for (std::size_t d = 0; d < 3; ++d) low[d] -= radius, high[d] += radius;
    double area = 0, mould = 0;
    // The tree knows boxes; corners of the box outside of the ball are left out after that.
    const boost::geometry::model::box<TreePoint> box(tree_point(low), tree_point(high));
    for (auto found = tree.qbegin(boost::geometry::index::intersects(box)); found != tree.qend(); ++found) {
      const Piece& other = pieces[found->second];
      if (!ball.has(other.centre)) continue;
      area += other.area;
      mould += other.mould;
    }
    spread.push_back(mould * piece.area / area);
  }
  for (std::size_t i = 0; i < pieces.size(); ++i) pieces[i].mould = spread[i];
}

/// Splits the area in the ball into equal parts by how much mould is behind each of its faces.
std::vector<MouldLayer> layers_of(std::vector<Piece> pieces, double inside) {
  // Faces with little mould behind them first: cores and tongues between ribs before plain walls.
  std::ranges::stable_sort(pieces, {}, [](const Piece& piece) { return piece.mould / piece.area; });
  std::vector<MouldLayer> layers(1);
  double sum = 0;
  for (const Piece& piece : pieces) {
    if (!(piece.inside > 0)) continue;
    // A layer is full once its share of the area is reached.
    if (layers.size() < k_layers && sum >= inside * static_cast<double>(layers.size()) / k_layers)
      layers.emplace_back();
    layers.back().area += piece.inside;
    layers.back().volume += piece.mould * piece.inside / piece.area;
    sum += piece.inside;
  }
  // A part without any mould is joined with the next: its faces are finer than the mould's elements.
  for (std::size_t i = 0; i + 1 < layers.size();) {
    if (layers[i].volume > 0) {
      ++i;
      continue;
    }
    layers[i + 1].area += layers[i].area;
    layers.erase(layers.begin() + static_cast<std::ptrdiff_t>(i));
  }
  // Without mould at the last layer nothing can be said, and the caller takes the mean.
  if (!(layers.back().volume > 0)) layers.clear();
  return layers;
}

}  // namespace

LocalShape measure_around(const mesh::Mesh& mesh, AnalysisKind kind, std::size_t body,
                          const PlaceInMetal& place, const std::vector<SkinPlace>& skins) {
  LocalShape shape;
  // The ball of the place, and a larger one from which mould can take up its heat.
  const Ball ball{place.centre, place.radius};
  const Ball near{place.centre, place.radius + k_mould * place.depth};
  each_element(mesh, kind, body, [&](std::span<const Index> vertices, double volume) {
    shape.volume += volume * share_inside(mesh, vertices, ball);
  });
  shape.volume = parallel::global_sum(shape.volume);
  for (const SkinPlace& skin : skins) {
    double all = 0;
    // Faces beyond the mould that counts have mould of their own.
    std::vector<Piece> pieces = pieces_of(mesh, kind, body, skin, ball, 2 * near.radius, all);
    // What area of each skin lies in the ball.
    const double inside = std::transform_reduce(pieces.begin(), pieces.end(), 0.0, std::plus<>(),
                                                [](const Piece& piece) { return piece.inside; });
    shape.all.push_back(all);
    shape.area.push_back(inside);
    shape.layers.emplace_back();
    // Skins without a body behind them are films, which need no mould.
    if (!skin.other || !(inside > 0)) continue;
    share_mould(mesh, kind, *skin.other, near, pieces);
    spread_mould(place.spread, pieces);
    shape.layers.back() = layers_of(std::move(pieces), inside);
  }
  return shape;
}

}  // namespace solidus::check
