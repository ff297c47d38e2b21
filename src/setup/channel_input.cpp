#include "setup/channel_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "input/column_table.hpp"
#include "input/units.hpp"
#include "numbers/index_casts.hpp"
#include "setup/criteria_input.hpp"
#include "setup/section_names.hpp"

namespace solidus::setup {

namespace {

[[noreturn]] void refuse(const cases::ChannelSpec& c, const std::string& what, const std::string& allowed) {
  throw InputError(c.where, fmt::format("the channel '{}' {}", c.name, what), allowed);
}

/// Corners of a CSV file with named columns.
std::vector<Position> read_corners(const cases::ChannelSpec& c, int dimension) {
  const ColumnTable table = read_column_table(c.path.file);
  std::vector<Position> corners;
  constexpr std::array k_axes{"x", "y", "z"};
  for (int axis = 0; axis < dimension; ++axis) {
    const auto a = as_size(axis);
    const auto column = std::ranges::find_if(
        table.columns, [&](const ColumnTable::Column& one) { return one.name == k_axes[a]; });
    if (column == table.columns.end() || column->unit.empty())
      throw InputError({table.file}, fmt::format("the column {} with its unit is missing", k_axes[a]),
                       dimension == 3 ? "x[mm], y[mm], z[mm]" : "x[mm], y[mm]");
    const units::Conversion to_si = units::conversion(column->unit, "m");
    corners.resize(column->values.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (!std::isfinite(column->values[i]))
        throw InputError(table.place(*column, i), "this is no number", "a coordinate in each column");
      corners[i][a] = to_si(column->values[i]);
    }
  }
  return corners;
}

/// A path has a file or lists, of as many coordinates as the analysis has, and no corner twice in a row.
void check_path(const cases::ChannelSpec& c, int dimension) {
  const cases::ChannelPathSpec& p = c.path;
  const bool lists = !p.x.empty() || !p.y.empty() || !p.z.empty();
  const std::string example = dimension == 3
                                  ? "path = { x = [\"0 mm\", \"120 mm\"], y = [\"20 mm\", \"20 mm\"], z = "
                                    "[\"15 mm\", \"15 mm\"] }"
                                  : "path = { x = \"40 mm\", y = \"15 mm\" }";
  if (p.file.empty() != lists)
    refuse(c, lists ? "has a file and lists for its path" : "has no path", example);
  if (lists && (p.x.size() != p.y.size() || (dimension == 3 && p.x.size() != p.z.size())))
    refuse(c, fmt::format("has {} x, {} y and {} z in its path", p.x.size(), p.y.size(), p.z.size()),
           "one of each for every corner");
  if (dimension == 2 && !p.z.empty()) refuse(c, "has a z, which this analysis does not have", example);
  const std::vector<Position> corners = channel_path(c, dimension);
  if (corners.size() < (dimension == 3 ? 2U : 1U))
    refuse(c, fmt::format("has {} corner{} in its path", corners.size(), corners.size() == 1 ? "" : "s"),
           dimension == 3 ? "two at least" : "one at least");
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
    if (corners[i] == corners[i + 1])
      refuse(c, fmt::format("has the same corner twice, number {} and {}", i + 1, i + 2),
             "corners that differ");
}

/// Either a flow of its own, or the outlet of another channel.
void check_flow(const cases::CaseSpec& spec, std::size_t number) {
  const cases::ChannelSpec& c = spec.channels[number];
  const std::string example = "flow = \"8 l/min\", inlet_temperature = \"25 degC\"";
  if (c.after.empty()) {
    if (c.flow.has_value() == c.mass_flow.has_value())
      refuse(c, c.flow ? "has a flow and a mass_flow" : "has no flow", example);
    if (!c.inlet) refuse(c, "has no inlet_temperature", example);
    return;
  }
  if (c.flow || c.mass_flow || c.inlet)
    refuse(c, fmt::format("comes after '{}' and has a flow or an inlet temperature of its own", c.after),
           "without flow, mass_flow and inlet_temperature, or without after");
  for (std::size_t i = 0; i < number; ++i) {
    const cases::ChannelSpec& before = spec.channels[i];
    if (before.name != c.after) continue;
    if (before.stages != c.stages || before.fluid != c.fluid || before.share != c.share)
      refuse(c,
             fmt::format("comes after '{}', which has other stages, another fluid or another share", c.after),
             "the same stages, fluid and share in both");
    return;
  }
  refuse(c, fmt::format("comes after '{}', which is no channel further up", c.after),
         "the name of a [[channel]] that stands before it");
}

}  // namespace

void check_dies(const cases::CaseSpec& spec) {
  check_channels(spec);
  check_die_lives(spec);
}

/// Refuses combinations that channels do not support, at their place in the case and before a mesh is read.
void check_channels(const cases::CaseSpec& spec) {
  check_names(spec.channels, "[[channel]]");
  for (std::size_t i = 0; i < spec.channels.size(); ++i) {
    const cases::ChannelSpec& c = spec.channels[i];
    if (!spec.has_heat())
      refuse(c, "cools, and there is no heat in this analysis", "physics = \"heat\" or \"thermomechanical\"");
    if (spec.heat.integration == heat::HeatIntegration::open)
      refuse(c, "cools nodes, which the open rule has not", "heat.integration = \"closed\", the default");
    if (spec.simultaneous()) refuse(c, "is not known to the simultaneous scheme", "another coupling.scheme");
    for (const cases::ThermalConditionSpec& t : spec.thermal_conditions)
      if (t.name == c.name)
        refuse(c, "has the name of a [[thermal_condition]]", "a name of its own: history.csv has it");
    for (const cases::SourceSpec& s : spec.sources)
      if (s.name == c.name)
        refuse(c, "has the name of a [[source]]", "a name of its own: history.csv has both by name");
    if (std::ranges::none_of(spec.bodies, [&](const cases::BodySpec& b) { return b.mesh_group() == c.body; }))
      refuse(c, fmt::format("is in no body '{}'", c.body), "the group of a [[body]]");
    for (const cases::DepositionSpec& d : spec.depositions)
      if (d.body == c.body) refuse(c, "is in a body that grows", "a body that is there from the start");
    check_path(c, spec.dimension());
    check_flow(spec, i);
  }
}

/// The corners of the centre line, from the file or from the lists.
std::vector<Position> channel_path(const cases::ChannelSpec& channel, int dimension) {
  if (!channel.path.file.empty()) return read_corners(channel, dimension);
  std::vector<Position> corners(channel.path.x.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = {channel.path.x[i], channel.path.y[i], dimension == 3 ? channel.path.z[i] : 0.0};
  return corners;
}

void add_channels(const cases::CaseSpec& spec, const cases::StageRun* stage,
                  heat::ThermalConditions& conditions) {
  for (const cases::ChannelSpec& c : spec.channels) {
    heat::Channel& channel = conditions.channels.emplace_back();
    channel.name = c.name;
    channel.body = c.body;
    channel.path = channel_path(c, spec.dimension());
    channel.diameter = c.diameter;
    channel.by_volume = c.flow.has_value();
    if (c.flow || c.mass_flow) {
      // In stages that the channel does not name nothing flows. Tables follow the clock of the run or of the
      // stage.
      const bool flows = cases::holds(c.stages, stage);
      channel.flow =
          flows ? PlaceFunction(cases::on_clock(c.flow ? *c.flow : *c.mass_flow, c.clock, stage)) : 0.0;
      channel.inlet = cases::on_clock(*c.inlet, c.clock, stage);
    }
    channel.fluid = c.fluid == cases::ChannelSpec::Fluid::water
                        ? heat::water()
                        : heat::ChannelFluid{c.density.table, c.specific_heat.table, c.conductivity.table,
                                             c.viscosity.table};
    channel.law = c.law;
    channel.laminar = c.laminar;
    channel.share = c.share;
    channel.after = c.after;
  }
}

}  // namespace solidus::setup
