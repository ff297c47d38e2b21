/// Facts on every body at a step that failed: its size and weight, what holds it, how far and where it has
/// moved, and its points of contact.
#pragma once

#include <vector>

#include "cases/case_spec.hpp"
#include "coupling/diagnosis.hpp"
#include "mechanics/equilibrium_rejected.hpp"
#include "setup/assembly.hpp"

namespace solidus::run {

struct BodyFacts {
  bool moves = false;      ///< it is there and deforms
  double size = 0;         ///< from corner to corner as drawn [m]
  double weight = 0;       ///< [N]
  bool supported = false;  ///< it, or a body that shares nodes with it: Diagnosis::supported
  bool carried = false;    ///< supported, or in closed contact with a rigid surface or a carried body
  bool plastic = false;    ///< its material can flow
  bool rubs = false;       ///< a contact of it has friction
  coupling::ContactPoints contact;
  double elongation = 0;  ///< Diagnosis::elongation
  double moved = 0;       ///< Diagnosis::moved
  Index farthest = -1;    ///< the node of it, on the process that owns it; −1 on the others
  double yielding = 0;    ///< LastIterate::flowing
};

/// [body of the mesh]. Collective.
/// @param last     the last committed state
/// @param iterate  of the failing try; null: it has left none
std::vector<BodyFacts> body_facts(const cases::CaseSpec& spec, const setup::Assembly& a,
                                  const coupling::State& last, const mechanics::LastIterate* iterate);

}  // namespace solidus::run
