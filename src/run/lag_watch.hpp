/// Observers that report at the end of a run by how much results lag behind their own time, or heat of
/// deformation behind its limit for short steps: errors of first order in the step, each with its number.
#pragma once

#include <optional>
#include <vector>

#include "contact/interface/friction_coefficient.hpp"
#include "contact/pair.hpp"
#include "coupling/observer.hpp"

namespace solidus::run {

/// Reports at the end of a run whose displacements and stresses lag by a step (lags_a_step) how large the lag
/// is: the change of displacements in the last step as a part of all their change. A warning where it is much
/// and something melts or yields, which keeps the strain of an earlier temperature.
class LagWatch : public coupling::Observer {
 public:
  /// @param keeps_strain  Phases::keeps_strain
  explicit LagWatch(bool keeps_strain) : keeps_strain_(keeps_strain) {}
  void begin(const coupling::State& state) override;
  void step(const coupling::StepRecord& record, const coupling::State& state) override;
  void stopped(const coupling::Stop&, const coupling::State& state) override { end(state); }
  void end(const coupling::State& state) override;

 private:
  std::vector<double> first_, before_, now_;  ///< displacements at the start and at the last two times [m]
  double dt_ = 0;
  bool keeps_strain_;
};

/// Reports at the end of a run how far tractions of sliding surfaces are from the coefficient of friction at
/// the temperature of their own time,
///
///   ∑ |‖T‖/(μ(ζ_c, Θ_c) t_N) − 1| ΔW / ∑ ΔW   over all points that slip and all steps,
///
/// ΔW the work of friction per area in the step. A split slips with the coefficient of the temperature that
/// its mechanical phase starts from (docs/theory/friction.md). With heat first the interface keeps the heat
/// of its friction until the next step conducts; Θ_c is then the one at which that heat would flow to the
/// bodies.
class FrictionLagWatch : public coupling::Observer {
 public:
  /// @param contacts    kept by reference
  /// @param maps_again  the scheme can find slip again in its thermal phase (thermal_return_mapping)
  /// @param after_heat  heat is conducted before surfaces slip
  FrictionLagWatch(const std::vector<contact::ContactPair*>& contacts, bool maps_again, bool after_heat);
  void begin(const coupling::State& state) override;
  void step(const coupling::StepRecord& record, const coupling::State& state) override;
  void stopped(const coupling::Stop&, const coupling::State&) override { report(); }
  void end(const coupling::State&) override { report(); }

 private:
  void report() const;

  struct Pair {
    std::optional<contact::FrictionCoefficient> coefficient;  ///< absent without friction
    std::vector<double> work;                                 ///< of friction until now, [point] [J/m²]
    double late = 0, all = 0;                                 ///< the two sums on this process [J/m²]
  };
  const std::vector<contact::ContactPair*>& contacts_;
  std::vector<Pair> pairs_;  ///< [contact]
  bool maps_again_, after_heat_;
};

/// Reports at the end of a run in the energy form how much of the heat of deformation there is because the
/// stresses of the ends of steps do the work of whole steps (backward Euler): EnergyAudit::excess_work, which
/// the energy form makes heat of (docs/theory/coupling_stability.md, 9). It halves with the step; of a load
/// that acts at once it is the true half of its work.
class StressWorkWatch : public coupling::Observer {
 public:
  void begin(const coupling::State&) override {}
  void step(const coupling::StepRecord& record, const coupling::State& state) override;
  void stopped(const coupling::Stop&, const coupling::State&) override { report(); }
  void end(const coupling::State&) override { report(); }

 private:
  void report() const;

  double excess_ = 0, dissipated_ = 0, moved_ = 0;  ///< of the run [J]
};

}  // namespace solidus::run
