/// The nodal pressure of mixed elements (mixed_kernel.hpp) as a function of the displacement: it is
/// eliminated, so that the mechanical phase stays an equation in the displacement alone.
///
///   r_p(u, p) = 0   by   (C + S) δp = r_p,   C = ∫ N 1/κ N dV at the start of the step
///
/// one solve for a law whose volume is linear in p, a few for others. Conjugate gradients, preconditioned
/// with C and the part of S that couples neighbours. The tangent of what is left, A + B (C + S)⁻¹ Bᵀ, is the
/// Schur complement of a saddle point that MixedSolver solves.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "algebra/corrected_matrix.hpp"
#include "algebra/coupled_matrix.hpp"
#include "algebra/krylov_solver.hpp"
#include "algebra/parallel.hpp"
#include "mechanics/mixed_kernel.hpp"

namespace solidus::mechanics {

/// The number of nodal fields and that of each body: bodies of different materials that share nodes have
/// different ones. Collective.
struct PressureFields {
  int n_fields = 1;
  std::vector<int> of_body;
};
PressureFields pressure_fields(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
                               std::span<const char> mixed_block);

class PressureEquation {
 public:
  /// @param blocks      kernels of the phase; those that are no MixedKernel have no pressure
  /// @param materials   one per body of the mesh
  /// @param body_force  ρ g_0 of each body [N/m³]; empty with orthogonal sub-scales
  /// @param direct      factorise, else multigrid
  /// Collective.
  PressureEquation(const mesh::Mesh& mesh, int components, const std::vector<material::Material>& materials,
                   std::span<const std::unique_ptr<BlockKernel>> blocks,
                   std::vector<std::array<double, 3>> body_force, bool direct);
  ~PressureEquation();

  int fields() const { return fields_of_body_.n_fields; }
  /// Nodes at which no element has a pressure are fixed, [local node][field].
  const std::vector<char>& fixed() const { return fixed_; }
  const std::vector<MixedKernel*>& kernels() const { return kernels_; }

  /// A step begins: after the blocks' prepare().
  /// @param start  pressure to begin with, [local node][field] [Pa]; empty: zero
  void begin(std::span<const double> start);
  /// Finds the pressure at u ([local node][component]); false where a law finds no state. Collective.
  bool solve(std::span<const double> u);
  /// The first guess of the next solves is that of the last one plus a share of `pressure`, the share being
  /// that of `displacement` by which u has gone on; both on owned nodes, pressure in units.
  void expect(std::span<const double> displacement, std::span<const double> pressure);

  /// Of the last solve(), [local node][field] [Pa].
  const std::vector<double>& pressure() const { return pressure_; }
  /// In which the linear systems count pressures [Pa]: 2Ĝ over the length of an element, so that rows of both
  /// fields are of one size.
  double unit() const { return unit_; }
  /// y += factor × unit² × the part of S that couples neighbours of neighbours, taken as positive: S is its
  /// compact part less this one; x in units; owned nodes. Collective.
  void add_projection_to(std::span<const double> x, double factor, std::span<double> y);
  /// x = (C + S)⁻¹ b, both in units and on owned nodes, to ‖b − …‖ <= relative ‖b‖. Collective.
  algebra::LinearReport solve_linear(std::span<const double> b, std::span<double> x, double relative) {
    return solver_.solve(b, x, relative);
  }
  /// A matrix of pressures, all zero.
  std::unique_ptr<algebra::BlockMatrix> make_matrix() const;
  /// As algebra::TangentSolver::forget().
  void forget() { solver_.reset(); }

  int iterations() const { return iterations_; }  ///< of conjugate gradients, in all
  double seconds() const { return solver_.seconds_setup() + solver_.seconds_solve(); }
  std::size_t bytes() const;

 private:
  void find_unit();
  void add_projection(std::span<const double> p, double factor, std::span<double> out);
  void guess(std::span<const double> u);

  const mesh::Mesh& mesh_;
  int components_;
  bool orthogonal_;
  algebra::GhostExchange ghosts_;
  PressureFields fields_of_body_;
  std::vector<const mesh::Block*> blocks_;  ///< of the kernels
  std::vector<MixedKernel*> kernels_;
  std::vector<char> fixed_;
  algebra::BlockMatrix matrix_;  ///< C + the part of S that couples neighbours, times unit²
  algebra::CorrectedMatrix operator_;
  algebra::KrylovSolver solver_;
  double unit_ = 1;
  double n_nodes_ = 1;  ///< with a pressure
  double volume_ = 0;   ///< ‖∫ N dV‖ [m³]
  int iterations_ = 0;
  std::vector<double> pressure_;              ///< [local node][field] [Pa]
  std::vector<double> weight_;                ///< 1/Σ w of the projection, zero where there is none
  std::vector<double> defect_, size_;         ///< [local node][field]
  std::vector<double> gradient_, projected_;  ///< scratch
  std::vector<double> local_;                 ///< scratch, [local node][field]
  std::vector<double> right_, correction_;    ///< owned
  std::vector<double> last_u_;                ///< owned, of the last solve
  struct {
    std::vector<double> u, p, from_u, from_p;
    double squared = 0;
  } direction_;
};

}  // namespace solidus::mechanics
