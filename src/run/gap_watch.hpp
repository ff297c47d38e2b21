/// An observer of runs that conduct heat through the gaps of a step's start (PhaseOrder::heat_first): what
/// the change of the conductances within the steps misplaces.
#pragma once

#include <vector>

#include "contact/pair.hpp"
#include "coupling/observer.hpp"

namespace solidus::model {

/// Reports at the end of a run the heat that interfaces passed by conductances that were no longer true at
/// the end of the step:
///
///   late = Σ_steps Δt Σ_a A_a |q_a/h_a,n+1| |h_a,n+1 − h_a,n|,   all = Σ_steps Δt Σ_a A_a |q_a/h_a,n+1|
///   h_a,n
///
/// a nodes of a surface, q_a [W/m²] flux at the end of the step without the heat of friction, A_a [m²] the
/// area around the node, h_a,n and h_a,n+1 [W/(m² K)] conductance at both ends of the step.
class GapWatch : public coupling::Observer {
 public:
  /// @param contacts  kept by reference
  explicit GapWatch(const std::vector<contact::ContactPair*>& contacts)
      : contacts_(contacts), pairs_(contacts.size()) {}
  void begin(const coupling::State& state) override;
  void step(const coupling::StepRecord& record, const coupling::State& state) override;
  void stopped(const coupling::Stop&, const coupling::State&) override { report(); }
  void end(const coupling::State&) override { report(); }

 private:
  struct Pair {
    std::vector<double> conductance;                   ///< at the last time, [owned node of the pair]
    double late = 0, all = 0;                          ///< [J], all processes
    double worst = 0, worst_time = 0, worst_step = 0;  ///< the step that misplaced most [J], [s]
  };
  void report() const;

  const std::vector<contact::ContactPair*>& contacts_;
  std::vector<Pair> pairs_;  ///< [contact]
  double exchanged_ = 0;     ///< heat that moved anywhere in the run [J]
};

}  // namespace solidus::model
