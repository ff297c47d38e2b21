/// Specification of a contact pair by the user, in SI.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "contact/interface/friction.hpp"
#include "contact/interface/heat_transfer.hpp"
#include "contact/interface/normal.hpp"
#include "contact/interface/wear.hpp"
#include "contact/points/integration.hpp"
#include "contact/surfaces/master_analytic.hpp"
#include "system/errors.hpp"

namespace solidus::contact {

enum class Formulation {
  small_sliding,  ///< partners found once, in the reference configuration (fixed_kinematics.hpp)
  large_sliding   ///< closest points on the current configuration
};

struct ContactParameters {
  std::string name;    ///< for messages and column names
  std::string slave;   ///< surface that is integrated over; the finer or softer one
  std::string master;  ///< surface that it is projected on; with `rigid_master` only a name for messages
  /// The slave becomes the surface with the smaller faces, of two alike the softer one, else the first.
  bool choose_roles = false;
  /// Instead of a surface of the mesh, with large sliding.
  std::optional<RigidSurface> rigid_master;
  /// Those of the two surfaces whose faces come or go with the elements of bodies that grow.
  std::vector<std::string> growing;
  Formulation formulation = Formulation::small_sliding;
  bool smoothing = false;  ///< averaged normals of the master (large sliding)
  NormalKind normal = NormalKind::penalty;
  /// The pressure that holds liquid metal on its wall (normal.hpp) [Pa]; zero: it lets go without tension.
  double atmosphere = 101325;
  /// A liquid skin that is farther from its wall than this has left it, for reports [m].
  double leaving_gap = 0;
  /// Tolerance of the augmented Lagrangian: the penetration that may be left, as a share of the mean size of
  /// the slave's faces.
  double penetration_tolerance = 1e-6;
  /// Another tolerance in place of it: the largest pressure that the penetrations around a node may still
  /// make, as a share of the largest contact pressure of the pair.
  std::optional<double> pressure_tolerance;
  std::optional<FrictionParameters> friction;  ///< absent: none
  std::optional<WearParameters> wear;          ///< absent: no depth of wear; needs friction
  double interface_heat_capacity = 0;          ///< C_co [J/(m² K)]
  /// ε_N [Pa/m], or the factor on the local stiffness E/h (`penalty_is_factor`).
  double penalty = 10;
  bool penalty_is_factor = true;
  /// Upper bound of a penalty that is given as a factor [Pa/m]: next to a melt, which is a million times
  /// softer than the solid, a penalty of the solid's stiffness makes Newton's iteration open and close points
  /// without end.
  double largest_penalty = std::numeric_limits<double>::infinity();
  /// ε_N of points with a solid skin where it is more than that of the pair [Pa/m]: the penalty alone, no
  /// other law of pressure, rises to it as the skin gets solid (PointLaw::stiffen).
  double solid_penalty = 0;
  /// Stiffness of every point in all directions, as a part of ε_N, that the tangent gets on top of the law's.
  /// It is not in the forces, so a converged solution does not feel it; it keeps the matrix regular while a
  /// body has lost support (all points open) or may slide freely. As a wrong part of the tangent it costs
  /// iterations when it is not small against the elastic stiffness, and where it is too small rounding moves
  /// a body that nothing holds (docs/verification/contact.md): 1e-8 holds most, 1e-6 all with iterative
  /// ones. Zero: none.
  double stabilisation = 1e-8;
  IntegrationRule integration = IntegrationRule::automatic;
  int gauss_degree = 4;  ///< rule `gauss`
  /// Distance up to which partners are searched for along the normal [m]; absent: a tenth of the slave's
  /// extent.
  std::optional<double> search_distance;
  /// Initial gaps and penetrations up to this size are taken as touching, g_N = 0 [m]; absent:
  /// rounding and what the facets of curved surfaces leave between them (ContactGeometry::initial_offset).
  std::optional<double> touching;
  std::optional<HeatTransferSpec> heat;  ///< absent: no heat passes
  /// Heat between nodes of the two sides only (a graph Laplacian): keeps the thermal matrix of non-negative
  /// type, as the closed integration rule needs (6.3.1). False: consistent integrals, for the open rule.
  bool nodal_heat = true;
  SourceLocation where;
};

}  // namespace solidus::contact
