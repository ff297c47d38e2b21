/// The mechanics of one mesh block behind an interface: one virtual call per block, none per element.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "linear/block_matrix.hpp"
#include "material/material.hpp"
#include "material/melt.hpp"
#include "material/time_integration.hpp"
#include "mechanics/elements/simplices.hpp"
#include "mechanics/state/pass.hpp"
#include "mechanics/state/phase_fields.hpp"
#include "mechanics/state/structural_change.hpp"

namespace solidus::mechanics {

class StructuralPoints;

/// The state at the start of a step that a phase passes to its blocks before a solve. Kernels keep references
/// to temperature, old_displacement and the histories and stresses until the next one.
struct StepStart {
  std::span<const double> temperature;          ///< Θ_n [K], [local node]
  std::span<const double> pass_temperature;     ///< at which the law works: Θ_n or that of an iterate [K]
  std::span<const double> initial_temperature;  ///< Θ_0 [K], [local node]
  std::span<const double> old_displacement;     ///< at t_n [m], [local node][component]
  std::span<const double> held_displacement;    ///< whose entropy is held: at t_n or of an iterate [m]
  const BlockHistory* held_history;             ///< the same
  const BlockHistory* old_history;              ///< at t_n
  const BlockHistory* start_history;            ///< z*, from which the effective step sets out
  double dt;                                    ///< t_{n+1} − t_n [s]
  material::TimeStep effective;                 ///< of the law
  /// Stress at the points at t_n, of a step whose work is that of a mean stress (motion.hpp). Null: the work
  /// is that of σ_{n+1}.
  const BlockHistory* old_stress = nullptr;
  double stress_share = 1;  ///< of t_{n+1} in the mean
  /// The stress whose work the step does; null: that at its end, or the mean.
  const StressAtWork* at_work = nullptr;
  PhaseFields phases{};  ///< of the block's body at t_n
  /// The melt whose viscosity the program chooses; null, or a modulus of zero: the material has its
  /// viscosity.
  const material::MeltModulus* melt = nullptr;
  /// MechanicalPass::lead of the block, [batch][point]; null: none.
  const PackVector<StructuralDensities>* lead = nullptr;
  bool expands = false;  ///< held_deformation() stores what free expansion would take up

  double melt_modulus() const { return melt != nullptr ? melt->modulus : 0.0; }
  /// η of such a melt or mush in the step [Pa s].
  Lane melt_viscosity(const Lane& solid_fraction) const {
    return melt->mush.at(solid_fraction, Lane(melt->viscosity(effective.dt)));
  }
  /// The stiffness of such melt or mush against compaction (compaction.hpp): ζ/Δt, the bulk modulus where it
  /// completes its freezing at one temperature, zero in solid metal [Pa].
  /// @param solid_fraction, contracting  the mean of the step and that over its temperatures
  Lane compaction_stiffness(const Lane& solid_fraction, const Lane& contracting) const {
    const LaneMask solid = solid_fraction >= Lane(1.0);
    const Lane viscous = melt_viscosity(select(solid, Lane(0.0), solid_fraction)) / Lane(effective.dt);
    return select(solid, Lane(0.0), select(contracting >= Lane(1.0), Lane(melt->bulk), viscous));
  }
};

/// The results that finish() writes, of the block's size.
struct BlockEnd {
  BlockHistory& history;
  BlockHistory* stress = nullptr;   ///< at the points at t_{n+1}; null: not asked for
  StressAtWork* at_work = nullptr;  ///< of this step, for a later one; null: not asked for
  /// Values of the elements for results; null: not asked for. Storage that no other state has serves again.
  SharedElementValues* elements = nullptr;
  /// The deformation at the points for the heat balance; null: not asked for.
  std::shared_ptr<const StructuralPoints>* deformation = nullptr;
};

/// Sums over the counted elements of a block.
struct BlockWork {
  double internal_work = 0, dissipation = 0, plastic_dissipation = 0, plastic_work = 0;  ///< [J]
  /// Work of the pressure on the volume that mixed elements leave to their sub-scales [J].
  double stabilisation_work = 0;
  double least_dissipation = 0, largest_dissipation = 0;  ///< [W/m³]
  double inelastic_entropy = 0;                           ///< change of S^I [J/K]

  BlockWork& operator+=(const BlockWork& other) {
    internal_work += other.internal_work;
    stabilisation_work += other.stabilisation_work;
    dissipation += other.dissipation;
    plastic_dissipation += other.plastic_dissipation;
    plastic_work += other.plastic_work;
    inelastic_entropy += other.inelastic_entropy;
    least_dissipation = std::min(least_dissipation, other.least_dissipation);
    largest_dissipation = std::max(largest_dissipation, other.largest_dissipation);
    return *this;
  }
};

/// [m³], in two dimensions per depth or radian.
struct FlowingVolume {
  double flowing = 0, all = 0;
};

/// A point whose law finds no state.
struct LawFailure {
  std::string text;        ///< element and inputs, for a message; empty: there is no such point
  double temperature = 0;  ///< at which the law works there [K]
};

/// The change by a return mapping in the thermal phase against the flow of the mechanical phase.
struct FlowChange {
  BlockWork work;      ///< differences; least and largest dissipation of the new flow
  bool flows = false;  ///< some point of solid metal flows otherwise
  bool found = true;   ///< the law has found a state everywhere
};

class BlockKernel {
 public:
  virtual ~BlockKernel() = default;

  /// Whether the tangent is symmetric at every state.
  virtual bool symmetric() const = 0;
  /// Looks up matrix slots.
  virtual void bind(const linear::BlockMatrix& matrix) = 0;
  virtual BlockHistory initial_history() const = 0;
  /// From now on the points carry this stress where the displacement is zero and the temperatures and phases
  /// are those of `start`: they have the strain C⁻¹ σ_0 besides that of the displacement.
  /// @param stress  xx, yy, zz, xy, yz, xz of each element, [element][6] [Pa]
  /// Returns whether the law can: a law from outside finds its stress by its own rules.
  virtual bool set_initial_stress(const StepStart& start, std::span<const double> stress) = 0;
  /// Properties at the quadrature points for the temperature of this step, and the entropy that an isentropic
  /// law holds. Returns the square of the nodal
  /// forces that a strain of 1 would cause, counted elements only: the scale of round-off.
  virtual double prepare(const StepStart& start) = 0;
  /// forces += ∫ B̄ᵀ σ dV at u ([local node][component]); returns the sum of squares of the element's nodal
  /// forces before they cancel, counted elements only. Where the law finds no state the forces are not
  /// numbers.
  virtual double add_forces(std::span<const double> u, std::span<double> forces) = 0;
  /// matrix += ∫ B̄ᵀ C B̄ dV at u.
  virtual void add_tangent(std::span<const double> u, linear::BlockMatrix& matrix) = 0;
  /// Writes the new history and what else `end` asks for.
  virtual BlockWork finish(std::span<const double> old_u, std::span<const double> u, const BlockEnd& end) = 0;
  /// Finds the flow of solid metal again at `pass_temperature`, the strains being those at `u` and the flow
  /// that of t_n (4.45, 4.49, 4.54). Melt and mush keep the flow of the mechanical phase, and the stress
  /// power stays. Follows prepare() with the arguments of that phase.
  /// @param start  temperatures, phases and melt
  /// @param end    history and deformation as the mechanical phase has left them, which are brought up to
  /// date,
  ///               and values for results
  virtual FlowChange restart_flow(const StepStart& start, std::span<const double> old_u,
                                  std::span<const double> u, const BlockEnd& end) = 0;
  /// The deformation of a body that stays at the held displacement and history.
  virtual std::shared_ptr<const StructuralPoints> held_deformation(const StepStart& start) = 0;
  /// The first point whose law finds no state at u.
  virtual LawFailure failure(std::span<const double> u) const = 0;
  /// Volume of the block that flows plastically at u; counted elements only.
  virtual FlowingVolume flowing(std::span<const double> u) const = 0;
  /// out_i += weight × ∫ N_i dV, [local node].
  virtual void add_nodal_volume(double weight, std::span<double> out) const = 0;

  /// StructuralPoints::spread_as_stored.
  virtual void spread_heat_as_stored(const PackVector<Lane>& weights) = 0;
  virtual std::size_t bytes() const = 0;
};

/// @param b_bar  for quads and hexes (kinematics.hpp); simplices have the standard operator
std::unique_ptr<BlockKernel> make_block_kernel(const mesh::Mesh& mesh, const mesh::ElementBlock& block,
                                               AnalysisKind kind, const material::Material& material,
                                               Mapping mapping, bool b_bar);

}  // namespace solidus::mechanics
