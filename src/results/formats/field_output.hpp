/// The field files of a run, numbered and collected in fields.pvd.
#pragma once

#include <map>
#include <string>

#include "results/fields/field.hpp"
#include "results/formats/pvd.hpp"
#include "results/output/run_folder.hpp"

namespace solidus::results {

/// fields/fields_00012.vtu, in parallel fields/fields_00012.pvtu with one part per process; surfaces likewise
/// as fields/surface_NAME_00012.vtu.
class FieldOutput {
 public:
  FieldOutput(const RunFolder& folder, const mesh::Mesh& mesh);
  /// Continues the fields of an earlier run and drops those after `time`. Collective. Throws
  /// OutputError.
  FieldOutput(const RunFolder& folder, const mesh::Mesh& mesh, double time);

  /// Writes one moment, unless it was written last (by a run that stops there). Collective; an error on one
  /// process is thrown on all (OutputError, NotFiniteError), and the collection is then unchanged.
  /// @param surfaces  nodal fields of surfaces of the mesh, which are written to separate files, by name of
  /// the surface
  void write(double time, const FieldSet& fields, const std::map<std::string, FieldSet>& surfaces = {});

  int written() const { return written_; }

 private:
  std::string write_one(const std::string& name, const mesh::Surface* surface, const FieldSet& fields,
                        double time);

  const mesh::Mesh& mesh_;
  std::filesystem::path fields_;
  PvdCollection collection_;
  int written_ = 0;
  double last_time_ = 0;
};

}  // namespace solidus::results
