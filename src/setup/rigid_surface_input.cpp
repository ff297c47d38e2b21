/// Shape and motion of each rigid surface are checked, then put into the frame of its master.
#include "setup/rigid_surface_input.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "numbers/index_casts.hpp"

namespace solidus::setup {

namespace {

using Shape = contact::RigidSurface::Shape;

contact::Point point_of(const std::vector<double>& components) {
  contact::Point p{};
  std::copy(components.begin(), components.end(), p.begin());
  return p;
}

std::string text(const cases::RigidSurfaceSpec& s) {
  return fmt::format("the rigid surface '{}'", s.name);
}

void check_size(const cases::RigidSurfaceSpec& s, const char* key, std::size_t size, int dimension) {
  if (size != as_size(dimension))
    throw InputError(s.where, fmt::format("'{}' of {} has {} components", key, text(s), size),
                     fmt::format("{} in this analysis", dimension));
}

void check_direction(const cases::RigidSurfaceSpec& s, const char* key, const std::vector<double>& direction,
                     int dimension) {
  check_size(s, key, direction.size(), dimension);
  if (std::all_of(direction.begin(), direction.end(), [](double d) { return d == 0; }))
    throw InputError(s.where, fmt::format("'{}' of {} has no length", key, text(s)), "a direction");
}

/// A shape has a point and, by its kind, a normal or an axis; in two dimensions axes are those of the
/// analysis.
void check_shape(const cases::RigidSurfaceSpec& s, AnalysisKind kind, int dimension) {
  check_size(s, "point", s.point.size(), dimension);
  if (s.shape == Shape::plane) return check_direction(s, "normal", s.normal, dimension);
  if (s.shape == Shape::sphere && kind == AnalysisKind::plane_strain)
    throw InputError(s.where, text(s) + " is a sphere, which plane strain does not have",
                     "shape = \"cylinder\", which lies along z");
  if (kind == AnalysisKind::axisymmetric && s.point[0] != 0)
    throw InputError(s.where, text(s) + " is not centred on the axis of revolution",
                     "a `point` at radius zero: [\"0 mm\", ...]");
  if (s.shape == Shape::sphere) return;
  if (dimension == 3) return check_direction(s, "axis", s.axis, dimension);
  if (!s.axis.empty())
    throw InputError(s.where, fmt::format("'axis' of {} in an analysis of two dimensions", text(s)),
                     kind == AnalysisKind::plane_strain ? "no axis: a cylinder lies along z"
                                                        : "no axis: it is that of revolution");
}

/// Refuses motions that the kind of analysis does not have, and rotations that are not complete.
void check_motion(const cases::RigidSurfaceSpec& s, AnalysisKind kind, int dimension) {
  const auto refuse = [&](const char* key, const char* allowed) {
    throw InputError(s.where,
                     fmt::format("{} has a motion '{}', which this analysis does not have", text(s), key),
                     allowed);
  };
  // Motions that the kind of analysis does not have.
  if (kind == AnalysisKind::plane_strain && s.uz) refuse("uz", "ux, uy, rotation");
  if (kind == AnalysisKind::axisymmetric && s.ux) refuse("ux", "uy (or uz), along the axis");
  if (kind == AnalysisKind::axisymmetric && s.rotation) refuse("rotation", "uy (or uz), along the axis");
  if (kind == AnalysisKind::axisymmetric && s.uy && s.uz)
    throw InputError(s.where, text(s) + " has its motion along the axis twice", "uy or uz");
  // Then centre and axis, which mean nothing without a rotation and follow from z in plane strain.
  if (!s.rotation) {
    if (!s.rotation_centre.empty() || !s.rotation_axis.empty())
      throw InputError(s.where,
                       fmt::format("{} has a centre or axis of rotation, but does not turn", text(s)),
                       "rotation = ..., or neither");
    return;
  }
  if (!s.rotation_centre.empty()) check_size(s, "rotation_centre", s.rotation_centre.size(), dimension);
  if (dimension == 2) {
    if (!s.rotation_axis.empty())
      throw InputError(s.where, fmt::format("'rotation_axis' of {} in plane strain", text(s)),
                       "no rotation_axis: it is z");
    return;
  }
  if (s.rotation_axis.empty() && s.shape != Shape::cylinder)
    throw InputError(s.where, text(s) + " turns about no axis", "rotation_axis = [0, 0, 1]");
  if (!s.rotation_axis.empty()) check_direction(s, "rotation_axis", s.rotation_axis, dimension);
}

void check_contact(const cases::CaseSpec& spec, const cases::ContactSpec& c) {
  // A rigid surface has no nodes, so that it cannot be the slave; the checks after that refuse what has no
  // meaning on an exact shape.
  const auto as_slave = [&](const std::string& name) {
    if (spec.rigid_surface(name) != nullptr)
      throw InputError(
          c.where,
          fmt::format("the contact '{}' has the rigid surface '{}' where its slave may be", c.name, name),
          "slave = a surface group, master = the rigid surface");
  };
  as_slave(c.slave);
  for (const std::string& side : c.surfaces) as_slave(side);
  const cases::RigidSurfaceSpec* master = spec.rigid_surface(c.master);
  if (master == nullptr) return;
  const auto refuse = [&](const SourceLocation& where, const char* what, const char* allowed) {
    throw InputError(where, fmt::format("the contact '{}' with {} has {}", c.name, text(*master), what),
                     allowed);
  };
  // What follows from an exact shape: motion, large sliding, no smoothing, and heat only with a
  // temperature.
  if (!spec.has_mechanics())
    refuse(c.where, "no mechanics in this analysis, and no heat passes", "physics with mechanics");
  if (c.formulation != contact::Formulation::large_sliding)
    refuse(c.where, "small sliding", "formulation = \"large_sliding\"");
  if (c.smoothing) refuse(c.where, "smoothing, which is for meshes", "no smoothing: the surface is smooth");
  if (c.heat && spec.has_heat() && !master->temperature)
    refuse(c.heat->where, "heat, but the rigid surface has no temperature",
           "temperature = \"...\" of the [[rigid_surface]], or no [contact.heat]");
  if (master->temperature && (!c.heat || !spec.has_heat()))
    refuse(c.where, "no heat that passes into it, but it has a temperature",
           spec.has_heat() ? "a section [contact.heat], or no temperature" : "no temperature");
}

}  // namespace

contact::RigidSurface rigid_surface(const cases::RigidSurfaceSpec& spec, AnalysisKind kind) {
  const bool solid = kind == AnalysisKind::solid, axisymmetric = kind == AnalysisKind::axisymmetric;
  contact::RigidSurface s;
  s.shape = spec.shape;
  s.point = point_of(spec.point);
  s.radius = spec.radius;
  s.hollow = spec.hollow;
  if (spec.shape == Shape::plane) s.direction = point_of(spec.normal);
  if (spec.shape == Shape::cylinder) s.direction = solid ? point_of(spec.axis) : contact::Point{0, 0, 1};
  // About the axis of symmetry a cylinder is a plane in the section, normal to the radius.
  if (spec.shape == Shape::cylinder && axisymmetric) {
    s.shape = Shape::plane;
    s.point[0] = spec.radius;
    s.direction = {spec.hollow ? -1.0 : 1.0, 0, 0};
  }
  contact::RigidMotion& m = s.motion;
  if (spec.ux) m.translation[0] = spec.ux->table;
  if (spec.uy) m.translation[1] = spec.uy->table;
  if (spec.uz) m.translation[axisymmetric ? 1 : 2] = spec.uz->table;
  if (spec.rotation) m.angle = spec.rotation->table;
  m.centre = spec.rotation_centre.empty() ? s.point : point_of(spec.rotation_centre);
  if (spec.temperature) s.temperature = spec.temperature->table;
  if (!spec.rotation_axis.empty())
    m.axis = point_of(spec.rotation_axis);
  else if (solid && spec.shape == Shape::cylinder)
    m.axis = s.direction;
  return s;
}

void check_rigid_surfaces(const cases::CaseSpec& spec) {
  for (const cases::ContactSpec& c : spec.contacts) check_contact(spec, c);
  for (const cases::RigidSurfaceSpec& s : spec.rigid_surfaces) {
    check_shape(s, spec.analysis.kind, spec.dimension());
    check_motion(s, spec.analysis.kind, spec.dimension());
  }
}

}  // namespace solidus::setup
