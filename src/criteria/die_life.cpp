#include "criteria/die_life.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "criteria/die_nodes.hpp"
#include "criteria/quantities.hpp"
#include "criteria/strain_lanes.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::criteria {

namespace {

/// The record of a node: its hottest and its coldest temperature in the present shot, the strain range of the
/// last complete shot and, in dies that deform, the strains at both moments.
enum Columns : std::size_t { k_hottest, k_coldest, k_last, k_hot_strain, k_cold_strain };

/// The mark for no value: no fatigue is followed there, or nothing has happened yet.
constexpr double k_nothing = -1;

/// √(2/3 e:e) of the deviator of the difference of two tensors.
double equivalent(const double* a, const double* b) {
  const Sym<double> x = tensor_at(a), y = tensor_at(b);
  const Sym<double> e = dev(x - y);
  return std::sqrt(2.0 / 3.0 * dot(e, e));
}

/// Marks the bodies whose fatigue a [[die_life]] follows.
std::vector<char> tiring_bodies(const CriterionContext& context) {
  std::vector<char> bodies;
  for (const std::optional<FatigueLaw>& law : context.fatigue) bodies.push_back(law.has_value() ? 1 : 0);
  return bodies;
}

}  // namespace

std::unique_ptr<DieLife> DieLife::make(const CriterionContext& context) {
  const bool followed = std::ranges::any_of(context.fatigue, [](const auto& law) { return law.has_value(); });
  if (!followed || context.heat == nullptr) return nullptr;
  return std::make_unique<DieLife>(context);
}

DieLife::DieLife(const CriterionContext& context)
    : mesh_(context.mesh),
      laws_(context.fatigue),
      body_(die_nodes(context.mesh, tiring_bodies(context))),
      ghosts_(context.mesh) {
  // Data of the free thermal strain, for dies that only conduct heat, and Poisson's ratio, for those that
  // deform.
  for (const material::Material& m : context.materials) {
    expansion_.push_back(m.expansion);
    poisson_.push_back(m.poisson_ratio);
    reference_.push_back(m.expansion_reference);
  }
  // Only the elements of dies that deform evaluate strains.
  for (const mesh::ElementBlock& block : mesh_.blocks) {
    const std::optional<FatigueLaw>& law = laws_[as_size(block.body)];
    if (law && law->deforms) blocks_.push_back({ElementStrain(mesh_, block, context.kind), &block});
  }
}

/// The strain at the nodes of bodies that deform: the mean of the elements around by their volumes.
std::vector<double> DieLife::strains(const CriterionInput& moment) const {
  std::vector<double> sum(blocks_.empty() ? 0 : mesh_.x.size() * k_tensor, 0.0),
      volume(blocks_.empty() ? 0 : mesh_.x.size(), 0.0);
  if (blocks_.empty() || moment.mechanics.displacement.empty()) return sum;
  // Elements are evaluated eight at a time; each adds its strain to its nodes, weighted by its volume.
  for (const Deforming& one : blocks_) {
    const auto n_nodes = as_size(mesh::node_count(one.block->shape));
    for (Index batch = 0; batch < one.strain.n_batches(); ++batch) {
      const Sym<Lane> strain = one.strain.strain(moment.mechanics.displacement, batch);
      const int count = std::min<int>(k_lanes, one.strain.n_elements() - batch * k_lanes);
      for (int lane = 0; lane < count; ++lane) {
        const double v = one.strain.volume(batch)[lane];
        const Index* nodes = one.block->element(batch * k_lanes + lane);
        for (std::size_t a = 0; a < n_nodes; ++a) {
          const auto node = as_size(nodes[a]);
          volume[node] += v;
          for (std::size_t i = 0; i < k_tensor; ++i) sum[node * k_tensor + i] += v * strain.c[i][lane];
        }
      }
    }
  }
  // A process has all elements of its own nodes; nodes of others get their values from their owners.
  for (std::size_t node = 0; node < volume.size(); ++node)
    for (std::size_t i = 0; volume[node] > 0 && i < k_tensor; ++i) sum[node * k_tensor + i] /= volume[node];
  ghosts_.update(sum, static_cast<int>(k_tensor));
  return sum;
}

CriterionRecord DieLife::initial(const CriterionInput& start) const {
  CriterionRecord record{"die_life",
                         {make_column(mesh_, "hottest", mesh::FieldPlace::node),
                          make_column(mesh_, "coldest", mesh::FieldPlace::node),
                          make_column(mesh_, "range_of_last_shot", mesh::FieldPlace::node, 1, k_nothing)},
                         {}};
  record.columns[k_hottest].values = record.columns[k_coldest].values = start.heat.temperature;
  if (blocks_.empty()) return record;
  // Where the die deforms, its strain at these two moments is known too.
  for (const char* name : {"strain_when_hottest", "strain_when_coldest"}) {
    record.columns.push_back(make_column(mesh_, name, mesh::FieldPlace::node, static_cast<int>(k_tensor)));
    record.columns.back().values = strains(start);
  }
  return record;
}

CriterionRecord DieLife::restart(const CriterionRecord& before, const CriterionInput& /*start*/) const {
  return before;
}

/// The range of the shot that ends is kept, and the extremes of the new shot start from its first state.
CriterionRecord DieLife::next_shot(const CriterionRecord& before, const CriterionInput& start) const {
  CriterionRecord record = initial(start);
  for (std::size_t node = 0; node < mesh_.x.size(); ++node)
    record.columns[k_last].values[node] = present_range(before, node);
  return record;
}

void DieLife::step(const CriterionInput& /*old*/, const CriterionInput& next, CriterionRecord& record) {
  std::vector<double>&hottest = record.columns[k_hottest].values, &coldest = record.columns[k_coldest].values;
  const std::vector<double> strain = strains(next);
  for (std::size_t node = 0; node < mesh_.x.size(); ++node) {
    if (body_[node] < 0) continue;
    const double t = next.heat.temperature[node];
    // The strain of this moment is stored with the extreme that it sets.
    const auto take = [&](std::size_t column) {
      if (strain.empty()) return;
      const auto from = strain.begin() + static_cast<std::ptrdiff_t>(node * k_tensor);
      std::copy_n(from, k_tensor,
                  record.columns[column].values.begin() + static_cast<std::ptrdiff_t>(node * k_tensor));
    };
    if (t > hottest[node]) {
      hottest[node] = t;
      take(k_hot_strain);
    }
    if (t < coldest[node]) {
      coldest[node] = t;
      take(k_cold_strain);
    }
  }
}

/// The strain range since the start of the shot. A die that deforms has equation (f) of
/// docs/theory/channels.md, with Poisson's ratio at the hottest moment; one that only conducts heat has the
/// bound (g), twice the difference of the free thermal strains.
double DieLife::present_range(const CriterionRecord& record, std::size_t node) const {
  if (body_[node] < 0) return k_nothing;
  const auto body = as_size(body_[node]);
  const double hot = record.columns[k_hottest].values[node], cold = record.columns[k_coldest].values[node];
  if (laws_[body]->deforms) {
    const double nu = poisson_[body].value(hot);
    return 1.5 / (1 + nu) *
           equivalent(record.columns[k_hot_strain].values.data() + node * k_tensor,
                      record.columns[k_cold_strain].values.data() + node * k_tensor);
  }
  const auto grown = [&](double t) { return expansion_[body].value(t) * (t - reference_[body]); };
  return 2 * std::abs(grown(hot) - grown(cold));
}

/// The last complete shot counts until the present one exceeds it.
double DieLife::range(const CriterionRecord& record, std::size_t node) const {
  return std::max(record.columns[k_last].values[node], present_range(record, node));
}

std::span<const quantities::Quantity* const> DieLife::fields() const {
  return fields::k_of_die_life;
}

void DieLife::fill(const CriterionInput& /*now*/, const CriterionRecord& record,
                   std::span<const std::span<double>> values) const {
  for (std::size_t node = 0; node < mesh_.x.size(); ++node) {
    const double of_node = range(record, node);
    values[0][node] = of_node;
    values[1][node] = of_node < 0 ? k_nothing : laws_[as_size(body_[node])]->life(of_node);
  }
}

std::vector<CriterionResult> DieLife::findings(const CriterionRecord& record) const {
  // The worst node of this process, then that of all of them.
  double largest = k_nothing, fewest = k_most_cycles;
  mesh::Point of_largest{}, of_fewest{};
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
    const auto node = as_size(i);
    const double of_node = range(record, node);
    if (of_node < 0) continue;
    const double shots = laws_[as_size(body_[node])]->life(of_node);
    if (of_node > largest) {
      largest = of_node;
      of_largest = mesh_.x[node];
    }
    if (shots < fewest) {
      fewest = shots;
      of_fewest = mesh_.x[node];
    }
  }
  const processes::Largest strain = processes::find_largest(largest), life = processes::find_largest(-fewest);
  processes::broadcast(of_largest, strain.rank);
  processes::broadcast(of_fewest, life.rank);
  return {{largest_of(fields::k_shot_strain_range), "1", std::max(strain.value, 0.0), strain.value > 0,
           of_largest},
          {least_of(fields::k_shots_until_crack), "1", -life.value, -life.value < k_most_cycles, of_fewest}};
}

}  // namespace solidus::criteria
