/// An observer of runs that conduct heat before they solve deformation (PhaseOrder::heat_first): what the
/// change of the gaps within the steps misplaces.
#pragma once

#include <vector>

#include "contact/pair.hpp"
#include "coupling/observer.hpp"

namespace solidus::run {

/// Reports at the end of a run the heat that interfaces passed through other gaps than the mean ones of the
/// steps (StepEffort::gap_heat), added up over the steps.
class GapWatch : public coupling::Observer {
 public:
  /// @param contacts  kept by reference
  explicit GapWatch(const std::vector<contact::ContactPair*>& contacts)
      : contacts_(contacts), pairs_(contacts.size()) {}
  void begin(const coupling::State&) override {}
  void step(const coupling::StepRecord& record, const coupling::State& state) override;
  void stopped(const coupling::Stop&, const coupling::State&) override { report(); }
  void end(const coupling::State&) override { report(); }

 private:
  struct Pair {
    double late = 0, all = 0;                          ///< [J], all processes
    double worst = 0, worst_time = 0, worst_step = 0;  ///< the step that misplaced most [J], [s]
  };
  void report() const;

  const std::vector<contact::ContactPair*>& contacts_;
  std::vector<Pair> pairs_;  ///< [contact]
  double exchanged_ = 0;     ///< heat that moved anywhere in the run [J]
};

}  // namespace solidus::run
