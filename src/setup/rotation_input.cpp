/// The axis is that of the case, or the one that the analysis has; each body gets the acceleration of its
/// places, which its density makes a force.
#include "setup/rotation_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/roles.hpp"
#include "input/keys.hpp"
#include "numbers/index_casts.hpp"
#include "setup/load_laws.hpp"

namespace solidus::setup {

namespace {

bool turns(const cases::RotationSpec& rotation, const cases::BodySpec& body) {
  return rotation.bodies.empty() ||
         std::find(rotation.bodies.begin(), rotation.bodies.end(), body.name) != rotation.bodies.end();
}

/// A plane has no axis within it, and what is symmetric about an axis turns about that one.
void check_axis(const cases::RotationSpec& r, AnalysisKind kind) {
  double length = 0;
  for (const double a : r.axis) length += std::abs(a);
  if (kind != AnalysisKind::solid) {
    const std::size_t normal = kind == AnalysisKind::axisymmetric ? 1 : 2;
    for (std::size_t i = 0; i < r.axis.size(); ++i)
      if (i != normal && r.axis[i] != 0)
        throw InputError(r.where, "the axis of [rotation] is not that of this analysis",
                         kind == AnalysisKind::axisymmetric ? "no axis: all turns about that of revolution"
                                                            : "no axis: a plane turns about its normal");
    if (kind == AnalysisKind::axisymmetric && !r.point.empty() && r.point[0] != 0)
      throw InputError(r.where, "the axis of [rotation] is not that of this analysis",
                       "no point: all turns about the axis of revolution");
  } else if (!r.axis.empty() && r.axis.size() != 3) {
    throw InputError(r.where, fmt::format("the axis of [rotation] has {} components", r.axis.size()), "3");
  }
  if (!r.axis.empty() && !(length > 0)) throw InputError(r.where, "the axis of [rotation] has no length");
}

}  // namespace

void check_rotation(const cases::CaseSpec& spec) {
  if (!spec.rotation) return;
  const cases::RotationSpec& r = *spec.rotation;
  check_axis(r, spec.analysis.kind);
  if (const auto n = as_size(spec.dimension()); !r.point.empty() && r.point.size() != n)
    throw InputError(r.where, fmt::format("the point of [rotation] has {} coordinates", r.point.size()),
                     fmt::format("{} in this analysis", n));
  std::vector<std::string> bodies;
  for (const cases::BodySpec& body : spec.bodies) bodies.push_back(body.name);
  for (const std::string& name : r.bodies)
    if (std::find(bodies.begin(), bodies.end(), name) == bodies.end())
      throw InputError(r.where, fmt::format("[rotation] names the unknown body '{}'", name),
                       one_of(bodies, name));
}

mechanics::Turning turning(const cases::CaseSpec& spec) {
  mechanics::Turning turning;
  if (!spec.rotation) return turning;
  const cases::RotationSpec& r = *spec.rotation;
  turning.omega = r.omega.table.max_value();
  turning.axis[spec.analysis.kind == AnalysisKind::axisymmetric ? 1 : 2] = 1;
  if (spec.analysis.kind == AnalysisKind::solid && !r.axis.empty()) {
    const double length = std::hypot(r.axis[0], r.axis[1], r.axis[2]);
    for (std::size_t i = 0; i < 3; ++i) turning.axis[i] = r.axis[i] / length;
  }
  std::copy(r.point.begin(), r.point.end(), turning.point.begin());
  return turning;
}

std::vector<mechanics::BodyForce> centrifugal_forces(const cases::CaseSpec& spec) {
  std::vector<mechanics::BodyForce> forces;
  if (!spec.rotation) return forces;
  const mechanics::Turning about = turning(spec);
  const TimeFunction omega(spec.rotation->omega.table);
  for (const cases::BodySpec& body : spec.bodies) {
    if (!turns(*spec.rotation, body) || cases::only_conducts(body)) continue;
    mechanics::BodyForce force{body.mesh_group(), {}, true};
    for (std::size_t i = 0; i < 3; ++i)
      force.value[i] = centrifugal_acceleration(omega, about.axis, about.point, i);
    forces.push_back(std::move(force));
  }
  return forces;
}

}  // namespace solidus::setup
