/// Takes neighbours of a run of heat alone, whose data differ a little, along with its steps
/// (heat/step_sensitivity.hpp).
#pragma once

#include <span>
#include <vector>

#include "coupling/observer.hpp"
#include "coupling/phases.hpp"
#include "heat/step_sensitivity.hpp"

namespace solidus::coupling {

/// Steps must be the run's own, not two halves of them: those of a size that does not follow from errors.
class HeatSensitivity : public Observer {
 public:
  struct Neighbour {
    const Phases* phases = nullptr;  ///< on the mesh of the run; outlive this object
    heat::ThermalState initial;
  };
  /// @param phases  of the run; its thermal phase keeps its stages from here on
  /// Throws InputError for what has no derivative here: deformation, interfaces that store heat, bodies that
  /// burn, heat at Gauss points.
  HeatSensitivity(const Phases& phases, std::vector<Neighbour> neighbours);

  void begin(const State& state) override;
  /// Throws StepRejected where a linear system has no solution.
  void step(const StepRecord& record, const State& state) override;
  void stopped(const Stop&, const State&) override {}
  void end(const State&) override {}

  /// The states of the neighbours at the last step.
  std::span<const heat::NeighbourPhase> neighbours() const { return neighbours_; }

 private:
  const Phases& phases_;
  std::vector<const Phases*> of_neighbours_;
  std::vector<heat::NeighbourPhase> neighbours_;
  heat::StepSensitivity sensitivity_;
  heat::ThermalState before_;
};

}  // namespace solidus::coupling
