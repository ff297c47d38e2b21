/// What the criteria of freezing keep of castings when others are poured.
#include <algorithm>
#include <vector>

#include "criteria/freezing.hpp"
#include "criteria/freezing_history.hpp"
#include "criteria/gather.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::criteria {

using namespace freezing_history;

CriterionRecord Freezing::restart(const CriterionRecord& before, const CriterionInput& start) const {
  const std::size_t n_bodies = mesh_.bodies.size();
  // Of every body: whether a node is not solid, and time, number and place of the node that froze last.
  constexpr std::size_t k_entries = 6;
  std::vector<double> own(n_bodies * k_entries, 0.0);
  for (std::size_t b = 0; b < n_bodies; ++b) own[b * k_entries + 2] = -1;
  const std::vector<double>& history = before.columns[0].values;
  // A later time wins, of equal times the lower number.
  const auto take = [](double* best, const double* row) {
    best[0] = std::max(best[0], row[0]);
    const bool later = row[1] > best[1] || (row[1] == best[1] && row[2] < best[2]);
    if (row[2] >= 0 && (best[2] < 0 || later)) std::copy(row + 1, row + k_entries, best + 1);
  };
  for (const FreezingNode& who : nodes_) {
    const auto i = as_size(who.node);
    const double frozen = history[i * k_width + k_solidified_at];
    const mesh::Point& x = mesh_.x[i];
    const double number = frozen < 0 ? -1.0 : static_cast<double>(mesh_.input_node[i]);
    const double row[k_entries] = {start.solid_fraction[i] < 1 ? 1.0 : 0.0, frozen, number, x[0], x[1], x[2]};
    take(own.data() + as_size(who.body) * k_entries, row);
  }
  // The best of all processes, which may each have several bodies.
  const std::vector<double> all = gathered(own);
  std::vector<double> best(own.size(), 0.0);
  for (std::size_t b = 0; b < n_bodies; ++b) best[b * k_entries + 2] = -1;
  for (std::size_t k = 0; k * k_entries < all.size(); ++k)
    take(best.data() + (k % n_bodies) * k_entries, all.data() + k * k_entries);
  // Bodies that hold melt again begin again; the others keep the place that froze last.
  CriterionRecord record = initial(start);
  constexpr std::size_t width = k_row;
  std::vector<double>& rows = record.tables[0].values;
  for (std::size_t b = 0; b < n_bodies; ++b) {
    const double* const found = best.data() + b * k_entries;
    if (found[0] > 0) continue;  // it holds melt
    if (found[2] >= 0) {
      rows.insert(rows.end(), {static_cast<double>(b), found[1], found[3], found[4], found[5]});
      continue;
    }
    const std::vector<double>& kept = before.tables[0].values;  // it was solid before the pour before, too
    for (std::size_t r = 0; r < kept.size(); r += width)
      if (kept[r] == static_cast<double>(b))
        rows.insert(rows.end(), kept.begin() + static_cast<std::ptrdiff_t>(r),
                    kept.begin() + static_cast<std::ptrdiff_t>(r + width));
  }
  return record;
}

std::vector<Freezing::LastMelt> Freezing::frozen_before(const CriteriaState& state) {
  std::vector<LastMelt> found;
  for (const CriterionRecord& record : state.records) {
    if (record.name != k_name) continue;
    const std::vector<double>& rows = record.tables[0].values;
    for (std::size_t r = 0; r + k_row <= rows.size(); r += k_row)
      found.push_back({static_cast<int>(rows[r]), rows[r + 1], {rows[r + 2], rows[r + 3], rows[r + 4]}});
  }
  return found;
}

}  // namespace solidus::criteria
