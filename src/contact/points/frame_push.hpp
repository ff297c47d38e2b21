/// F, which carries a traction from the master's reference plane to the current one, and its derivatives.
///
///   F = R(ν_f → ν) (τ^α ⊗ τ_α^ref) R(ν^ref → ν_f^ref)
///
/// with the basis of the face (3.9), its normals ν_f, ν_f^ref (3.10), and the normals of the planes that
/// traction lives in, ν and ν^ref. Without smoothing both pairs are the same and F is τ^α ⊗ τ_α^ref; with
/// averaged normals, and in the wedges at edges, the smallest rotations R join the planes. A master that
/// moves as a rigid body has F = Q on the plane whatever the face, so friction does not jump between faces.
#pragma once

#include "contact/surfaces/master.hpp"

namespace solidus::contact {

/// @param reference_plane ν^ref @param normal ν
Tensor push_forward(const MasterFrame& frame, const Point& reference_plane, const Point& normal);

struct PushRates {
  Point pushed{};                  ///< F T
  std::array<Tensor, 2> by_tau{};  ///< ∂(F T)/∂τ_α at fixed ξ
  Tensor by_normal{};              ///< ∂(F T)/∂ν
  std::array<Point, 2> by_xi{};    ///< ∂(F T)/∂ξ^α at fixed nodes and ν
};
/// @param reference_plane_xi ∂ν^ref/∂ξ^α
PushRates push_rates(const MasterFrame& frame, const Point& reference_plane,
                     const std::array<Point, 2>& reference_plane_xi, const Point& normal,
                     const Point& traction);

}  // namespace solidus::contact
