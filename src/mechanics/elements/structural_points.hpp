/// The deformation of a step at the quadrature points of a block, as far as the heat balance needs it (see
/// structural_heat.hpp). A mechanical pass returns it (StepDeformation, pass.hpp).
#pragma once

#include <span>

#include "linear/contribution.hpp"
#include "linear/lane_slots.hpp"
#include "material/derivatives/structural_lines.hpp"
#include "mechanics/elements/point_temperature.hpp"
#include "mechanics/state/structural_change.hpp"
#include "mechanics/state/structural_lead.hpp"
#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

/// Variables of the structural energy of a point besides its temperature.
struct Deformation {
  Lane strain_trace;     ///< tr ε
  Lane elastic_squared;  ///< dev ε^E : dev ε^E, zero unless solid
  Lane hardening;        ///< ξ
  Lane back_squared;     ///< ζ : ζ
  Lane cold_work{0.0};   ///< energy of plastic work that is stored in addition to that of hardening [J/m³]
};

/// The data with which energy and entropy of a point are evaluated, besides its deformation and temperature:
/// the tables' lines (material/derivatives/structural_lines.hpp) and the phases, those of the last mechanical
/// phase. A part of the state: the energy of a state is a function of the state alone.
struct StructuralBase {
  Lane line_temperature;  ///< Θ of the lines [K]
  Lane strain_offset;     ///< e^θ less 3 α (Θ − Θ_ref)
  Lane solid;             ///< one where the point was solid, else zero
};

/// The largest share of the capacity at fixed strain that free expansion is expected to take up besides. Up
/// to one the functional of stability falls whatever the deformation is (docs/theory/coupling_stability.md,
/// 3); the rest is the room for steps that are not small.
inline constexpr double k_most_expansion = 0.5;

class StructuralPoints {
 public:
  /// The start of a stage of the thermal phase: S*, E* of the second one, [batch][point]; empty: S and E at
  /// t_n.
  struct Start {
    Lane entropy, energy;
  };
  struct Stage {
    linear::RungeKuttaStage stage;
    PackVector<Start> carried;
  };

  struct Point {
    /// The tables' lines at Θ_n, or at the temperature of StructuralBase where the deformation is held.
    material::ElasticLines<Lane> lines;
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
    Lane transformed;    ///< magnitude of the energy that the new base has brought at fixed S and ε [J/m³]
  };

  /// Keeps a reference to the geometry, which is the kernel's.
  StructuralPoints(const mesh::BlockGeometry& geometry, const material::Material& material);

  /// Until this is called nothing is stored, and only the functions that say so may be called: nothing is
  /// needed without structural heat.
  void keep() { points_.resize(n_points_); }
  bool kept() const { return !points_.empty(); }
  /// Whether the energy goes on as it is where lines and phases change. With the specific heat at constant
  /// strain the latent heat is that at fixed strain: the energy is evaluated again (docs/theory/coupling.md).
  bool carries_energy() const {
    return material_.specific_heat_at == material::SpecificHeatAt::constant_pressure;
  }
  Point& at(Index batch, int point) { return points_[index(batch, point)]; }
  const Point& at(Index batch, int point) const { return points_[index(batch, point)]; }
  /// Begins a step of length dt [s]; the deformations of the one before need not have been kept.
  void set_dt(double dt) {
    dt_ = dt;
    of_mechanics_.clear();
    expansion_.clear();
    ahead_.clear();
  }
  /// The time step of the mechanical pass [s].
  double dt() const { return dt_; }
  /// Stores the deformation with the flow of the mechanical phase, before another one is put into Point::now.
  void keep_of_mechanics(Index batch, int point, const Deformation& deformation) {
    of_mechanics_.resize(n_points_);
    of_mechanics_[index(batch, point)] = deformation;
  }
  /// The start of a stage whose predecessor has ended at `temperature` (StructuralHeat::begin_stage).
  Stage stage(const linear::RungeKuttaStage& stage, std::span<const double> temperature) const;
  /// Heat of the points is spread over the nodes by the basis functions; its mean over an element by these
  /// weights, with which the thermal phase stores heat: [batch][node] [m³]. So uniform heating warms every
  /// node of an element alike whatever the shape and rule.
  void spread_as_stored(const PackVector<Lane>& weights);
  /// Fills temperature, pass_temperature and strain_offset, if kept.
  /// @param temperature     Θ_n
  /// @param thermal_strain  e^θ of the mechanical phase, which works at `pass_temperature`
  void set_temperature(Index batch, int point, Lane temperature, Lane pass_temperature, Lane thermal_strain);
  /// Fills the old entropy and energy: those of the state at t_n, which has its own base.
  void set_old(Index batch, int point, const Deformation& old, const StructuralBase& base);
  /// Fills all of a point whose deformation is held, with the base of its state, if kept.
  void hold_deformation(Index batch, int point, const Deformation& deformation, const StructuralBase& base);
  /// From here on a held deformation stores besides what it would take up if it expanded at constant mean
  /// stress,
  ///
  ///   P (Θ − Θ_n) [J/m³]  and  P ln(Θ/Θ_n) [J/(m³ K)],   P = C_p − C_v = Θ (∂p/∂Θ)²/k,
  ///
  /// p the mean stress at fixed strain and P of Θ_n, at most k_most_expansion of the capacity at fixed
  /// strain.
  void expect_expansion();
  /// What that comes to at a nodal temperature, [batch][point]; empty where it is not expected.
  PackVector<StructuralDensities> expected(std::span<const double> temperature) const;
  /// The step of this pass begins with that much energy and entropy besides those of its deformation and
  /// temperature: what conduction before it has moved ahead of the deformation.
  void begin_with(Index batch, int point, const StructuralDensities& ahead);
  /// S with the base `old` less S with that of the step, at the temperature of the pass [J/(m³ K)].
  Lane entropy_ahead(Index batch, int point, const Deformation& deformation, const StructuralBase& old) const;
  /// The base of the step; of a point that has been solved for.
  StructuralBase base(Index batch, int point, const LaneMask& solid) const;
  /// The base of a body at Θ_0, which has not been deformed yet.
  StructuralBase initial_base(Lane initial_temperature) const;

  /// At a temperature and the deformation at t_{n+1}.
  StructuralDensities densities(Index batch, int point, Lane temperature) const;
  /// Correction of the basis functions by spread_as_stored, [node]; null: none.
  const Lane* spread(Index batch) const {
    return correction_.empty() ? nullptr
                               : correction_.data() + static_cast<std::ptrdiff_t>(batch) * geometry_.n_nodes;
  }

  /// out += the residual of StructuralHeat in a stage, or (tangent) its lumped diagonal; [local node].
  void add_heat(StructuralForm form, const Stage& stage, std::span<const double> temperature, bool tangent,
                std::span<double> out) const;
  /// matrix += the derivative of that residual, ∫N_a N_b of the points' own, without the correction of
  /// spread_as_stored.
  /// @param slots  those of slots(), for this matrix
  void add_heat_tangent(StructuralForm form, const Stage& stage, std::span<const double> temperature,
                        const linear::LaneSlots& slots, linear::BlockMatrix& matrix) const;
  linear::LaneSlots slots(const linear::BlockMatrix& matrix) const {
    return {matrix, geometry_.nodes, geometry_.n_nodes, geometry_.n_elements};
  }
  /// Over the step, with the nodal temperature at its end; sums over the counted elements.
  StructuralChange change(std::span<const double> temperature) const;
  /// Up to the end of the mechanical phase, where points have temperatures of their own: the sensible heat
  /// between Θ_n and Θ̄ is in it, while that of the nodes stays.
  StructuralChange mechanical_change() const;
  /// The work of the mechanical pass beyond that of the stresses on its way (excess_work,
  /// structural_heat.hpp); sum over the counted elements [J].
  double excess_work() const;
  /// The structural energy of the deformation at the nodal temperature, over the counted elements [J].
  double energy(std::span<const double> temperature) const;
  std::size_t bytes() const {
    return points_.capacity() * sizeof(Point) + of_mechanics_.capacity() * sizeof(Deformation) +
           expansion_.capacity() * sizeof(Lane) + ahead_.capacity() * sizeof(StructuralDensities);
  }

 private:
  std::size_t index(Index batch, int point) const {
    return as_size(batch) * as_size(geometry_.n_points) + as_size(point);
  }
  /// Entropy, internal energy and Θ ∂S/∂Θ of deformation and hardening, along the lines of Θ_n.
  struct State {
    Lane entropy, internal_energy, capacity;
  };
  State state(const Point& at, const Deformation& deformation, Lane temperature) const;
  State state(const StructuralBase& base, const Deformation& deformation, Lane temperature) const;
  State state(const material::ElasticLines<Lane>& lines, Lane strain_offset, const Deformation& deformation,
              Lane temperature) const;
  /// The same of Point::now, with what expansion is expected to take up.
  State state_now(std::size_t point, Lane temperature) const;
  StructuralDensities expected(std::size_t point, Lane temperature) const;
  /// The deformation at the end of the mechanical phase.
  const Deformation& of_mechanics(std::size_t i) const {
    return of_mechanics_.empty() ? points_[i].now : of_mechanics_[i];
  }
  /// A quantity and its derivative with respect to temperature.
  struct Sloped {
    Lane value, slope;
  };
  Sloped structural_heating(const Point& at, Lane temperature) const;
  Sloped heat(StructuralForm form, const Stage& stage, std::size_t point, Lane temperature) const;

  const mesh::BlockGeometry& geometry_;
  material::Material material_;  ///< without phase changes: their fraction and straining are held
  std::size_t n_points_;         ///< of all batches
  PackVector<Point> points_;
  /// Point::now of the mechanical phase, where the thermal phase maps the flow again; else empty.
  PackVector<Deformation> of_mechanics_;
  PackVector<Lane> expansion_;             ///< P of expect_expansion(); empty: none is expected
  PackVector<StructuralDensities> ahead_;  ///< of begin_with(); empty: none
  PackVector<Lane> correction_;  ///< share of a node less that of the points, [batch][node]; empty: none
  double dt_ = 0;
};

}  // namespace solidus::mechanics
