/// The nodal pressure of mixed elements (mixed_kernel.hpp): a second unknown of Newton's iteration along with
/// the displacement. This class holds the nodes that have a pressure, the unit in which it is counted, and
/// the part of its stabilisation that couples neighbours of neighbours.
///
///   r_p(u, p) = ∫ N (div u − e_v(dev ε, p)) dV − S p = 0
///
/// The unknown is p/unit and its residual −unit × r_p, so that both have the size of a displacement [m] and a
/// force [N], and the pair (r_u, −unit × r_p) is the monotone form of the saddle point: its product with
/// Newton's direction is minus what the linearised problem stores, whatever the sign of r_p.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "mechanics/elements/mixed_kernel.hpp"
#include "mechanics/solver/balance.hpp"
#include "mechanics/state/body_fields.hpp"
#include "parallel/parallel.hpp"

namespace solidus::mechanics {

/// 1 for blocks of mixed elements, [block].
std::vector<char> mixed_blocks(std::span<const std::unique_ptr<BlockKernel>> blocks);

/// The part of S that couples neighbours of neighbours: G ᵀ D⁻¹ G of orthogonal sub-scales.
class PressureProjection {
 public:
  /// Keeps references.
  /// @param fields  of the pressures at a node
  PressureProjection(const mesh::Mesh& mesh, const parallel::GhostExchange& ghosts,
                     const std::vector<MixedKernel*>& kernels, int fields);
  /// A step begins: finds the weights.
  void begin();
  /// out += factor × the projection of p, both [local node][field]; ghost rows are scrap. Collective.
  void add(std::span<const double> p, double factor, std::span<double> out);
  /// y += factor × that of x, both on owned nodes, but for absent pressures. Collective.
  void add_owned(std::span<const double> x, double factor, const std::vector<char>& absent,
                 std::span<double> y);
  std::size_t bytes() const;

 private:
  const mesh::Mesh& mesh_;
  const parallel::GhostExchange& ghosts_;
  const std::vector<MixedKernel*>& kernels_;
  int fields_;
  std::vector<double> weight_;                ///< 1/Σ w, zero where there is none
  std::vector<double> gradient_, projected_;  ///< scratch
  std::vector<double> local_;                 ///< scratch, [local node][field]
};

class NodalPressure {
 public:
  /// @param blocks      kernels of the phase; those that are no MixedKernel have no pressure
  /// @param fields      those of a phase stay as they are when bodies leave: states hold them
  /// @param orthogonal  sub-scales; else algebraic ones
  /// Collective.
  NodalPressure(const mesh::Mesh& mesh, BodyFields fields,
                std::span<const std::unique_ptr<BlockKernel>> blocks, bool orthogonal);

  const BodyFields& fields() const { return fields_; }
  /// Nodes at which no element has this pressure, [local node][field].
  const std::vector<char>& absent() const { return absent_; }
  const std::vector<MixedKernel*>& kernels() const { return kernels_; }
  /// The blocks of these kernels.
  const std::vector<const mesh::ElementBlock*>& blocks() const { return blocks_; }
  /// The part of S that couples neighbours of neighbours; null: there is none.
  PressureProjection* projection() const { return projection_.get(); }

  /// A step begins, after the blocks' prepare(): finds the unit and the weights of the projection.
  /// Collective.
  void begin();
  /// In which pressures are counted [Pa/m]: 2Ĝ over the length of an element.
  double unit() const { return unit_; }
  /// Pressures that the kernels work with, from the unknowns of an iterate, [local node][field]; the volume
  /// residual of the kernels' next add_forces() begins at zero.
  void set(std::span<const double> unknowns);
  /// The pressures of the last set(), [local node][field] [Pa].
  const std::vector<double>& pressure() const { return pressure_; }
  /// After the kernels' add_forces(): r = −unit × r_p on owned nodes, [owned node][field], and what it is
  /// measured against goes to the balance. Collective.
  void residual(std::span<double> r, BodyBalance& balance);

  std::size_t bytes() const;

 private:
  void find_unit();

  const mesh::Mesh& mesh_;
  parallel::GhostExchange ghosts_;
  BodyFields fields_;
  std::vector<const mesh::ElementBlock*> blocks_;  ///< of the kernels
  std::vector<MixedKernel*> kernels_;
  std::vector<char> absent_;
  double unit_ = 1;
  double n_nodes_ = 1;                   ///< with a pressure
  std::vector<double> pressure_;         ///< [local node][field] [Pa]
  std::vector<double> volume_residual_;  ///< r_p [m³], [local node][field]; ghost rows are scrap
  std::vector<double> volume_change_;    ///< the magnitudes of its terms in this step [m³]
  std::unique_ptr<PressureProjection> projection_;
};

/// The unknowns of a pressure [Pa], [local node][field]; zero where it is empty or nothing has it any more.
void to_unknowns(const NodalPressure& of, std::span<const double> pressure, std::span<double> unknowns);
/// A step begins with no element that is full of pores (pores.hpp).
void release_pores(NodalPressure& pressure);
/// After equilibrium: whether further elements have filled with pores at these unknowns, so that it must be
/// sought again from there. Throws StepRejected after too many iterations. Collective.
/// @param iteration  from one
bool fill_pores(NodalPressure& pressure, std::span<const double> unknowns, int iteration);
/// y += factor × unit² × the part of S that couples neighbours of neighbours, taken as positive: S is its
/// compact part less this one. x are unknowns; both on owned nodes. Collective.
void add_projection(const NodalPressure& pressure, std::span<const double> x, double factor,
                    std::span<double> y);
/// The sparsity pattern of the pressures of one field: the nodes that couple within the elements that have
/// them.
linear::NodeGraph pressure_graph(const mesh::Mesh& mesh, const NodalPressure& pressure);

}  // namespace solidus::mechanics
