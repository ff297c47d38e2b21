/// What a contact pair remembers of a step: written by ContactPair::update, committed or thrown away by the
/// scheme with the rest of the state.
#pragma once

#include <vector>

namespace solidus::contact {

/// Without friction the law has no history; the penetration at t_n is kept for the difference quotients of
/// 5.19 and for the audit. Friction adds its slip here.
struct ContactState {
  std::vector<double> penetration;  ///< g_N [m], [point]
};

}  // namespace solidus::contact
