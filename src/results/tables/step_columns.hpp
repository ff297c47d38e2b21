/// Columns of the tables of steps: those of steps.csv and the global columns of history.csv.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "coupling/observer.hpp"
#include "numbers/types.hpp"
#include "results/output/csv.hpp"

namespace solidus::results {

/// steps.csv: one row a step, all that StepRecord holds; energies are those of the step.
struct StepTable {
  bool dynamics = false;   ///< bodies have inertia: one column more
  bool stability = false;  ///< 𝓛 is followed: five more
  bool stages = false;     ///< the run has stages: two more
  /// Heat is followed: five for the first law, which mechanics alone does not close, because the energy of
  /// deformation is not counted there.
  bool heat = true;
};
std::vector<CsvColumn> step_columns(StepTable table = {});
std::vector<CsvCell> step_row(const coupling::StepRecord& record, StepTable table = {});

/// The columns of one contact pair in history.csv; their names begin with the pair's.
struct PairColumns {
  std::string name;
  bool friction = false;
  bool heat = false;
  AnalysisKind kind = AnalysisKind::plane_strain;
};

/// The columns of history.csv that concern the whole model: temperatures, solid fraction, contact, and the
/// first law and dissipation summed over the steps since the start. Which of them exist follows from the
/// analysis.
class GlobalHistory {
 public:
  struct Options {
    bool melting = true, contact = true, mechanics = true;
    /// Columns that probes of the same header give already; they are left out here.
    std::vector<CsvColumn> taken = {};
    bool plastic = false;    ///< a material can flow plastically
    bool dynamics = false;   ///< bodies have inertia
    bool stability = false;  ///< 𝓛 is followed
    std::vector<PairColumns> pairs = {};
    bool heat = true;                        ///< is followed: the first law is audited
    bool internal_energy = false;            ///< states have one (coupling/internal_energy.hpp)
    std::vector<std::string> sources = {};   ///< names of sources that travel: a column of power for each
    std::vector<std::string> channels = {};  ///< names of channels: columns of the fluid of each
    bool grows = false;                      ///< bodies grow: their mass is a column
    bool bodies = false;                     ///< bodies leave and come: their heat is part of the balance
  };
  explicit GlobalHistory(Options options) : options_(std::move(options)) {}

  std::vector<CsvColumn> columns() const;
  /// The state before the first step; energies begin at zero.
  /// @param energy, stability  sums of the steps before, where a run goes on
  /// @param heat_content       of that state, as of coupling::heat_content() [J]
  void start(const coupling::StepEffort& initial, const coupling::EnergyAudit& energy = {},
             const coupling::StabilityAudit& stability = {}, double heat_content = 0,
             double heat_of_bodies = 0);
  /// @param heat_of_bodies  heat of the active bodies [J] (ThermalPhase::heat_content), where they change
  void add(const coupling::StepEffort& step, double heat_of_bodies = 0);
  /// The mass that has been deposited until now [kg].
  void deposited(double mass) { mass_ = mass; }
  /// In the order of columns().
  std::vector<double> values() const;
  /// All there are, those that probes of the same header give included.
  std::vector<Reading> all() const;
  const coupling::EnergyAudit& energy() const { return sum_; }
  const coupling::StabilityAudit& stability() const { return stability_; }
  /// Relative defect of the first law over all steps, as coupling::relative_defect() defines it.
  double relative_defect() const;

 private:
  void add_channel(const std::string& name, std::vector<Reading>& to) const;
  std::vector<Reading> entries() const;  ///< those that are shown

  Options options_;
  coupling::StepEffort last_;
  coupling::EnergyAudit sum_;
  double heat_content_ = 0;             ///< at the start [J]
  double mass_ = 0;                     ///< that has been deposited [kg]
  double heat_of_bodies_ = 0;           ///< of the active ones, counted from 20 °C [J]
  coupling::StabilityAudit stability_;  ///< summed
};

}  // namespace solidus::results
