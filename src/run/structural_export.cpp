#include "run/structural_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cases/case_materials.hpp"
#include "coupling/contact_states.hpp"
#include "coupling/passes.hpp"
#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"
#include "results/checkpoint/checkpoint.hpp"
#include "results/formats/deck_supports.hpp"
#include "results/formats/pvd.hpp"
#include "results/formats/temperature_history.hpp"
#include "results/output/output_file.hpp"
#include "setup/assembly.hpp"
#include "setup/fingerprint.hpp"
#include "setup/mesh_input.hpp"
#include "system/processes.hpp"

namespace solidus::run {

namespace {

/// A step so short, as a share of the run, that nothing flows in it.
constexpr double k_short = 1e-9;

void check_exportable(const cases::CaseSpec& spec) {
  if (processes::count() > 1) throw InputError({}, "the export works on one process", "without mpirun");
  if (!spec.has_mechanics())
    throw InputError(spec.analysis.where, "there is no stress to export", "a case with mechanics");
  if (spec.dynamics)
    throw InputError(spec.dynamics->where, "the stress of bodies in motion is in no equilibrium",
                     "a quasi-static case");
}

/// Number of the volumetric modes of B-bar in a shape (mechanics/elements/law_block.hpp); simplices have
/// none.
int volumetric_modes(mesh::Shape shape) {
  switch (shape) {
    case mesh::Shape::quad4:
    case mesh::Shape::hex8:
      return 1;
    case mesh::Shape::quad8:
      return 3;
    case mesh::Shape::hex20:
      return 4;
    default:
      return 0;
  }
}

using PointValues = std::vector<double>;  ///< of the points of an element

/// The projection of a function on some modes in the mean square with the weights of the points
/// (Gram and Schmidt).
PointValues projection(std::vector<PointValues> modes, const PointValues& weight, const PointValues& values) {
  const auto product = [&](const PointValues& a, const PointValues& b) {
    double sum = 0;
    for (std::size_t q = 0; q < weight.size(); ++q) sum += weight[q] * a[q] * b[q];
    return sum;
  };
  const auto add = [](double factor, const PointValues& a, PointValues& to) {
    for (std::size_t q = 0; q < a.size(); ++q) to[q] += factor * a[q];
  };
  PointValues result(values.size(), 0.0);
  for (std::size_t k = 0; k < modes.size(); ++k) {
    for (std::size_t l = 0; l < k; ++l)
      add(-product(modes[l], modes[k]) / product(modes[l], modes[l]), modes[l], modes[k]);
    add(product(modes[k], values) / product(modes[k], modes[k]), modes[k], result);
  }
  return result;
}

/// The stresses at the points, their pressure replaced by its projection on the volumetric modes where there
/// are some: the nodal forces of both are the same, ∫ B̄ᵀ σ dV = ∫ Bᵀ (dev σ + tr σ̄/3 1) dV.
std::vector<std::vector<std::array<double, 6>>> point_stress(const mesh::Mesh& mesh,
                                                             const mesh::ElementBlock& block,
                                                             AnalysisKind kind,
                                                             const mechanics::BlockHistory& history,
                                                             int n_modes) {
  const mesh::Rule rule = mesh::stiffness_rule(block.shape);
  const mesh::BlockGeometry geometry(mesh, block, kind, rule);
  std::vector<PointValues> modes;
  for (int k = 0; k < n_modes; ++k) {
    modes.emplace_back();
    for (const mesh::QuadraturePoint& point : rule)
      modes.back().push_back(k == 0 ? 1.0 : point.xi[as_size(k - 1)]);
  }
  std::vector<std::vector<std::array<double, 6>>> stress(as_size(block.size()));
  for (std::size_t e = 0; e < stress.size(); ++e) {
    const std::size_t batch = e / k_lanes;
    const int lane = static_cast<int>(e % k_lanes);
    PointValues weight, pressure;
    for (std::size_t q = 0; q < rule.size(); ++q) {
      std::array<double, 6>& s = stress[e].emplace_back();
      const std::size_t point = batch * rule.size() + q;
      for (std::size_t i = 0; i < 6; ++i) s[i] = history.values[point * 6 + i][lane];
      weight.push_back(geometry.weight[point][lane]);
      pressure.push_back((s[0] + s[1] + s[2]) / 3);
    }
    if (modes.empty()) continue;
    const PointValues projected = projection(modes, weight, pressure);
    for (std::size_t q = 0; q < rule.size(); ++q)
      for (std::size_t i = 0; i < 3; ++i) stress[e][q][i] += projected[q] - pressure[q];
  }
  return stress;
}

/// Mixed triangles around an axis take the hoop work of their pressure at the nodes exactly, and so have
/// other nodal forces than the stress at their one point. Around them the loads are what that stress
/// balances, ∫ Bᵀ σ dV.
void balance_triangles(results::StructuralDeck& deck) {
  std::vector<char> around(deck.mesh.x.size(), 0);
  std::vector<double> force(deck.force.size(), 0.0);
  for (std::size_t b = 0; b < deck.mesh.blocks.size(); ++b) {
    const mesh::ElementBlock& block = deck.mesh.blocks[b];
    if (!deck.active.body(block.body)) continue;
    const mesh::BlockGeometry geometry(deck.mesh, block, deck.kind, mesh::stiffness_rule(block.shape));
    const auto n = as_size(geometry.n_nodes);
    for (Index e = 0; e < block.size(); ++e) {
      const Index batch = e / k_lanes;
      const int lane = static_cast<int>(e % k_lanes);
      for (int q = 0; q < geometry.n_points; ++q) {
        const std::array<double, 6>& s = deck.stress[b][as_size(e)][as_size(q)];
        const double w = geometry.weight_at(batch, q)[lane];
        const double hoop = geometry.inverse_radius[as_size(batch * geometry.n_points + q)][lane] * s[2];
        const Lane* const gradients = geometry.gradients_at(batch, q);
        for (std::size_t a = 0; a < n; ++a) {
          const auto node = as_size(block.element(e)[a]);
          const double gr = gradients[2 * a][lane], gz = gradients[2 * a + 1][lane];
          const double value = geometry.values[as_size(q) * n + a];
          force[2 * node] += w * (gr * s[0] + gz * s[3] + value * hoop);
          force[2 * node + 1] += w * (gz * s[1] + gr * s[3]);
          if (block.shape == mesh::Shape::tri3) around[node] = 1;
        }
      }
    }
  }
  for (std::size_t node = 0; node < around.size(); ++node)
    for (std::size_t i = 0; i < 2 && around[node] != 0; ++i) deck.force[2 * node + i] = force[2 * node + i];
}

std::vector<std::vector<Index>> tied_entries(const linear::MultiPointConstraints& constraints,
                                             std::size_t n_entries) {
  std::map<GlobalIndex, std::vector<Index>> groups;
  for (std::size_t i = 0; i < n_entries && !constraints.empty(); ++i)
    groups[constraints.unknown(as_index(i))].push_back(as_index(i));
  std::vector<std::vector<Index>> tied;
  for (auto& [leader, entries] : groups)
    if (entries.size() > 1) tied.push_back(std::move(entries));
  return tied;
}

}  // namespace

namespace {

ExportReport export_history(const cases::CaseSpec& spec, const setup::Assembly& a,
                            const ExportOptions& options) {
  // A temperature history is exported without deformation, for a case of one stage, because bodies that come
  // and go have no place in one deck.
  if (options.deformed)
    throw InputError({}, "a temperature history is that of the undeformed casting", "no --deformed");
  if (spec.stages.size() > 1)
    throw InputError(spec.analysis.where,
                     "a temperature history is of one stage: bodies come and go in stages",
                     "the end of the run, without --temperature-history");
  const linear::ActiveSet& active = a.mechanics->bodies().active;
  results::StructuralDeck deck{
      .title = spec.title.empty() ? "Solidus" : spec.title,
      .kind = spec.analysis.kind,
      .mesh = a.mesh,
      .active = active,
      .materials = a.materials,
      .displacement = {},
      .temperature = {},
      .stress = {},
      .plastic_strain = {},
      .fixed = a.mechanics->system().matrix().fixed(),
      .constraints = tied_entries(a.mechanics->system().matrix().constraints(),
                                  a.mechanics->system().matrix().fixed().size()),
      .force = {},
      .history = results::read_temperature_history(options.folder / results::k_collection, a.mesh, active)};
  for (const cases::BodySpec& body : spec.bodies) deck.body_names.push_back(body.name);
  // What only contact held is given supports in the deck, and the report says how many.
  deck.supports = results::missing_supports(a.mesh, active, spec.analysis.kind, deck.fixed, deck.constraints);
  ExportReport report{deck.history.back().time, 0, 0, deck.history.size(), deck.supports.size()};
  for (const mesh::ElementBlock& block : a.mesh.blocks)
    if (active.body(block.body)) report.elements += as_size(block.size());
  results::write_file(options.file, options.deck(deck));
  return report;
}

/// Solves mechanics once more at the temperatures of a state, in a step so short that nothing flows.
/// @param state  loses what a two-step method has of the step before
/// @param still  becomes the state in equilibrium
mechanics::MechanicalReport brought_into_balance(setup::Assembly& a, coupling::State& state,
                                                 const std::vector<double>& temperature,
                                                 coupling::State& still) {
  state.mechanics.dt_before = 0;  // by backward Euler
  const double dt = k_short * std::max(state.time, 1e-3);
  coupling::restore_contacts(a.phases, state);
  still = state;
  coupling::StepEffort effort;
  const std::vector<double> share = coupling::plateau_share(a.phases, state.heat);
  return coupling::mechanical_pass(a.phases, state, still,
                                   {.time = state.time,
                                    .dt = dt,
                                    .temperature = temperature,
                                    .plateau_share = share,
                                    .iterate_temperature = temperature,
                                    .stores_stress = true},
                                   effort);
}

/// Gives a deck the stresses of all points and the plastic strains of all elements of active bodies. Returns
/// how many elements have stresses.
std::size_t add_stresses(const cases::CaseSpec& spec, const setup::Assembly& a, const coupling::State& still,
                         results::StructuralDeck& deck) {
  std::size_t n_elements = 0;
  const std::vector<double> plastic_strain =
      mechanics::element_field(a.mesh, still.mechanics, mechanics::ElementField::equivalent_plastic_strain);
  auto of_block = plastic_strain.begin();
  for (std::size_t b = 0; b < a.mesh.blocks.size(); ++b) {
    const mesh::ElementBlock& block = a.mesh.blocks[b];
    deck.stress.emplace_back();
    deck.plastic_strain.emplace_back(of_block, of_block + block.size());
    of_block += block.size();
    if (!a.mechanics->bodies().active.body(block.body)) continue;
    const int n_modes = spec.mechanics.b_bar ? volumetric_modes(block.shape) : 0;
    deck.stress[b] = point_stress(a.mesh, block, spec.analysis.kind, still.mechanics.stress[b], n_modes);
    n_elements += deck.stress[b].size();
  }
  return n_elements;
}

}  // namespace

ExportReport export_state(const setup::Case& c, const ExportOptions& options) {
  // The state of the checkpoint is brought into equilibrium once more at its temperatures, in a step so short
  // that nothing flows, because the deck needs stresses that balance its loads.
  cases::CaseSpec spec = c.spec;  // with the contacts that its interfaces make
  check_exportable(spec);
  setup::Assembly a;
  a.materials = cases::load_materials(spec);
  a.mesh = setup::load_mesh(spec);
  setup::require_sound_mesh(spec);
  setup::build(spec, a);
  if (options.temperature_history) return export_history(spec, a, options);
  // The checkpoint has to be that of this case and mesh.
  results::Checkpoint from =
      results::CheckpointFolder(options.folder)
          .read(a.mesh, setup::fingerprint(spec, a.mesh, a.materials, a.initial.heat.temperature), a.initial);
  const coupling::StageStart& stage = from.continuation.stage;
  cases::check_stage_of_checkpoint(spec, stage, from.state.time);
  if (stage.number > 0) setup::apply(spec, as_size(stage.number - 1), stage.displacement, nullptr, a);

  coupling::State& state = from.state;
  const std::vector<double>& temperature = a.heat ? state.heat.temperature : a.phases.temperature;
  coupling::State still;
  const mechanics::MechanicalReport solved = brought_into_balance(a, state, temperature, still);
  // How far nodes moved is told: it says how well the stored state was in balance.
  ExportReport report{state.time, 0, 0, 0, 0};
  for (std::size_t i = 0; i < state.mechanics.displacement.size(); ++i)
    report.adjusted = std::max(report.adjusted,
                               std::abs(still.mechanics.displacement[i] - state.mechanics.displacement[i]));

  // The deck holds the stresses of all points of active bodies, without contact, whose forces become loads.
  const linear::ActiveSet& active = a.mechanics->bodies().active;
  results::StructuralDeck deck{.title = spec.title.empty() ? "Solidus" : spec.title,
                               .kind = spec.analysis.kind,
                               .mesh = a.mesh,
                               .active = active,
                               .materials = a.materials,
                               .displacement = {},
                               .temperature = temperature,
                               .stress = {},
                               .plastic_strain = {},
                               .fixed = a.mechanics->system().matrix().fixed(),
                               .constraints = tied_entries(a.mechanics->system().matrix().constraints(),
                                                           still.mechanics.displacement.size()),
                               .force = solved.applied};
  for (const cases::BodySpec& body : spec.bodies) deck.body_names.push_back(body.name);
  deck.supports = results::missing_supports(a.mesh, active, spec.analysis.kind, deck.fixed, deck.constraints);
  report.supports = deck.supports.size();
  if (options.deformed) deck.displacement = still.mechanics.displacement;
  report.elements = add_stresses(spec, a, still, deck);
  if (spec.analysis.kind == AnalysisKind::axisymmetric) balance_triangles(deck);
  results::write_file(options.file, options.deck(deck));
  return report;
}

}  // namespace solidus::run
