/// Power, outlet, hottest wall, flow and film of a channel.
#include <array>

#include "heat/columns.hpp"
#include "numbers/types.hpp"

namespace solidus::heat {

namespace {

constexpr auto always = [](const EveryRun&) { return true; };

/// Zero before the first step, when nothing is known.
double celsius(const ChannelReading& reading, double kelvin) {
  return reading.name.empty() ? 0.0 : kelvin - k_zero_celsius;
}

constexpr auto k_channels = std::to_array<ChannelColumn>({
    {k_power, always, [](const ChannelSource& s) { return s.power; }},
    {{.name = "_outlet",
      .unit = "degC",
      .label = "outlet",
      .doc = "Temperature of the fluid at the outlet",
      .when = "with cooling channels"},
     always,
     [](const ChannelSource& s) { return celsius(s.reading, s.reading.outlet); }},
    {{.name = "_wall",
      .unit = "degC",
      .label = "wall",
      .doc = "Temperature of the hottest place of the wall",
      .when = "with cooling channels"},
     always,
     [](const ChannelSource& s) { return celsius(s.reading, s.reading.wall); }},
    {{.name = "_reynolds",
      .unit = "1",
      .label = "Reynolds number",
      .doc = "Mean Reynolds number along the way",
      .when = "with cooling channels"},
     always,
     [](const ChannelSource& s) { return s.reading.reynolds; }},
    {{.name = "_film",
      .unit = "W/m2/K",
      .label = "film",
      .doc = "Mean film coefficient along the way",
      .when = "with cooling channels"},
     always,
     [](const ChannelSource& s) { return s.reading.film; }},
});

}  // namespace

std::span<const ChannelColumn> channel_columns() {
  return k_channels;
}

}  // namespace solidus::heat
