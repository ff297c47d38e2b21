/// The planes at a node tell where it may go: nowhere at a corner, along a line at an edge, in a plane on a
/// face.
#include "mesh/making/surface_node.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "mesh/surfaces/skin.hpp"

namespace solidus::mesh {

namespace {

constexpr double k_sharp = 0.866;  ///< the cosine of 30 degrees

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double dot(const Point& u, const Point& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
Point cross(const Point& u, const Point& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
Point unit(Point v) {
  const double length = std::sqrt(dot(v, v));
  if (length > 0)
    for (double& component : v) component /= length;
  return v;
}
Point moved(Point from, const Point& direction, double distance) {
  for (std::size_t i = 0; i < 3; ++i) from[i] += distance * direction[i];
  return from;
}

}  // namespace

Point normal_of(const Tetrahedra& mesh, const SurfaceFace& face) {
  const Point& a = mesh.x(face.nodes[0]);
  const Point n = cross(minus(mesh.x(face.nodes[1]), a), minus(mesh.x(face.nodes[2]), a));
  return face.outside < 0 || face.inside < face.outside ? n : Point{-n[0], -n[1], -n[2]};
}

SurfaceNode::SurfaceNode(const Tetrahedra& mesh, Index node)
    : mesh_(mesh), node_(node), faces_(surface_at(mesh, node)) {
  std::map<Index, std::vector<std::size_t>> at;
  // The mean normal by area, and which other nodes lie on the surface; edges where it bends or bodies change
  // are curves.
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Point n = normal_of(mesh, faces_[f]);
    for (std::size_t i = 0; i < 3; ++i) mean_[i] += n[i];
    normals_.push_back(unit(n));
    for (const Index other : faces_[f].nodes)
      if (other != node) at[other].push_back(f);
  }
  mean_ = unit(mean_);
  for (const Point& n : normals_) turned_ = std::min(turned_, dot(n, mean_));
  // A face is told by the bodies on its two sides.
  const auto sides = [this](std::size_t f) { return std::minmax(faces_[f].inside, faces_[f].outside); };
  for (const auto& [other, of] : at) {
    on_surface_.insert(other);
    if (of.size() != 2 || sides(of[0]) != sides(of[1]) || dot(normals_[of[0]], normals_[of[1]]) < k_sharp)
      on_curves_.insert(other);
  }
}

std::vector<Point> SurfaceNode::places(double step) const {
  if (mesh_.is_locked(node_)) return {};
  if (!faces_.empty())
    return importance() == 0 ? on_surface(step) : importance() == 1 ? on_curve(step) : std::vector<Point>{};
  std::vector<Point> all;
  for (std::size_t i = 0; i < 3; ++i)
    for (const double sign : {-1.0, 1.0}) {
      all.push_back(mesh_.x(node_));
      all.back()[i] += sign * step;
    }
  return all;
}

std::vector<Point> SurfaceNode::on_surface(double step) const {
  // Two axes in the tangent plane, from the coordinate axis that is least along the normal.
  const Point axis = std::abs(mean_[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
  const Point first = unit(cross(mean_, axis)), second = cross(mean_, first);
  std::vector<SkinFace> around;
  for (const SurfaceFace& face : faces_)
    around.push_back(face_through({mesh_.x(face.nodes[0]), mesh_.x(face.nodes[1]), mesh_.x(face.nodes[2])}));
  std::vector<Point> all;
  // Steps along two tangents both ways, each drawn back onto the faces around.
  for (const Point& way : {first, second})
    for (const double sign : {-1.0, 1.0}) {
      const Point wanted = moved(mesh_.x(node_), way, sign * step);
      Point nearest = wanted;
      double least = std::numeric_limits<double>::max();
      for (const SkinFace& face : around) {
        const Point p = nearest_on_face(face, wanted), off = minus(p, wanted);
        if (const double distance = dot(off, off); distance < least) least = distance, nearest = p;
      }
      all.push_back(nearest);
    }
  return all;
}

std::vector<Point> SurfaceNode::on_curve(double step) const {
  const Point& here = mesh_.x(node_);
  const Point first = minus(mesh_.x(*on_curves_.begin()), here),
              second = minus(mesh_.x(*on_curves_.rbegin()), here);
  if (dot(unit(first), unit(second)) > -k_sharp) return {};
  std::vector<Point> all;
  constexpr double k_most = 0.7;  // of the edge
  for (const Point& edge : {first, second})
    if (const double length = std::sqrt(dot(edge, edge)); step < k_most * length)
      all.push_back(moved(here, unit(edge), step));
  return all;
}

bool SurfaceNode::keeps_surface() const {
  constexpr double k_turn = 0.966;  // the cosine of 15 degrees
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const Point n = unit(normal_of(mesh_, faces_[f]));
    if (on_curves_.empty() ? dot(n, mean_) < std::min(k_sharp, turned_) : dot(n, normals_[f]) < k_turn)
      return false;
  }
  return true;
}

}  // namespace solidus::mesh
