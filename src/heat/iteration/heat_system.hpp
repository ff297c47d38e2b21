/// Everything of the thermal balance but storage: conduction, surfaces, sources, contributions from outside.
///
///   r_i = ∫ ∇N_i · ∇u dV − ∫ N_i q dA − ∫ N_i R dV + contributions        [W], heat that leaves node i
///
/// (monograph 2.150 without the capacity terms), k ∇Θ = ∇u by Kirchhoff's transform (conduction_block.hpp).
/// The system puts its parts together, in one residual and one matrix; what concerns one part alone is asked
/// of that part.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "heat/iteration/heat_limits.hpp"
#include "heat/iteration/heat_parts.hpp"
#include "heat/loads/thermal_conditions.hpp"
#include "linear/block_matrix.hpp"
#include "material/material.hpp"
#include "mesh/mesh.hpp"

namespace solidus::heat {

class HeatSystem {
 public:
  /// @param storage        of the matrix: half of it where no tangent that is added is unsymmetric
  /// @param correct_edges  whether conduction next to re-entrant edges is corrected (edge_conduction.hpp)
  /// Throws InputError for a condition that names no group of the mesh, std::invalid_argument for absent
  /// bodies: they leave later.
  HeatSystem(const mesh::Mesh& mesh, AnalysisKind kind, const std::vector<material::Material>& materials,
             const ThermalConditions& conditions, bool closed,
             std::vector<linear::Contribution*> contributions,
             linear::BlockMatrix::Storage storage = linear::BlockMatrix::Storage::whole,
             bool correct_edges = false);

  /// Replaces the conditions from here on. If bodies leave or come back, the matrix gets another pattern;
  /// returns whether it did. Throws InputError as the constructor does. Collective.
  bool set_conditions(const ThermalConditions& conditions);
  /// Loads are their means over the window from here on, temperatures that are prescribed those at its time.
  /// Collective where a condition varies with position. Throws InputError, on every process, where it has no
  /// value that is allowed.
  void set_window(const LoadWindow& window);
  /// The parts, to ask what concerns one of them alone.
  HeatParts& parts() { return parts_; }
  /// Limits of conduction, and the temperatures around the bodies.
  HeatLimits& limits() { return limits_; }

  /// r on owned nodes [W]. Returns this process's share of the heat moved by surfaces, sources and
  /// contributions, magnitudes before they cancel.
  double residual(std::span<const double> temperature, std::span<double> r);
  /// Fills the matrix with ∂r/∂Θ, which is unsymmetric where a conductivity varies.
  void assemble(std::span<const double> temperature);
  /// Fills the matrix with ∂r/∂v in the unknown of nodal_potential.hpp. It is symmetric if the contributions
  /// are, and exact but for two parts, which HeatParts::unsymmetric holds:
  ///   conduction   at nodes that materials of different k(Θ)/κ share. With g = (k_m/κ_m)/c, which is one at
  ///                all other nodes, κ_m K_ij √(g_i g_j) stands for κ_m K_ij g_j, the diagonal being exact;
  ///   contributions and surfaces   between nodes of different c = dv/dΘ. With S = ∂r/∂Θ of those,
  ///                c^-1/2 S c^-1/2 replaces S c^-1.
  /// @param slopes   c, [local node], ghosts up to date
  /// @param further  adds to S; may be empty
  /// @param shared   exact is for iterations that make use of HeatParts::unsymmetric. Without it Newton's
  ///                 method for the open rule did not converge in long steps where materials share nodes;
  ///                 plain takes g = 1 there.
  void assemble_symmetric(std::span<const double> temperature, std::span<const double> slopes,
                          const std::function<void(linear::BlockMatrix&)>& further = {},
                          SharedNodes shared = SharedNodes::exact);
  linear::BlockMatrix& matrix() { return *matrix_; }
  /// Gives the matrix another pattern if a contribution asks for it; returns whether it did. Collective.
  bool follow_graph();

 private:
  linear::NodeGraph graph() const;
  void bind();
  void scale_by_slopes(std::span<const double> slopes);

  const mesh::Mesh& mesh_;
  AnalysisKind kind_;
  bool closed_;
  std::vector<char> at_nodes_;  ///< [body]: whether it stores its heat there
  HeatParts parts_;
  HeatLimits limits_;
  std::unique_ptr<linear::BlockMatrix> matrix_;
};

}  // namespace solidus::heat
