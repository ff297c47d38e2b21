/// Sums over elements and steps in which metal freezes, from which the errors of the answers are estimated.
#include "criteria/resolution.hpp"

#include <algorithm>
#include <array>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::criteria {

namespace {

/// Samples are taken when the time since pouring has grown by this share: some forty in a decade.
constexpr double k_sampling = 0.05;

/// Rows of the table: the start and the time of the last sample, then of each body the sums of η² Δt and Δt.
constexpr int k_width = 2;

/// Sums around the nodes of one body.
struct NodeSums {
  double volume = 0;
  mesh::Point gradient{};
};

double square(const mesh::Point& v) {
  return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

}  // namespace

Resolution::Resolution(const mesh::Mesh& mesh, AnalysisKind kind, std::vector<char> freezes)
    : mesh_(mesh),
      freezes_(std::move(freezes)),
      patches_(mesh, kind, std::vector<char>(mesh.bodies.size(), 1)),
      ghosts_(mesh) {
  std::vector<char> is_of(as_size(mesh.n_owned_nodes), 0);
  for (const mesh::ElementBlock& block : mesh.blocks)
    if (freezes_[as_size(block.body)] != 0)
      for (const Index node : block.nodes)
        if (node < mesh.n_owned_nodes) is_of[as_size(node)] = 1;
  for (Index i = 0; i < mesh.n_owned_nodes; ++i)
    if (is_of[as_size(i)] != 0) freezing_.push_back(i);
}

CriterionRecord Resolution::initial(const CriterionInput& start) const {
  CriterionTable table{"flow_errors", k_width, {start.time, start.time}};
  table.values.resize(k_width * (1 + mesh_.bodies.size()), 0.0);
  return {k_name, {make_column(mesh_, "frozen_within", mesh::FieldPlace::node)}, {std::move(table)}};
}

void Resolution::step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) {
  std::vector<double>& within = record.columns[0].values;
  bool melt = false, changed = false;
  // The step within which a node freezes bounds how well the time of freezing is resolved.
  for (const Index node : freezing_) {
    const auto i = as_size(node);
    if (old.solid_fraction[i] >= 1) continue;
    melt = true;
    if (next.solid_fraction[i] < 1) continue;
    within[i] = next.time - old.time;
    changed = true;
  }
  if (parallel::any_process(changed)) ghosts_.update(within, 1);
  std::vector<double>& sums = record.tables[0].values;
  const double start = sums[0], last = sums[1];
  if (next.time < last + k_sampling * (last - start) || !parallel::any_process(melt)) return;
  // The error of the heat flow is costly; it is sampled at times that grow with the time already covered, and
  // summed over time for its mean.
  const std::vector<double> errors = flow_errors(next.heat.temperature);
  for (std::size_t b = 0; b < errors.size(); ++b) {
    sums[k_width * (b + 1)] += errors[b] * (next.time - last);
    sums[k_width * (b + 1) + 1] += next.time - last;
  }
  sums[1] = next.time;
}

std::vector<double> Resolution::flow_errors(std::span<const double> temperature) const {
  const std::size_t n_bodies = mesh_.bodies.size();
  // The share of |∇Θ|² that its means at the nodes do not explain says how far the gradient jumps from
  // element to element, body by body.
  std::vector<double> sums(2 * n_bodies, 0.0);  // of body b: Σ V |g|² and what its means at nodes explain
  std::vector<NodeSums> nodes(as_size(mesh_.n_owned_nodes));
  for (std::size_t b = 0; b < n_bodies; ++b) {
    // Sums at the nodes are over owned nodes alone, of all their elements, so that no communication is needed
    // before the end.
    std::fill(nodes.begin(), nodes.end(), NodeSums{});
    patches_.for_elements([&](const Patches::Element& e) {
      if (patches_.body(e) != static_cast<int>(b)) return;
      const std::span<const Index> of = patches_.nodes(e);
      std::array<double, k_most_nodes> values{};
      for (std::size_t a = 0; a < of.size(); ++a) values[a] = temperature[as_size(of[a])];
      const Patches::Gradient g = patches_.gradient(e, std::span(values).first(of.size()));
      const double share = g.volume / static_cast<double>(of.size());
      for (const Index node : of) {
        if (node >= mesh_.n_owned_nodes) continue;
        NodeSums& sum = nodes[as_size(node)];
        sum.volume += share;
        for (std::size_t k = 0; k < 3; ++k) sum.gradient[k] += share * g.value[k];
        sums[2 * b] += share * square(g.value);
      }
    });
    // The means at the nodes explain |Σ V g|²/Σ V.
    for (const NodeSums& sum : nodes)
      if (sum.volume > 0) sums[2 * b + 1] += square(sum.gradient) / sum.volume;
  }
  processes::sum(std::span(sums));
  // The error is one less the explained share; a body without a gradient has none.
  std::vector<double> errors(n_bodies, 0.0);
  for (std::size_t b = 0; b < n_bodies; ++b)
    if (sums[2 * b] > 0) errors[b] = std::max(0.0, 1 - sums[2 * b + 1] / sums[2 * b]);
  return errors;
}

std::optional<Resolution::Told> Resolution::told(const CriteriaState& state) {
  for (const CriterionRecord& record : state.records) {
    if (record.name != k_name) continue;
    Told told;
    told.frozen_within = record.columns[0].values;
    const std::vector<double>& sums = record.tables[0].values;
    // The mean error of each body over the time sampled.
    for (std::size_t k = k_width; k + 1 < sums.size(); k += k_width)
      told.flow_error.push_back(sums[k + 1] > 0 ? sums[k] / sums[k + 1] : 0.0);
    return told;
  }
  return {};
}

}  // namespace solidus::criteria
