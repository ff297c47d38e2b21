/// Data of the deformation that the thermal phase needs, stored at the quadrature points of a block (see
/// structural_heat.hpp).
#pragma once

#include <span>

#include "material/elasticity.hpp"
#include "mechanics/structural_heat.hpp"
#include "mesh/block_geometry.hpp"

namespace solidus::mechanics {

/// Variables of the structural energy of a point besides its temperature.
struct Deformation {
  Lane strain_trace;     ///< tr ε
  Lane elastic_squared;  ///< dev ε^E : dev ε^E, zero unless solid
  Lane hardening;        ///< ξ
  Lane back_squared;     ///< ζ : ζ
};

/// Densities of entropy and energy of deformation and hardening.
struct StructuralDensities {
  Lane entropy;  ///< S [J/(m³ K)]
  Lane energy;   ///< E [J/m³]
};

class StructuralPoints {
 public:
  struct Point {
    Lane temperature;       ///< Θ_n [K]
    Lane pass_temperature;  ///< at the end of the mechanical phase: the one it holds, or Θ̄ [K]
    Lane strain_offset;  ///< e^θ minus 3 α (Θ − Θ_ref): initial strain and straining of phase changes, held
                         ///< (4.81)
    Deformation now;     ///< at t_{n+1}
    Deformation change;  ///< now : Δ, of every part (tr: Δ tr ε, ξ: Δξ)
    Lane old_entropy;    ///< S of the deformation at t_n and Θ_n [J/(m³ K)]
    Lane old_energy;     ///< E of the deformation at t_n and Θ_n [J/m³]
    Lane dissipated;     ///< D_mech Δt [J/m³]
    Lane work;           ///< σ_{n+1} : Δε [J/m³]
  };

  /// Keeps a reference to the geometry.
  StructuralPoints(const mesh::BlockGeometry& geometry, const material::Material& material);

  /// Until this is called nothing is stored, and only the functions that say so may be called: nothing is
  /// needed without structural heat.
  void keep() { points_.resize(n_points_); }
  bool kept() const { return !points_.empty(); }
  Point& at(Index batch, int point) { return points_[index(batch, point)]; }
  const Point& at(Index batch, int point) const { return points_[index(batch, point)]; }
  /// A step of one stage begins, kept or not.
  void set_dt(double dt) {
    stage_ = {dt};
    carried_.clear();
  }
  /// StructuralHeat::begin_stage.
  void begin_stage(const algebra::Stage& stage, std::span<const double> temperature);
  /// Heat of the points is spread over the nodes by the basis functions; its mean over an element by these
  /// weights, with which the thermal phase stores heat: [batch][node] [m³]. So uniform heating warms every
  /// node of an element alike whatever the shape and rule.
  void spread_as_stored(const PackVector<Lane>& weights);
  /// Fills temperature, pass_temperature and strain_offset, if kept.
  /// @param temperature     Θ_n
  /// @param thermal_strain  e^θ of the mechanical phase, which works at `pass_temperature`
  void set_temperature(Index batch, int point, Lane temperature, Lane pass_temperature, Lane thermal_strain);
  /// Fills the old entropy and energy from the deformation at t_n.
  void set_old(Index batch, int point, const Deformation& old);
  /// Fills all but the temperatures of a point whose deformation is held, if kept.
  void hold_deformation(Index batch, int point, const Deformation& deformation);

  /// At a temperature and the deformation at t_{n+1}.
  StructuralDensities densities(Index batch, int point, Lane temperature) const;
  /// Correction of the basis functions by spread_as_stored, [node]; null: none.
  const Lane* spread(Index batch) const {
    return correction_.empty() ? nullptr
                               : correction_.data() + static_cast<std::ptrdiff_t>(batch) * geometry_.n_nodes;
  }

  /// BlockKernel::add_structural_heat.
  void add_heat(StructuralForm form, std::span<const double> temperature, bool tangent,
                std::span<double> out) const;
  /// Over the step, with the nodal temperature at its end; sums over the counted elements.
  StructuralChange change(std::span<const double> temperature) const;
  /// Up to the end of the mechanical phase, where points have temperatures of their own: the sensible heat
  /// between Θ_n and Θ̄ is in it, while that of the nodes stays.
  StructuralChange mechanical_change() const;
  std::size_t bytes() const {
    return points_.capacity() * sizeof(Point) + carried_.capacity() * sizeof(Start);
  }

 private:
  std::size_t index(Index batch, int point) const {
    return static_cast<std::size_t>(batch) * static_cast<std::size_t>(geometry_.n_points) +
           static_cast<std::size_t>(point);
  }
  /// Entropy, internal energy and Θ ∂S/∂Θ of deformation and hardening, along the lines of Θ_n.
  struct State {
    Lane entropy, internal_energy, capacity;
  };
  State state(const Point& at, const Deformation& deformation, Lane temperature) const;
  /// A quantity and its derivative with respect to temperature.
  struct Sloped {
    Lane value, slope;
  };
  Sloped structural_heating(const Point& at, Lane temperature) const;
  Sloped heat(StructuralForm form, std::size_t point, Lane temperature) const;

  const mesh::BlockGeometry& geometry_;
  material::Material material_;  ///< without phase changes: their fraction and straining are held
  std::size_t n_points_;         ///< of all batches
  PackVector<Point> points_;
  PackVector<Lane> correction_;  ///< share of a node less that of the points, [batch][node]; empty: none
  algebra::Stage stage_;
  struct Start {
    Lane entropy, energy;
  };
  PackVector<Start> carried_;  ///< S*, E* of the second stage, [batch][point]; empty: S and E at t_n
};

/// The temperature at a point of a batch from nodal values. Where all nodes of an element have one value it
/// is that value to the last bit.
Lane temperature_at(const mesh::BlockGeometry& geometry, Index batch, int point,
                    std::span<const double> nodal);
/// The same of a quantity that must not leave the range of its nodes: basis functions of quadratic shapes
/// are negative in places.
Lane within_nodes(const mesh::BlockGeometry& geometry, Index batch, int point, std::span<const double> nodal);

}  // namespace solidus::mechanics
