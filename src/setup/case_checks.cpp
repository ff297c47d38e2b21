#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "cases/stage_input.hpp"
#include "contact/quantities.hpp"
#include "coupling/all_fields.hpp"
#include "input/units.hpp"
#include "numbers/index_casts.hpp"
#include "results/output/run_folder.hpp"
#include "setup/body_input.hpp"
#include "setup/case_file.hpp"
#include "setup/channel_input.hpp"
#include "setup/deposition.hpp"
#include "setup/dynamics_input.hpp"
#include "setup/heat_input.hpp"
#include "setup/jet_input.hpp"
#include "setup/mesh_section.hpp"
#include "setup/rigid_surface_input.hpp"
#include "setup/rotation_input.hpp"
#include "setup/run_input.hpp"
#include "setup/scheme_input.hpp"
#include "setup/section_names.hpp"
#include "setup/source_input.hpp"
#include "setup/time_input.hpp"

namespace solidus::setup {

namespace {

template <class S>
std::vector<std::string> names_of(const std::vector<S>& sections) {
  std::vector<std::string> names;
  for (const S& s : sections) names.push_back(s.name);
  return names;
}

void check_analysis(const cases::AnalysisSpec& a, std::size_t dimension) {
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

/// Names of bodies, and that a friction has heat.
void check_interfaces(const cases::CaseSpec& spec) {
  const std::vector<std::string> bodies = names_of(spec.bodies);
  std::set<std::string> seen;
  std::set<std::pair<std::string, std::string>> pairs;
  for (const cases::BodyInterfaceSpec& i : spec.interfaces) {
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

/// What cannot be had where surfaces see each other: values that vary from place to place, the open rule, and
/// a scheme that solves for displacements and temperatures at once.
void check_enclosure(const cases::CaseSpec& spec) {
  using C = cases::ThermalConditionSpec;
  std::vector<const C*> seen;
  for (const C& c : spec.thermal_conditions) {
    if (c.kind != C::Kind::radiation || c.sees != C::Sees::enclosure) continue;
    for (const auto& [key, f] :
         {std::pair{"emissivity", &c.emissivity}, {"ambient", &c.ambient}, {"factor", &c.factor}})
      if (f->place != nullptr)
        throw InputError(f->where,
                         fmt::format("'{}' of '{}' is a function of place, but its surface is in an "
                                     "enclosure",
                                     key, c.name),
                         "a number or a table; surfaces of their own where it differs");
    if (spec.heat.integration == heat::HeatIntegration::open)
      throw InputError(c.where, fmt::format("'{}' is in an enclosure, which the open rule has not", c.name),
                       "heat.integration = \"closed\", which is the default");
    if (spec.simultaneous())
      throw InputError(c.where,
                       fmt::format("'{}' is in an enclosure, which the simultaneous scheme has not", c.name),
                       "another coupling.scheme, or radiation = \"ambient\"");
    // In one stage a surface is there once.
    for (const C* other : seen) {
      const bool together =
          c.stages.empty() || other->stages.empty() ||
          std::ranges::any_of(c.stages, [&](const std::string& stage) {
            return std::find(other->stages.begin(), other->stages.end(), stage) != other->stages.end();
          });
      if (c.group == other->group && together)
        throw InputError(c.where, fmt::format("the surface '{}' is in the enclosure twice", c.group),
                         "one condition with radiation = \"enclosure\" for each surface");
    }
    seen.push_back(&c);
  }
}

void check_displacement(const cases::MechanicalConditionSpec& c, AnalysisKind kind) {
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

void check_conditions(const cases::CaseSpec& spec) {
  // Names first, then that the analysis has the physics that a condition or a stress belongs to.
  check_names(spec.thermal_conditions, "[[thermal_condition]]");
  check_names(spec.mechanical_conditions, "[[mechanical_condition]]");
  if (!spec.has_heat() && !spec.thermal_conditions.empty())
    throw InputError(spec.thermal_conditions.front().where, "there is no heat in this analysis",
                     "physics = \"heat\" or \"thermomechanical\"");
  if (!spec.has_mechanics() && !spec.mechanical_conditions.empty())
    throw InputError(spec.mechanical_conditions.front().where, "there is no mechanics in this analysis",
                     "physics = \"mechanics\" or \"thermomechanical\"");
  for (const cases::BodySpec& body : spec.bodies)
    if (!spec.has_mechanics() && body.initial_stress)
      throw InputError(body.initial_stress->where, "there is no mechanics in this analysis",
                       "physics = \"mechanics\" or \"thermomechanical\", or no initial_stress");
  check_enclosure(spec);
  // What a mechanical condition gives, it gives for each direction of the mesh.
  for (const auto& c : spec.mechanical_conditions) {
    if (c.kind == cases::MechanicalConditionSpec::Kind::displacement)
      check_displacement(c, spec.analysis.kind);
    using Kind = cases::MechanicalConditionSpec::Kind;
    const auto n_directions = as_size(spec.dimension());
    const std::vector<Function>& directions = c.kind == Kind::traction ? c.traction : c.force;
    if ((c.kind == Kind::traction || c.kind == Kind::body_force) && directions.size() != n_directions)
      throw InputError(
          c.where,
          fmt::format("the {} '{}' has {} components", c.kind == Kind::traction ? "traction" : "force",
                      c.name, directions.size()),
          fmt::format("{} in this analysis", n_directions));
    if (c.kind == Kind::metallostatic && spec.analysis.gravity == 0)
      throw InputError(c.where, fmt::format("'{}' is the pressure of a melt, but gravity is 0", c.name),
                       "gravity = \"9.81 m/s2\" in [analysis]");
  }
}

/// Friction makes heat: it needs a way out of the interface.
void check_friction_heat(const cases::CaseSpec& spec, const cases::ContactSpec& c) {
  if (!c.friction || !spec.coupled()) return;
  if (!c.heat)
    throw InputError(c.where, fmt::format("friction of the contact '{}' makes heat, but none passes", c.name),
                     "a section [contact.heat], or physics = \"mechanics\"");
}

/// Checks that an interface that stores heat gets any.
void check_interface(const cases::CaseSpec& spec, const cases::ContactSpec& c) {
  if (c.interface.heat_capacity == 0 || (c.heat && spec.has_heat())) return;
  throw InputError(
      c.where,
      fmt::format("the interface of the contact '{}' stores heat, but nothing conducts heat to it", c.name),
      "a section [contact.heat] along with it in a case with heat, or no [contact.interface]");
}

void check_contacts(const cases::CaseSpec& spec) {
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
std::string field_unit(const cases::CaseSpec& spec, const std::string& field) {
  if (field != contact::fields::k_internal_variable.name) return std::string(coupling::field_of(field).unit);
  bool works = false, slips = false;
  for (const cases::ContactSpec& c : spec.contacts) {
    if (!c.friction) continue;
    const bool slip = c.friction->internal_variable == contact::InternalVariable::slip;
    (slip ? slips : works) = true;
  }
  return works && slips ? "1" : slips ? "m" : "N/m";
}

/// The unit of a probe inside the program, through differences.
std::string probe_unit(const cases::CaseSpec& spec, const cases::ProbeSpec& probe) {
  if (probe.kind != cases::ProbeSpec::Kind::difference) return field_unit(spec, probe.field);
  const auto first = std::find_if(spec.probes.begin(), spec.probes.end(),
                                  [&](const cases::ProbeSpec& p) { return p.name == probe.of[0]; });
  return field_unit(spec, first->field);
}

/// The unit of an integral follows from the dimension of its group, which only the mesh knows; which global
/// columns there are, the phases.
bool has_unit_of_the_run(const cases::CaseSpec& spec, const cases::ProbeSpec& probe) {
  const auto later = [](const cases::ProbeSpec& p) {
    return p.kind == cases::ProbeSpec::Kind::integral || p.kind == cases::ProbeSpec::Kind::global;
  };
  if (probe.kind != cases::ProbeSpec::Kind::difference) return later(probe);
  return std::any_of(spec.probes.begin(), spec.probes.end(),
                     [&](const cases::ProbeSpec& p) { return p.name == probe.of[0] && later(p); });
}

void check_profiles(const cases::CaseSpec& spec) {
  check_names(spec.profiles, "[[profile]]");
  for (const cases::ProfileSpec& p : spec.profiles) {
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
    for (const cases::ProfileColumnSpec& c : p.columns)
      if (!units::compatible(c.unit, field_unit(spec, c.field)))
        throw InputError(c.where, fmt::format("the column '{}' cannot be given in '{}'", c.name, c.unit),
                         "a unit of " + units::dimension_name(field_unit(spec, c.field)));
  }
}

void check_probes(const cases::CaseSpec& spec) {
  // A difference needs two probes that exist and are no differences themselves.
  check_names(spec.probes, "[[probe]]");
  const std::vector<std::string> bodies = names_of(spec.bodies), probes = names_of(spec.probes);
  for (const auto& p : spec.probes) {
    if (p.kind == cases::ProbeSpec::Kind::difference) {
      if (p.of.size() != 2)
        throw InputError(p.where, fmt::format("the probe '{}' needs two others", p.name),
                         "of = [\"a\", \"b\"]");
      for (const std::string& other : p.of) {
        const auto found = std::find_if(spec.probes.begin(), spec.probes.end(),
                                        [&](const cases::ProbeSpec& q) { return q.name == other; });
        if (found == spec.probes.end())
          throw InputError(
              p.where,
              fmt::format("the probe '{}' is the difference of an unknown probe '{}'", p.name, other),
              one_of(probes, other));
        if (found->kind == cases::ProbeSpec::Kind::difference)
          throw InputError(p.where, fmt::format("the probe '{}' is the difference of a difference", p.name));
      }
    }
    if (p.kind == cases::ProbeSpec::Kind::point && p.point.size() != as_size(spec.dimension()))
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

void check_coupling(const cases::CaseSpec& spec) {
  if (!spec.coupled()) return;
  using Heating = cases::CouplingSpec::StructuralHeatForm;
  const cases::CouplingSpec& c = spec.coupling;
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

void check_simplices(const cases::CaseSpec& spec) {
  const cases::MechanicsSpec& m = spec.mechanics;
  if (m.stabilisation == mechanics::Stabilisation::algebraic && spec.dynamics)
    throw InputError(
        spec.dynamics->where,
        "mechanics.stabilisation = \"algebraic\" is for quasi-statics: its residual has no inertia",
        "stabilisation = \"orthogonal\"");
}

void check_output(const cases::OutputSpec& o) {
  const auto check = [&](const std::string& unit, const char* si, const char* key, const char* allowed) {
    if (!units::compatible(unit, si))
      throw InputError(o.where, fmt::format("'{}' is no unit for {}", unit, key), allowed);
  };
  check(o.length_unit, "m", "length_unit", "\"mm\", \"m\", \"inch\", ...");
  check(o.temperature_unit, "K", "temperature_unit", "\"degC\", \"degF\", \"K\"");
  check(o.stress_unit, "Pa", "stress_unit", "\"MPa\", \"ksi\", ...");
}

/// Values of [filling] over its times.
void check_over_times(const cases::FillingSpec& filling, const std::vector<double>& values, const char* key,
                      bool negative) {
  if (values.empty()) return;
  if (values.size() != filling.times.size())
    throw InputError(
        filling.where,
        fmt::format("'{}' has {} values and 'times' {}", key, values.size(), filling.times.size()),
        "as many as times");
  if (!negative && std::ranges::any_of(values, [](double v) { return v < 0; }))
    throw InputError(filling.where, fmt::format("'{}' is negative at a time", key), "0 or more");
  if (!negative && std::ranges::all_of(values, [](double v) { return v == 0; }))
    throw InputError(filling.where, fmt::format("'{}' is zero at all times: no metal comes", key),
                     "more than 0 at a time");
}

/// What drives the metal in, and how the mould turns.
void check_drive(const cases::FillingSpec& filling) {
  // One thing alone says how fast the metal comes.
  const int drives = filling.time.has_value() + filling.rate.has_value() + filling.head.has_value() +
                     !filling.speed.empty() + !filling.pressure.empty();
  if (drives > 1)
    throw InputError(filling.where, "[filling] says more than once how fast the metal comes",
                     "time or rate or head, or speed or pressure over times");
  if (!filling.times.empty() && filling.times.front() != 0)
    throw InputError(filling.where, "'times' do not begin with 0 s", "0 s first");
  if (std::ranges::adjacent_find(filling.times, std::greater_equal<>()) != filling.times.end())
    throw InputError(filling.where, "'times' do not rise", "each later than the one before");
  if (!filling.times.empty() && filling.speed.empty() && filling.pressure.empty() && filling.tilt.empty())
    throw InputError(filling.where, "nothing is given over 'times'", "speed, pressure or tilt");
  check_over_times(filling, filling.speed, "speed", false);
  check_over_times(filling, filling.pressure, "pressure", false);
  check_over_times(filling, filling.tilt, "tilt", true);
  const bool turns = std::ranges::any_of(filling.tilt_axis, [](double x) { return x != 0; });
  if (!filling.tilt.empty() && (filling.tilt_axis.size() != 3 || !turns))
    throw InputError(filling.where, "'tilt' needs the direction of its axis", "tilt_axis = [0, 1, 0]");
}

/// What the keys of [filling] say together and of the analysis.
void check_filling(const cases::CaseSpec& spec) {
  if (!spec.filling) return;
  const cases::FillingSpec& filling = *spec.filling;
  if (spec.analysis.kind != AnalysisKind::solid)
    throw InputError(filling.where, "the mould is filled in three dimensions only",
                     "kind = \"solid\" in [analysis]");
  if (!spec.has_heat())
    throw InputError(filling.where, "filling gives temperatures to start from, and no heat is computed",
                     "no [filling], or an analysis with heat");
  // Of two keys that say the same only one may be given.
  if (filling.gate && !filling.gate_at.empty())
    throw InputError(filling.where, "the gate is given twice", "gate or gate_at");
  if (!filling.gate_at.empty() && filling.gate_at.size() != 3)
    throw InputError(filling.where, fmt::format("'gate_at' has {} coordinates", filling.gate_at.size()),
                     "three");
  if (filling.gate && filling.gate_width)
    throw InputError(filling.where, "'gate_width' is that of a square at gate_at, and `gate` names its faces",
                     "one of both");
  check_drive(filling);
}

/// Heat that moves with metal is there for what a run of heat alone with one set of bodies has.
void check_feeding(const cases::CaseSpec& spec) {
  const auto refuse = [&](const char* why, const char* instead) {
    throw InputError(spec.feeding.where, fmt::format("feeding.moves_heat: {}", why), instead);
  };
  if (spec.has_mechanics() || !spec.has_heat())
    refuse("metal moves in runs of heat alone", "moves_heat = false, or a run with --heat-only");
  if (!spec.feeding.follow || !spec.criteria.follow || spec.time.steady)
    refuse("no feeding is followed that could move metal", "follow = true in [feeding] and [criteria]");
  if (spec.heat.integration != heat::HeatIntegration::closed)
    refuse("the open rule cannot yet", "heat.integration = \"closed\"");
  if (!spec.stages.empty() || !spec.cycles.empty() || !spec.depositions.empty())
    refuse("not with stages, shots or bodies that grow yet", "moves_heat = false");
}

}  // namespace

void check_case(const cases::CaseSpec& spec) {
  // Each section by itself, then what sections say together.
  check_analysis(spec.analysis, as_size(spec.dimension()));
  check_mesh(spec.mesh, spec.analysis);
  check_time(spec);
  if (spec.bodies.empty()) throw InputError(spec.mesh.where, "the case has no body", "at least one [[body]]");
  check_names(spec.bodies, "[[body]]");
  check_conditions(spec);
  check_rotation(spec);
  check_dies(spec);
  check_shot_sleeves(spec);
  check_sources(spec);
  check_depositions(spec);
  check_contacts(spec);
  check_interfaces(spec);
  cases::check_stage_names(spec);
  check_bodies(spec);
  check_coupling(spec);
  check_dynamics(spec);
  check_simplices(spec);
  check_probes(spec);
  check_profiles(spec);
  check_output(spec.output);
  check_filling(spec);
  if (spec.feeding.moves_heat) check_feeding(spec);
  probes(spec), profiles(spec);  // components that their fields do not have
  if (!spec.time.steady && spec.output.every && *spec.time.end / *spec.output.every > 1e6)
    throw InputError(spec.time.where, "more than a million outputs are asked for",
                     "a longer `every` in [output]");
  for (const cases::ThermalConditionSpec& c : spec.thermal_conditions)
    if (spec.time.steady && c.kind == cases::ThermalConditionSpec::Kind::exothermic)
      throw InputError(c.where, fmt::format("'{}' burns, and a steady analysis has no time for it", c.name),
                       "steady = false, or kind = \"source\"");
  if (spec.time.steady && spec.dynamics)
    throw InputError(spec.dynamics->where, "inertia in a steady analysis",
                     "no [dynamics], or steady = false");
}

}  // namespace solidus::setup
