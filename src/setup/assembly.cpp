/// Everything is built in the order of its needs: mesh, materials, heat, mechanics, contacts; a stage then
/// changes what it changes and nothing else.
#include "setup/assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "cases/case_materials.hpp"
#include "mechanics/new_bodies.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/admissible.hpp"
#include "setup/bare_melt.hpp"
#include "setup/body_input.hpp"
#include "setup/contact_input.hpp"
#include "setup/criteria_input.hpp"
#include "setup/heat_input.hpp"
#include "setup/initial_stress.hpp"
#include "setup/mechanics_input.hpp"
#include "setup/scheme_input.hpp"
#include "setup/skin_measures.hpp"
#include "system/log.hpp"

namespace solidus::setup {

namespace {

/// Temperatures at which nodes are free of thermal strain, and which they have in mechanics alone: every body
/// at its temperature. A node of several bodies takes that of one that deforms, of these the hottest: the
/// casting's. Where bodies grow, what is there at the start comes before what comes later.
std::vector<double> nodal_temperature(const cases::CaseSpec& spec, const InitialTemperatures& start,
                                      const Assembly& a) {
  const mesh::Mesh& mesh = a.mesh;
  using Rank = std::tuple<bool, bool, double>;
  std::vector<Rank> best(mesh.x.size(), {false, false, -1.0});
  for (const mesh::ElementBlock& block : mesh.blocks) {
    const bool deforms = !cases::only_conducts(spec.bodies[as_size(block.body)]);
    const int n = mesh::node_count(block.shape);
    for (Index e = 0; e < block.size(); ++e) {
      const bool there = !a.growth || a.growth->there(block.input_element[as_size(e)]);
      for (int k = 0; k < n; ++k) {
        const Index i = block.element(e)[k];
        Rank& here = best[as_size(i)];
        here = std::max(here, Rank(there, deforms, start.temperature(i, block.body)));
      }
    }
  }
  std::vector<double> temperature(mesh.x.size());
  for (std::size_t i = 0; i < best.size(); ++i)
    temperature[i] = std::get<double>(best[i]);          // ghosts may have no body
  parallel::GhostExchange(mesh).update(temperature, 1);  // an owner sees every body at its node
  return temperature;
}

/// Checks that the two surfaces of a contact are not one. Collective.
void check_separate(const mesh::Mesh& mesh, const contact::ContactParameters& pair) {
  const GlobalIndex shared = shared_nodes(mesh, pair.slave, pair.master);
  if (shared > 0 && shared == shared_nodes(mesh, pair.slave, pair.slave))
    throw InputError(pair.where,
                     fmt::format("the surfaces '{}' and '{}' of the contact '{}' share all their nodes: the "
                                 "bodies are one there, and no gap can open",
                                 pair.slave, pair.master, pair.name),
                     "bodies with nodes of their own: no mesh.conforming, no common faces in the geometry");
}

/// Warns of slave surfaces that contacts cover in part; several may share one. Surfaces that the program has
/// found are made of all faces that another body covers in part, at whose rim a part has no partner.
void check_coverage(const cases::CaseSpec& spec, const Assembly& a) {
  constexpr double k_given = 0.98, k_found = 0.5;
  for (std::size_t c = 0; c < a.contacts.size(); ++c) {
    const auto& pair = a.contacts[c];
    double covered = 0;
    bool slides = false;
    for (const auto& other : a.contacts) {
      if (other->parts().spec.slave != pair->parts().spec.slave) continue;
      covered += other->parts().geometry.kinematics().coverage();
      slides = slides || other->parts().spec.formulation == contact::Formulation::large_sliding;
    }
    if (!slides && covered < (spec.contacts[c].surfaces.empty() ? k_given : k_found))
      logging::warn("contact '{}': only {:.1f} % of the slave surface '{}' faces the master",
                    pair->parts().spec.name, 100 * pair->parts().geometry.kinematics().coverage(),
                    pair->parts().spec.slave);
  }
}

void build_contacts(const cases::CaseSpec& spec, Assembly& a) {
  std::vector<double> moduli = contact_moduli(a.materials);
  for (std::size_t b = 0; b < moduli.size(); ++b)
    if (cases::only_conducts(spec.bodies[b])) moduli[b] = 0;  // its stiffness makes no penalty
  const std::vector<double> sections = sections_of(spec, a.mesh);
  // Each pair gets what follows from mesh and materials before it is built: walls, leaving gap, penalty,
  // conductivity, direction of the normal.
  for (contact::ContactParameters& pair : contact_specs(spec)) {
    check_separate(a.mesh, pair);
    set_walls(spec, a.mesh, pair);
    set_leaving_gap(spec, a.mesh, a.materials, sections, pair);
    set_solid_penalty(a.mesh, a.materials, pair);
    set_mean_conductivity(a.mesh, a.materials, pair);
    choose_normal(spec, a.materials, pair);
    set_growing_surfaces(spec, a.mesh, pair);
    a.contacts.push_back(
        std::make_unique<contact::ContactPair>(a.mesh, spec.analysis.kind, std::move(pair), moduli));
    a.phases.contacts.push_back(a.contacts.back().get());
  }
  check_coverage(spec, a);
}

void build_mechanics(const cases::CaseSpec& spec, const std::vector<double>& initial_temperature,
                     Assembly& a) {
  std::vector<linear::Contribution*> contributions;
  // Each pair of surfaces adds forces and stiffness; the matrix is symmetric if that of all of them is.
  mechanics::MechanicsOptions options = mechanics_options(spec);
  options.initial_stress = initial_stress(spec, a.mesh, a.materials, a.start);
  for (const auto& pair : a.contacts) {
    contributions.push_back(&pair->parts().forces.term());
    options.symmetric = options.symmetric && pair->parts().forces.symmetric();
    a.initial.contacts.push_back(pair->parts().history.initial());
  }
  // The matrix of the simultaneous scheme is unsymmetric anyway.
  if (options.mapping == mechanics::Mapping::simultaneous &&
      std::ranges::any_of(a.contacts, [](const auto& pair) { return pair->parts().slides(); }))
    options.symmetric = false;
  for (const auto& pair : a.contacts) pair->parts().forces.term().follow_weights(!options.symmetric);
  mechanics::MechanicalConditions conditions = mechanical_conditions(spec, a.first_stage());
  conditions.absent_bodies =
      absent_from_mechanics(spec, nullptr);  // others leave when the first stage begins
  // The phase is made of all bodies that conditions of the first stage leave; contacts need to know where
  // melt touches them.
  const mesh::Mesh& mesh = a.growth ? a.growth->present() : a.mesh;  // as yet with all that will come
  a.mechanics =
      std::make_unique<mechanics::MechanicalPhase>(mesh, spec.analysis.kind, a.materials, initial_temperature,
                                                   std::move(conditions), std::move(options), contributions);
  a.phases.mechanics = a.mechanics.get();
  a.coherency = std::make_unique<coupling::Coherency>(mesh, a.materials, a.mechanics->bodies().active);
  if (!a.coherency->melts()) return;
  a.phases.coherency = a.coherency.get();
  std::vector<std::string> in_contact;
  for (const auto& pair : a.contacts)
    for (const std::string& surface : {pair->parts().spec.slave, pair->parts().spec.master})
      if (surface != pair->parts().spec.master || !pair->parts().spec.rigid_master)
        in_contact.push_back(surface);
  // Bodies that grow have another mesh in each step; their elements alone decide how coherent a wall is.
  if (!a.growth) {
    std::vector<double> shell = sections_of(spec, a.mesh);
    for (double& length : shell) length *= coupling::k_shell_depth;
    a.coherency->set_shells(in_contact, shell);
  }
  a.skin = std::make_unique<coupling::SkinShare>(a.mesh, spec.analysis.kind, in_contact, *a.coherency);
  if (a.skin->any()) a.phases.skin = a.skin.get();
}

void build_heat(const cases::CaseSpec& spec, const InitialTemperatures& start, Assembly& a) {
  // Contacts and the deforming structure add heat; the matrix is symmetric only if that of every contact is.
  std::vector<linear::Contribution*> contributions;
  for (const auto& pair : a.contacts)
    if (pair->parts().heat.term() != nullptr) contributions.push_back(pair->parts().heat.term());
  if (a.structural) contributions.push_back(a.structural.get());
  // One contact without a symmetric matrix is enough to make that of the whole unsymmetric.
  heat::HeatOptions options = heat_options(spec);
  for (const auto& pair : a.contacts) options.symmetric = options.symmetric && pair->parts().heat.symmetric();
  heat::ThermalConditions conditions = thermal_conditions(spec, a.first_stage());
  conditions.absent_bodies.clear();  // they leave when the first stage begins
  // The phase keeps references to the mesh and the materials, which the assembly outlives it with.
  const mesh::Mesh& mesh = a.growth ? a.growth->present() : a.mesh;
  a.heat = std::make_unique<heat::ThermalPhase>(mesh, spec.analysis.kind, a.materials, conditions, options,
                                                contributions);
  a.phases.heat = a.heat.get();
  a.initial.heat =
      a.heat->states().initial_of([&](Index node, int body) { return start.enthalpy(node, body); });
  // Nodes at which nothing has grown yet show what will come.
  if (a.growth) {
    const std::vector<double> to_come = nodal_temperature(spec, start, a);
    for (Index i = 0; i < a.mesh.n_nodes(); ++i)
      if (!heat::active(*a.heat).node(i)) a.initial.heat.temperature[as_size(i)] = to_come[as_size(i)];
  }
  // What has burned is part of the state, where something can burn at all.
  const bool burns = std::ranges::any_of(spec.thermal_conditions, [](const cases::ThermalConditionSpec& c) {
    return c.kind == cases::ThermalConditionSpec::Kind::exothermic;
  });
  if (burns) a.initial.burning = heat::unlit(a.mesh.x.size());
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "'" : ", '") + name + "'";
  return text;
}

/// Reports which bodies leave and come when a stage begins, with how much heat, and the conditions that end
/// with them. What comes later than the first stage does not leave when that begins.
void announce_bodies(const cases::CaseSpec& spec, const cases::StageRun& stage, const cases::StageRun* before,
                     const coupling::BodyHeat& heat, const std::vector<std::string>& idle) {
  if (before == nullptr) return;
  // Compared with the stage before: first who leaves, then who comes.
  std::vector<std::string> leaving, coming;
  for (const cases::BodySpec& body : spec.bodies) {
    const bool there = cases::holds(body.stages, &stage), was = cases::holds(body.stages, before);
    if (was && !there) leaving.push_back(body.name);
    if (there && !was) coming.push_back(body.name);
  }
  // One sentence for each, in the singular or the plural, with the heat that they carry.
  const auto sentence = [&](const std::vector<std::string>& bodies, const char* one, const char* several,
                            double joule) {
    return fmt::format("{} {}{}", listed(bodies), bodies.size() == 1 ? one : several,
                       spec.has_heat() ? fmt::format(" with {:.6g} J, counted from 20 degC", joule) : "");
  };
  std::string text;
  if (!leaving.empty()) text = sentence(leaving, "leaves", "leave", heat.ejected);
  if (!coming.empty())
    text += (text.empty() ? "" : "; ") + sentence(coming, "comes new", "come new", heat.poured);
  if (text.empty()) return;
  logging::info("stage '{}' at t = {:g} s: {}{}", stage.stage->name, stage.start, text,
                idle.empty() || leaving.empty() ? "" : "; without a body: " + listed(idle));
}

/// Bodies that come are as drawn: without displacement, stress and history, in contact as at the start of a
/// run.
void renew_contacts(const cases::CaseSpec& spec, const std::vector<char>& fresh, coupling::State& state,
                    Assembly& a) {
  if (state.contacts.empty()) return;
  std::vector<std::string> groups;  // absent in the sense of an active set: their faces are reversed
  for (std::size_t b = 0; b < fresh.size(); ++b)
    if (fresh[b] != 0) groups.push_back(spec.bodies[b].mesh_group());
  const linear::ActiveSet others(a.mesh, groups);
  // A surface is new where any of its faces belongs to a body that comes; all processes must agree.
  const auto is_new = [&](const std::string& surface) {
    const auto group = a.mesh.surfaces.find(surface);
    bool any = false;
    if (group != a.mesh.surfaces.end())
      for (const mesh::ElementBlock& faces : group->second.faces)
        any = any || (faces.size() > 0 && others.reversed(faces));
    return parallel::any_process(any);
  };
  for (std::size_t i = 0; i < a.contacts.size(); ++i) {
    // Of a new side the history is forgotten, that of the other one stays.
    const contact::ContactParameters& pair = a.contacts[i]->parts().spec;
    const bool slave = is_new(pair.slave), master = is_new(pair.master);
    if (slave || master)
      state.contacts[i] = a.contacts[i]->parts().history.renewed(state.contacts[i], slave, master,
                                                                 state.mechanics.displacement, state.time);
  }
}

}  // namespace

double Assembly::coldest_start() const {
  double low = start.front().low;
  for (const InitialTemperatureRange& range : start) low = std::min(low, range.low);
  return low;
}

coupling::BodyHeat apply(const cases::CaseSpec& spec, std::size_t number,
                         const std::vector<double>& displacement, coupling::State* begins, Assembly& a) {
  const cases::StageRun& stage = a.stages[number];
  if (begins != nullptr) check_no_bare_melt(spec, a, number, *begins);
  // Conditions whose body is not there do nothing in this stage, and are named in the log.
  const std::vector<std::string> idle = without_body(spec, a.mesh, &stage);
  const std::vector<char> fresh = new_bodies(spec, a.stages, number);
  const bool comes =
      begins != nullptr && std::any_of(fresh.begin(), fresh.end(), [](char f) { return f != 0; });
  for (std::size_t i = 0; i < a.contacts.size(); ++i)
    a.contacts[i]->activate(holds(spec, spec.contacts[i], a.mesh, &stage));
  // Burned sleeves that come new have all their heat again.
  if (comes && !begins->burning.lit.empty())
    heat::renew(mechanics::nodes_of_bodies(a.mesh, fresh), begins->burning);
  // Motion first, as contacts of new bodies start from the displacement that is left then.
  if (a.mechanics) {
    if (comes) mechanics::renew_nodes(a.mesh, fresh, begins->mechanics);
    a.mechanics->set_conditions(mechanical_conditions(spec, &stage),
                                begins != nullptr ? begins->mechanics.displacement : displacement);
    if (a.structural)
      mechanics::spread_heat_as_stored(*a.mechanics, spec.heat.integration == heat::HeatIntegration::closed);
    if (comes) {
      mechanics::renew_history(*a.mechanics, fresh, begins->mechanics);
      renew_contacts(spec, fresh, *begins, a);
    }
  }
  heat::CarriedHeat carried;
  if (a.heat) {
    // If a run continues at the end of a stage, the heat of the bodies that left before it has been removed
    // already.
    if (begins != nullptr && number > 0) a.heat->set_conditions(thermal_conditions(spec, &stage - 1));
    const InitialTemperatures& initial = *a.initial_temperatures;
    carried =
        a.heat->set_conditions(thermal_conditions(spec, &stage), begins != nullptr ? &begins->heat : nullptr,
                               [&](Index node, int body) { return initial.enthalpy(node, body); });
  }
  const coupling::BodyHeat heat{.poured = carried.along, .ejected = carried.away};
  if (begins != nullptr) announce_bodies(spec, stage, number > 0 ? &stage - 1 : nullptr, heat, idle);
  return heat;
}

namespace {

/// The conditions and contacts that find no body to act on in any stage: a body may come after the first one.
/// Throws InputError as without_body() does. Collective.
std::vector<std::string> idle_throughout(const cases::CaseSpec& spec, const Assembly& a) {
  std::map<std::string, const std::vector<std::string>*> stages_of;
  for (const cases::ThermalConditionSpec& c : spec.thermal_conditions) stages_of[c.name] = &c.stages;
  for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) stages_of[c.name] = &c.stages;
  for (const cases::ContactSpec& c : spec.contacts) stages_of[c.name] = &c.stages;
  std::vector<std::string> idle = without_body(spec, a.mesh, a.first_stage());
  for (const cases::StageRun& stage : a.stages) {
    if (stage.cycle > 1) continue;
    const std::vector<std::string> here = without_body(spec, a.mesh, &stage);
    std::erase_if(idle, [&](const std::string& name) {
      return cases::holds(*stages_of.at(name), &stage) &&
             std::find(here.begin(), here.end(), name) == here.end();
    });
  }
  return idle;
}

}  // namespace

void build(const cases::CaseSpec& spec, Assembly& a) {
  // The parts of a run are made in the order in which they need each other: stages, initial temperatures,
  // contacts, mechanics, structural heat, heat, criteria.
  a.stages = cases::stage_runs(spec);
  if (const auto idle = idle_throughout(spec, a); !idle.empty())
    logging::warn("these act on bodies that only conduct heat, and do nothing: {}", listed(idle));
  check_new_bodies(spec, a.stages, a.mesh);
  a.initial_temperatures = std::make_unique<InitialTemperatures>(spec, a.materials, a.mesh);
  const InitialTemperatures& start = *a.initial_temperatures;
  a.start = start.ranges();
  std::vector<double> highest;
  for (const InitialTemperatureRange& range : a.start) highest.push_back(range.high);
  cases::check_melts(spec, a.materials, highest);
  if (!spec.depositions.empty()) {  // divides the blocks of the mesh, to which nothing refers yet
    a.growth = std::make_unique<Deposition>(spec, a);
    a.phases.growth = a.growth.get();
  }
  build_contacts(spec, a);
  // Mechanics is given the initial temperatures even if heat is not solved for.
  if (spec.has_mechanics()) {
    a.phases.temperature = nodal_temperature(spec, start, a);
    build_mechanics(spec, a.phases.temperature, a);
    if (spec.exchanges_heat()) {
      a.structural = std::make_unique<mechanics::StructuralHeat>(
          *a.mechanics, structural_form(spec), spec.heat.integration == heat::HeatIntegration::closed);
      a.phases.structural = a.structural.get();
    }
    if (a.growth) a.growth->grow(0, nullptr);            // from here on without what comes later
    a.initial.mechanics = a.mechanics->initial_state();  // with what structural heat keeps at the points
  }
  if (spec.has_heat()) build_heat(spec, start, a);
  if (a.growth) a.growth->begin_contacts();
  // The range of temperatures that a coupled run may reach is checked against the coldest start.
  if (spec.coupled())
    a.phases.ambient_temperature = admissibility(spec, a.coldest_start()).ambient_temperature;
  a.local_laws = local_laws(spec, a.materials, a.start);
  a.criteria = make_criteria(spec, a.growth ? a.growth->present() : a.mesh, a.materials, a.start,
                             a.local_laws, a.phases, a.growth ? &a.mesh : nullptr);
  if (a.criteria == nullptr) return;
  a.phases.criteria = a.criteria.get();
  a.initial.criteria = a.criteria->initial({a.initial.time, a.initial.heat, a.initial.mechanics});
}

}  // namespace solidus::setup
