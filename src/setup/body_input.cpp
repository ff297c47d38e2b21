/// Which bodies leave, come back or only conduct is read from all stages at once, since what a body needs
/// depends on all of them.
#include "setup/body_input.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "linear/active_set.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::setup {

namespace {

bool named(const std::vector<std::string>& stages, const cases::StageRun* stage) {
  return !stages.empty() && stage != nullptr && holds(stages, stage);
}

/// Whether a group has a node, or as a surface a face, of an active body. Collective.
bool stands(const mesh::Mesh& mesh, const linear::ActiveSet& active, const std::string& group,
            bool needs_faces) {
  bool found = false;
  if (needs_faces) {
    const auto surface = mesh.surfaces.find(group);
    if (surface != mesh.surfaces.end())
      for (const mesh::ElementBlock& faces : active.part(mesh, surface->second).faces)
        found = found || faces.size() > 0;
  } else if (const auto nodes = mesh.node_sets.find(group); nodes != mesh.node_sets.end()) {
    found = std::any_of(nodes->second.begin(), nodes->second.end(),
                        [&](Index node) { return active.node(node); });
  }
  return parallel::any_process(found);
}

[[noreturn]] void refuse(const SourceLocation& where, const std::string& what, const cases::StageRun& stage) {
  throw InputError(where,
                   fmt::format("{} holds in the stage '{}', but its body has gone", what, stage.stage->name),
                   "stages in which the body is there, or no 'stages': then it ends with the body");
}

/// Whether bodies behind a contact surface have been removed, and whether others are active. Collective.
struct Sides {
  bool gone = false, there = false;
};
Sides sides(const mesh::Mesh& mesh, const linear::ActiveSet& active, const std::string& surface) {
  Sides found;
  const auto group = mesh.surfaces.find(surface);
  if (group == mesh.surfaces.end()) return found;  // a rigid surface
  for (const mesh::ElementBlock& faces : group->second.faces)
    if (faces.size() > 0) (active.reversed(faces) ? found.gone : found.there) = true;
  return {parallel::any_process(found.gone), parallel::any_process(found.there)};
}

void check_stages_of(const cases::CaseSpec& spec, const cases::BodySpec& body) {
  if (body.stages.empty()) return;
  if (spec.dynamics)
    throw InputError(body.where, fmt::format("the body '{}' leaves, but the analysis has inertia", body.name),
                     "no [dynamics], or no 'stages' of bodies");
}

}  // namespace

std::vector<std::string> gone_bodies(const cases::CaseSpec& spec, const cases::StageRun* stage) {
  std::vector<std::string> gone;
  for (const cases::BodySpec& body : spec.bodies)
    if (!holds(body.stages, stage)) gone.push_back(body.mesh_group());
  return gone;
}

std::vector<std::string> absent_from_mechanics(const cases::CaseSpec& spec, const cases::StageRun* stage) {
  std::vector<std::string> absent;
  for (const cases::BodySpec& body : spec.bodies)
    if (cases::only_conducts(body) || !holds(body.stages, stage)) absent.push_back(body.mesh_group());
  return absent;
}

void check_bodies(const cases::CaseSpec& spec) {
  for (const cases::BodySpec& body : spec.bodies) {
    check_stages_of(spec, body);
    if (!cases::only_conducts(body)) continue;
    // A body that conducts alone makes sense only among others that deform.
    if (!spec.coupled())
      throw InputError(
          body.where,
          fmt::format("the body '{}' has physics = \"heat\", but the analysis does not couple heat "
                      "with mechanics",
                      body.name),
          "physics = \"thermomechanical\" in [analysis], or no such key");
    if (!body.initial_velocity.empty())
      throw InputError(body.where,
                       fmt::format("the body '{}' only conducts heat and cannot have a velocity", body.name),
                       "no initial_velocity, or physics = \"all\"");
  }
  const auto all = [&](const auto& of) { return std::all_of(spec.bodies.begin(), spec.bodies.end(), of); };
  // Where all of them conduct alone the coupling has nothing to do.
  if (all(cases::only_conducts))
    throw InputError(spec.bodies.front().where, "no body deforms: all have physics = \"heat\"",
                     "physics = \"heat\" in [analysis]");
  // In heat and mechanics together nothing need deform: a die that only conducts waits for its next casting.
  for (const cases::StageRun& run : cases::stage_runs(spec))
    if (all([&](const cases::BodySpec& body) { return !holds(body.stages, &run); }))
      throw InputError(spec.bodies.front().where,
                       fmt::format("nothing is left in the stage '{}'", run.stage->name),
                       "a body that stays");
}

std::vector<char> new_bodies(const cases::CaseSpec& spec, const std::vector<cases::StageRun>& runs,
                             std::size_t number) {
  std::vector<char> fresh(spec.bodies.size(), 0);
  if (number == 0) return fresh;
  for (std::size_t b = 0; b < fresh.size(); ++b)
    fresh[b] =
        holds(spec.bodies[b].stages, &runs[number]) && !holds(spec.bodies[b].stages, &runs[number - 1]);
  return fresh;
}

void check_new_bodies(const cases::CaseSpec& spec, const std::vector<cases::StageRun>& runs,
                      const mesh::Mesh& mesh) {
  // A body that comes new into a stage starts without strain, so it may not share nodes with one that stays
  // and is strained. Rounds of a cycle beyond the second are like it.
  if (!spec.has_mechanics()) return;
  for (std::size_t i = 1; i < runs.size(); ++i) {
    if (!runs[i].pours || runs[i].cycle > 2) continue;  // all further rounds are like the second one
    // First the nodes of bodies that stay are marked, then those of new bodies are compared with them.
    const std::vector<char> fresh = new_bodies(spec, runs, i);
    std::vector<char> stays(mesh.x.size(), 0);  // [node] of a body that deforms and was there before
    std::string shares;
    SourceLocation where;
    for (const bool is_new : {false, true})
      for (const mesh::ElementBlock& block : mesh.blocks) {
        const auto b = as_size(block.body);
        const cases::BodySpec& body = spec.bodies[b];
        // Bodies that conduct alone have no displacements to share.
        if (cases::only_conducts(body) || !holds(body.stages, &runs[i]) || (fresh[b] != 0) != is_new)
          continue;
        bool shared = false;
        for (const Index node : block.nodes) {
          char& there = stays[as_size(node)];
          if (is_new)
            shared = shared || there != 0;
          else
            there = 1;
        }
        // All processes must know it before any of them throws.
        if (parallel::any_process(shared)) shares = body.name, where = body.where;
      }
    if (!shares.empty())
      throw InputError(
          where,
          fmt::format(
              "the body '{}' comes new into the stage '{}', but shares nodes with one that deforms and stays",
              shares, runs[i].stage->name),
          "nodes of its own and a contact, which [[interface]] makes");
  }
}

void set_walls(const cases::CaseSpec& spec, const mesh::Mesh& mesh, contact::ContactParameters& pair) {
  // A surface is a wall when no body behind it deforms. With free roles a lone wall becomes the master.
  std::vector<std::string> conductors;
  for (const cases::BodySpec& body : spec.bodies)
    if (cases::only_conducts(body)) conductors.push_back(body.mesh_group());
  const linear::ActiveSet deforms(mesh, conductors);
  if (deforms.complete()) return;
  // Gone in the sense of the set of deforming bodies, and with nothing on the surface that deforms.
  const auto is_wall = [&](const std::string& surface) {
    const Sides side = sides(mesh, deforms, surface);
    return side.gone && !side.there;
  };
  const bool slave = is_wall(pair.slave), master = is_wall(pair.master);
  if (pair.choose_roles && slave != master) {
    if (slave) std::swap(pair.slave, pair.master);
    pair.choose_roles = false;
  }
  if (!slave || !master) return;
  pair.penalty_is_factor = false;
  pair.penalty = 1;
}

bool holds(const cases::CaseSpec& spec, const cases::ContactSpec& contact, const mesh::Mesh& mesh,
           const cases::StageRun* stage) {
  if (!holds(contact.stages, stage)) return false;
  const linear::ActiveSet active(mesh, gone_bodies(spec, stage));
  if (active.complete()) return true;
  const auto surfaces = contact.sides();
  return std::none_of(surfaces.begin(), surfaces.end(),
                      [&](const std::string& surface) { return sides(mesh, active, surface).gone; });
}

std::vector<std::string> without_body(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                                      const cases::StageRun* stage) {
  // Conditions and contacts whose body is absent in a stage are idle. One that names the stage in its own
  // list contradicts it, and is refused.
  std::vector<std::string> idle;
  const linear::ActiveSet there(mesh, gone_bodies(spec, stage)),
      deforms(mesh, absent_from_mechanics(spec, stage));
  if (deforms.complete()) return idle;
  // Thermal conditions need the body to be there, mechanical ones that it deforms, too.
  for (const cases::ThermalConditionSpec& c : spec.thermal_conditions) {
    using Kind = cases::ThermalConditionSpec::Kind;
    if (!holds(c.stages, stage)) continue;
    const bool needs_faces = c.kind != Kind::temperature && !c.in_volume();
    if (stands(mesh, there, c.group, needs_faces)) continue;
    if (named(c.stages, stage)) refuse(c.where, "the thermal condition '" + c.name + "'", *stage);
    idle.push_back(c.name);
  }
  for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) {
    if (!holds(c.stages, stage)) continue;
    const bool needs_faces = c.on_faces();
    if (stands(mesh, deforms, c.group, needs_faces)) continue;
    if (named(c.stages, stage) && !stands(mesh, there, c.group, needs_faces))
      refuse(c.where, "the mechanical condition '" + c.name + "'", *stage);
    idle.push_back(c.name);
  }
  // A contact is idle if one of its sides is gone. A side whose faces belong to a body that has gone and to
  // one that stays cannot be either.
  for (const cases::ContactSpec& c : spec.contacts) {
    if (!holds(c.stages, stage)) continue;
    for (const std::string& surface : c.sides()) {
      const Sides side = sides(mesh, there, surface);
      if (!side.gone) continue;
      if (side.there)
        throw InputError(
            c.where,
            fmt::format("the surface '{}' of the contact '{}' belongs to a body that has gone in the "
                        "stage '{}' and to one that stays",
                        surface, c.name, stage->stage->name),
            "one contact, and one surface, for each body");
      if (named(c.stages, stage)) refuse(c.where, "the contact '" + c.name + "'", *stage);
      idle.push_back(c.name);
      break;
    }
  }
  return idle;
}

}  // namespace solidus::setup
