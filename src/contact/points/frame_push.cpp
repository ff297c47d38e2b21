/// The push-forward is a product of three linear maps; its derivatives by place, tangents and normal follow
/// by the product rule, each in its own term.
#include "contact/points/frame_push.hpp"

namespace solidus::contact {

namespace {

// τ^α (τ_α^ref · v)
Point through_basis(const std::array<Point, 2>& dual, const std::array<Point, 2>& reference, const Point& v) {
  return contact::add_scaled(scale(dot(reference[0], v), dual[0]), dot(reference[1], v), dual[1]);
}

}  // namespace

Tensor push_forward(const MasterFrame& frame, const Point& reference_plane, const Point& normal) {
  const auto dual = dual_basis(frame.tau);
  // Each unit vector goes the way of the traction: to the reference face, with its basis to the present one,
  // to the normal.
  Tensor columns{};  // row j is F e_j
  for (std::size_t j = 0; j < 3; ++j) {
    Point e{};
    e[j] = 1;
    const Point there = rotate(reference_plane, frame.reference_face_normal, e);
    columns[j] = rotate(frame.face_normal, normal, through_basis(dual, frame.reference_tau, there));
  }
  Tensor push{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) push[i][j] = columns[j][i];
  return push;
}

PushRates push_rates(const MasterFrame& frame, const Point& reference_plane,
                     const std::array<Point, 2>& reference_plane_xi, const Point& normal,
                     const Point& traction) {
  // The traction turns from the reference plane to that of the face, is carried by its basis to the present,
  // and turns to the normal: the push of a traction vector with the master.
  const auto dual = dual_basis(frame.tau);
  const RotationRates back = rotation_rates(reference_plane, frame.reference_face_normal, traction);
  const Point there = times(back.by_vector, traction);
  const Point s = through_basis(dual, frame.reference_tau, there);
  const RotationRates turn = rotation_rates(frame.face_normal, normal, s);
  PushRates rates;
  rates.pushed = times(turn.by_vector, s);
  rates.by_normal = turn.by_to;
  for (std::size_t b = 0; b < 2; ++b) {
    // δτ^α = −(τ^α·δτ_β) τ^β + m^αβ (ν_f·δτ_β) ν_f and δν_f = −τ^β (ν_f·δτ_β).
    Tensor by_basis{}, of_normal{};
    add_outer(by_basis, -1, dual[b], s);
    add_outer(by_basis, dot(s, dual[b]), frame.face_normal, frame.face_normal);
    add_outer(of_normal, -1, dual[b], frame.face_normal);
    rates.by_tau[b] = times(turn.by_vector, by_basis);
    contact::add_scaled(rates.by_tau[b], 1, times(turn.by_from, of_normal));
  }
  // Along the reference face the basis changes by its curvature, and so does what is carried.
  const std::array<std::array<std::size_t, 2>, 2> k_order{{{0, 2}, {2, 1}}};  // of τ_β,α
  for (std::size_t a = 0; a < 2; ++a) {
    const Point turned =
        add(times(back.by_from, reference_plane_xi[a]), times(back.by_to, frame.reference_face_normal_xi[a]));
    Point change{}, of_tau{};
    for (std::size_t b = 0; b < 2; ++b) {
      const double t =
          dot(frame.reference_tau_xi[k_order[b][a]], there) + dot(frame.reference_tau[b], turned);
      change = contact::add_scaled(change, t, dual[b]);
      of_tau = add(of_tau, times(rates.by_tau[b], frame.tau_xi[k_order[b][a]]));
    }
    rates.by_xi[a] = add(times(turn.by_vector, change), of_tau);
  }
  return rates;
}

}  // namespace solidus::contact
