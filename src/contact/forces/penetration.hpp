/// How far the surfaces of a contact pair penetrate: means around the slave's nodes, and where they are
/// largest.
#pragma once

#include <string>
#include <vector>

#include "contact/points/contact_state.hpp"
#include "contact/points/geometry.hpp"

namespace solidus::contact {

/// Mean penetrations ḡ_a around nodes over closed points (augmented_lagrangian.hpp), [local node] [m].
/// Collective.
std::vector<double> nodal_penetration(const ContactGeometry& geometry, const ContactState& now);

/// Largest |ḡ_a| [m] and t_N [Pa] of a state.
struct Penetration {
  double penetration = 0, pressure = 0;
};
/// Collective.
Penetration largest_penetration(const ContactGeometry& geometry, const ContactState& now);

/// Describes the place of the largest mean penetration, for messages. Collective.
std::string worst_penetration(const ContactGeometry& geometry, const ContactState& now);

}  // namespace solidus::contact
