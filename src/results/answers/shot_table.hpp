/// shots.csv: a row for every shot that is over.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupling/shot.hpp"
#include "mesh/mesh.hpp"
#include "results/fields/field.hpp"
#include "results/output/csv.hpp"
#include "results/output/json_document.hpp"

namespace solidus::results {

struct CastBody;

/// A row of the table.
struct ShotRow {
  coupling::ShotRecord shot;
  /// From the pour to the last melt of all castings [s]; absent: something was liquid when it left.
  std::optional<double> time_to_solidify;
};

/// When the last melt of the castings froze [s since their pouring]; nothing where some of it did not, or
/// where no criteria follow it. Collective.
std::optional<double> time_to_solidify(const mesh::Mesh& mesh, const FieldSet& fields,
                                       const std::vector<CastBody>& castings);

/// Columns: time (of its end), shot, poured_at, time_to_solidify (−1: it was not solid when it left); mean,
/// lowest and highest temperature of the bodies that stay when the shot begins and ends; the largest change
/// between these at a place; heat that was poured, ejected, and put in by the search for the periodic state;
/// and whether this state is found. One process writes it.
class ShotTable {
 public:
  /// @param from  the run goes on from this time [s]: rows up to there stay
  /// Throws OutputError.
  ShotTable(const std::filesystem::path& path, std::optional<double> from);
  void add(const coupling::ShotRecord& record, std::optional<double> time_to_solidify);
  /// All rows, of an earlier run that goes on too.
  const std::vector<ShotRow>& rows() const { return rows_; }

 private:
  CsvTable table_;
  std::vector<ShotRow> rows_;
};

/// A line of the terminal.
std::string shot_text(const ShotRow& row);
/// For summary.json, SI.
Json json(const std::vector<ShotRow>& rows);

}  // namespace solidus::results
