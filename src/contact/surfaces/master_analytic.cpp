/// All questions are answered in the frame of the tool at rest; places and normals are then moved with it.
#include "contact/surfaces/master_analytic.hpp"

#include <cmath>

namespace solidus::contact {

namespace {

Point unit(const Point& v) {
  return scale(1 / norm(v), v);
}

// Rodrigues: Q = cos θ I + sin θ [a]× + (1 − cos θ) a ⊗ a.
Tensor rotation(const Point& a, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Tensor q{{{c, -s * a[2], s * a[1]}, {s * a[2], c, -s * a[0]}, {-s * a[1], s * a[0], c}}};
  add_outer(q, 1 - c, a, a);
  return q;
}

}  // namespace

AnalyticMaster::AnalyticMaster(int components, const RigidSurface& surface, double search_distance)
    : surface_(surface), planar_(components == 2), search_distance_(search_distance) {
  surface_.direction = unit(surface.direction);
  surface_.motion.axis = unit(surface.motion.axis);
  place({}, 0);
}

void AnalyticMaster::place(std::span<const double>, double time) {
  const RigidMotion& m = surface_.motion;
  turn_ = rotation(m.axis, m.angle.value(time));
  for (std::size_t i = 0; i < 3; ++i) shift_[i] = m.translation[i].value(time);
}

Point AnalyticMaster::place_at(const Point& own, double time) const {
  const RigidMotion& m = surface_.motion;
  Point x = add(m.centre, times(rotation(m.axis, m.angle.value(time)), subtract(own, m.centre)));
  for (std::size_t i = 0; i < 3; ++i) x[i] += m.translation[i].value(time);
  return x;
}

Point AnalyticMaster::way(const Partner& partner, double from, double to) const {
  return subtract(place_at(partner.xi, to), place_at(partner.xi, from));
}

Partner AnalyticMaster::find(const Point& x, const Point& slave_normal, Index) const {
  // In the body's own frame: X = c + Qᵀ (x − d − c).
  const Point& c = surface_.motion.centre;
  const Point here = add(c, transposed_times(turn_, subtract(subtract(x, shift_), c)));
  // Distance and normal in closed form: along the plane's normal, or radially from the axis or
  // centre.
  Point from = subtract(here, surface_.point);
  Partner p;
  Point normal = surface_.direction;
  if (surface_.shape == RigidSurface::Shape::plane) {
    p.penetration = -dot(from, normal);
  } else {
    if (surface_.shape == RigidSurface::Shape::cylinder)
      from = contact::add_scaled(from, -dot(from, surface_.direction), surface_.direction);
    const double rho = norm(from);
    if (!(rho > 1e-9 * surface_.radius)) return {};
    const double side = surface_.hollow ? -1 : 1;
    normal = scale(side / rho, from);
    p.penetration = side * (surface_.radius - rho);
  }
  p.normal = times(turn_, normal);
  // However deep a point has come into a rigid body, it is pushed out.
  if (!(p.penetration >= -search_distance_)) return {};
  if (!(dot(p.normal, slave_normal) < k_facing_cosine)) return {};
  // The place is stored in the body's frame, so that slip along a moving tool is relative to it.
  p.xi = contact::add_scaled(here, p.penetration, normal);
  p.face = 0;
  return p;
}

Point AnalyticMaster::curvature(const Point& radial, const Point& tangent) const {
  if (surface_.shape == RigidSurface::Shape::plane) return {};
  Point t = contact::add_scaled(tangent, -dot(tangent, radial), radial);
  if (surface_.shape == RigidSurface::Shape::cylinder)
    t = contact::add_scaled(t, -dot(t, surface_.direction), surface_.direction);
  return scale(1 / surface_.radius, t);
}

// The basis is orthonormal at the partner; only there, and to first order around it, is it ever asked for.
void AnalyticMaster::frame(const Partner& partner, bool, MasterFrame& frame) const {
  frame.n_face_nodes = 0;
  frame.nodes = {};
  // Everything is built in the body's frame and moved to the present place at the end.
  const Point nu = transposed_times(turn_, partner.normal);
  Point e1, e2;
  if (planar_) {
    e2 = {0, 0, 1};
    e1 = cross(e2, nu);
  } else {
    tangent_basis(nu, e1, e2);
  }
  // The normal changes with the place by the curvature of the surface, towards the inside where it is hollow.
  const double side = surface_.hollow ? -1 : 1;
  const Point radial = scale(side, nu);
  const Point c1 = curvature(radial, e1), c2 = planar_ ? Point{} : curvature(radial, e2);
  frame.reference_y = partner.xi;
  frame.reference_tau = {e1, e2};
  frame.reference_tau_xi = {scale(-dot(c1, e1), radial), scale(-dot(c2, e2), radial),
                            scale(-dot(c2, e1), radial)};
  frame.reference_face_normal = frame.reference_nu = nu;
  frame.reference_face_normal_xi = frame.reference_nu_xi = {scale(side, c1), scale(side, c2)};

  // What is of the reference moves along with the tool: turned about its centre and shifted.
  const Point& c = surface_.motion.centre;
  frame.y = add(add(c, times(turn_, subtract(partner.xi, c))), shift_);
  for (std::size_t a = 0; a < 2; ++a) {
    frame.tau[a] = times(turn_, frame.reference_tau[a]);
    frame.nu_xi[a] = times(turn_, frame.reference_nu_xi[a]);
  }
  for (std::size_t a = 0; a < 3; ++a) frame.tau_xi[a] = times(turn_, frame.reference_tau_xi[a]);
  frame.face_normal = frame.nu = partner.normal;
}

}  // namespace solidus::contact
