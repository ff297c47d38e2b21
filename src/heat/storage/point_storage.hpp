/// The open rule's storage of heat: enthalpy differences at Gauss points (monograph 6.3, 4.149).
///
///   r_a += ∫ N_a (h(Θ) − h(Θ_n))/Δt dV,   K_ab += ∫ N_a N_b (dh/dΘ)/Δt dV
///
/// A point has a temperature and no enthalpy of its own: bodies whose material has an isothermal change keep
/// their heat at the nodes (consistent_heat.hpp). Where a range is narrow the row of a point whose
/// temperature crosses it is steep but smooth, and the line search of Newton's method on the convex
/// functional takes it.
#pragma once

#include <memory>
#include <span>

#include "heat/loads/thermal_state.hpp"
#include "heat/storage/sensible_form.hpp"
#include "linear/block_matrix.hpp"
#include "material/material.hpp"
#include "mesh/mesh.hpp"

namespace solidus::heat {

class PointStorage {
 public:
  virtual ~PointStorage() = default;
  virtual void bind(const linear::BlockMatrix& matrix) = 0;
  /// h(Θ_n) at the points; with a printed form Θ_n itself.
  virtual void start(std::span<const double> old_temperature, double dt) = 0;
  /// From then on heat is counted from h_n + factor (h(Θ) − h_n): the second stage of a two-stage method.
  virtual void extrapolate(std::span<const double> temperature, double factor) = 0;
  /// r += stored heat per time [W], [local node]; ghost rows are scrap.
  virtual void add_residual(std::span<const double> temperature, std::span<double> r) const = 0;
  virtual void add_tangent(std::span<const double> temperature, linear::BlockMatrix& matrix) const = 0;
  /// Change of the heat content over the step and of its latent part, counted elements [J].
  virtual double stored(std::span<const double> temperature) const = 0;
  virtual double latent(std::span<const double> old_temperature,
                        std::span<const double> temperature) const = 0;
  /// The heat content of the counted elements [J].
  virtual double enthalpy(std::span<const double> temperature) const = 0;
  /// Change of the entropy ∫ dH/Θ over the counted elements.
  virtual EntropyChange entropy_change(std::span<const double> from, std::span<const double> to) const = 0;
  virtual std::size_t bytes() const = 0;
};

/// @param material kept by reference, without isothermal changes
/// @param form     of the sensible heat
/// @param degree   polynomial degree that the rule integrates; 0: 3 for linear shapes, 4 for quadratic
/// simplices, 5 for others
std::unique_ptr<PointStorage> make_point_storage(const mesh::Mesh& mesh, const mesh::ElementBlock& block,
                                                 AnalysisKind kind, const material::Material& material,
                                                 SensibleForm form, int degree);

}  // namespace solidus::heat
