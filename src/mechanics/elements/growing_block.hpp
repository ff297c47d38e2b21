/// A mesh block whose elements are born together during a run: until then it takes no part in mechanics, from
/// then on its kernel works with what has happened since.
///
/// With the displacement u_b, the temperature Θ_b and the straining of phase changes e_b of the nodes when
/// the block is born, the kernel sees u − u_b, Θ_b in place of Θ_0, and e^pc − e_b: strain, thermal strain
/// and history are zero at birth, whatever the deformation of the metal below, which is what the block is
/// laid down on. Stress follows from the strain since birth alone.
///
/// These numbers belong to the nodes of the block: metal of different age at one node has different ones.
/// They are part of the state, behind what the kernel keeps at the points, so that a checkpoint has them: the
/// n (d + 2) numbers of an element with n nodes in d directions are dealt out to its q points. Before birth
/// all of it is zero.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "mechanics/elements/block_kernel.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

/// Fields that the blocks of a phase fill at their own nodes before their kernels read them.
struct SinceBirth {
  /// @param n_nodes     local nodes of the mesh
  /// @param components  of the displacement
  SinceBirth(std::size_t n_nodes, int components)
      : now(n_nodes * as_size(components)),
        old(now.size()),
        held(now.size()),
        temperature(n_nodes),
        straining(n_nodes) {}
  std::vector<double> now, old, held;  ///< displacement since birth [m], [local node][component]
  std::vector<double> temperature;     ///< Θ_b [K], [local node]
  std::vector<double> straining;       ///< e^pc − e_b, [local node]
};

/// The nodal fields of the moment in which elements are born.
struct BirthFields {
  std::span<const double> displacement;  ///< u_b [m], [local node][component]
  std::span<const double> temperature;   ///< Θ_b [K], [local node]
  std::span<const double> straining;     ///< e_b, [local node]; empty: zero
};

class GrowingBlock final : public BlockKernel {
 public:
  /// @param kernel  of the block with all its elements
  /// @param fields  of the phase, shared by its growing blocks
  GrowingBlock(mesh::Shape shape, int components, std::unique_ptr<BlockKernel> kernel,
               std::shared_ptr<SinceBirth> fields);

  /// From now on the elements take part, which are those of the kernel. bind() follows.
  void come(const mesh::ElementBlock& block);
  bool there() const { return there_; }
  /// The history of elements that are born at these fields.
  BlockHistory born_at(const BirthFields& fields) const;

  bool symmetric() const override { return kernel_->symmetric(); }
  void bind(const linear::BlockMatrix& matrix) override;
  BlockHistory initial_history() const override;
  bool set_initial_stress(const StepStart& start, std::span<const double> stress) override;
  double prepare(const StepStart& start) override;
  double add_forces(std::span<const double> u, std::span<double> forces) override;
  void add_tangent(std::span<const double> u, linear::BlockMatrix& matrix) override;
  BlockWork finish(std::span<const double> old_u, std::span<const double> u, const BlockEnd& end) override;
  FlowChange restart_flow(const StepStart& start, std::span<const double> old_u, std::span<const double> u,
                          const BlockEnd& end) override;
  std::shared_ptr<const StructuralPoints> held_deformation(const StepStart& start) override;
  LawFailure failure(std::span<const double> u) const override;
  FlowingVolume flowing(std::span<const double> u) const override;
  void add_nodal_volume(double weight, std::span<double> out) const override;
  void spread_heat_as_stored(const PackVector<Lane>& weights) override;
  std::size_t bytes() const override;

 private:
  /// Lanes of a point: those of the kernel, and behind them those of birth.
  struct Layout {
    std::size_t points = 0, kernel = 0, birth = 0;
    std::size_t all() const { return kernel + birth; }
  };
  const Layout& layout() const;
  std::size_t numbers() const { return components_ + 2; }
  /// Numbers of birth from and to a history.
  void read_birth(const BlockHistory& history);
  void write_birth(std::span<const double> birth, BlockHistory& history) const;
  /// A history without, and with, the lanes of birth.
  void strip(const BlockHistory& from, BlockHistory& to) const;
  void spread(const BlockHistory& from, BlockHistory& to) const;
  /// The start of a step as the kernel sees it: fields since birth, histories those of strip().
  StepStart since_birth(const StepStart& start) const;
  StepStart take(const StepStart& start);
  /// Fills the fields that a kernel refers to since prepare().
  void enter() const;
  std::span<const double> shift(std::span<const double> u, std::vector<double>& to) const;

  std::size_t n_nodes_;  ///< of an element
  std::size_t components_;
  std::unique_ptr<BlockKernel> kernel_;
  std::shared_ptr<SinceBirth> fields_;
  bool there_ = false;
  std::vector<Index> nodes_;        ///< of the elements, each once; none before birth
  std::vector<std::size_t> place_;  ///< of the elements' nodes among them, [element][node]
  std::vector<double> birth_;       ///< u_b, Θ_b and e_b, [nodes_][number]
  std::vector<double> old_;         ///< u_n − u_b, [nodes_][component]
  mutable Layout layout_;           ///< no points: not known yet
  BlockHistory old_history_, held_history_, start_history_, trial_;  ///< as the kernel has them
};

}  // namespace solidus::mechanics
