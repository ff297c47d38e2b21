/// The temperatures on both sides of a point are means of nodal temperatures with the shares that the
/// motion gives: slave nodes first, then those of the master.
#include "contact/forces/coupled_interface.hpp"

#include "numbers/index_casts.hpp"

namespace solidus::contact {

std::optional<Surroundings> CoupledInterface::around(const PointMotion& motion) const {
  if (law == nullptr || !motion.partnered) return {};
  Surroundings s{.law = law, .time_step = time_step};
  // Temperatures of both sides at the point; shares of the master are negative, as in the gap. A rigid tool
  // has its own temperature, or takes no heat.
  const auto n_slave = as_size(motion.n_slave);
  for (std::size_t b = 0; b < motion.nodes.size(); ++b) {
    const double part = motion.share[b] * temperature[as_size(motion.nodes[b])];
    if (b < n_slave)
      s.temperature[0] += part;
    else
      s.temperature[1] -= part;
  }
  if (n_slave == motion.nodes.size()) {
    s.master_takes_heat = tool_temperature.has_value();
    s.temperature[1] = tool_temperature.value_or(s.temperature[0]);
  }
  return s;
}

}  // namespace solidus::contact
