/// The depth of wear around the nodes of a pair, without the other means that a report has.
#pragma once

#include <span>

#include "contact/contact_report.hpp"

namespace solidus::contact {

/// Raises the depths to those of a pair that wears, at the end of its step: on the slave the mean of its
/// points, on a master that wears its own. A pair that does not wear changes nothing. Local.
/// @param depth  [local node] [m]; entries of owned nodes are changed
void take_wear(const ContactView& pair, std::span<double> depth);

}  // namespace solidus::contact
