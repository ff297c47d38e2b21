/// Adaptive steps of bodies that grow and deform: where births keep them from getting as short as their error
/// asks.
#pragma once

#include "cases/case_spec.hpp"
#include "coupling/observer.hpp"
#include "coupling/step_limits.hpp"
#include "setup/assembly.hpp"

namespace solidus::run {

/// Whether a case leaves the shortest step of bodies that grow to the program (setup::time_options).
bool chooses_shortest_step_of_growth(const cases::CaseSpec& spec);

/// Warns at the end of a run whose shortest steps had errors of the displacement above what is allowed.
class GrowthStepWatch : public coupling::Observer {
 public:
  GrowthStepWatch(const cases::CaseSpec& spec, const setup::Assembly& a);
  void begin(const coupling::State&) override {}
  void step(const coupling::StepRecord& record, const coupling::State& state) override;
  void stopped(const coupling::Stop&, const coupling::State&) override { report(); }
  void end(const coupling::State&) override { report(); }

 private:
  void report() const;

  coupling::StepLimits limits_;
  double shortest_ = 0;  ///< [s]
  int steps_ = 0, too_long_ = 0;
  double worst_ = 0, worst_time_ = 0;  ///< the largest error [m] and its time [s]
};

}  // namespace solidus::run
