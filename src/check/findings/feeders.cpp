// Findings on the feeders that [criteria] names.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "check/finding_family.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/mechanics_input.hpp"

namespace solidus::check {

namespace {

constexpr double k_all = 0.9;   // nodes of a feeder, of all that is poured
constexpr double k_low = 0.25;  // height of a feeder, of that of its casting

/// Heights of a feeder's nodes in what is poured, against gravity, summed over all processes, and how many of
/// them this process owns in each body. Collective.
std::pair<double, std::vector<double>> nodes_of_feeder(const mesh::Mesh& mesh, const std::string& group,
                                                       std::span<const int> poured,
                                                       const std::array<double, 3>& g, std::size_t n_bodies) {
  double height = 0;
  std::vector<double> of_body(n_bodies, 0.0);
  if (const auto nodes = mesh.node_sets.find(group); nodes != mesh.node_sets.end())
    for (const Index node : nodes->second) {
      const auto i = as_size(node);
      if (node >= mesh.n_owned_nodes || poured[i] < 0) continue;
      of_body[as_size(poured[i])] += 1;
      for (std::size_t d = 0; d < 3; ++d) height -= g[d] * mesh.x[i][d];
    }
  return {parallel::global_sum(height), std::move(of_body)};
}

/// Feeders that touch no melt, or that lie where melt does not flow down from. Collective.
void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  if (!spec.has_heat() || m.pours.empty()) return;
  // Which poured body a node belongs to; nodes of moulds keep -1.
  std::vector<int> poured(a.mesh.x.size(), -1);
  for (const mesh::ElementBlock& block : a.mesh.blocks)
    for (const Pour& pour : m.pours)
      if (static_cast<int>(pour.body) == block.body)
        for (const Index node : block.nodes) poured[as_size(node)] = block.body;
  const std::array<double, 3> g = setup::gravity(spec.analysis);
  double all = 0;                             // nodes of all that is poured
  double all_low = 1e300, all_high = -1e300;  // its ends, against gravity
  // The ends of a box along gravity come from its corners: each direction adds its lower or higher
  // side.
  const auto ends = [&](std::size_t body) {
    double low = 0, high = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double first = -g[d] * m.bodies[body].low[d], second = -g[d] * m.bodies[body].high[d];
      low += std::min(first, second), high += std::max(first, second);
    }
    return std::pair(low, high);
  };
  for (const Pour& pour : m.pours) {
    all += static_cast<double>(m.bodies[pour.body].nodes);
    const auto [low, high] = ends(pour.body);
    all_low = std::min(all_low, low), all_high = std::max(all_high, high);
  }
  for (const std::string& group : spec.criteria.feeders) {
    // The mean height of the feeder's own nodes is compared with the ends of what it belongs to.
    const auto [height, of_body] = nodes_of_feeder(a.mesh, group, poured, g, m.bodies.size());
    double n = 0, lowest = 0, highest = 0;
    // Bodies weigh in by the number of the feeder's nodes in them, as it may reach over several.
    for (std::size_t body = 0; body < of_body.size(); ++body) {
      const double nodes = parallel::global_sum(of_body[body]);
      // A riser that is a body of its own is above or below what is poured with it, a part of a body within
      // it.
      const bool whole = nodes > 0.9 * static_cast<double>(m.bodies[body].nodes);
      const auto [low, high] = whole ? std::pair(all_low, all_high) : ends(body);
      n += nodes, lowest += nodes * low, highest += nodes * high;
    }
    // One finding a feeder, from the one that has no effect to the one that is doubtful.
    if (n == 0)
      findings.push_back({true, spec.criteria.where,
                          fmt::format("the feeder '{}' has no node of a body that is poured", group),
                          "a surface or volume of the casting: melt that it touches is fed"});
    else if (n > k_all * all)
      findings.push_back({false, spec.criteria.where,
                          fmt::format("the feeder '{}' is all that is poured: no pore is looked for", group),
                          "the riser, or the surface through which the casting is fed"});
    else if (height < lowest + k_low * (highest - lowest))
      findings.push_back(
          {false, spec.criteria.where,
           fmt::format("the feeder '{}' lies in the lowest quarter of its casting, by the direction "
                       "of gravity",
                       group),
           "feeders above what they feed; is gravity_direction right?"});
  }
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_feeders() {
  return {
      .name = "feeders",
      .place = 95,
      .find = &find,
      .rows = {
          {Topic::pour, "a feeder touches no melt", "none of its nodes is of a body that is poured", "error"},
          {Topic::pour, "a low feeder",
           fmt::format("in the lowest {} of its casting, by the direction of gravity; a riser that is a body "
                       "of its own: of all that is poured",
                       percent(k_low))},
          {Topic::pour, "a feeder is nearly all poured metal",
           fmt::format("it holds {} of the nodes", percent(k_all))}}};
}

}  // namespace solidus::check
