#include "criteria/soldering.hpp"

#include <algorithm>

#include "criteria/die_nodes.hpp"
#include "criteria/die_quantities.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::criteria {

namespace {

enum Columns : std::size_t { k_time, k_time_of_last };

/// The mark for no value: of nodes that are not followed.
constexpr double k_nothing = -1;

std::vector<char> soldering_bodies(const CriterionContext& context) {
  std::vector<char> bodies;
  for (const DieLimits& limits : context.die_limits)
    bodies.push_back(limits.soldering_temperature.has_value() ? 1 : 0);
  return bodies;
}

}  // namespace

double part_above(double from, double to, double limit) {
  // Temperatures are linear in a step.
  const double low = std::min(from, to), high = std::max(from, to);
  if (low >= limit) return high > limit ? 1.0 : 0.0;
  return high > limit ? (high - limit) / (high - low) : 0.0;
}

std::unique_ptr<Soldering> Soldering::make(const CriterionContext& context) {
  if (context.heat == nullptr || std::ranges::count(soldering_bodies(context), 1) == 0) return nullptr;
  return std::make_unique<Soldering>(context);
}

Soldering::Soldering(const CriterionContext& context)
    : mesh_(context.mesh),
      limits_(context.die_limits),
      body_(die_nodes(context.mesh, soldering_bodies(context))) {}

CriterionRecord Soldering::initial(const CriterionInput& /*start*/) const {
  return {"soldering",
          {make_column(mesh_, "time", mesh::FieldPlace::node),
           make_column(mesh_, "time_in_last_shot", mesh::FieldPlace::node)},
          {}};
}

CriterionRecord Soldering::restart(const CriterionRecord& before, const CriterionInput& /*start*/) const {
  return before;
}

CriterionRecord Soldering::next_shot(const CriterionRecord& before, const CriterionInput& start) const {
  // The shot that ends becomes the last one, and the new one begins at zero.
  CriterionRecord record = initial(start);
  record.columns[k_time_of_last].values = before.columns[k_time].values;
  return record;
}

void Soldering::step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) {
  const double dt = next.time - old.time;
  std::vector<double>& time = record.columns[k_time].values;
  for (std::size_t node = 0; node < body_.size(); ++node) {
    if (body_[node] < 0) continue;
    const double limit = *limits_[as_size(body_[node])].soldering_temperature;
    time[node] += dt * part_above(old.heat.temperature[node], next.heat.temperature[node], limit);
  }
}

double Soldering::longest(const CriterionRecord& record, std::size_t node) const {
  // Within a shot the last whole one counts until it is exceeded.
  if (body_[node] < 0) return k_nothing;
  return std::max(record.columns[k_time].values[node], record.columns[k_time_of_last].values[node]);
}

std::span<const quantities::Quantity* const> Soldering::fields() const {
  return fields::k_of_soldering;
}

void Soldering::fill(const CriterionInput& /*now*/, const CriterionRecord& record,
                     std::span<const std::span<double>> values) const {
  for (std::size_t node = 0; node < body_.size(); ++node) values[0][node] = longest(record, node);
}

std::vector<CriterionResult> Soldering::findings(const CriterionRecord& record) const {
  // The longest time of the owned nodes, then of all processes.
  double most = k_nothing;
  mesh::Point where{};
  for (std::size_t node = 0; node < as_size(mesh_.n_owned_nodes); ++node) {
    const double time = longest(record, node);
    if (time <= most) continue;
    most = time;
    where = mesh_.x[node];
  }
  const processes::Largest all = processes::find_largest(most);
  processes::broadcast(where, all.rank);
  return {{largest_of(fields::k_soldering_time), "s", std::max(all.value, 0.0), all.value > 0, where}};
}

}  // namespace solidus::criteria
