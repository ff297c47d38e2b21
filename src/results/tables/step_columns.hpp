/// Columns of the tables of steps: those of steps.csv and the global columns of history.csv.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "coupling/columns.hpp"
#include "results/output/csv.hpp"

namespace solidus::results {

/// steps.csv: one row a step, all that StepRecord holds; energies are those of the step.
using StepTable = coupling::StepParts;
std::vector<CsvColumn> step_columns(StepTable table = {});
std::vector<CsvCell> step_row(const coupling::StepRecord& record, StepTable table = {});

/// The columns of history.csv that concern the whole model (coupling/history_columns.cpp): temperatures,
/// solid fraction, contact, and the first law and dissipation summed over the steps since the start. Which of
/// them exist follows from the analysis.
class GlobalHistory {
 public:
  using Options = coupling::HistoryParts;
  /// @param taken  columns that probes of the same header give already; they are left out here
  explicit GlobalHistory(Options options, std::vector<CsvColumn> taken = {})
      : options_(std::move(options)), taken_(std::move(taken)) {}

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
  void deposited(double mass) { now_.mass = mass; }
  /// In the order of columns().
  std::vector<double> values() const;
  /// All there are, those that probes of the same header give included.
  std::vector<Reading> all() const;
  const coupling::EnergyAudit& energy() const { return now_.energy; }
  const coupling::StabilityAudit& stability() const { return now_.stability; }
  /// Relative defect of the first law over all steps, as coupling::relative_defect() defines it.
  double relative_defect() const;

 private:
  std::vector<Reading> entries() const;  ///< those that are shown

  Options options_;
  std::vector<CsvColumn> taken_;
  coupling::RunSums now_;
  double heat_content_ = 0;  ///< at the start [J]
};

}  // namespace solidus::results
