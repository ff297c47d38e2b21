/// The columns of cooling channels in history.csv; their names begin with the channel's.
#pragma once

#include <span>

#include "heat/loads/thermal_state.hpp"
#include "quantities/column.hpp"

namespace solidus::heat {

/// The fluid of a channel at the end of a step, and the mean of its power over the step [W]. A reading
/// without a name: no step has been taken yet.
struct ChannelSource {
  ChannelReading reading;
  double power;
};
struct EveryRun {};
using ChannelColumn = quantities::ReadColumn<EveryRun, ChannelSource, double>;
std::span<const ChannelColumn> channel_columns();

/// Of each channel, and of each source that travels.
inline constexpr quantities::Column k_power{
    .name = "_power",
    .unit = "W",
    .label = "power",
    .doc = "Mean over the step of the heat of a source that travels, or of a channel into the die",
    .when = "with sources that travel or cooling channels"};

}  // namespace solidus::heat
