/// The unknowns of displacement, pressure and temperature at once (coupled_matrix.hpp with a saddle point):
/// those of the saddle point (saddle_unknowns.hpp), then the temperatures that are not prescribed.
#pragma once

#include <span>
#include <vector>

#include "linear/coupled_matrix.hpp"
#include "linear/saddle_unknowns.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "parallel/petsc_handles.hpp"

namespace solidus::linear {

/// Displacements, pressures and temperatures on owned nodes follow one another in what is called the
/// whole.
class CoupledUnknowns {
 public:
  /// @param matrix       with a saddle point and one temperature a node
  /// @param no_pressure  as of SaddleUnknowns
  /// Constraints and prescribed degrees of freedom are those of the matrices as they are now. Collective.
  CoupledUnknowns(const mesh::Mesh& mesh, CoupledMatrix& matrix, std::span<const char> no_pressure,
                  const parallel::GhostExchange& ghosts);

  /// Unknowns of this process, and of all processes.
  std::size_t size() const { return saddle_.size() + temperatures_of_process_.size(); }
  GlobalIndex n_global() const { return n_global_; }
  /// From unknowns to the whole, and from the whole to unknowns, as SaddleUnknowns. Collective with
  /// constraints.
  void expand(std::span<const double> unknowns, std::span<double> whole) const;
  void restrict_to(std::span<const double> whole, std::span<double> unknowns) const;

  /// The number over all processes, −1 where there is no unknown; of a local node.
  PetscInt of_displacement(Index node, int component) const {
    return number(saddle_.of_displacement(node, component));
  }
  PetscInt of_pressure(Index node, int field) const { return number(saddle_.of_pressure(node, field)); }
  PetscInt of_temperature(Index node) const { return temperatures_[as_size(node)]; }

 private:
  PetscInt number(PetscInt of_saddle) const;

  SaddleUnknowns saddle_;
  std::size_t n_saddle_ = 0;  ///< entries of the whole before the temperatures
  GlobalIndex n_global_ = 0;
  /// For each process, the number of its first unknown of the saddle point and how many temperatures the
  /// processes before it have.
  std::vector<std::int64_t> first_of_saddle_, temperatures_before_;
  std::vector<Index> temperatures_of_process_;  ///< owned nodes whose temperature is an unknown, rising
  std::vector<PetscInt> temperatures_;          ///< [local node]
};

/// The tangent of the unknowns in PETSc's format, for factorisations.
class CoupledCopy {
 public:
  /// Copies the values of now, rows of displacement and pressure times `force_scale`, those of temperature
  /// times `heat_scale`. Collective.
  Mat copy(const mesh::Mesh& mesh, CoupledMatrix& matrix, const CoupledUnknowns& unknowns, double force_scale,
           double heat_scale);
  /// The next copy has another pattern.
  void reset() { matrix_.reset(); }

 private:
  void create(const mesh::Mesh& mesh, CoupledMatrix& matrix, const CoupledUnknowns& unknowns);

  petsc::MatHandle matrix_;
  std::vector<double> values_;
};

}  // namespace solidus::linear
