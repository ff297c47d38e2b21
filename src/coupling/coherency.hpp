/// Coherency of the nodes, which tells melt from casting: the solid fraction over that at which metal is
/// coherent (material::Casting::coherency_fraction).
///
/// The solid fraction is that of the nodes' enthalpy, which alone determines it where freezing is isothermal;
/// without a thermal phase it is that of the temperature.
#pragma once

#include <vector>

#include "heat/thermal_state.hpp"
#include "linear/active_set.hpp"
#include "material/material.hpp"
#include "mesh/mesh.hpp"

namespace solidus::heat {
class ThermalPhase;
}

namespace solidus::coupling {

class Coherency {
 public:
  /// @param materials  [body]; kept by reference
  /// Collective.
  /// @param active   of the mechanical phase at the start: bodies that only conduct heat do not count
  Coherency(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
            const linear::ActiveSet& active);

  /// Whether a body that deforms can melt. The same on every process.
  bool melts() const { return melts_; }
  /// 1/f_c of every node, [local node], ghosts up to date; one where nothing melts.
  const std::vector<double>& of_solid() const { return of_solid_; }
  /// f_S/f_c of every node, [local node], ghosts up to date; one where nothing melts. A node that bodies
  /// share goes with the first one that can melt. Empty unless melts(). Collective.
  /// @param heat         null: mechanics alone, at `temperature` [local node] [K]
  std::vector<double> at(const heat::ThermalPhase* heat, const heat::ThermalState& state,
                         const std::vector<double>& temperature) const;

 private:
  const mesh::Mesh& mesh_;
  std::vector<const material::Material*> material_;  ///< [owned node]; null where nothing melts
  std::vector<double> of_solid_;
  bool melts_ = false;
};

}  // namespace solidus::coupling
