/// Bodies whose elements come during a run. A phase is made on a mesh with all elements; those that come
/// later are then taken out of the mesh, block by block, and put back when they are born
/// (linear::GrowingMesh). A block has all of its elements or none.
#pragma once

#include <span>

#include "mechanics/mechanical_phase.hpp"

namespace solidus::mechanics {

/// Blocks without an element on any process wait from here on, and those that have got their elements back
/// take part (elements/growing_block.hpp). Returns whether anything has changed. Collective.
bool follow_elements(MechanicalBodies& bodies);
/// Whether blocks come during the run.
bool grows(const MechanicalBodies& bodies);

/// The moment in which elements are born.
struct BirthMoment {
  double time = 0;                          ///< [s]
  std::span<const double> temperature{};    ///< with the heat of the new elements [K], [local node]
  std::span<const double> plateau_share{};  ///< MechanicalPass::plateau_share
};

/// Brings the phase in line with the elements that its mesh has now, in quasi-statics; its matrix is made
/// again. Collective.
/// @param conditions  with the surfaces of now
/// @param state       gets the displacement of the new nodes and the history of the new elements, free of
///                    strain; null: it has them, or there is none yet
void grow(MechanicalPhase& phase, MechanicalConditions conditions, const BirthMoment& birth,
          MechanicalState* state);

}  // namespace solidus::mechanics
