/// The part of mechanics in the thermal phase of a split, at a fixed configuration.
#pragma once

#include <span>

#include "mechanics/state/mechanical_state.hpp"
#include "mechanics/state/pass.hpp"

namespace solidus::mechanics {

class MechanicalPhase;
struct FlowChange;

/// The return mapping of the thermal phase (4.45, 4.49, 4.54): finds the flow of solid metal again at the
/// temperatures of the step's end, from the internal variables at t_n, at the strain that
/// MechanicalPhase::solve() has found. Melt and mush keep the flow of that solve, of whose stress the work
/// also stays; may be repeated. Throws StepRejected on all processes where a law finds no state. Collective.
/// @param old, pass    those of the solve
/// @param temperature  Θ_{n+1} [K], [local node], ghosts up to date
/// @param trial        the state that the solve has found; its history and fields of elements are replaced
/// @param deformation  that of the solve; replaced
/// @return differences to the mechanical phase, over all processes
FlowChange restart_flow(MechanicalPhase& phase, const MechanicalState& old, const MechanicalPass& pass,
                        std::span<const double> temperature, MechanicalState& trial,
                        StepDeformation& deformation);

/// The deformation of bodies that stay as they are in `state`, for a thermal phase of its own.
/// @param expands  they store the heat that free expansion would take up
///                 (StructuralPoints::expect_expansion)
StepDeformation held_deformation(MechanicalPhase& phase, const MechanicalState& state,
                                 std::span<const double> temperature,
                                 std::span<const double> plateau_share = {}, bool expands = false);

}  // namespace solidus::mechanics
