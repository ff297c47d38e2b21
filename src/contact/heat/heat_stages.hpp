/// The thermal phase of an interface in time: the heat of friction of a mechanical pass is spread evenly over
/// the phase that follows, which has one or two stages.
#pragma once

#include <optional>
#include <vector>

#include "contact/interface/interface_thermodynamics.hpp"
#include "numbers/types.hpp"

namespace solidus::contact {

/// Time over which a thermal phase spreads the heat of a mechanical pass, if their time steps differ.
struct HeatSpan {
  double dt = 0;           ///< [s]
  bool adiabatic = false;  ///< nothing flows: the dissipation alone is a term
};

/// The results of the first stage that the second one starts from, [point].
struct FirstStage {
  std::vector<double> temperature;  ///< Θ_c that the second stage starts from
  std::vector<double> flux;         ///< heat that the first one took from the bodies [J/m²]
  std::vector<double> dissipation;  ///< and its part of what friction makes in all [J/m²]
};

class HeatStages {
 public:
  /// The thermal phase that follows: dissipation and entropy of the points are spread evenly over it. Until
  /// end() a point's balance is that of the stage.
  void begin(const HeatSpan& span) { phase_ = Phase{.span = span, .stage_dt = span.dt, .first = {}}; }
  void end() { phase_.reset(); }
  bool running() const { return phase_.has_value(); }
  bool adiabatic() const { return phase_ && phase_->span.adiabatic; }
  /// Length of the phase and of its stage; outside of a phase those of the mechanical pass [s].
  double span(double of_pass) const { return phase_ ? phase_->span.dt : of_pass; }
  double stage(double of_pass) const { return phase_ ? phase_->stage_dt : of_pass; }
  /// The stage of the phase that begins.
  /// @param first  of a second stage; absent: the first one
  void begin_stage(double dt, std::optional<FirstStage> first);
  /// The results of the first stage while the second one is computed; null otherwise.
  const FirstStage* first() const { return phase_ && phase_->first ? &*phase_->first : nullptr; }
  /// Returns the heat balance of a point over the stage.
  /// @param whole  the same over the whole of the phase
  InterfaceStep step(Index point, InterfaceStep whole) const;
  /// Heat of friction over the phase, found at the end of its last stage [J/m²].
  /// @param whole  over the whole of the phase, as it is found in this stage
  double dissipated(Index point, double whole) const;

 private:
  struct Phase {
    HeatSpan span;
    double stage_dt = 0;
    std::optional<FirstStage> first;
  };
  std::optional<Phase> phase_;
};

}  // namespace solidus::contact
