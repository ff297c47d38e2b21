/// The fields of a run in all formats that it is asked for.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "results/fields/field.hpp"
#include "results/output/field_format.hpp"
#include "results/output/run_folder.hpp"

namespace solidus::results {

class FieldOutput {
 public:
  /// Collective. Throws OutputError.
  /// @param formats  names of those with a key in [output] that are written too
  /// @param from     the time from which an earlier run is continued, whose fields up to then have been
  /// written
  FieldOutput(const RunFolder& folder, const mesh::Mesh& mesh, const std::vector<std::string>& formats = {},
              std::optional<double> from = {});

  /// Writes one moment, unless it was written last (by a run that stops there). Collective; an error on one
  /// process is thrown on all (OutputError, NotFiniteError).
  /// @param surfaces  nodal fields of surfaces of the mesh, by name of the surface
  void write(double time, const FieldSet& fields, const std::map<std::string, FieldSet>& surfaces = {});
  /// The run ends or stops. Collective. Throws OutputError, InputError where files were damaged meanwhile.
  void end();

 private:
  std::vector<std::unique_ptr<FieldWriter>> writers_;
  std::optional<double> last_;  ///< the moment written last
};

}  // namespace solidus::results
