/// Observers that compare the report of every step with the laws of thermodynamics, and warn once of a
/// violation.
#pragma once

#include "coupling/observer.hpp"
#include "heat/thermal_phase.hpp"
#include "setup/admissible.hpp"

namespace solidus::run {

/// Warns when the functional 𝓛 of 2.24 grows over a step, by more than residuals and rounding explain,
/// although the conditions are admissible.
class StabilityWatch : public coupling::Observer {
 public:
  /// @param spec     kept by reference; thermo-mechanical
  /// @param coldest  as of admissibility()
  explicit StabilityWatch(const cases::CaseSpec& spec,
                          double coldest = std::numeric_limits<double>::infinity())
      : spec_(spec), admissibility_(setup::admissibility(spec, coldest)) {}
  void begin(const coupling::State&) override {}
  void step(const coupling::StepRecord& record, const coupling::State& state) override;
  void stopped(const coupling::Stop&, const coupling::State&) override {}
  void end(const coupling::State&) override {}

 private:
  const cases::CaseSpec& spec_;
  setup::Admissibility admissibility_;
  bool warned_ = false;
};

/// Warns at the end of a run, whole or stopped, whose steps together violate the first law: by more than
/// residuals explain where the scheme closes it, by a thousandth of the heat exchanged where it does not
/// (the entropy and the printed forms).
class FirstLawWatch : public coupling::Observer {
 public:
  /// @param spec  kept by reference
  /// @param heat  of the run, kept; null: nothing but what is exchanged makes the scale
  explicit FirstLawWatch(const cases::CaseSpec& spec, const heat::ThermalPhase* heat = nullptr)
      : spec_(spec), heat_(heat) {}
  void begin(const coupling::State& state) override;
  void step(const coupling::StepRecord& record, const coupling::State& state) override;
  void stopped(const coupling::Stop&, const coupling::State&) override { report(); }
  void end(const coupling::State&) override { report(); }

 private:
  void report() const;

  const cases::CaseSpec& spec_;
  const heat::ThermalPhase* heat_;
  coupling::EnergyAudit sum_;
  double heat_content_ = 0;  ///< at the start [J]
  double unsolved_ = 0;      ///< imbalance by residuals, summed [J]
};

/// Reports at the end of a run that liquid metal has left its wall, and where
/// (contact::ContactParameters::leaving_gap).
class WallWatch : public coupling::Observer {
 public:
  /// @param contacts  kept by reference
  explicit WallWatch(const std::vector<contact::ContactPair*>& contacts)
      : contacts_(contacts), largest_(contacts.size()) {}
  void begin(const coupling::State&) override {}
  void step(const coupling::StepRecord& record, const coupling::State& state) override;
  void stopped(const coupling::Stop&, const coupling::State&) override { report(); }
  void end(const coupling::State&) override { report(); }

 private:
  void report() const;

  const std::vector<contact::ContactPair*>& contacts_;
  struct Largest {
    double gap = 0, area = 0, time = 0;
  };
  std::vector<Largest> largest_;  ///< [contact]; the time is that of the largest gap
};

}  // namespace solidus::run
