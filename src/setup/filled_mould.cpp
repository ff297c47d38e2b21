/// The files of a filling are read, and the heat of its walls is laid into the first layers of the mould.
#include "setup/filled_mould.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "input/column_table.hpp"
#include "input/keys.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::setup {

namespace fs = std::filesystem;

PlaceSpec filled_temperature(const cases::FillingSpec& filling, int body) {
  const fs::path start = fs::path(*filling.result) / fmt::format("body_{}", body) / "start";
  if (!fs::is_directory(start))
    throw InputError(filling.where, fmt::format("'{}' holds no filling of this case", *filling.result),
                     "a folder that `solidus fill` has filled; without `result` the run fills first");
  PlaceSpec place;
  place.kind = PlaceSpec::Kind::field;
  place.key = "initial_temperature";
  place.key_unit = "K";
  place.file = start.string();
  place.column = "T";
  place.with_time = false;
  place.lower_open = true;
  place.upper = std::numeric_limits<double>::infinity();
  place.where = filling.where;
  return place;
}

namespace {

/// The values of a column. Throws InputError where the table lacks it, and for what is no number.
const ColumnTable::Column& column_of(const ColumnTable& table, const char* name) {
  const auto found = std::ranges::find(table.columns, name, &ColumnTable::Column::name);
  if (found == table.columns.end())
    throw InputError({table.file}, fmt::format("the table has no column '{}'", name),
                     one_of(table.headers(), name));
  for (std::size_t row = 0; row < found->values.size(); ++row)
    if (!std::isfinite(found->values[row]))
      throw InputError(table.place(*found, row), fmt::format("'{}' has no number here", name));
  return *found;
}

}  // namespace

std::vector<FilledWall> read_filled_walls(const cases::FillingSpec& filling, std::size_t n_bodies) {
  const ColumnTable table = read_column_table(fs::path(*filling.result) / "mould_heat.csv");
  const ColumnTable::Column& body = column_of(table, "body");
  const std::array<const ColumnTable::Column*, 3> x = {&column_of(table, "x"), &column_of(table, "y"),
                                                       &column_of(table, "z")};
  const ColumnTable::Column &heat = column_of(table, "heat"), &contact = column_of(table, "contact");
  // A row is a face; the number of its body is that of the case.
  std::vector<FilledWall> walls(body.values.size());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (!(body.values[i] >= 0) || body.values[i] >= static_cast<double>(n_bodies))
      throw InputError(table.place(body, i),
                       fmt::format("the case has no body of number {:g}", body.values[i]),
                       "the filling of this case");
    walls[i] = {static_cast<int>(body.values[i]),
                {x[0]->values[i], x[1]->values[i], x[2]->values[i]},
                heat.values[i],
                contact.values[i]};
  }
  return walls;
}

namespace {

/// Heat of one face goes to the nodes around it.
/// @param squares of the distances of the nodes [m²]
/// @param depth   δ² [m²] to start with
void add_heat_of_wall(double heat, std::span<const double> squares, double depth,
                      std::span<const double> weights, double limit, std::span<double> enthalpies) {
  constexpr double k_negligible = 40;  // exp(-40) of the heat is none
  constexpr int k_rounds = 60;         // of doubling, after which a body takes what is left as it comes
  double left = heat;
  for (int round = 0; round <= k_rounds && std::abs(left) > 1e-13 * std::abs(heat);
       ++round, depth = depth > 0 ? 2 * depth : 1e-12) {
    // The weights of the nodes with the volumes that they stand for make the share of the heat of each; a
    // depth of zero is a node on the face without time to heat up, which takes all.
    const auto share = [&](std::size_t k) {
      const double power = depth > 0 ? squares[k] / (4 * depth) : squares[k] > 0 ? 2 * k_negligible : 0.0;
      return power < k_negligible ? std::exp(-power) : 0.0;
    };
    double total = 0;
    for (std::size_t k = 0; k < squares.size(); ++k) total += weights[k] * share(k);
    total = parallel::global_sum(total);
    // Each node takes its share, as far as it has room below the limit; ghosts do as their owners.
    double placed = 0;
    for (std::size_t k = 0; k < squares.size(); ++k) {
      double added = left * share(k) / total;
      if (added > 0 && round < k_rounds) added = std::min(added, std::max(limit - enthalpies[k], 0.0));
      enthalpies[k] += added;
      placed += weights[k] * added;
    }
    left -= parallel::global_sum(placed);
  }
}

}  // namespace

void add_heat_of_walls(std::span<const FilledWall> walls, const mesh::Mesh& mesh,
                       std::span<const Index> nodes, std::span<const double> weights, double diffusivity,
                       double limit, std::span<double> enthalpies) {
  for (const FilledWall& wall : walls) {
    // The squares of the distances of all nodes, and the smallest of them over all processes.
    std::vector<double> squares(nodes.size());
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const mesh::Point& x = mesh.x[as_size(nodes[k])];
      for (std::size_t d = 0; d < x.size(); ++d)
        squares[k] += (x[d] - wall.centre[d]) * (x[d] - wall.centre[d]);
      if (weights[k] > 0) nearest = std::min(nearest, squares[k]);
    }
    const double depth = std::max(parallel::global_min(nearest), diffusivity * wall.seconds);
    add_heat_of_wall(wall.heat, squares, depth, weights, limit, enthalpies);
  }
}

}  // namespace solidus::setup
