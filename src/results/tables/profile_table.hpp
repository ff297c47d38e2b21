/// Fields along a group of nodes as a table of their own, NAME.csv: wear along a sheet, pressure along a
/// wall.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "results/tables/probes.hpp"

namespace solidus::results {

struct Profile {
  std::string name;                ///< of the file, without its ending
  std::string group;               ///< a key of Mesh::node_sets
  std::string length_unit = "mm";  ///< of the coordinates
  std::vector<Sampled> columns;    ///< fields at nodes
  SourceLocation where;
};

/// One row a node, at its place before deformation: coordinates x, y (z), then the columns. Rows are sorted
/// by x, then y, then z.
class ProfileTable {
 public:
  /// Throws InputError (on every process) for an unknown group or field, a field of cells, a unit of another
  /// dimension. Collective.
  /// @param fields  the fields there will be; only names, units and shapes are used
  ProfileTable(const mesh::Mesh& mesh, AnalysisKind kind, Profile profile, const FieldSet& fields);

  std::string file_name() const { return profile_.name + ".csv"; }
  /// Replaces the file by the values of this moment. Collective. Throws OutputError, NotFiniteError on every
  /// process.
  void write(const std::filesystem::path& folder, const FieldSet& fields) const;

 private:
  std::vector<CsvColumn> columns() const;
  std::vector<double> gather(const FieldSet& fields) const;

  const mesh::Mesh& mesh_;
  Profile profile_;
  int dimension_;
  std::vector<Index> nodes_;  ///< of the group, owned
  units::Conversion length_;
  std::vector<units::Conversion> shown_;
};

}  // namespace solidus::results
