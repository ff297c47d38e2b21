#include "criteria/die_wear.hpp"

#include <algorithm>

#include "criteria/die_nodes.hpp"
#include "criteria/die_quantities.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::criteria {

namespace {

/// The record of a node: its depth of wear now and at the start of the shot, and that of the last complete
/// shot.
enum Columns : std::size_t { k_depth, k_depth_before, k_depth_of_last };

/// The mark for no value: of nodes that are not followed, or that nothing wears.
constexpr double k_nothing = -1;

/// Marks the bodies with a limit of wear.
std::vector<char> worn_bodies(const CriterionContext& context) {
  std::vector<char> bodies;
  for (const DieLimits& limits : context.die_limits) bodies.push_back(limits.worn_depth.has_value() ? 1 : 0);
  return bodies;
}

}  // namespace

std::unique_ptr<DieWear> DieWear::make(const CriterionContext& context) {
  if (!context.mechanics || std::ranges::count(worn_bodies(context), 1) == 0) return nullptr;
  return std::make_unique<DieWear>(context);
}

DieWear::DieWear(const CriterionContext& context)
    : mesh_(context.mesh),
      limits_(context.die_limits),
      body_(die_nodes(context.mesh, worn_bodies(context))),
      ghosts_(context.mesh) {}

CriterionRecord DieWear::initial(const CriterionInput& /*start*/) const {
  return {"die_wear",
          {make_column(mesh_, "depth", mesh::FieldPlace::node),
           make_column(mesh_, "depth_at_start_of_shot", mesh::FieldPlace::node),
           make_column(mesh_, "depth_of_last_shot", mesh::FieldPlace::node)},
          {}};
}

CriterionRecord DieWear::restart(const CriterionRecord& before, const CriterionInput& /*start*/) const {
  return before;
}

CriterionRecord DieWear::next_shot(const CriterionRecord& before, const CriterionInput& /*start*/) const {
  // The wear of the shot that ends is what was added since its start.
  CriterionRecord record = before;
  std::vector<double>&depth = record.columns[k_depth].values, &start = record.columns[k_depth_before].values;
  for (std::size_t node = 0; node < depth.size(); ++node)
    record.columns[k_depth_of_last].values[node] = depth[node] - start[node];
  start = depth;
  return record;
}

void DieWear::step(const CriterionInput& /*old*/, const CriterionInput& next, CriterionRecord& record) {
  // Contact knows the wear of owned nodes alone.
  if (next.wear.empty()) return;
  std::vector<double>& depth = record.columns[k_depth].values;
  for (std::size_t node = 0; node < as_size(mesh_.n_owned_nodes); ++node)
    if (body_[node] >= 0) depth[node] = next.wear[node];
  ghosts_.update(depth, 1);
}

/// The last complete shot counts until the present one exceeds it.
double DieWear::in_shot(const CriterionRecord& record, std::size_t node) const {
  const double present = record.columns[k_depth].values[node] - record.columns[k_depth_before].values[node];
  return std::max(present, record.columns[k_depth_of_last].values[node]);
}

/// Equation (i) of docs/theory/channels.md: the allowed depth over the depth of one shot.
double DieWear::shots(double depth, std::size_t node) const {
  if (body_[node] < 0 || !(depth > 0)) return k_nothing;
  return std::min(*limits_[as_size(body_[node])].worn_depth / depth, k_most_cycles);
}

std::span<const quantities::Quantity* const> DieWear::fields() const {
  return fields::k_of_die_wear;
}

void DieWear::fill(const CriterionInput& /*now*/, const CriterionRecord& record,
                   std::span<const std::span<double>> values) const {
  for (std::size_t node = 0; node < body_.size(); ++node) {
    const double depth = in_shot(record, node);
    values[0][node] = body_[node] < 0 ? k_nothing : depth;
    values[1][node] = shots(depth, node);
  }
}

std::vector<CriterionResult> DieWear::findings(const CriterionRecord& record) const {
  // The worst node of this process by either, then that of all of them.
  double most = k_nothing, fewest = k_most_cycles;
  mesh::Point of_most{}, of_fewest{};
  for (std::size_t node = 0; node < as_size(mesh_.n_owned_nodes); ++node) {
    if (body_[node] < 0) continue;
    const double depth = in_shot(record, node), life = shots(depth, node);
    if (depth > most) {
      most = depth;
      of_most = mesh_.x[node];
    }
    if (life > 0 && life < fewest) {
      fewest = life;
      of_fewest = mesh_.x[node];
    }
  }
  const processes::Largest depth = processes::find_largest(most), life = processes::find_largest(-fewest);
  processes::broadcast(of_most, depth.rank);
  processes::broadcast(of_fewest, life.rank);
  return {{largest_of(fields::k_shot_wear), "m", std::max(depth.value, 0.0), depth.value > 0, of_most},
          {least_of(fields::k_shots_until_worn), "1", -life.value, -life.value < k_most_cycles, of_fewest}};
}

}  // namespace solidus::criteria
