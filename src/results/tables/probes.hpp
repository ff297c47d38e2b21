/// Columns of history.csv that sample fields: at points, over groups, and combinations of such.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "input/units.hpp"
#include "mesh/mesh.hpp"
#include "numbers/types.hpp"
#include "results/fields/field.hpp"
#include "results/output/csv.hpp"
#include "system/errors.hpp"

namespace solidus::results {

/// Component of a field by name: "x", "y", "z", "xx", … (axisymmetric also "r" radial, "z" axial, "rr", "zz"
/// axial, "tt" hoop, "rz"), "magnitude" of a vector, nothing for a scalar.
/// Throws std::invalid_argument with the names that are possible.
int component_index(std::string_view name, int components, AnalysisKind kind);
inline constexpr int k_magnitude = -1;

/// Field and component, and how the column is called; `column.unit` is the unit shown.
struct Sampled {
  CsvColumn column;
  std::string field;
  int component = 0;
  SourceLocation where;  ///< of the probe in the case, for messages
};

/// A field at nodes: interpolated; a field of cells: that of the element.
struct PointProbe : Sampled {
  mesh::Point at{};  ///< [m]
  int body = -1;     ///< index into Mesh::bodies where bodies touch; −1: any
};

enum class Statistic {
  mean,     ///< integral by measure (volume, area, length; axisymmetric: of the revolution)
  minimum,  ///< over nodes, or cells
  maximum,
  integral  ///< the unit shown is the field's times m³ (bodies) or m² (surfaces)
};

/// Group: a body, a surface, or a set of nodes (which has plain means and no integral). A field of cells has
/// on a surface the values of the elements behind its faces, and on a set of nodes those around them.
struct GroupProbe : Sampled {
  std::string group;
  Statistic statistic = Statistic::mean;
};

/// Σ factor × probe, of other probes that measure the same: gap = 1 × u_mould − 1 × u_casting. Factors that
/// sum to zero make differences (of temperatures: no zero point).
struct LinearProbe {
  CsvColumn column;
  std::vector<std::pair<double, std::string>> terms;  ///< factor, name of a probe defined before
  SourceLocation where;
};

/// A column that history.csv has anyway, under another name, times a factor, in another unit: "pass" = the
/// cycle, the force on 10 mm of a sheet = 0.01 x the force per metre. Without a unit the number as it is.
struct GlobalProbe {
  CsvColumn column;
  std::string global;  ///< name of the column, without its unit
  double factor = 1;
  SourceLocation where;
};

using Probe = std::variant<PointProbe, GroupProbe, LinearProbe, GlobalProbe>;

class Probes {
 public:
  /// Finds elements, nodes and weights once. Collective. Throws InputError (on every process) for a point in
  /// no element, an unknown group, field or probe, a unit of another dimension.
  /// @param fields, globals  what there will be; only names, units and shapes are used
  Probes(const mesh::Mesh& mesh, AnalysisKind kind, const std::vector<Probe>& probes, const FieldSet& fields,
         const std::vector<Reading>& globals = {});

  const std::vector<CsvColumn>& columns() const { return columns_; }
  /// The values of the columns in their units, on every process. Collective.
  std::vector<double> values(const FieldSet& fields, const std::vector<Reading>& globals = {}) const;
  std::size_t bytes() const;

 private:
  enum class Reduce { sum, minimum, maximum, linear, global };
  struct Sample {
    Reduce reduce = Reduce::sum;
    std::string field;  // of a global probe: the column's name
    int component = 0;
    int body = -1;  ///< of Mesh::bodies, whose values it takes at nodes that bodies share
    std::vector<std::pair<std::size_t, double>> weights;  // of nodes or cells this process counts
    double factor = 1;
    std::vector<std::pair<double, std::size_t>> terms;  // of a linear probe: factor and column
    std::string unit;                                   // SI
    units::Conversion shown;
  };
  Sample point_sample(const mesh::Mesh& mesh, const PointProbe& probe, const Field& field) const;
  Sample group_sample(const mesh::Mesh& mesh, AnalysisKind kind, const GroupProbe& probe,
                      const Field& field) const;
  Sample linear_sample(const LinearProbe& probe) const;
  /// Accumulators of a sample, in SI: sums and maxima. `peak` excludes bodies that have been removed.
  struct Totals {
    double &sum, &peak, &peak_of_all;
  };
  static void take(const Sample& sample, const Field& field, std::span<const double> values,
                   const linear::ActiveSet* active, Totals to);
  static Sample global_sample(const GlobalProbe& probe, const std::vector<Reading>& globals);

  std::vector<CsvColumn> columns_;
  std::vector<Sample> samples_;
};

}  // namespace solidus::results
