/// Parts of the melt are found over the elements and followed; records keep one row for each pool that
/// there ever was.
#include "criteria/pools.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "criteria/pool_tracking.hpp"
#include "criteria/quantities.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::criteria {

namespace {

constexpr int k_row = 14;
constexpr std::size_t k_told = 5;  ///< closed-off pools that the summary names

std::vector<double> row_of(const Pool& p) {
  return {static_cast<double>(p.number),
          static_cast<double>(p.parent),
          p.born,
          p.closed_off,
          p.frozen,
          static_cast<double>(p.into),
          p.volume,
          p.largest,
          p.solid_fraction,
          p.temperature,
          p.where[0],
          p.where[1],
          p.where[2],
          p.ended ? 1.0 : 0.0};
}

Pool pool_of(const double* r) {
  return {static_cast<int>(r[0]),
          static_cast<int>(r[1]),
          r[2],
          r[3],
          r[4],
          static_cast<int>(r[5]),
          r[6],
          r[7],
          r[8],
          r[9],
          {r[10], r[11], r[12]},
          r[13] != 0};
}

/// The hottest node of a part. Ties are broken by the solid fraction and then by the number in the input, so
/// that the place does not depend on the partition.
void take_hotter(MeltPart& part, double temperature, double fraction, double number,
                 const mesh::Point& where) {
  if (!(std::tuple(-temperature, fraction, number) <
        std::tuple(-part.temperature, part.fraction, part.number)))
    return;
  part.temperature = temperature;
  part.fraction = fraction;
  part.number = number;
  part.where = where;
}

std::vector<char> melting_bodies(const mesh::Mesh& mesh, const heat::NodalEnthalpy& storage,
                                 const std::vector<char>& wanted) {
  std::vector<char> chosen;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b)
    chosen.push_back(storage.can_melt(static_cast<int>(b)) && (wanted.empty() || wanted[b] != 0) ? 1 : 0);
  return chosen;
}

}  // namespace

Pools::Pools(const mesh::Mesh& mesh, const heat::NodalEnthalpy& storage, PoolOptions options)
    : mesh_(mesh),
      storage_(storage),
      options_(std::move(options)),
      followed_(melting_bodies(mesh, storage, options_.bodies)),
      feeder_(mesh.x.size(), 0),
      body_(as_size(mesh.n_owned_nodes), -1),
      ghosts_(mesh),
      connectivity_(mesh, ghosts_, followed_) {
  // Groups that feed (a riser's top, say) are marked at their nodes.
  for (const std::string& group : options_.feeders) {
    const auto nodes = mesh.node_sets.find(group);
    if (nodes == mesh.node_sets.end())
      throw InputError({}, "criteria.feeders: the mesh has no group '" + group + "'");
    for (const Index node : nodes->second) feeder_[as_size(node)] = 1;
  }
  const auto n_bodies = static_cast<int>(mesh.bodies.size());
  for (int b = 0; b < n_bodies; ++b) levels_.push_back(FreezingLevels::of(storage.material(b)));
  // Each node belongs to the followed body of the largest volume there, and the volume of all of them is the
  // reference for shares.
  double own = 0;
  for (std::size_t i = 0; i < body_.size(); ++i) {
    double most = 0;
    for (int b = 0; b < n_bodies; ++b) {
      const bool followed = followed_[as_size(b)] != 0;
      const double volume = followed ? storage.volume(as_index(i), b) : 0.0;
      if (volume > most) body_[i] = b;
      most = std::max(most, volume);
      own += volume;
    }
  }
  whole_ = parallel::global_sum(own);
}

double Pools::volume(std::size_t node) const {
  double volume = 0;
  for (std::size_t b = 0; b < levels_.size(); ++b)
    if (followed_[b] != 0) volume += storage_.volume(as_index(node), static_cast<int>(b));
  return volume;
}

std::vector<Pool> Pools::pools(const CriterionRecord& record) {
  std::vector<Pool> pools;
  const std::vector<double>& values = record.tables[0].values;
  for (std::size_t i = 0; i < values.size(); i += k_row) pools.push_back(pool_of(values.data() + i));
  return pools;
}

CriterionRecord Pools::initial(const CriterionInput& start) const {
  CriterionRecord record{k_name,
                         {make_column(mesh_, "pool", mesh::FieldPlace::node),
                          make_column(mesh_, "zone", mesh::FieldPlace::node)},
                         {{"pools", k_row, {}}}};
  track(nullptr, start, record);
  return record;
}

void Pools::step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) {
  track(&old, next, record);
}

double Pools::passed_at(std::size_t node, const CriterionInput& old, const CriterionInput& next) const {
  const double before = old.solid_fraction[node], after = next.solid_fraction[node];
  if (after <= before || body_[node] < 0) return next.time;
  const FreezingLevels& levels = levels_[as_size(body_[node])];
  const double solid = after == 1 ? levels.end(storage_, as_index(node), old, next) : 1.0;
  const double at = solid * std::clamp((options_.limit - before) / (after - before), 0.0, 1.0);
  return old.time + at * (next.time - old.time);
}

void Pools::track(const CriterionInput* old, const CriterionInput& next, CriterionRecord& record) const {
  std::vector<double>& number = record.columns[0].values;
  // Without melt anywhere and without a pool that is still told of, nothing has to be gathered.
  std::vector<Pool> pools = Pools::pools(record);
  std::vector<char> inside(mesh_.x.size());
  for (std::size_t i = 0; i < inside.size(); ++i) inside[i] = next.solid_fraction[i] < options_.limit;
  const bool melt_left = std::find(inside.begin(), inside.end(), 1) != inside.end();
  const bool pool_left =
      std::any_of(pools.begin(), pools.end(), [](const Pool& p) { return p.present() || p.ended; });
  if (!parallel::any_process(melt_left) && !pool_left) return;

  // Melt is cut into connected parts. Each process sums volume, solid fraction and the hottest node of its
  // share of a part, and how much of a part lies in which pool of the step before.
  const ConnectedParts parts = connectivity_.parts(inside);
  std::map<double, MeltPart> own;
  std::map<std::pair<double, int>, double> overlaps;
  Melt melt;
  for (std::size_t i = 0; i < body_.size(); ++i) {
    const int pool = static_cast<int>(number[i]);
    const double fraction = next.solid_fraction[i], temperature = next.heat.temperature[i];
    const auto in_input = static_cast<double>(mesh_.input_node[i]);
    const double volume = this->volume(i);
    // A node that was in a pool and is no longer may have been the last to freeze there, so its time of
    // passing is kept.
    if (inside[i] == 0) {
      if (pool == 0 || old == nullptr || volume == 0) continue;  // without volume: its body has left
      melt.last.push_back({pool, passed_at(i, *old, next), in_input, temperature, mesh_.x[i]});
      continue;
    }
    MeltPart& part = own[parts.label[i]];
    part.label = parts.label[i];
    part.volume += volume;
    part.solid += volume * fraction;
    part.fed = part.fed || feeder_[i] != 0;
    take_hotter(part, temperature, fraction, in_input, mesh_.x[i]);
    if (pool > 0) overlaps[{parts.label[i], pool}] += volume;
  }
  // A part that no border of a process cuts is whole here.
  for (auto& [label, part] : own) {
    part.whole = std::binary_search(parts.whole.begin(), parts.whole.end(), label);
    melt.parts.push_back(part);
  }
  for (const auto& [key, volume] : overlaps) melt.overlaps.push_back({key.first, key.second, volume});

  // All processes get all parts, and follow the pools by the same rules: a part keeps the number of the pool
  // that it overlaps most, new ones get new numbers.
  const Melt all = gathered(melt);
  const std::vector<int> numbers = follow_pools(pools, all, next.time, whole_, !options_.feeders.empty());
  std::map<double, int> of_label;
  // Numbers go back to the nodes, and the table of pools is written again.
  for (std::size_t k = 0; k < all.parts.size(); ++k) of_label[all.parts[k].label] = numbers[k];
  for (std::size_t i = 0; i < number.size(); ++i)
    number[i] = inside[i] != 0 ? of_label.at(parts.label[i]) : 0;
  // A place keeps the number of the pool that it was in last: that fed it until it passed the limit.
  std::vector<double>& zone = record.columns[1].values;
  for (std::size_t i = 0; i < number.size(); ++i)
    if (number[i] > 0) zone[i] = number[i];
  std::vector<double>& rows = record.tables[0].values;
  rows.clear();
  for (const Pool& pool : pools) {
    const std::vector<double> row = row_of(pool);
    rows.insert(rows.end(), row.begin(), row.end());
  }
}

std::span<const quantities::Quantity* const> Pools::fields() const {
  return fields::k_of_pools;
}

void Pools::fill(const CriterionInput& /*now*/, const CriterionRecord& record,
                 std::span<const std::span<double>> values) const {
  std::map<int, double> volume{{0, 0.0}};
  for (const Pool& pool : pools(record)) volume[pool.number] = pool.volume;
  const std::vector<double>& number = record.columns[0].values;
  std::copy(number.begin(), number.end(), values[0].begin());
  for (std::size_t i = 0; i < number.size(); ++i) values[1][i] = volume.at(static_cast<int>(number[i]));
  std::ranges::copy(record.columns[1].values, values[2].begin());
}

std::vector<CriterionResult> Pools::findings(const CriterionRecord& record) const {
  std::vector<Pool> closed = pools(record);
  std::erase_if(closed, [](const Pool& p) { return p.closed_off < 0; });
  std::vector<CriterionResult> found{
      {"closed_off_pools", "1", static_cast<double>(closed.size()), false, {}}};
  // The largest pools by their greatest volume.
  std::stable_sort(closed.begin(), closed.end(),
                   [](const Pool& a, const Pool& b) { return a.largest > b.largest; });
  for (std::size_t k = 0; k < std::min(closed.size(), k_told); ++k) {
    const std::string name = "pool_" + std::to_string(closed[k].number);
    found.push_back({name + "_volume", "m3", closed[k].largest, false, {}});
    if (closed[k].frozen >= 0)
      found.push_back({name + "_frozen", "s", closed[k].frozen, true, closed[k].where});
  }
  return found;
}

}  // namespace solidus::criteria
