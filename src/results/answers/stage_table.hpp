/// stages.csv: a row for every stage that is over, with what it has left in the bodies: temperatures, stress
/// and distortion.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "coupling/observer.hpp"
#include "coupling/phases.hpp"
#include "coupling/state.hpp"
#include "mesh/mesh.hpp"
#include "quantities/column.hpp"
#include "results/fields/field.hpp"
#include "results/output/csv.hpp"
#include "results/output/display_units.hpp"
#include "results/output/json_document.hpp"

namespace solidus::results {

struct CastBody;

/// A row of the table: the end of a stage. The values are those of what is cast; where nothing of it is
/// there, of all bodies that are.
struct StageRow {
  int stage = 0, cycle = 0;                   ///< as in coupling::StepRecord
  double time = 0;                            ///< [s]
  double lowest = 0, highest = 0;             ///< temperature [K]; zero of a run without heat
  std::optional<double> stress, mean_stress;  ///< von Mises, the largest and the mean by volume [Pa]
  std::optional<double> distortion;           ///< the largest [m]; absent where nothing follows it
  bool has_temperatures() const { return highest > 0; }
};

/// The row of a state at the end of a stage. Collective.
/// @param fields  of the bodies, those of criteria up to date
StageRow stage_row(const mesh::Mesh& mesh, const coupling::Phases& phases, const coupling::StepRecord& record,
                   const coupling::State& state, const std::vector<CastBody>& castings,
                   const FieldSet& fields);

using StageColumn = quantities::ReadColumn<StageRow, StageRow, double>;
/// stages.csv in its order; −1 stands for a stress or a distortion that the run does not have.
std::span<const StageColumn> stage_columns();

/// One process writes it.
class StageTable {
 public:
  /// @param from  the run goes on from this time [s]: rows up to there stay
  /// Throws OutputError.
  StageTable(const std::filesystem::path& path, std::optional<double> from);
  void add(const StageRow& row);
  /// All rows, of an earlier run that goes on too.
  const std::vector<StageRow>& rows() const { return rows_; }

 private:
  CsvTable table_;
  std::vector<StageRow> rows_;
};

/// The stages that are over, with their names by their numbers in the case.
struct StageAnswers {
  std::vector<std::string> names;
  std::vector<StageRow> rows;
  const std::string& name(const StageRow& row) const;
};

/// A line for each stage of the case that is over; of one that has come round several times the last row.
std::string stage_lines(const StageAnswers& stages, const DisplayUnits& units);
/// For summary.json, SI.
Json json(const StageAnswers& stages);

}  // namespace solidus::results
