/// Findings of the criteria of freezing at the end of a run.
#include "criteria/freezing.hpp"

#include <algorithm>

#include "criteria/freezing_history.hpp"
#include "criteria/gather.hpp"
#include "criteria/quantities.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::criteria {

/// The share of the volume in which a field is beyond its threshold, for each field with one; the volume is
/// that which has a value of the field.
std::vector<CriterionResult> Freezing::shares_beyond(const CriterionRecord& record,
                                                     std::span<const double> speeds) const {
  std::vector<CriterionResult> shares;
  for (std::size_t f = 0; f < k_fields; ++f) {
    // Only fields with a threshold have a share beyond it.
    const quantities::Quantity& field = *fields::k_of_freezing[f];
    if (!field.threshold) continue;
    double all = 0, bad = 0;
    for (const FreezingNode& who : nodes_) {
      const double value = values_of(who, record.columns[0].values, speeds[as_size(who.node)])[f];
      if (value == field.no_value) continue;
      const double volume = storage_.volume(who.node, who.body);
      // The side of the threshold that is bad is that of the field's worst extreme.
      all += volume;
      const bool low = field.worst == quantities::Extreme::least;
      if (low ? value < *field.threshold : value > *field.threshold) bad += volume;
    }
    all = parallel::global_sum(all);
    bad = parallel::global_sum(bad);
    if (all > 0) shares.push_back({beyond(field), "1", bad / all, false, {}});
  }
  // Where shrinkage alone opens pores no strain rate is left that melt could feed.
  constexpr auto critical_at =
      static_cast<std::size_t>(std::ranges::find(fields::k_of_freezing, &fields::k_critical_strain_rate) -
                               fields::k_of_freezing.begin());
  double all = 0, none = 0;
  for (const FreezingNode& who : nodes_) {
    const double critical = values_of(who, record.columns[0].values, speeds[as_size(who.node)])[critical_at];
    if (critical < 0) continue;
    const double volume = storage_.volume(who.node, who.body);
    all += volume;
    if (critical == 0) none += volume;
  }
  all = parallel::global_sum(all);
  none = parallel::global_sum(none);
  if (all > 0) shares.push_back({fed_nowhere(), "1", none / all, false, {}});
  return shares;
}

std::vector<CriterionResult> Freezing::findings(const CriterionRecord& record) const {
  // The least and the greatest value of every field over the nodes that have it, with the number of the node
  // and its place.
  struct Extreme {
    double value = 0, number = -1;
    mesh::Point where{};
  };
  std::array<Extreme, 2 * k_fields> own;
  const auto take = [](Extreme& e, double value, double number, const mesh::Point& where, bool least) {
    const bool better = e.number < 0 || (least ? value < e.value : value > e.value) ||
                        (value == e.value && number < e.number);
    if (better) e = {value, number, where};
  };
  // Own nodes first; of equal values the lower number wins, so that the place does not depend on
  // processes.
  const std::vector<double> speeds = front_speeds(record.columns[0].values);
  for (const FreezingNode& who : nodes_) {
    const auto i = as_size(who.node);
    const auto of_node = values_of(who, record.columns[0].values, speeds[i]);
    for (std::size_t f = 0; f < k_fields; ++f)
      if (of_node[f] > 0 || (of_node[f] == 0 && nothing_known()[f] < 0))
        for (std::size_t side = 0; side < 2; ++side)
          take(own[2 * f + side], of_node[f], static_cast<double>(mesh_.input_node[i]), mesh_.x[i],
               side == 0);
  }
  std::vector<CriterionResult> shares = shares_beyond(record, speeds);
  // Rows of plain numbers go to all processes, and the same comparison chooses the best of all.
  std::vector<double> mine;
  for (const Extreme& e : own)
    mine.insert(mine.end(), {e.value, e.number, e.where[0], e.where[1], e.where[2]});
  const std::vector<double> all = gathered(mine);
  std::array<Extreme, 2 * k_fields> best;
  for (std::size_t k = 0; k < all.size() / 5; ++k) {
    const double* const row = all.data() + 5 * k;
    const std::size_t which = k % (2 * k_fields);
    if (row[1] >= 0) take(best[which], row[0], row[1], {row[2], row[3], row[4]}, which % 2 == 0);
  }
  // Two results for each field that any node has.
  std::vector<CriterionResult> found;
  for (std::size_t f = 0; f < k_fields; ++f)
    for (std::size_t side = 0; side < 2; ++side)
      if (const Extreme& e = best[2 * f + side]; e.number >= 0)
        found.push_back(
            {side == 0 ? least_of(*fields::k_of_freezing[f]) : largest_of(*fields::k_of_freezing[f]),
             std::string(fields::k_of_freezing[f]->exact_unit()), e.value, true, e.where});
  found.insert(found.end(), shares.begin(), shares.end());
  return found;
}

}  // namespace solidus::criteria
