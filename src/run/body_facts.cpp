/// Facts are found body by body with one exchange between processes for each kind of fact.
#include "run/body_facts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "coupling/contact_states.hpp"
#include "mechanics/elements/block_kernel.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/mechanics_input.hpp"
#include "system/processes.hpp"

namespace solidus::run {

namespace {

/// Boxes, weights and supports of the bodies, each on its own.
class Bodies {
 public:
  Bodies(const cases::CaseSpec& spec, const setup::Assembly& a)
      : spec_(spec), a_(a), n_(a.mesh.bodies.size()), gravity_(setup::gravity(spec.analysis)) {}

  void measure(std::vector<BodyFacts>& facts) const {
    for (std::size_t b = 0; b < n_; ++b) {
      const auto body = static_cast<int>(b);
      facts[b].moves = a_.mechanics->bodies().active.body(body);
      facts[b].plastic = a_.materials[b].flow.has_value();
    }
    measure_boxes(facts);
    weigh(facts);
    find_supports(facts);
  }

 private:
  void measure_boxes(std::vector<BodyFacts>& facts) const;
  void weigh(std::vector<BodyFacts>& facts) const;
  void find_supports(std::vector<BodyFacts>& facts) const;
  /// Whether components with a prescribed displacement hold a body: along its weight if it has one, else
  /// along every component.
  bool holds(const double* prescribed, int components) const;

  const cases::CaseSpec& spec_;
  const setup::Assembly& a_;
  std::size_t n_;
  std::array<double, 3> gravity_;
};

void Bodies::measure_boxes(std::vector<BodyFacts>& facts) const {
  std::vector<double> high(6 * n_, -std::numeric_limits<double>::infinity());  // of x and of −x
  // Largest coordinates and largest negative ones: one maximum over processes gives both corners.
  for (const mesh::ElementBlock& block : a_.mesh.blocks)
    for (const Index node : block.nodes)
      for (std::size_t d = 0; d < 3; ++d) {
        double* const of_body = high.data() + 6 * as_size(block.body);
        of_body[d] = std::max(of_body[d], a_.mesh.x[as_size(node)][d]);
        of_body[3 + d] = std::max(of_body[3 + d], -a_.mesh.x[as_size(node)][d]);
      }
  processes::largest(high);
  for (std::size_t b = 0; b < n_; ++b) {
    const double* const of_body = high.data() + 6 * b;
    // The diagonal of the box is the scale of all motions of the body.
    facts[b].size = std::hypot(of_body[0] + of_body[3], of_body[1] + of_body[4], of_body[2] + of_body[5]);
  }
}

void Bodies::weigh(std::vector<BodyFacts>& facts) const {
  std::vector<double> weight(n_, 0.0);
  for (std::size_t k = 0; k < a_.mesh.blocks.size(); ++k) {
    const auto body = as_size(a_.mesh.blocks[k].body);
    std::vector<double> mass(a_.mesh.x.size(), 0.0);
    a_.mechanics->bodies().blocks[k]->add_nodal_volume(a_.materials[body].density, mass);
    for (Index i = 0; i < a_.mesh.n_owned_nodes; ++i) weight[body] += mass[as_size(i)];
  }
  processes::sum(weight);
  const double g = std::hypot(gravity_[0], gravity_[1], gravity_[2]);
  for (std::size_t b = 0; b < n_; ++b) facts[b].weight = weight[b] * g;
}

bool Bodies::holds(const double* prescribed, int components) const {
  constexpr double k_along = 0.1;  // of gravity's components, the share that counts
  const double g = std::hypot(gravity_[0], gravity_[1], gravity_[2]);
  const int first = spec_.analysis.kind == AnalysisKind::axisymmetric ? 1 : 0;
  bool all = true, along = false;
  for (int c = first; c < components; ++c) {
    all &= prescribed[c] > 0;
    along |= prescribed[c] > 0 && std::abs(gravity_[as_size(c)]) > k_along * g;
  }
  return g > 0 ? along : all;
}

void Bodies::find_supports(std::vector<BodyFacts>& facts) const {
  // Which components of a body are prescribed at any node, and which bodies share nodes, is found on each
  // process and combined over all.
  const int n_components = a_.mechanics->bodies().components;
  const std::vector<char>& fixed = a_.mechanics->system().matrix().fixed();
  std::vector<double> prescribed(3 * n_, 0.0), joined(n_ * n_, 0.0);
  std::vector<int> first(a_.mesh.x.size(), -1);
  for (const mesh::ElementBlock& block : a_.mesh.blocks) {
    const auto body = as_size(block.body);
    if (!facts[body].moves) continue;
    for (const Index node : block.nodes) {
      for (int c = 0; c < n_components; ++c)
        if (const std::size_t entry = as_size(node) * as_size(n_components) + as_size(c);
            entry < fixed.size() && fixed[entry] != 0)
          prescribed[3 * body + as_size(c)] = 1;
      int& other = first[as_size(node)];
      if (other < 0) other = block.body;
      joined[body * n_ + as_size(other)] = joined[as_size(other) * n_ + body] = 1;
    }
  }
  processes::largest(prescribed);
  processes::largest(joined);
  // Bodies that share nodes hold each other, so the components held are those of the whole group. Repeating
  // the union as often as there are bodies reaches all of a chain.
  std::vector<int> group(n_);
  for (std::size_t b = 0; b < n_; ++b) group[b] = static_cast<int>(b);
  for (std::size_t sweep = 0; sweep < n_; ++sweep)
    for (std::size_t b = 0; b < n_; ++b)
      for (std::size_t other = 0; other < n_; ++other)
        if (joined[b * n_ + other] > 0) group[b] = group[other] = std::min(group[b], group[other]);
  std::vector<std::array<double, 3>> of_group(n_, std::array<double, 3>{});
  for (std::size_t b = 0; b < n_; ++b)
    for (std::size_t c = 0; c < 3; ++c)
      of_group[as_size(group[b])][c] = std::max(of_group[as_size(group[b])][c], prescribed[3 * b + c]);
  for (std::size_t b = 0; b < n_; ++b)
    facts[b].supported = holds(of_group[as_size(group[b])].data(), n_components);
}

/// The bodies that have faces of a surface. Collective.
std::set<std::size_t> bodies_of(const mesh::Mesh& mesh, const std::string& surface) {
  std::vector<double> has(mesh.bodies.size(), 0.0);
  if (const auto found = mesh.surfaces.find(surface); found != mesh.surfaces.end())
    for (const mesh::ElementBlock& faces : found->second.faces)
      if (faces.body >= 0 && faces.size() > 0) has[as_size(faces.body)] = 1;
  processes::largest(has);
  std::set<std::size_t> bodies;
  for (std::size_t b = 0; b < has.size(); ++b)
    if (has[b] > 0) bodies.insert(b);
  return bodies;
}

/// Counts the points of contact of every body, and finds which bodies are carried by those that are closed:
/// at the last step, or in the failing try of a run that has none.
void find_contacts(const setup::Assembly& a, const coupling::State& last,
                   const mechanics::LastIterate* iterate, std::vector<BodyFacts>& facts) {
  struct Pair {
    std::set<std::size_t> slave, master;
    bool rigid, closed;
  };
  std::vector<Pair> pairs;
  // Each active pair: which bodies are on its sides, how many points it has, how many are closed.
  for (std::size_t i = 0; i < a.phases.contacts.size(); ++i) {
    const contact::ContactPair& pair = *a.phases.contacts[i];
    if (!pair.parts().forces.active()) continue;
    Pair found{
        bodies_of(a.mesh, pair.parts().spec.slave), {}, pair.parts().spec.rigid_master.has_value(), false};
    if (!found.rigid) found.master = bodies_of(a.mesh, pair.parts().spec.master);
    coupling::ContactPoints points;
    const auto& state = pair.state().points;
    points.all = std::llround(parallel::global_sum(
        static_cast<double>(std::ranges::count_if(state, [](const auto& point) { return point.counted; }))));
    // A run without a step has no closed points yet: those of the failing try are taken instead.
    const bool stood = parallel::any_process(i < last.contacts.size() && !last.contacts[i].points.empty());
    points.before = coupling::closed_points(stood ? last.contacts[i] : pair.state());
    if (iterate != nullptr && i < iterate->contacts.size()) {
      points.now = iterate->contacts[i].closed;
      points.changed = iterate->contacts[i].changed;
    }
    found.closed = points.before > 0 || (!stood && points.now > 0);
    // A point counts for the bodies of both sides.
    for (const std::set<std::size_t>* side : {&found.slave, &found.master})
      for (const std::size_t b : *side) {
        coupling::ContactPoints& of_body = facts[b].contact;
        of_body.all += points.all;
        of_body.before += points.before;
        of_body.now += points.now;
        of_body.changed += points.changed;
        facts[b].rubs |= pair.parts().spec.friction.has_value();
      }
    pairs.push_back(std::move(found));
  }
  // Supports carry; a closed contact hands that on to the other side.
  for (BodyFacts& body : facts) body.carried = body.supported || !body.moves;
  const auto any_carried = [&](const std::set<std::size_t>& side) {
    return std::ranges::any_of(side, [&](std::size_t b) { return facts[b].carried; });
  };
  // As many sweeps as there are bodies are enough for the longest chain.
  for (std::size_t sweep = 0; sweep <= facts.size(); ++sweep)
    for (const Pair& pair : pairs) {
      if (!pair.closed) continue;
      const bool carries = pair.rigid || any_carried(pair.slave) || any_carried(pair.master);
      if (!carries) continue;
      for (const std::set<std::size_t>* side : {&pair.slave, &pair.master})
        for (const std::size_t b : *side) facts[b].carried = true;
    }
}

/// The largest change of a distance between neighbouring nodes of an element at the last step, of every body.
void find_elongation(const setup::Assembly& a, const coupling::State& last, std::vector<BodyFacts>& facts) {
  const std::vector<double>& u = last.mechanics.displacement;
  const auto n = as_size(a.mechanics->bodies().components);
  std::vector<double> largest(facts.size(), 0.0);
  // Edges between neighbouring nodes in their numbering: a few for each element are enough to see a
  // strain of a mechanism.
  for (const mesh::ElementBlock& block : a.mesh.blocks) {
    double& of_body = largest[as_size(block.body)];
    if (!facts[as_size(block.body)].moves || u.empty()) continue;
    for (Index e = 0; e < block.n_counted; ++e)
      for (int i = 1; i < mesh::node_count(block.shape); ++i) {
        const Index one = block.element(e)[i - 1], other = block.element(e)[i];
        double drawn = 0, now = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          const double edge = a.mesh.x[as_size(one)][c] - a.mesh.x[as_size(other)][c];
          const double change = c < n ? u[as_size(one) * n + c] - u[as_size(other) * n + c] : 0.0;
          drawn += edge * edge;
          now += (edge + change) * (edge + change);
        }
        if (drawn > 0) of_body = std::max(of_body, std::abs(std::sqrt(now / drawn) - 1));
      }
  }
  processes::largest(largest);
  for (std::size_t b = 0; b < facts.size(); ++b) facts[b].elongation = largest[b];
}

/// The farthest way of every body from its last step to the iterate that failed.
void find_motion(const setup::Assembly& a, const coupling::State& last, const mechanics::LastIterate& iterate,
                 std::vector<BodyFacts>& facts) {
  const std::vector<double>&now = iterate.displacement, &before = last.mechanics.displacement;
  if (parallel::any_process(now.size() != before.size())) return;
  const auto n = as_size(a.mechanics->bodies().components);
  // The farthest node of each body on this process;
  for (const mesh::ElementBlock& block : a.mesh.blocks) {
    BodyFacts& body = facts[as_size(block.body)];
    if (!body.moves) continue;
    for (const Index node : block.nodes) {
      if (node >= a.mesh.n_owned_nodes) continue;
      double squares = 0;
      for (std::size_t c = 0; c < n; ++c) {
        const double way = now[as_size(node) * n + c] - before[as_size(node) * n + c];
        squares += way * way;
      }
      const double way = std::isnan(squares) ? HUGE_VAL : std::sqrt(squares);
      if (body.farthest >= 0 && way <= body.moved) continue;
      body.moved = way;
      body.farthest = node;
    }
  }
  // then of all processes, of which one keeps the node.
  for (BodyFacts& body : facts) {
    const processes::Largest largest = processes::find_largest(body.farthest >= 0 ? body.moved : -1.0);
    body.moved = std::max(largest.value, 0.0);
    if (largest.rank != processes::rank()) body.farthest = -1;
  }
}

}  // namespace

std::vector<BodyFacts> body_facts(const cases::CaseSpec& spec, const setup::Assembly& a,
                                  const coupling::State& last, const mechanics::LastIterate* iterate) {
  std::vector<BodyFacts> facts(a.mesh.bodies.size());
  if (!a.mechanics) return facts;
  Bodies(spec, a).measure(facts);
  find_elongation(a, last, facts);
  find_contacts(a, last, iterate, facts);
  if (iterate == nullptr) return facts;
  find_motion(a, last, *iterate, facts);
  for (std::size_t b = 0; b < facts.size() && b < iterate->flowing.size(); ++b)
    facts[b].yielding = iterate->flowing[b];
  return facts;
}

}  // namespace solidus::run
