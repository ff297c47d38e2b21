/// Coherency, which tells melt from casting: the solid fraction over that at which metal is coherent
/// (material::Casting::coherency_fraction).
///
/// An element is as coherent as its mean, whose viscosity, pores and flow of melt follow (melt.hpp,
/// pores.hpp). A node is as coherent as the least of its elements: what it holds on to must carry before it
/// can leave its wall, rub, or count as casting. A node that is solid next to an element that is melt would
/// be pulled off its wall by what the melt weighs, by a length that follows the size of the step
/// (docs/theory/step_and_mesh.md). On a surface in contact the shell has a least thickness besides
/// (skin_depth.hpp).
///
/// The solid fraction of a moment is that of the nodes' enthalpy, which alone determines it where freezing is
/// isothermal; without a thermal phase it is that of the temperature.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "coupling/skin_depth.hpp"
#include "heat/loads/thermal_state.hpp"
#include "linear/active_set.hpp"
#include "material/material.hpp"
#include "mechanics/state/body_fields.hpp"
#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::heat {
class ThermalPhase;
}

namespace solidus::coupling {

class Coherency {
 public:
  /// @param materials  [body]; kept by reference
  /// @param active   of the mechanical phase at the start: bodies that only conduct heat do not count
  /// Collective.
  Coherency(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
            const linear::ActiveSet& active);

  /// From now on shells have a least thickness at these surfaces (skin_depth.hpp).
  /// @param length  of every body [m]; zero: none
  /// Collective.
  void set_shells(std::span<const std::string> surfaces, std::span<const double> length);
  /// Whether a body that deforms can melt. The same on every process.
  bool melts() const { return melts_; }
  /// Whether a node, local, is of such a body as far as the elements of this process tell: all of an owned
  /// node.
  bool melts(Index node) const { return material_[as_size(node)] != nullptr; }
  /// 1/f_c of every node, [local node], ghosts up to date; one where nothing melts. Where bodies share a node
  /// the least.
  const std::vector<double>& of_solid() const { return of_solid_; }
  /// The least f_S/f_c of the elements at every node, [local node], ghosts up to date; one where nothing
  /// melts. Empty unless melts(). Collective.
  /// @param solid_fraction  [local node][field of the body]
  std::vector<double> of(std::span<const double> solid_fraction, const mechanics::BodyFields& fields) const;
  /// That of a moment. Collective.
  /// @param heat         null: mechanics alone, at `temperature` [local node] [K]
  std::vector<double> at(const heat::ThermalPhase* heat, const heat::ThermalState& state,
                         const std::vector<double>& temperature) const;

 private:
  const mesh::Mesh& mesh_;
  const std::vector<material::Material>& materials_;
  std::vector<const mesh::ElementBlock*> blocks_;    ///< of bodies that deform and can melt
  std::vector<const material::Material*> material_;  ///< [local node]; null where nothing melts
  std::vector<double> of_solid_;
  std::optional<SkinDepth> depth_;
  bool melts_ = false;
};

}  // namespace solidus::coupling
