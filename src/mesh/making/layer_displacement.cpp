/// Directions are the means of what the faces of a vertex want; lengths are made even, and shortened where
/// elements would be crushed.
#include "mesh/making/layer_displacement.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/making/layer_elements.hpp"
#include "mesh/making/layer_spread.hpp"
#include "mesh/quality.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

constexpr int k_first_sweeps = 200;      ///< of the mean of neighbours, before the first round
constexpr int k_sweeps = 20;             ///< and before each further one
constexpr int k_even_rounds = 40;        ///< of thinner layers, with the body's vertices following
constexpr double k_thinner = 0.8;        ///< of layers that were too thick
constexpr double k_steepest = 0.4;       ///< change of the thickness over the length of an edge of the wall
constexpr int k_rounds = 60;             ///< of moving less, one vertex at a time
constexpr double k_less = 0.85;          ///< of a displacement that was too large
constexpr double k_flatter = 0.5;        ///< the least share of its quality that an element keeps
constexpr double k_good_enough = 0.35;   ///< or the quality that is enough
constexpr double k_least_cosine = 0.15;  ///< between a displacement and the normal of each of its faces
constexpr double k_least_share = 0.06;   ///< of the thickness; thinner layers are none
constexpr double k_one_plane = 1e-4;     ///< sine of the angle of normals that count as one

Point difference(const Point& p, const Point& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

double dot(const Point& p, const Point& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

Point cross(const Point& s, const Point& t) {
  return {s[1] * t[2] - s[2] * t[1], s[2] * t[0] - s[0] * t[2], s[0] * t[1] - s[1] * t[0]};
}

void add(Point& p, double factor, const Point& q) {
  for (std::size_t i = 0; i < 3; ++i) p[i] += factor * q[i];
}

/// The shape with the vertices alone: mid nodes follow later.
Shape linear(Shape shape) {
  switch (shape) {
    case Shape::tri6:
      return Shape::tri3;
    case Shape::quad8:
      return Shape::quad4;
    case Shape::tet10:
      return Shape::tet4;
    case Shape::hex20:
      return Shape::hex8;
    default:
      return shape;
  }
}

double normalise(Point& p) {
  const double length = std::sqrt(dot(p, p));
  if (length > 0)
    for (double& c : p) c /= length;
  return length;
}

/// The unit normal of a face at its vertex `a`, into the body (faces are outward, as elements have them), and
/// the angle there, by which it counts.
struct Corner {
  Index node;
  Point normal;
  double angle;
  int surface = -1;  ///< of the wall; -1: none
};

/// Sign of the orientation of the element that a face is of: meshes are not yet oriented.
double orientation(const RawMesh& mesh, const RawGroup& body, const FaceOwner& owner) {
  const RawBlock& block = body.blocks[as_size(owner.block)];
  const Index* nodes =
      block.nodes.data() + static_cast<std::ptrdiff_t>(owner.element) * node_count(block.shape);
  return element_quality(mesh, linear(block.shape), nodes) < 0 ? -1 : 1;
}

void add_corners(const RawMesh& mesh, const WallFace& face, double sign, std::vector<Corner>& corners) {
  const int n = face.n_vertices;
  // The normal at each corner, weighted by the angle there, so that it does not depend on how faces are
  // divided.
  for (int a = 0; a < n; ++a) {
    const auto node = [&](int b) { return face.nodes[as_size((a + b + n) % n)]; };
    const Point& x = mesh.x[as_size(node(0))];
    Point next = difference(mesh.x[as_size(node(1))], x);
    Corner corner{node(0), {}, 1, face.surface};
    if (n == 2) {
      corner.normal = a == 0 ? Point{-next[1], next[0], 0} : Point{next[1], -next[0], 0};
    } else {
      Point last = difference(mesh.x[as_size(node(-1))], x);
      normalise(next);
      normalise(last);
      corner.angle = std::acos(std::clamp(dot(next, last), -1.0, 1.0));
      corner.normal = cross(last, next);
    }
    // In the plane the normal is the line turned by a right angle; in space it is that of the two
    // edges at the corner.
    normalise(corner.normal);
    for (double& c : corner.normal) c *= sign;
    corners.push_back(corner);
  }
}

std::vector<Corner> corners_of(const RawMesh& mesh, const RawGroup& body, const WallTopology& wall,
                               const std::vector<WallFace>& faces) {
  std::vector<Corner> corners;
  for (const WallFace& face : faces) {
    const FaceOwner& owner = wall.faces.at(face_key(face.nodes.data(), face.n_vertices));
    add_corners(mesh, face, orientation(mesh, body, owner), corners);
  }
  std::stable_sort(corners.begin(), corners.end(),
                   [](const Corner& p, const Corner& q) { return p.node < q.node; });
  return corners;
}

/// The direction from which all faces of a vertex are seen best: their mean, turned to the worst one.
Point best_direction(const Corner* first, const Corner* last) {
  Point d{};
  for (const Corner* c = first; c != last; ++c) add(d, c->angle, c->normal);
  normalise(d);
  for (int round = 0; round < 30; ++round) {
    const Corner* worst = std::min_element(
        first, last, [&](const Corner& p, const Corner& q) { return dot(p.normal, d) < dot(q.normal, d); });
    if (dot(worst->normal, d) > 0.5) break;
    add(d, 0.1, worst->normal);
    normalise(d);
  }
  return d;
}

/// The part of a direction within the planes of the faces that the wall meets at a vertex of its rim; zero at
/// a corner of them and where it nearly vanishes.
Point along(Point d, const Corner* first, const Corner* last) {
  std::vector<Point> normals;
  for (const Corner* c = first; c != last; ++c) {
    Point n = c->normal;
    for (const Point& m : normals) add(n, -dot(n, m), m);
    if (normalise(n) > k_one_plane) normals.push_back(n);
  }
  if (normals.size() > 2) return {};
  for (const Point& n : normals) add(d, -dot(d, n), n);
  return normalise(d) > 0.3 ? d : Point{};
}

/// Returns the displacements of the vertices of the wall if there was enough room.
/// @param thickness  [surface of the wall]; between two of them its mean
std::vector<Point> wanted(const RawMesh& mesh, const RawGroup& body, const WallTopology& wall,
                          const std::vector<Corner>& corners, const std::vector<double>& thickness) {
  // Corners of the faces around the wall, along which its rim may slide.
  const std::vector<Corner> around = corners_of(mesh, body, wall, wall.around);
  std::vector<Point> u(mesh.x.size(), Point{});
  const auto less = [](const Corner& c, Index node) { return c.node < node; };
  // All corners of one node together, as both lists are sorted by nodes.
  for (auto first = corners.begin(); first != corners.end();) {
    const Index node = first->node;
    auto last = first;
    while (last != corners.end() && last->node == node) ++last;
    const auto rim = std::lower_bound(around.begin(), around.end(), node, less);
    auto rim_end = rim;
    while (rim_end != around.end() && rim_end->node == node) ++rim_end;
    Point d{};
    if (wall.held[as_size(node)] == 0) d = best_direction(&*first, &*first + (last - first));
    if (rim != rim_end) d = along(d, &*rim, &*rim + (rim_end - rim));
    // The thickness is measured along the normals: a slanted displacement has to be longer.
    double mean = 0, least = 1, thick = 0;
    for (auto c = first; c != last; ++c) {
      mean += c->angle * dot(c->normal, d);
      thick += c->angle * thickness[as_size(c->surface)];
      least = std::min(least, dot(c->normal, d));
    }
    if (least > k_least_cosine) add(u[as_size(node)], thick / mean, d);
    first = last;
  }
  return u;
}

/// Makes displacements shorter until every element and every layer is good.
class Room {
 public:
  Room(const RawMesh& mesh, const RawGroup& body, const WallTopology& wall,
       const std::vector<Corner>& corners, const std::vector<double>& levels, std::vector<Point>& u)
      : mesh_(mesh),
        body_(body),
        wall_(wall),
        corners_(corners),
        levels_(levels),
        u_(u),
        changed_(u.size(), 1) {
    for (const Point& d : u) wanted_.push_back(std::sqrt(dot(d, d)));
    moved_.dimension = mesh.dimension;
    moved_.x = mesh.x;
    for (const RawBlock& block : body.blocks)
      for (std::size_t e = 0; e < block.nodes.size(); e += as_size(node_count(block.shape)))
        quality_.push_back(element_quality(mesh, linear(block.shape), block.nodes.data() + e));
  }

  /// Layers get thinner, evenly along the wall, around what has no room, and the vertices of the body follow
  /// each time. What is bad then moves less, one vertex at a time. In the end displacements that are still
  /// too large are taken away.
  void fit(const LayerSpread& spread) {
    const std::vector<Point> wanted = u_;
    std::vector<double> share(u_.size(), 1);
    for (int round = 0; round <= k_even_rounds; ++round) {
      make_even(share);
      for (std::size_t i = 0; i < u_.size(); ++i)
        if (wall_.on_wall[i] != 0)
          for (std::size_t k = 0; k < 3; ++k) u_[i][k] = share[i] * wanted[i][k];
      spread.sweep(u_, round == 0 ? k_first_sweeps : k_sweeps);
      std::fill(changed_.begin(), changed_.end(), 1);
      find_bad();
      std::vector<char> thinner(u_.size(), 0);
      bool all_good = true;
      for (std::size_t i = 0; i < u_.size(); ++i) {
        if (bad_[i] == 0 || dot(u_[i], u_[i]) == 0) continue;
        all_good = false;
        if (const Index owner = spread.wall_vertex(as_index(i)); owner >= 0) thinner[as_size(owner)] = 1;
      }
      if (all_good) return;
      if (round == k_even_rounds) break;
      for (std::size_t i = 0; i < u_.size(); ++i)
        if (thinner[i] != 0) share[i] *= k_thinner;
    }
    for (int round = 0; !good(round < k_rounds ? k_less : 0.0); ++round) {
    }
  }

 private:
  /// The thickness of the layers changes along no edge of the wall by more than a share of its length.
  void make_even(std::vector<double>& share) const {
    bool changed = true;
    constexpr int k_most = 100;
    for (int round = 0; changed && round < k_most; ++round) {
      changed = false;
      for (const WallFace& face : wall_.wall)
        for (int a = 0; a < face.n_vertices; ++a) {
          const Index p = face.nodes[as_size(a)], q = face.nodes[as_size((a + 1) % face.n_vertices)];
          changed = make_even(p, q, share) || make_even(q, p, share) || changed;
        }
    }
  }
  /// Makes the layers at p thinner where those at q, its neighbour, ask for it.
  bool make_even(Index p, Index q, std::vector<double>& share) const {
    if (!(wanted_[as_size(q)] > 0)) return false;  // layers end there with one step
    const Point d = difference(mesh_.x[as_size(p)], mesh_.x[as_size(q)]);
    const double most = share[as_size(q)] * wanted_[as_size(q)] + k_steepest * std::sqrt(dot(d, d));
    if (share[as_size(p)] * wanted_[as_size(p)] <= most * (1 + 1e-9)) return false;
    share[as_size(p)] = most / wanted_[as_size(p)];
    return true;
  }

  /// Finds the vertices of bad elements and layers.
  void find_bad() {
    for (std::size_t i = 0; i < u_.size(); ++i) {
      moved_.x[i] = mesh_.x[i];
      add(moved_.x[i], 1, u_[i]);
    }
    bad_.assign(u_.size(), 0);
    look_at_elements();
    look_at_layers();
  }

  /// Finds bad elements and multiplies the displacements of their vertices. True: there are none.
  bool good(double factor) {
    find_bad();
    look_at_columns();
    std::fill(changed_.begin(), changed_.end(), 0);
    bool all_good = true;
    for (std::size_t i = 0; i < u_.size(); ++i) {
      if (bad_[i] == 0 || dot(u_[i], u_[i]) == 0) continue;
      all_good = false;
      changed_[i] = 1;
      const double of = bad_[i] == 2 ? 0.0 : factor;
      for (double& c : u_[i]) c *= of;
    }
    return all_good;
  }

  bool has_changed(const Index* nodes, int n) const {
    return std::any_of(nodes, nodes + n, [&](Index i) { return changed_[as_size(i)] != 0; });
  }
  void mark(const Index* nodes, int n) {
    for (int a = 0; a < n; ++a) bad_[as_size(nodes[a])] = std::max<char>(bad_[as_size(nodes[a])], 1);
  }

  void look_at_elements() {
    std::size_t number = 0;
    for (const RawBlock& block : body_.blocks) {
      const auto nn = as_size(node_count(block.shape));
      const int n_vertices = vertex_count(block.shape);
      for (std::size_t e = 0; e < block.nodes.size(); e += nn, ++number) {
        const Index* element = block.nodes.data() + e;
        if (!has_changed(element, n_vertices)) continue;
        const double before = quality_[number], sign = before < 0 ? -1 : 1;
        const double now = sign * element_quality(moved_, linear(block.shape), element);
        if (now < std::min(k_flatter * std::abs(before), k_good_enough)) mark(element, n_vertices);
      }
    }
  }

  /// A displacement that is nearly none or away from one of its faces becomes none.
  void look_at_columns() {
    for (const Corner& c : corners_) {
      const Point& u = u_[as_size(c.node)];
      const double length = std::sqrt(dot(u, u));
      if (length > 0 &&
          (length < k_least_share * wanted_[as_size(c.node)] || dot(u, c.normal) < k_least_cosine * length))
        bad_[as_size(c.node)] = 2;
    }
  }

  /// No element of a layer is folded or much flatter than a layer of even thickness is.
  void look_at_layers() {
    RawMesh column;  // the vertices above one face, level by level
    column.dimension = mesh_.dimension;
    std::vector<LayerColumn> columns;
    // Above each face that moves the vertices of all levels, and from them the elements as they would be
    // made: none may have a negative volume.
    for (const WallFace& face : wall_.wall) {
      if (!has_changed(face.nodes.data(), face.n_vertices)) continue;
      const auto n = as_size(face.n_vertices);
      const FaceOwner& owner = wall_.faces.at(face_key(face.nodes.data(), face.n_vertices));
      const Shape shape = body_.blocks[as_size(owner.block)].shape;
      const double sign = orientation(mesh_, body_, owner);
      column.x.clear();
      for (std::size_t level = 0; level <= levels_.size(); ++level)
        for (std::size_t a = 0; a < n; ++a) {
          column.x.push_back(mesh_.x[as_size(face.nodes[a])]);
          if (level > 0) add(column.x.back(), levels_[level - 1], u_[as_size(face.nodes[a])]);
        }
      bool folds = false;
      for (std::size_t level = 0; level < levels_.size() && !folds; ++level) {
        columns.clear();
        for (std::size_t a = 0; a < n; ++a) {
          const bool none = dot(u_[as_size(face.nodes[a])], u_[as_size(face.nodes[a])]) == 0;
          const auto lower = as_index(level * n + a), upper = lower + as_index(n);
          columns.push_back({face.nodes[a], none ? as_index(a) : lower, none ? as_index(a) : upper});
        }
        for (const std::vector<Index>& element : layer_elements(shape, columns))
          folds = folds || sign * measure(column, element) <= 0;
      }
      if (folds) mark(face.nodes.data(), face.n_vertices);
    }
  }

  /// Area or volume of a simplex, the least corner's of another element, with its sign and a factor.
  static double measure(const RawMesh& mesh, const std::vector<Index>& element) {
    const auto x = [&](std::size_t a) { return mesh.x[as_size(element[a])]; };
    if (element.size() == 3) return cross(difference(x(1), x(0)), difference(x(2), x(0)))[2];
    if (element.size() == 4 && mesh.dimension == 3)
      return dot(cross(difference(x(1), x(0)), difference(x(2), x(0))), difference(x(3), x(0)));
    return element_quality(mesh, element.size() == 4 ? Shape::quad4 : Shape::hex8, element.data());
  }

  const RawMesh& mesh_;
  RawMesh moved_;
  const RawGroup& body_;
  const WallTopology& wall_;
  const std::vector<Corner>& corners_;
  const std::vector<double>& levels_;
  std::vector<Point>& u_;
  std::vector<double> wanted_;   ///< [node] lengths of the displacements of the wall [m]
  std::vector<double> quality_;  ///< of the elements, before
  std::vector<char> changed_;    ///< [node]: moves less than in the round before
  std::vector<char> bad_;        ///< [node]: 1 move less, 2 not at all
};

}  // namespace

std::vector<Point> layer_displacement(const RawMesh& mesh, const RawGroup& body, const WallTopology& wall,
                                      const std::vector<double>& thickness,
                                      const std::vector<double>& levels) {
  const std::vector<Corner> corners = corners_of(mesh, body, wall, wall.wall);
  std::vector<Point> u = wanted(mesh, body, wall, corners, thickness);
  const LayerSpread spread(mesh, body, wall);
  Room(mesh, body, wall, corners, levels, u).fit(spread);
  return u;
}

}  // namespace solidus::mesh
