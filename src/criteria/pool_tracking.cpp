/// Parts of the melt are matched with the pools of the step before by the volume that they share.
#include "criteria/pool_tracking.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "criteria/gather.hpp"

namespace solidus::criteria {

namespace {

// The hotter node; of isothermal ones that with less solid; of equals the one with the lesser number.
void take_hotter(MeltPart& part, const MeltPart& other) {
  const auto rank = [](const MeltPart& p) { return std::tuple(-p.temperature, p.fraction, p.number); };
  if (rank(other) >= rank(part)) return;
  part.temperature = other.temperature;
  part.fraction = other.fraction;
  part.number = other.number;
  part.where = other.where;
}

void add(std::map<double, MeltPart>& parts, const MeltPart& other) {
  const auto [place, fresh] = parts.try_emplace(other.label, other);
  if (fresh) return;
  MeltPart& part = place->second;
  part.volume += other.volume;
  part.solid += other.solid;
  part.whole = part.whole || other.whole;
  part.fed = part.fed || other.fed;
  take_hotter(part, other);
}

void take_later(std::map<int, LastNode>& last, const LastNode& other) {
  const auto [place, fresh] = last.try_emplace(other.pool, other);
  const LastNode& node = place->second;
  if (!fresh && (other.time > node.time || (other.time == node.time && other.number < node.number)))
    place->second = other;
}

// Calls `take` with every row of the processes' lists.
template <class Take>
void each_row(const std::vector<double>& own, std::size_t width, const Take& take) {
  const std::vector<double> all = gathered(std::span<const double>(own));
  for (std::size_t i = 0; i + width <= all.size(); i += width) take(all.data() + i);
}

Pool& pool_of(std::vector<Pool>& pools, int number) {
  return *std::find_if(pools.begin(), pools.end(), [&](const Pool& p) { return p.number == number; });
}

}  // namespace

// Every process has found a part of each pool; labels are the same on all of them.
Melt gathered(const Melt& own) {
  std::map<double, MeltPart> parts;
  std::map<std::pair<double, int>, double> overlaps;
  std::map<int, LastNode> last;
  // Each kind of row is sent to all processes as plain numbers and joined by its label: volumes add, of the
  // last nodes the later one stays.
  std::vector<double> rows;
  for (const MeltPart& p : own.parts)
    rows.insert(rows.end(), {p.label, p.volume, p.solid, p.whole ? 1.0 : 0.0, p.fed ? 1.0 : 0.0,
                             p.temperature, p.fraction, p.number, p.where[0], p.where[1], p.where[2]});
  each_row(rows, 11, [&](const double* r) {
    add(parts, {r[0], r[1], r[2], r[3] != 0, r[4] != 0, r[5], r[6], r[7], {r[8], r[9], r[10]}});
  });
  rows.clear();
  for (const Overlap& o : own.overlaps)
    rows.insert(rows.end(), {o.label, static_cast<double>(o.pool), o.volume});
  each_row(rows, 3, [&](const double* r) { overlaps[{r[0], static_cast<int>(r[1])}] += r[2]; });
  rows.clear();
  for (const LastNode& n : own.last)
    rows.insert(rows.end(), {static_cast<double>(n.pool), n.time, n.number, n.temperature, n.where[0],
                             n.where[1], n.where[2]});
  each_row(rows, 7, [&](const double* r) {
    take_later(last, {static_cast<int>(r[0]), r[1], r[2], r[3], {r[4], r[5], r[6]}});
  });
  // Maps are in order of their labels, so all processes get the same lists.
  Melt all;
  for (const auto& [label, part] : parts) all.parts.push_back(part);
  for (const auto& [key, volume] : overlaps) all.overlaps.push_back({key.first, key.second, volume});
  for (const auto& [pool, node] : last) all.last.push_back(node);
  return all;
}

std::vector<int> follow_pools(std::vector<Pool>& pools, const Melt& melt, double time, double whole,
                              bool feeders) {
  // The largest common volumes first. Rounding must not decide between halves of equal size.
  std::vector<Overlap> overlaps = melt.overlaps;
  const auto rank = [&](const Overlap& o) {
    return std::tuple(-std::llround(o.volume / whole * 1e9), o.pool, o.label);
  };
  std::sort(overlaps.begin(), overlaps.end(),
            [&](const Overlap& a, const Overlap& b) { return rank(a) < rank(b); });
  // Each pool goes on in the part with which it shares the most, each part continues one pool.
  std::map<double, int> number_of;  // by label
  std::map<int, int> kept;          // pool -> 1
  for (const Overlap& o : overlaps)
    if (!kept.contains(o.pool) && number_of.try_emplace(o.label, o.pool).second) kept[o.pool] = 1;

  // A pool without a part has joined another one, left with its body, or frozen at its last node.
  for (Pool& pool : pools) {
    pool.ended = false;
    if (!pool.present() || kept.contains(pool.number)) continue;
    pool.ended = true;
    pool.volume = 0;
    const auto joined = std::find_if(overlaps.begin(), overlaps.end(),
                                     // The largest overlap that is left says into which pool it
                                     // went.
                                     [&](const Overlap& o) { return o.pool == pool.number; });
    if (joined != overlaps.end()) {
      pool.into = number_of.at(joined->label);
      continue;
    }
    const auto last = std::find_if(melt.last.begin(), melt.last.end(),
                                   [&](const LastNode& n) { return n.pool == pool.number; });
    if (last == melt.last.end()) {  // no node of it is left
      pool.into = Pool::k_left;
      continue;
    }
    // All of it froze in this step: where and when its last node did.
    pool.frozen = last->time;
    pool.temperature = last->temperature;
    pool.where = last->where;
  }

  // Parts without a pool are born, of the pool that they come from, if they hold a whole element.
  std::vector<int> numbers;
  for (const MeltPart& part : melt.parts) {
    const auto known = number_of.find(part.label);
    int number = known == number_of.end() ? 0 : known->second;
    if (number == 0 && part.whole) {
      // The parent is the pool with which the new part shares the most.
      const auto parent = std::find_if(overlaps.begin(), overlaps.end(),
                                       [&](const Overlap& o) { return o.label == part.label; });
      number = pools.empty() ? 1 : pools.back().number + 1;
      Pool& born = pools.emplace_back();
      born.number = number;
      born.born = time;
      born.parent = parent == overlaps.end() ? 0 : parent->pool;
      // Without feeders a pool that splits off is cut off by that.
      if (!feeders && born.parent > 0) born.closed_off = time;
    }
    numbers.push_back(number);
    if (number == 0) continue;
    Pool& pool = pool_of(pools, number);
    // With feeders a pool is cut off while no feeder is in it, and may be joined again.
    if (feeders) pool.closed_off = part.fed ? -1 : (pool.closed_off < 0 ? time : pool.closed_off);
    pool.volume = part.volume;
    if (pool.closed_off >= 0) pool.largest = std::max(pool.largest, part.volume);
    pool.solid_fraction = part.volume > 0 ? part.solid / part.volume : 0.0;
    pool.temperature = part.temperature;
    pool.where = part.where;
  }
  return numbers;
}

}  // namespace solidus::criteria
