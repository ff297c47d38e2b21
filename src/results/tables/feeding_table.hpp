/// feeding.csv: where the metal that shrinks took its volume from, at every step.
#pragma once

#include <filesystem>
#include <optional>

#include "coupling/state.hpp"
#include "results/output/csv.hpp"

namespace solidus::results {

/// One row a step, volumes since pouring in m³ (in two dimensions per depth or revolution): the contractions
/// of melt, of freezing and of solid; pipe, sink, cavity, pores and gas, by how much the wall of the mould
/// gave way, and what the outside has lost by the contraction of solid metal; the defect of this balance as a
/// share of the castings. One process writes it.
class FeedingTable {
 public:
  /// @param from  the run goes on from this time [s]
  /// Throws OutputError.
  FeedingTable(const std::filesystem::path& path, std::optional<double> from);
  void add(const coupling::State& state);

 private:
  CsvTable table_;
};

}  // namespace solidus::results
