#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "case/stage_input.hpp"
#include "contact/quantities.hpp"
#include "coupling/all_fields.hpp"
#include "input/units.hpp"
#include "results/output/run_folder.hpp"
#include "setup/body_input.hpp"
#include "setup/case_file.hpp"
#include "setup/dynamics_input.hpp"
#include "setup/heat_input.hpp"
#include "setup/rigid_surface_input.hpp"
#include "setup/run_input.hpp"
#include "setup/scheme_input.hpp"
#include "setup/time_input.hpp"

namespace solidus::model {

namespace {

template <class S>
std::vector<std::string> names_of(const std::vector<S>& sections) {
  std::vector<std::string> names;
  for (const S& s : sections) names.push_back(s.name);
  return names;
}

template <class S>
void check_names(const std::vector<S>& sections, const std::string& heading) {
  std::set<std::string> seen;
  for (const S& s : sections) {
    if (s.name.empty()) throw InputError(s.where, fmt::format("a {} has an empty name", heading));
    if (!seen.insert(s.name).second)
      throw InputError(s.where, fmt::format("the name '{}' is used by two {} sections", s.name, heading),
                       "each needs a name of its own");
  }
}

void check_analysis(const AnalysisSpec& a, std::size_t dimension) {
  if (a.gravity_direction.empty()) return;
  if (a.gravity_direction.size() != dimension && a.gravity_direction.size() != 3)
    throw InputError(a.where,
                     fmt::format("'gravity_direction' has {} components", a.gravity_direction.size()),
                     fmt::format("{} in this analysis", dimension));
  double length = 0;
  for (const double d : a.gravity_direction) length += std::abs(d);
  if (!(length > 0)) throw InputError(a.where, "'gravity_direction' has no length");
  if (a.kind == AnalysisKind::axisymmetric && std::abs(a.gravity_direction[0]) > 0)
    throw InputError(a.where, "gravity has a radial component, which no axisymmetric body can carry",
                     "gravity along the axis: [0, -1]");
  if (dimension == 2 && a.gravity_direction.size() == 3 && std::abs(a.gravity_direction[2]) > 0)
    throw InputError(a.where, "gravity points out of the plane of the analysis");
}

/// A slip in a size must not fill the memory.
void check_element_count(const MeshSpec& m, double elements) {
  constexpr double k_most = 1e8;
  if (elements > k_most)
    throw InputError(m.where, fmt::format("the shape '{}' would have {:.2g} elements", *m.shape, elements),
                     fmt::format("at most {:.0e}; larger elements, fewer divisions", k_most));
}

double product(const std::vector<int>& divisions) {
  double n = 1;
  for (const int d : divisions) n *= d;
  return n;
}

/// A rule for faces chooses surfaces, and its points have three coordinates.
void check_face_rule(const MeshGroupSpec& g) {
  const auto refuse = [&](const std::string& what, const std::string& allowed) {
    throw InputError(g.where, fmt::format("the group '{}' of the mesh: {}", g.name, what), allowed);
  };
  if (g.kind == MeshGroupSpec::Kind::body || !g.numbers.empty() || !g.label.empty())
    refuse("a rule chooses faces of the mesh", "no kind = \"body\", numbers or label beside a rule");
  for (const std::vector<double>* point : {&g.normal, &g.plane, &g.nearest})
    if (!point->empty() && point->size() != 3)
      refuse("a rule has a point or direction that is none", "three coordinates");
  if (!g.plane.empty() && g.normal.empty())
    refuse("'plane' is a point of a plane without its normal", "normal = [0, 0, 1] beside it");
  if (!g.normal.empty() && !(std::hypot(g.normal[0], g.normal[1], g.normal[2]) > 0))
    refuse("'normal' has no length", "a direction");
}

/// Coats are cut out of a block that is thick enough for all of them.
void check_coats(const MeshSpec& m) {
  if (m.coats.empty()) {
    if (m.mould && m.mould->bed)
      throw InputError(m.mould->where, "'bed' is what lies beyond coats, and there is no [[mesh.coat]]",
                       "[[mesh.coat]], or no 'bed'");
    return;
  }
  const SourceLocation& where = m.coats.front().where;
  if (!m.mould)
    throw InputError(where, "[[mesh.coat]] is cut out of a block of mould, and there is no [mesh.mould]",
                     "[mesh.mould] with walls thicker than all coats together");
  check_names(m.coats, "[[mesh.coat]]");
  double whole = 0;
  for (const MeshCoatSpec& coat : m.coats) whole += coat.thickness;
  for (const double wall : m.mould->walls)
    if (wall > 0 && wall <= whole)
      throw InputError(m.mould->where,
                       fmt::format("a wall of {:g} mm has no room for coats that are {:g} mm thick together",
                                   1e3 * wall, 1e3 * whole),
                       fmt::format("more than {:g} mm, or 0 where the shell is open", 1e3 * whole));
}

/// Names of bodies, and that a friction has heat.
void check_interfaces(const CaseSpec& spec) {
  const std::vector<std::string> bodies = names_of(spec.bodies);
  std::set<std::string> seen;
  std::set<std::pair<std::string, std::string>> pairs;
  for (const BodyInterfaceSpec& i : spec.interfaces) {
    if (!i.name.empty() && !seen.insert(i.name).second)
      throw InputError(i.where, fmt::format("the name '{}' is used by two [[interface]] sections", i.name),
                       "each needs a name of its own");
    if (!i.all() && i.bodies.size() != 2)
      throw InputError(i.where, "an interface is between two bodies",
                       "bodies = [\"casting\", \"mould\"], or bodies = \"all\"");
    if (i.all()) continue;
    for (const std::string& body : i.bodies)
      if (std::find(bodies.begin(), bodies.end(), body) == bodies.end())
        throw InputError(i.where, fmt::format("an interface names the unknown body '{}'", body),
                         one_of(bodies, body));
    if (i.bodies[0] == i.bodies[1])
      throw InputError(i.where, fmt::format("an interface of the body '{}' with itself", i.bodies[0]),
                       "two bodies");
    if (!pairs.insert(std::minmax(i.bodies[0], i.bodies[1])).second)
      throw InputError(i.where,
                       fmt::format("two interfaces are between '{}' and '{}'", i.bodies[0], i.bodies[1]),
                       "one for each pair");
  }
}

void check_mesh(const MeshSpec& m, const AnalysisSpec& analysis) {
  // What the keys of [mesh] say together: one source of the mesh, and keys that belong to it. Each
  // contradiction has its own message.
  if (m.shape.has_value() == m.file.has_value())
    throw InputError(m.where,
                     m.shape ? "[mesh] has both a shape and a file" : "[mesh] has neither a shape nor a file",
                     "shape = \"...\" or file = \"...\"");
  if (!m.unit.empty() && !units::compatible(m.unit, "m"))
    throw InputError(m.where, fmt::format("'{}' is no unit of length", m.unit),
                     "\"mm\", \"m\", \"inch\", ...");
  check_names(m.groups, "[[mesh.group]]");
  check_names(m.layers, "[[mesh.layers]]");
  if (m.mould && m.mould->walls.size() != 1 && m.mould->walls.size() != 6)
    throw InputError(m.mould->where, fmt::format("'walls' has {} lengths", m.mould->walls.size()),
                     "one, or six: lowest and highest x, y and z");
  check_coats(m);
  // Sizes, mould, riser and symmetry make the mesh of a casting from a geometry, and exclude what sizes
  // elements otherwise.
  const bool of_casting = !m.sizes.empty() || m.mould || m.riser || m.symmetry;
  if (m.way > 0 && !of_casting)
    throw InputError(m.where, "'way' is for files that are meshed by the thickness of walls",
                     "[[mesh.size]] for each body, or no 'way'");
  if (of_casting && (m.element_size || m.conforming))
    throw InputError(m.where,
                     fmt::format("'{}' beside [[mesh.size]], [mesh.mould], [mesh.riser] or [mesh.symmetry], "
                                 "which make sizes and shared faces themselves",
                                 m.element_size ? "element_size" : "conforming"),
                     "[[mesh.size]] for each body");
  if (m.riser && m.riser->foot.size() != 3)
    throw InputError(m.riser->where, fmt::format("'foot' has {} coordinates", m.riser->foot.size()), "three");
  // A group is chosen in exactly one way.
  for (const MeshGroupSpec& g : m.groups) {
    const bool box = !g.lowest.empty() || !g.highest.empty();
    if (g.by_rule())
      check_face_rule(g);
    else if ((g.numbers.empty() ? 0 : 1) + (g.label.empty() ? 0 : 1) + (box ? 1 : 0) != 1)
      throw InputError(g.where, fmt::format("the group '{}' of the mesh is not chosen in one way", g.name),
                       "numbers, label, or lowest and highest; or owner, normal, plane, nearest");
    if (box && (g.lowest.size() != 3 || g.highest.size() != 3))
      throw InputError(g.where, fmt::format("the box of the group '{}' has no two corners", g.name),
                       "lowest and highest of three coordinates each");
  }
  // From here on the mesh is a built-in shape: its order follows from the element, and only groups by rule
  // exist.
  if (!m.shape) return;
  if (m.order != 1)
    throw InputError(
        m.where, "'order' is that of files that hold a geometry; a built-in shape takes it from 'element'",
        "element = \"tri6\", \"quad8\", \"tet10\" or \"hex20\" for the second order");
  const bool rules_alone =
      std::all_of(m.groups.begin(), m.groups.end(), [](const MeshGroupSpec& g) { return g.by_rule(); });
  if (!rules_alone || m.conforming)
    throw InputError(m.where,
                     "[[mesh.group]] without a rule and 'conforming' are for files, and the mesh is a "
                     "built-in shape");
  if (of_casting)
    throw InputError(m.where,
                     "[[mesh.size]], [mesh.mould], [mesh.riser] and [mesh.symmetry] are for files that hold "
                     "a geometry, and the mesh is a built-in shape");
  if (!m.constants.empty())
    throw InputError(m.where, "[[mesh.constant]] is for .geo scripts, and the mesh is a built-in shape");
  const bool solid = analysis.kind == AnalysisKind::solid;
  const bool element_3d = m.element.starts_with("tet") || m.element.starts_with("hex");
  if (solid != element_3d)
    throw InputError(m.where,
                     fmt::format("element \"{}\" is not for a {} analysis", m.element,
                                 solid ? "three-dimensional" : "two-dimensional"),
                     solid ? "one of: tet4, tet10, hex8, hex20" : "one of: tri3, tri6, quad4, quad8");
  if (*m.shape == "cylinder_in_mould") {
    if (!m.cylinder_in_mould) throw InputError(m.where, "the section [mesh.cylinder_in_mould] is missing");
    if (analysis.kind != AnalysisKind::axisymmetric)
      throw InputError(m.where, "the shape cylinder_in_mould is for axisymmetric analyses");
    const CylinderInMouldSpec& c = *m.cylinder_in_mould;
    if (c.mould_height < (c.mould_bottom + c.height) * (1 - 1e-12))
      throw InputError(m.where, "the mould is lower than its bottom and the casting together",
                       "mould_height >= mould_bottom + height");
    const double width = c.radius + c.mould_wall;
    check_element_count(m, c.radius * c.height / (c.element_size * c.element_size) +
                               width * c.mould_height / (c.mould_element_size * c.mould_element_size));
  }
  if (*m.shape == "block") {
    if (!m.block) throw InputError(m.where, "the section [mesh.block] is missing");
    const std::size_t dimension = solid ? 3 : 2;
    const bool origin_fits = m.block->origin.empty() || m.block->origin.size() == dimension;
    if (m.block->size.size() != dimension || m.block->divisions.size() != dimension || !origin_fits)
      throw InputError(m.where, "[mesh.block] does not fit the analysis",
                       fmt::format("{} lengths and {} divisions", dimension, dimension));
    check_element_count(m, product(m.block->divisions));
  }
  if (*m.shape == "two_blocks") {
    if (!m.two_blocks) throw InputError(m.where, "the section [mesh.two_blocks] is missing");
    const TwoBlocksSpec& t = *m.two_blocks;
    const std::size_t dimension = solid ? 3 : 2;
    for (const std::size_t n :
         {t.lower.size(), t.upper.size(), t.lower_divisions.size(), t.upper_divisions.size()})
      if (n != dimension)
        throw InputError(m.where, "[mesh.two_blocks] does not fit the analysis",
                         fmt::format("{} lengths and {} divisions for each block", dimension, dimension));
    check_element_count(m, product(t.lower_divisions) + product(t.upper_divisions));
  }
}

void check_displacement(const MechanicalConditionSpec& c, AnalysisKind kind) {
  if (!c.ux && !c.uy && !c.uz && !c.ur)
    throw InputError(c.where, fmt::format("the displacement '{}' prescribes no component", c.name),
                     kind == AnalysisKind::axisymmetric ? "ur and/or uz" : "ux, uy, uz");
  const auto refuse = [&](const char* name, const char* allowed) {
    throw InputError(
        c.where, fmt::format("'{}' has a component '{}', which this analysis does not have", c.name, name),
        allowed);
  };
  if (kind == AnalysisKind::plane_strain && (c.uz || c.ur)) refuse(c.uz ? "uz" : "ur", "ux, uy");
  if (kind == AnalysisKind::solid && c.ur) refuse("ur", "ux, uy, uz");
  if (kind == AnalysisKind::axisymmetric && ((c.ux && c.ur) || (c.uy && c.uz)))
    throw InputError(c.where, fmt::format("'{}' gives the same component twice", c.name),
                     "ur and uz are x and y");
}

void check_conditions(const CaseSpec& spec) {
  check_names(spec.thermal_conditions, "[[thermal_condition]]");
  check_names(spec.mechanical_conditions, "[[mechanical_condition]]");
  if (!spec.has_heat() && !spec.thermal_conditions.empty())
    throw InputError(spec.thermal_conditions.front().where, "there is no heat in this analysis",
                     "physics = \"heat\" or \"thermomechanical\"");
  if (!spec.has_mechanics() && !spec.mechanical_conditions.empty())
    throw InputError(spec.mechanical_conditions.front().where, "there is no mechanics in this analysis",
                     "physics = \"mechanics\" or \"thermomechanical\"");
  for (const auto& c : spec.mechanical_conditions) {
    if (c.kind == MechanicalConditionSpec::Kind::displacement) check_displacement(c, spec.analysis.kind);
    if (c.kind == MechanicalConditionSpec::Kind::traction &&
        c.traction.size() != static_cast<std::size_t>(spec.dimension()))
      throw InputError(c.where, fmt::format("the traction '{}' has {} components", c.name, c.traction.size()),
                       fmt::format("{} in this analysis", spec.dimension()));
  }
}

/// Friction makes heat: it needs a way out of the interface.
void check_friction_heat(const CaseSpec& spec, const ContactSpec& c) {
  if (!c.friction || !spec.coupled()) return;
  if (!c.heat)
    throw InputError(c.where, fmt::format("friction of the contact '{}' makes heat, but none passes", c.name),
                     "a section [contact.heat], or physics = \"mechanics\"");
}

/// Checks that an interface that stores heat gets any.
void check_interface(const CaseSpec& spec, const ContactSpec& c) {
  if (c.interface.heat_capacity == 0 || (c.heat && spec.has_heat())) return;
  throw InputError(
      c.where,
      fmt::format("the interface of the contact '{}' stores heat, but nothing conducts heat to it", c.name),
      "a section [contact.heat] beside it in a case with heat, or no [contact.interface]");
}

void check_contacts(const CaseSpec& spec) {
  check_names(spec.contacts, "[[contact]]");
  check_names(spec.rigid_surfaces, "[[rigid_surface]]");
  check_rigid_surfaces(spec);
  for (const auto& c : spec.contacts) {
    check_friction_heat(spec, c);
    check_interface(spec, c);
    const bool named = !c.slave.empty() || !c.master.empty();
    const bool complete =
        c.surfaces.empty() ? !c.slave.empty() && !c.master.empty() : c.surfaces.size() == 2 && !named;
    if (!complete)
      throw InputError(c.where, fmt::format("the contact '{}' does not name its two surfaces", c.name),
                       "slave = \"...\" and master = \"...\", or surfaces = [\"...\", \"...\"]");
    if (c.sides()[0] == c.sides()[1])
      throw InputError(c.where, fmt::format("the contact '{}' has one surface on both sides", c.name));
    if (c.heat) contact::HeatTransferLaw checked(contact::without_bodies(*c.heat));
  }
}

/// The unit of a field in this case: the internal variable of friction may be a slip
/// (results/fields/state_fields.cpp).
std::string field_unit(const CaseSpec& spec, const std::string& field) {
  if (field != contact::fields::k_internal_variable.name) return std::string(coupling::field_of(field).unit);
  bool works = false, slips = false;
  for (const ContactSpec& c : spec.contacts) {
    if (!c.friction) continue;
    const bool slip = c.friction->internal_variable == contact::InternalVariable::slip;
    (slip ? slips : works) = true;
  }
  return works && slips ? "1" : slips ? "m" : "N/m";
}

/// The unit of a probe inside the program, through differences.
std::string probe_unit(const CaseSpec& spec, const ProbeSpec& probe) {
  if (probe.kind != ProbeSpec::Kind::difference) return field_unit(spec, probe.field);
  const auto first = std::find_if(spec.probes.begin(), spec.probes.end(),
                                  [&](const ProbeSpec& p) { return p.name == probe.of[0]; });
  return field_unit(spec, first->field);
}

/// The unit of an integral follows from the dimension of its group, which only the mesh knows; which global
/// columns there are, the phases.
bool has_unit_of_the_run(const CaseSpec& spec, const ProbeSpec& probe) {
  const auto later = [](const ProbeSpec& p) {
    return p.kind == ProbeSpec::Kind::integral || p.kind == ProbeSpec::Kind::global;
  };
  if (probe.kind != ProbeSpec::Kind::difference) return later(probe);
  return std::any_of(spec.probes.begin(), spec.probes.end(),
                     [&](const ProbeSpec& p) { return p.name == probe.of[0] && later(p); });
}

void check_profiles(const CaseSpec& spec) {
  check_names(spec.profiles, "[[profile]]");
  for (const ProfileSpec& p : spec.profiles) {
    // The name becomes that of a file, and the units of columns those of fields.
    const bool plain = std::all_of(p.name.begin(), p.name.end(), [](unsigned char c) {
      return std::isalnum(c) != 0 || c == '_' || c == '-';
    });
    if (!plain || results::RunFolder::is_taken(p.name + ".csv"))
      throw InputError(p.where, fmt::format("a file cannot be called '{}.csv' here", p.name),
                       "letters, digits, _ and -; not history, steps and pools");
    if (p.columns.empty())
      throw InputError(p.where, fmt::format("the profile '{}' has no [[profile.column]]", p.name));
    check_names(p.columns, "[[profile.column]]");
    for (const ProfileColumnSpec& c : p.columns)
      if (!units::compatible(c.unit, field_unit(spec, c.field)))
        throw InputError(c.where, fmt::format("the column '{}' cannot be given in '{}'", c.name, c.unit),
                         "a unit of " + units::dimension_name(field_unit(spec, c.field)));
  }
}

void check_probes(const CaseSpec& spec) {
  // A difference needs two probes that exist and are no differences themselves.
  check_names(spec.probes, "[[probe]]");
  const std::vector<std::string> bodies = names_of(spec.bodies), probes = names_of(spec.probes);
  for (const auto& p : spec.probes) {
    if (p.kind == ProbeSpec::Kind::difference) {
      if (p.of.size() != 2)
        throw InputError(p.where, fmt::format("the probe '{}' needs two others", p.name),
                         "of = [\"a\", \"b\"]");
      for (const std::string& other : p.of) {
        const auto found = std::find_if(spec.probes.begin(), spec.probes.end(),
                                        [&](const ProbeSpec& q) { return q.name == other; });
        if (found == spec.probes.end())
          throw InputError(
              p.where,
              fmt::format("the probe '{}' is the difference of an unknown probe '{}'", p.name, other),
              one_of(probes, other));
        if (found->kind == ProbeSpec::Kind::difference)
          throw InputError(p.where, fmt::format("the probe '{}' is the difference of a difference", p.name));
      }
    }
    if (p.kind == ProbeSpec::Kind::point && p.point.size() != static_cast<std::size_t>(spec.dimension()))
      throw InputError(p.where,
                       fmt::format("the point of the probe '{}' has {} coordinates", p.name, p.point.size()),
                       fmt::format("{} in this analysis", spec.dimension()));
    if (p.body && std::find(bodies.begin(), bodies.end(), *p.body) == bodies.end())
      throw InputError(p.where, fmt::format("the probe '{}' is on an unknown body '{}'", p.name, *p.body),
                       one_of(bodies, *p.body));
    if (!p.field.empty() && coupling::field_of(p.field).of_contact() && spec.contacts.empty() &&
        spec.interfaces.empty())
      throw InputError(
          p.where,
          fmt::format("the probe '{}' reads the field '{}', but nothing is in contact", p.name, p.field),
          "a [[contact]], or another field");
    if (!has_unit_of_the_run(spec, p) && !units::compatible(p.unit, probe_unit(spec, p)))
      throw InputError(p.where, fmt::format("the probe '{}' cannot be given in '{}'", p.name, p.unit),
                       "a unit of " + units::dimension_name(probe_unit(spec, p)));
  }
}

void check_coupling(const CaseSpec& spec) {
  if (!spec.coupled()) return;
  using Heating = CouplingSpec::StructuralHeatForm;
  const CouplingSpec& c = spec.coupling;
  if (const auto wrong = c.scheme->objection(scheme_context(spec, false)))
    throw InputError(c.where, wrong->found, wrong->allowed);
  if (const std::string reason = against_two_stages(spec);
      spec.heat.stepping == heat::ThermalStepping::sdirk2 && !reason.empty())
    throw InputError(c.where, "heat.stepping = \"sdirk2\": " + reason,
                     "no such key, or a split whose phases are solved once a step, one after the other, with "
                     "structural_heating "
                     "\"energy\" or \"none\"");
  if (c.as_printed && (c.structural_heating == Heating::energy || c.structural_heating == Heating::none))
    throw InputError(c.where, "as_printed has no meaning without a printed form of structural heat",
                     "structural_heating \"entropy\", \"literal\" or \"temperature\", or as_printed = false");
}

void check_simplices(const CaseSpec& spec) {
  const MechanicsSpec& m = spec.mechanics;
  if (m.stabilisation == mechanics::Stabilisation::algebraic && spec.dynamics)
    throw InputError(
        spec.dynamics->where,
        "mechanics.stabilisation = \"algebraic\" is for quasi-statics: its residual has no inertia",
        "stabilisation = \"orthogonal\"");
}

void check_output(const OutputSpec& o) {
  const auto check = [&](const std::string& unit, const char* si, const char* key, const char* allowed) {
    if (!units::compatible(unit, si))
      throw InputError(o.where, fmt::format("'{}' is no unit for {}", unit, key), allowed);
  };
  check(o.length_unit, "m", "length_unit", "\"mm\", \"m\", \"inch\", ...");
  check(o.temperature_unit, "K", "temperature_unit", "\"degC\", \"degF\", \"K\"");
  check(o.stress_unit, "Pa", "stress_unit", "\"MPa\", \"ksi\", ...");
}

}  // namespace

void check_case(const CaseSpec& spec) {
  // Each section by itself, then what sections say together.
  check_analysis(spec.analysis, static_cast<std::size_t>(spec.dimension()));
  check_mesh(spec.mesh, spec.analysis);
  check_time(spec);
  if (spec.bodies.empty())
    throw InputError(spec.mesh.where, "the case has no body", "at least one [[body]] section");
  check_names(spec.bodies, "[[body]]");
  check_conditions(spec);
  check_contacts(spec);
  check_interfaces(spec);
  check_stage_names(spec);
  check_bodies(spec);
  check_coupling(spec);
  check_dynamics(spec);
  check_simplices(spec);
  check_probes(spec);
  check_profiles(spec);
  check_output(spec.output);
  probes(spec), profiles(spec);  // components that their fields do not have
  if (!spec.time.steady && spec.output.every && *spec.time.end / *spec.output.every > 1e6)
    throw InputError(spec.time.where, "more than a million outputs are asked for",
                     "a longer `every` in [output]");
  for (const ThermalConditionSpec& c : spec.thermal_conditions)
    if (spec.time.steady && c.kind == ThermalConditionSpec::Kind::exothermic)
      throw InputError(c.where, fmt::format("'{}' burns, and a steady analysis has no time for it", c.name),
                       "steady = false, or kind = \"source\"");
  if (spec.time.steady && spec.dynamics)
    throw InputError(spec.dynamics->where, "inertia in a steady analysis, in which nothing moves",
                     "no [dynamics], or steady = false");
}

}  // namespace solidus::model
