/// Two blocks in contact with their materials, supports and phases, for the verification of contact.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "../unit/contact/bodies.hpp"
#include "contact/pair.hpp"
#include "heat/thermal_phase.hpp"
#include "mechanics/mechanical_phase.hpp"

namespace solidus::test {

inline material::Material elastic(double young, double poisson, double expansion = 0,
                                  double conductivity = 20) {
  material::Material m;
  m.name = "elastic";
  m.density = 7800;
  m.conductivity = conductivity;
  m.specific_heat = 500.0;
  m.young_modulus = young;
  m.poisson_ratio = poisson;
  m.expansion = expansion;
  m.expansion_reference = 300;
  m.liquid_viscosity = 1.0;
  return m;
}

inline contact::ContactParameters interface() {
  contact::ContactParameters s;
  s.name = "interface";
  s.slave = "lower_top";
  s.master = "upper_bottom";
  return s;
}

/// Criteria at round-off, to compare with closed forms.
inline mechanics::MechanicsOptions strict_mechanics() {
  mechanics::MechanicsOptions options;
  options.newton.tolerance = 1e-12;
  options.newton.max_iterations = 40;
  options.solver = linear::SolverKind::direct;
  return options;
}

/// Supports under which a block under pressure along its last axis is in a homogeneous state: symmetry at the
/// low sides, the lower block stands on its bottom.
inline mechanics::MechanicalConditions symmetric_supports(int dimension) {
  mechanics::MechanicalConditions c;
  const std::string last = dimension == 2 ? "y" : "z";
  for (const std::string body : {"lower", "upper"}) {
    c.displacements.push_back({body + "_x_min", 0, 0.0});
    if (dimension == 3) c.displacements.push_back({body + "_y_min", 1, 0.0});
  }
  c.displacements.push_back({"lower_" + last + "_min", dimension - 1, 0.0});
  return c;
}

}  // namespace solidus::test
