/// Options of the mechanical phase.
#pragma once

#include <optional>
#include <vector>

#include "linear/newton.hpp"
#include "mechanics/elements/simplices.hpp"
#include "mechanics/loads/inertial_forces.hpp"
#include "mechanics/state/pass.hpp"

namespace solidus::mechanics {

enum class TimeIntegration { backward_euler, two_step };

struct MechanicsOptions {
  linear::NewtonOptions newton;
  /// Constant volumetric mode (Q1/P0, 6.2) in 4-node quads and 8-node hexes; other shapes use the standard
  /// operator.
  bool b_bar = true;
  Simplices simplices = Simplices::automatic;
  Stabilisation stabilisation = Stabilisation::automatic;
  TimeIntegration integration = TimeIntegration::backward_euler;
  Mapping mapping = Mapping::isothermal;
  linear::SolverKind solver = linear::SolverKind::automatic;
  double linear_tolerance = 1e-8;  ///< iterative solvers, relative
  /// False when a contribution's tangent is not symmetric (friction); a law's is found by itself
  /// (Armstrong–Frederick).
  bool symmetric = true;
  std::optional<DynamicsOptions> dynamics;  ///< absent: no inertia
  /// Stress of each block at the start, [block][element][6]: xx, yy, zz, xy, yz, xz [Pa]. A block without any
  /// has an empty list; all empty: no stress. Solid metal of the built-in laws, in quasi-statics.
  std::vector<std::vector<double>> initial_stress = {};
};

}  // namespace solidus::mechanics
