/// Interface of a mesh block for the simultaneous scheme besides BlockKernel: the derivatives of stress with
/// respect to temperature and of structural heat with respect to both fields.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "linear/coupled_matrix.hpp"
#include "mechanics/elements/block_kernel.hpp"

namespace solidus::mechanics {

/// Iterate at which the tangent is evaluated; fields are [local node][component].
struct CoupledIterate {
  std::optional<StructuralForm> form;   ///< of structural heat: energy or entropy; absent: there is none
  std::span<const double> old_u;        ///< from which the strain increment counts
  std::span<const double> u;            ///< displacement
  std::span<const double> temperature;  ///< Θ [K]
  double pressure_unit = 1;             ///< in which the pressures of mixed elements are counted [Pa/m]
};

class CoupledKernel {
 public:
  virtual ~CoupledKernel() = default;
  /// Looks up slots of the thermal matrix.
  virtual void bind_heat(const linear::BlockMatrix& matrix) = 0;
  /// Adds the derivatives of forces and volumes with respect to the temperature, and of structural heat with
  /// respect to all fields, consistent with the quadrature of StructuralHeat, at the iterate of the last
  /// prepare() and finish().
  virtual void add_coupling(const CoupledIterate& at, linear::CoupledMatrix& matrix) = 0;
  /// The second stage of a two-stage method begins: until drop_carried() structural heat counts from
  /// S* = S_n + factor (S − S_n), E* likewise.
  /// @param first        the deformation of the first stage, of which S and E are at `temperature`; null: of
  /// a
  ///                     body that takes no part
  virtual void carry(double factor, const StructuralPoints* first, std::span<const double> temperature) = 0;
  /// From now on it counts from S_n and E_n again.
  /// @return the deformation of the last finish(), over the whole step
  virtual std::shared_ptr<const StructuralPoints> drop_carried() = 0;
};

}  // namespace solidus::mechanics
