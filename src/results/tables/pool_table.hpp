/// pools.csv: every pool of melt at every step.
#pragma once

#include <filesystem>
#include <optional>
#include "coupling/state.hpp"
#include "results/output/csv.hpp"

namespace solidus::results {

/// One row a pool and step, largest pools not first but by number: time, pool, parent (0: there from the
/// start), closed_off_since (−1: it is not), frozen_at (−1: not yet), volume, solid_fraction, and of its
/// hottest node temperature, x, y, z. A pool's last row has the volume zero, and of its last node where and
/// when (frozen_at) it passed the limit; a pool that left as melt with its body has not (−1). One process
/// writes it.
class PoolTable {
 public:
  /// @param from  the run goes on from this time [s]
  /// Throws OutputError.
  PoolTable(const std::filesystem::path& path, std::optional<double> from);
  void add(const coupling::State& state);

 private:
  CsvTable table_;
};

}  // namespace solidus::results
