/// The surfaces of a heat system through which heat enters: fluxes, films and radiation, one object each.
#pragma once

#include <span>
#include <vector>

#include "heat/loads/named_group.hpp"
#include "heat/loads/surface_heat.hpp"
#include "heat/loads/thermal_conditions.hpp"
#include "linear/active_set.hpp"
#include "linear/block_matrix.hpp"
#include "mesh/mesh.hpp"

namespace solidus::heat {

class SurfaceHeats {
 public:
  /// Surfaces are restricted to faces of active bodies. Throws InputError for a condition that names no
  /// surface of the mesh.
  SurfaceHeats(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active, bool closed,
               const ThermalConditions& conditions);

  std::span<SurfaceHeat> each() { return surfaces_; }
  std::span<const SurfaceHeat> each() const { return surfaces_; }
  void bind(const linear::BlockMatrix& matrix);
  /// Adds the heat that leaves the nodes, [local node] [W], and its magnitudes on this process to `moved`;
  /// ghost rows are scrap. powers() are those of this call.
  void add_residual(std::span<const double> temperature, std::span<double> out, double& moved);
  void add_tangent(std::span<const double> temperature, linear::BlockMatrix& matrix) const;
  /// Adds the heat that leaves the nodes of one surface as add_residual() does, without telling its power,
  /// which is the result [W].
  double add_residual_of(std::size_t surface, std::span<const double> temperature,
                         std::span<double> out) const;
  /// The power of a surface on this process has become larger by so much since add_residual() [W].
  void add_power(std::size_t surface, double power) { powers_[surface] += power; }
  /// The powers are zero until the next add_residual().
  void clear_powers();
  /// Collective.
  std::vector<NamedPower> powers() const;

 private:
  std::vector<SurfaceHeat> surfaces_;
  std::vector<double> powers_;  ///< of this process
};

/// Whether a condition varies with position.
bool placed(const SurfaceHeats& surfaces);
/// Whether the tangents add to the diagonal alone; on this process.
bool diagonal(const SurfaceHeats& surfaces);
/// The longest time after which a load that moves still overlaps with itself; infinite where none moves.
/// Collective.
double lasting(const SurfaceHeats& surfaces, double from, double to);

}  // namespace solidus::heat
