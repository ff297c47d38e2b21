#include "run/channel_watch.hpp"

#include <fmt/format.h>

#include "coupling/state.hpp"
#include "heat/loads/channel_fluid.hpp"
#include "system/log.hpp"

namespace solidus::run {

void ChannelWatch::step(const coupling::StepRecord& record, const coupling::State& state) {
  for (std::size_t i = 0; i < spec_.channels.size(); ++i) {
    const cases::ChannelSpec& channel = spec_.channels[i];
    if (warned_[i] != 0 || channel.fluid != cases::ChannelSpec::Fluid::water) continue;
    // The reading of this channel: only where it flows is there a wall that it wets.
    for (const heat::ChannelReading& reading : record.channels) {
      if (reading.name != channel.name || !reading.found) continue;
      const double boils = heat::boiling_point_of_water(channel.pressure);
      if (reading.wall <= boils) continue;
      warned_[i] = 1;
      logging::warn(
          "channel '{}': its wall is {:.0f} degC hot at ({:.4g}, {:.4g}, {:.4g}) m at t = {:g} s, where "
          "water "
          "of {:.3g} bar boils from {:.0f} degC on; its film coefficient knows no boiling, so that the heat "
          "there is uncertain (more flow, or the pressure that it has)",
          channel.name, reading.wall - k_zero_celsius, reading.place[0], reading.place[1], reading.place[2],
          state.time, 1e-5 * channel.pressure, boils - k_zero_celsius);
    }
  }
}

}  // namespace solidus::run
