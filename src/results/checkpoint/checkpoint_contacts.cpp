/// Points of each pair become rows by their numbers; reading finds each process's own points among them.
#include "results/checkpoint/checkpoint_contacts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <unordered_map>

namespace solidus::results {

namespace {

std::string table(std::size_t pair) {
  return fmt::format("contact_{}", pair);
}

/// Everything that a point remembers, in a fixed order: written and read by the same list.
template <class Point, class Visit>
void each_number(Point& p, const Visit& visit) {
  const auto all = [&visit](auto&... n) { (visit(n), ...); };
  all(p.offset, p.sunk, p.penetration, p.pressure, p.balance_pressure, p.multiplier, p.suction, p.stiffening);
  for (std::size_t i = 0; i < 3; ++i) all(p.traction[i], p.anchor[i], p.master_normal[i]);
  all(p.internal_variable, p.slip, p.work, p.dissipation, p.wear_depth, p.temperature, p.plastic_entropy);
}

std::vector<double> numbers_of(const contact::ContactPointState& p) {
  std::vector<double> numbers{static_cast<double>(p.status), p.anchored ? 1.0 : 0.0};
  each_number(p, [&](double n) { numbers.push_back(n); });
  return numbers;
}

void set_numbers(contact::ContactPointState& p, std::span<const double> numbers) {
  p.status = static_cast<contact::PointStatus>(numbers[0]);
  p.anchored = numbers[1] != 0;
  std::size_t i = 2;
  each_number(p, [&](double& n) { n = numbers[i++]; });
}

/// Sets a point from its row. Throws OutputError for a state that no point can have.
void take_point(const TableReader& in, const std::string& table, std::int64_t number,
                std::span<const double> row, contact::ContactPointState& point) {
  const auto allow = [&](bool allowed, const char* what, double value) {
    if (!allowed) in.refuse(fmt::format("the {} of point {} of '{}' is {}", what, number, table, value));
  };
  constexpr auto k_last = static_cast<double>(contact::PointStatus::slips);
  allow(row[0] >= 0 && row[0] <= k_last && row[0] == std::floor(row[0]), "status", row[0]);
  allow(row[1] == 0 || row[1] == 1, "mark of a partner", row[1]);
  set_numbers(point, row);
  allow(point.stiffening > 0, "share of the penalty", point.stiffening);
  allow(point.slip >= 0, "slip", point.slip);
  allow(point.wear_depth >= 0, "wear", point.wear_depth);
  allow(point.temperature >= 0, "temperature", point.temperature);
}

}  // namespace

void write_contacts(TableWriter& out, const std::vector<contact::ContactState>& contacts) {
  // The number of values a point has is that of an empty one.
  const auto width = static_cast<int>(numbers_of({}).size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    std::vector<std::int64_t> keys;
    std::vector<double> values;
    // Each point is written by the process that counts it, under its number.
    for (const contact::ContactPointState& point : contacts[i].points) {
      if (!point.counted) continue;
      keys.push_back(point.number);
      const std::vector<double> numbers = numbers_of(point);
      values.insert(values.end(), numbers.begin(), numbers.end());
    }
    // Keys and values are two tables with as many rows.
    out.rows<std::int64_t>(table(i) + "/point", 1, keys);
    out.rows<double>(table(i) + "/values", width, values);
    // Worn nodes of the master are kept where it wears.
    if (contacts[i].master.empty()) continue;
    std::vector<std::int64_t> nodes;
    std::vector<double> worn;
    for (const contact::WornNode& node : contacts[i].master) {
      if (!node.counted) continue;
      nodes.push_back(node.number);
      worn.insert(worn.end(), {node.volume, node.dissipation});
    }
    out.rows<std::int64_t>(table(i) + "/master_node", 1, nodes);
    out.rows<double>(table(i) + "/master_values", 2, worn);
  }
}

namespace {

void take_master(TableReader& in, const std::string& pair, std::vector<contact::WornNode>& master) {
  if (master.empty()) return;
  std::unordered_map<std::int64_t, contact::WornNode*> places;
  for (contact::WornNode& node : master) places.emplace(node.number, &node);
  std::size_t taken = 0;
  in.each(pair + "/master_node", pair + "/master_values", {0},
          [&](std::int64_t number, std::span<const double> row) {
            const auto place = places.find(number);
            if (place == places.end() || row.size() != 2) return;
            place->second->volume = row[0];
            place->second->dissipation = row[1];
            places.erase(place);  // a second row of a node is not one of another
            ++taken;
          });
  in.require(taken == master.size(), pair);
}

}  // namespace

void take_contacts(TableReader& in, std::vector<contact::ContactState>& contacts) {
  const std::size_t width = numbers_of({}).size();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    // Points are found by their numbers, and every one must be there.
    std::vector<contact::ContactPointState>& points = contacts[i].points;
    std::unordered_map<std::int64_t, std::size_t> places;
    for (std::size_t p = 0; p < points.size(); ++p) places.emplace(points[p].number, p);
    std::size_t taken = 0;
    in.each(table(i) + "/point", table(i) + "/values", {},
            [&](std::int64_t number, std::span<const double> row) {
              const auto place = places.find(number);
              if (place == places.end() || row.size() != width) return;
              take_point(in, table(i), number, row, points[place->second]);
              places.erase(place);
              ++taken;
            });
    in.require(taken == points.size(), table(i));
    take_master(in, table(i), contacts[i].master);
  }
}

}  // namespace solidus::results
