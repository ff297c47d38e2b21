/// Takes neighbours of a run, whose data differ a little, along with its steps: heat alone
/// (heat/step_sensitivity.hpp), or bodies that deform and then exchange heat, the order mechanics_first of
/// the isothermal and the isentropic split. Of a step of the latter
///
///   equilibrium   at the temperatures of t_n: how displacements follow (mechanics/step_sensitivity.hpp)
///   gaps          of the contacts at these displacements, each neighbour's own
///   heat          through these gaps, with the heat of each neighbour's own deformation
///
/// so that derivatives know that an interface which passes less heat opens earlier or later. Which points
/// are closed, yield or melt is as each neighbour finds it, an amount of ε beside the run: at a switch the
/// derivative is that of one side.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "coupling/observer.hpp"
#include "coupling/phases.hpp"
#include "heat/step_sensitivity.hpp"
#include "mechanics/step_sensitivity.hpp"

namespace solidus::coupling {

/// Steps must be the run's own, not two halves of them: those of a size that does not follow from errors.
class StepSensitivity : public Observer {
 public:
  struct Neighbour {
    const Phases* phases = nullptr;  ///< on the mesh of the run; outlive this object
    State initial;
  };
  /// @param phases  of heat alone: those of the run. Of bodies that deform: others that are made of the same
  ///                data, for the steps are taken again with them. The thermal phase of the run keeps its
  ///                stages (heat::ThermalPhase::keep_stages)
  /// Throws InputError for what has no derivative here: mechanics alone, interfaces that store heat, inertia,
  /// bodies that burn, heat at Gauss points.
  StepSensitivity(const Phases& phases, std::vector<Neighbour> neighbours);

  void begin(const State& state) override;
  /// Throws StepRejected where a linear system has no solution, and InputError where the step cannot be
  /// taken again: of a scheme that solves more than one equilibrium and one balance of heat.
  void step(const StepRecord& record, const State& state) override;
  void stopped(const Stop&, const State&) override {}
  void end(const State&) override {}

  /// Brings a state of a neighbour to the last step: heat, and of bodies that deform displacements and
  /// contacts.
  void read(std::size_t neighbour, State& state) const;

 private:
  struct Deformed {
    const Phases* phases = nullptr;
    mechanics::MechanicalState mechanics;
    std::vector<contact::ContactState> contacts;
  };
  void deform(const StepRecord& record, const State& state);
  mechanics::StepDeformation deform(const Phases& phases, const State& old, const State& now,
                                    const StepRecord& record, Deformed* neighbour);

  const Phases& phases_;
  std::vector<Deformed> deformed_;
  std::vector<heat::NeighbourPhase> heat_;
  heat::StepSensitivity of_heat_;
  std::unique_ptr<mechanics::StepSensitivity> of_bodies_;  ///< null: nothing deforms
  State before_;                                           ///< of the run at t_n
};

}  // namespace solidus::coupling
