/// The second law for deformation: every law dissipates (monograph 2.113).
#pragma once

#include "coupling/observer.hpp"
#include "coupling/state.hpp"
#include "system/log.hpp"

namespace solidus::run {

/// Warns once where a law does not dissipate.
class DissipationWatch : public coupling::Observer {
 public:
  void begin(const coupling::State&) override {}
  void step(const coupling::StepRecord& record, const coupling::State& state) override {
    constexpr double k_rounding = 1e-9;
    if (warned_ || record.least_dissipation >= -k_rounding * record.largest_dissipation) return;
    logging::warn("t = {:g} s: deformation dissipates {:.3g} W/m3 somewhere; it must not be negative",
                  state.time, record.least_dissipation);
    warned_ = true;
  }
  void stopped(const coupling::Stop&, const coupling::State&) override {}
  void end(const coupling::State&) override {}

 private:
  bool warned_ = false;
};

}  // namespace solidus::run
