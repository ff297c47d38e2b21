/// The values at nodes are looked up in the tables of the cards, by what the criteria of freezing say.
#include "criteria/local_properties.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "criteria/gather.hpp"
#include "criteria/quantities.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::criteria {

namespace {

using material::LocalLaw;

/// The lists of a table in the order of fields::k_of_local_properties.
constexpr std::array k_lists = {&LocalLaw::tensile_strength, &LocalLaw::elongation, &LocalLaw::hardness,
                                &LocalLaw::grain_size};

/// Bodies that are followed and whose card has tables.
std::vector<char> bodies_with_tables(const CriterionContext& context) {
  std::vector<char> chosen(context.followed.size(), 0);
  for (std::size_t b = 0; b < context.local_laws.size(); ++b)
    if (context.followed[b] != 0 && !context.local_laws[b].empty()) chosen[b] = 1;
  return chosen;
}

/// What the criteria of freezing say at all nodes, of the fields that tables go by.
class Froze {
 public:
  Froze(const Freezing& freezing, const CriterionInput& now, const CriterionRecord& record, std::size_t n)
      : shown_(freezing.fields()), columns_(shown_.size(), std::vector<double>(n)) {
    freezing.fill(now, record, std::vector<std::span<double>>(columns_.begin(), columns_.end()));
  }
  double of(const LocalLaw& law, std::size_t node) const {
    if (!law.section.empty()) return at(fields::k_plate_thickness, node);
    return at(law.arm_spacing.empty() ? fields::k_cooling_rate : fields::k_secondary_arm_spacing, node);
  }

 private:
  double at(const quantities::Quantity& wanted, std::size_t node) const {
    return columns_[as_size(std::ranges::find(shown_, &wanted) - shown_.begin())][node];
  }
  std::span<const quantities::Quantity* const> shown_;
  std::vector<std::vector<double>> columns_;
};

/// Least, largest and mean value of the nodes of a body.
struct Range {
  double least = 0, largest = 0, sum = 0, room = 0;
  mesh::Point at_least{}, at_largest{};

  void see(double low, const mesh::Point& where_low, double high, const mesh::Point& where_high,
           double weighted, double volume) {
    if (room == 0 || low < least) least = low, at_least = where_low;
    if (room == 0 || high > largest) largest = high, at_largest = where_high;
    sum += weighted;
    room += volume;
  }
  /// Of all processes. Collective.
  Range over_processes() const {
    const std::array own = {least, at_least[0],   at_least[1],   at_least[2],   largest,
                            sum,   at_largest[0], at_largest[1], at_largest[2], room};
    const std::vector<double> all = gathered(std::span<const double>(own));
    Range whole;
    for (std::size_t k = 0; k + own.size() <= all.size(); k += own.size()) {
      const double* const row = all.data() + k;
      if (row[9] > 0)
        whole.see(row[0], {row[1], row[2], row[3]}, row[4], {row[6], row[7], row[8]}, row[5], row[9]);
    }
    return whole;
  }
};

}  // namespace

std::unique_ptr<LocalProperties> LocalProperties::make(const CriterionContext& context) {
  if (context.heat == nullptr) return nullptr;
  const std::vector<char> chosen = bodies_with_tables(context);
  if (std::ranges::none_of(chosen, [](char c) { return c != 0; })) return nullptr;
  return std::make_unique<LocalProperties>(context);
}

LocalProperties::LocalProperties(const CriterionContext& context)
    : mesh_(context.mesh),
      laws_(context.local_laws),
      names_(context.names),
      freezing_(context.mesh, context.kind, context.heat->storage(),
                {.evaluation = context.evaluation, .bodies = bodies_with_tables(context)}),
      ghosts_(context.mesh) {
  // A node belongs to the body with tables that has the most of it.
  const std::vector<char> chosen = bodies_with_tables(context);
  for (Index i = 0; i < mesh_.n_owned_nodes; ++i) {
    Node node{i, -1, 0};
    for (std::size_t b = 0; b < chosen.size(); ++b) {
      const double room = chosen[b] != 0 ? context.heat->storage().volume(i, static_cast<int>(b)) : 0.0;
      if (room > node.room) node = {i, static_cast<int>(b), room};
    }
    if (node.body >= 0) nodes_.push_back(node);
  }
  // A field exists only if some card has values of it.
  for (std::size_t f = 0; f < k_lists.size(); ++f) {
    bool said = false;
    for (std::size_t b = 0; b < chosen.size(); ++b)
      for (const LocalLaw& law : laws_[b]) said = said || (chosen[b] != 0 && !(law.*k_lists[f]).empty());
    if (!said) continue;
    fields_.push_back(fields::k_of_local_properties[f]);
    which_.push_back(f);
  }
}

CriterionRecord LocalProperties::initial(const CriterionInput& start) const {
  CriterionRecord record = freezing_.initial(start);
  record.name = "local_properties";
  return record;
}

CriterionRecord LocalProperties::restart(const CriterionRecord& before, const CriterionInput& start) const {
  CriterionRecord record = freezing_.restart(before, start);
  record.name = "local_properties";
  return record;
}

void LocalProperties::step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) {
  freezing_.step(old, next, record);
}

std::vector<std::vector<double>> LocalProperties::values(const CriterionInput& now,
                                                         const CriterionRecord& record) const {
  const Froze froze(freezing_, now, record, mesh_.x.size());
  std::vector<std::vector<double>> all;
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    std::vector<double>& column = all.emplace_back(mesh_.x.size(), fields_[f]->no_value.value_or(0));
    // Of several tables with the property, the first that reaches the place tells it.
    for (const Node& who : nodes_) {
      const auto i = as_size(who.node);
      for (const LocalLaw& law : laws_[as_size(who.body)]) {
        const std::optional<double> value = law.value(law.*k_lists[which_[f]], froze.of(law, i));
        if (!value) continue;
        column[i] = *value;
        break;
      }
    }
    // Fields show ghosts' values too.
    ghosts_.update(column, 1);
  }
  return all;
}

void LocalProperties::fill(const CriterionInput& now, const CriterionRecord& record,
                           std::span<const std::span<double>> into) const {
  const std::vector<std::vector<double>> all = values(now, record);
  for (std::size_t f = 0; f < all.size(); ++f) std::ranges::copy(all[f], into[f].begin());
}

std::vector<CriterionResult> LocalProperties::findings(const CriterionRecord& record) const {
  const heat::ThermalState none;
  const mechanics::MechanicalState nothing;
  const std::vector<std::vector<double>> all = values({0, none, nothing}, record);
  std::vector<CriterionResult> found;
  for (std::size_t f = 0; f < all.size(); ++f) {
    // Each body by itself: a riser is not what one sells.
    std::vector<Range> of_body(laws_.size());
    for (const Node& who : nodes_) {
      const auto i = as_size(who.node);
      const double value = all[f][i];
      if (value == fields_[f]->no_value.value_or(0)) continue;
      of_body[as_size(who.body)].see(value, mesh_.x[i], value, mesh_.x[i], who.room * value, who.room);
    }
    for (std::size_t b = 0; b < of_body.size(); ++b) {
      const Range range = of_body[b].over_processes();
      if (!(range.room > 0)) continue;
      const std::string name = std::string(fields_[f]->name) + "_in_" + names_[b],
                        unit(fields_[f]->exact_unit());
      found.push_back({name + "_min", unit, range.least, true, range.at_least});
      found.push_back({name + "_mean", unit, range.sum / range.room, false, {}});
      found.push_back({name + "_max", unit, range.largest, true, range.at_largest});
    }
  }
  return found;
}

}  // namespace solidus::criteria
