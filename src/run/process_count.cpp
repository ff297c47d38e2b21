#include "run/process_count.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "cases/roles.hpp"
#include "cases/stage_input.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::run {

namespace {

// Measured by bench/processes.py model on one process and on two, and on the castings of cases/
// (docs/decisions/0077-all-cores.md).

/// What a phase costs.
struct Cost {
  double node;    ///< a step on one process, for each node [s]
  double growth;  ///< of the work where it is divided: solvers take more iterations, seams are computed twice
  double serial;  ///< part of the work that is not divided: reading, dividing, writing, waiting for memory
  double messages;  ///< of a step, for each doubling of the processes [s]
};
constexpr Cost k_heat{3.5e-6, 1.2, 0.1, 4e-3};
constexpr Cost k_mechanics_solid{12e-6, 1.1, 0.08, 10e-3};
/// Metal that melts, yields and touches its mould takes nine times as long.
constexpr Cost k_poured_solid{110e-6, 1.1, 0.08, 10e-3};
constexpr Cost k_mechanics_plane{11e-6, 1.1, 0.08, 60e-3};
/// Up to so many nodes of metal every process factorises all of it (linear/factorisation.cpp), and the serial
/// part is this.
constexpr double k_whole_factors = 10000, k_serial_of_whole_factors = 0.27;
/// To start several processes and to divide the mesh among them takes as long as this [s].
constexpr double k_start = 0.8;
/// An adaptive run takes at least as many steps as this, and of each stage as many as that, even where its
/// first step would reach the end.
constexpr double k_adaptive_steps = 120, k_adaptive_steps_of_stage = 20;
/// The most that a further number of processes may leave of the time of fewer, or it is not taken.
constexpr double k_gain_of_two = 0.9, k_gain_of_more = 0.97;

/// Number of different nodes of some groups.
double count_nodes(const std::vector<const cases::BodySpec*>& bodies, const mesh::RawMesh& mesh) {
  // A node on the seam of two bodies is one unknown, and is counted once. Only nodes that a group names
  // count: a mesh may hold parts that no body uses.
  std::vector<char> there(mesh.x.size(), 0);
  for (const cases::BodySpec* body : bodies) {
    const auto group = mesh.groups.find(body->mesh_group());
    if (group == mesh.groups.end()) continue;  // load_mesh() says so
    for (const mesh::RawBlock& block : group->second.blocks)
      for (const Index node : block.nodes)
        if (node >= 0 && as_size(node) < there.size()) there[as_size(node)] = 1;
  }
  return static_cast<double>(std::count(there.begin(), there.end(), 1));
}

/// @param adaptive  as many steps as an adaptive run takes of this; absent: steps are equal
double steps_of(std::optional<double> duration, std::optional<double> step, std::optional<double> adaptive) {
  // A case without an end or a step is counted as one step: its estimate is then the cost of the mesh, and
  // errs towards few processes.
  if (!duration || !step || !(*step > 0)) return 1;
  const double equal = std::max(*duration / *step, 1.0);
  return adaptive ? std::min(equal, *adaptive) : equal;
}

double expected_steps(const cases::CaseSpec& spec) {
  if (spec.time.steady) return 1;
  const auto if_adaptive = [&](double steps) {
    return spec.time.adaptive ? std::optional(steps) : std::nullopt;
  };
  const std::vector<cases::StageRun> stages = cases::stage_runs(spec);
  // Without stages the case has one duration.
  if (stages.empty()) return steps_of(spec.time.end, spec.time.step, if_adaptive(k_adaptive_steps));
  // With stages each has its own duration, and its own step where it gives one.
  double steps = 0;
  for (const cases::StageRun& run : stages)
    steps += steps_of(run.end - run.start, run.stage->step ? run.stage->step : spec.time.step,
                      if_adaptive(k_adaptive_steps_of_stage));
  return steps;
}

}  // namespace

RunWork run_work(const cases::CaseSpec& spec, const std::vector<material::Material>& materials,
                 const mesh::RawMesh& mesh) {
  std::vector<const cases::BodySpec*> warm, moving, poured;
  // Bodies are sorted by what they cost: all conduct, some move as well, and metal that is poured is the
  // dearest.
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const cases::BodySpec& body = spec.bodies[b];
    if (spec.has_heat()) warm.push_back(&body);
    if (!spec.has_mechanics() || cases::only_conducts(body)) continue;
    moving.push_back(&body);
    if (b < materials.size() && cases::is_poured(cases::role_of(body, materials[b]))) poured.push_back(&body);
  }
  // Nodes grow with the elements when the mesh is refined.
  const double refined = std::pow(spec.dimension() == 3 ? 8.0 : 4.0, spec.mesh.refine);
  return {refined * count_nodes(warm, mesh), refined * count_nodes(moving, mesh),
          refined * count_nodes(poured, mesh), spec.dimension() == 3, expected_steps(spec)};
}

double expected_seconds(const RunWork& work, int processes) {
  // Messages pass in a tree, so that their time grows with the doublings of the processes.
  const double doublings = std::log2(static_cast<double>(processes));
  const auto of_phase = [&](const Cost& cost, double nodes) {
    if (!(nodes > 0)) return 0.0;
    // The work falls as it is divided, but its serial part stays, and the sum of the parts is larger than the
    // whole.
    const double alone = nodes * cost.node;
    return processes == 1 ? alone
                          : alone * (cost.serial + cost.growth / processes) + cost.messages * doublings;
  };
  // Few nodes of metal are factorised by each process for itself, which makes more of the work serial; beyond
  // that the factors are shared.
  Cost poured = work.solid ? k_poured_solid : k_mechanics_plane;
  if (work.poured_nodes < k_whole_factors) poured.serial = k_serial_of_whole_factors;
  // Poured metal is counted apart from the other bodies that move, for a node of it costs many times as much
  // as one of them.
  const double step =
      of_phase(k_heat, work.heat_nodes) + of_phase(poured, work.poured_nodes) +
      of_phase(work.solid ? k_mechanics_solid : k_mechanics_plane, work.mechanics_nodes - work.poured_nodes);
  return (processes == 1 ? 0 : k_start) + work.steps * step;
}

int processes_that_pay(const RunWork& work, int cores) {
  int best = 1;
  double least = expected_seconds(work, 1);
  // Every number of processes is looked at, since costs need not fall evenly; a number that gains next to
  // nothing over fewer is left out, as its cores are better free for others.
  for (int n = 2; n <= cores; ++n) {
    const double seconds = expected_seconds(work, n);
    if (seconds > least * (best == 1 ? k_gain_of_two : std::pow(k_gain_of_more, n - best))) continue;
    best = n;
    least = seconds;
  }
  return best;
}

}  // namespace solidus::run
