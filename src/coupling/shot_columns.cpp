/// shots.csv: castings and the die from shot to shot; temperatures in degrees Celsius, as a foundry reads
/// them.
#include <array>

#include "coupling/columns.hpp"

namespace solidus::coupling {

namespace {

using quantities::Chart;

/// The chart of a column that history.csv has too is one over time.
constexpr Column without_chart(Column column) {
  column.chart = Chart::of_unit;
  return column;
}

constexpr auto of_all = [](const ShotRecord&) { return true; };

constexpr auto k_shots = std::to_array<ShotColumn>({
    {{.name = "time", .unit = "s", .label = "Ends at", .doc = "Time of its end", .listed = true},
     of_all,
     [](const ShotSource& s) { return s.shot.end; }},
    {columns::k_shot, of_all, [](const ShotSource& s) { return static_cast<double>(s.shot.number); }},
    {columns::k_poured_at, of_all, [](const ShotSource& s) { return s.shot.poured; }},
    {columns::k_time_to_solidify, of_all, [](const ShotSource& s) { return s.time_to_solidify; }},
    {{.name = "die_at_start_mean",
      .unit = "degC",
      .label = "Die at its start, mean",
      .doc = "Temperature of the bodies that stay when the shot begins: mean",
      .chart = Chart::die_of_shots,
      .listed = true},
     of_all,
     [](const ShotSource& s) { return s.shot.at_pour.mean - k_zero_celsius; }},
    {{.name = "die_at_start_min",
      .unit = "degC",
      .label = "Die at its start, coldest place",
      .doc = "Temperature of the bodies that stay when the shot begins: lowest",
      .chart = Chart::die_of_shots},
     of_all,
     [](const ShotSource& s) { return s.shot.at_pour.lowest - k_zero_celsius; }},
    {{.name = "die_at_start_max",
      .unit = "degC",
      .label = "Die at its start, hottest place",
      .doc = "Temperature of the bodies that stay when the shot begins: highest",
      .chart = Chart::die_of_shots},
     of_all,
     [](const ShotSource& s) { return s.shot.at_pour.highest - k_zero_celsius; }},
    {{.name = "die_at_end_mean",
      .unit = "degC",
      .label = "Die at its end, mean",
      .doc = "Temperature of the bodies that stay when the shot ends: mean",
      .listed = true},
     of_all,
     [](const ShotSource& s) { return s.shot.at_end.mean - k_zero_celsius; }},
    {{.name = "die_at_end_min",
      .unit = "degC",
      .label = "Die at its end, coldest place",
      .doc = "Temperature of the bodies that stay when the shot ends: lowest"},
     of_all,
     [](const ShotSource& s) { return s.shot.at_end.lowest - k_zero_celsius; }},
    {{.name = "die_at_end_max",
      .unit = "degC",
      .label = "Die at its end, hottest place",
      .doc = "Temperature of the bodies that stay when the shot ends: highest"},
     of_all,
     [](const ShotSource& s) { return s.shot.at_end.highest - k_zero_celsius; }},
    {columns::k_largest_change, of_all, [](const ShotSource& s) { return s.shot.change; }},
    {without_chart(columns::k_heat_poured), of_all, [](const ShotSource& s) { return s.shot.heat.poured; }},
    {without_chart(columns::k_heat_ejected), of_all, [](const ShotSource& s) { return s.shot.heat.ejected; }},
    {without_chart(columns::k_heat_corrected), of_all,
     [](const ShotSource& s) { return s.shot.heat.corrected; }},
    {columns::k_periodic, of_all, [](const ShotSource& s) { return s.shot.periodic ? 1.0 : 0.0; }},
});

}  // namespace

std::span<const ShotColumn> shot_columns() {
  return k_shots;
}

}  // namespace solidus::coupling
