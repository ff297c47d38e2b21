/// The tangent of two nodal fields at once, displacement and temperature (monograph 4.1):
///
///   ⎡ K_uu  K_uΘ ⎤ ⎧δu⎫     ⎧r_u⎫      [N]
///   ⎣ K_Θu  K_ΘΘ ⎦ ⎩δΘ⎭ = − ⎩r_Θ⎭      [W]
///
/// The second field may have several components a node. Where the displacement comes with pressures
/// (saddle_matrix.hpp) K_uu is that saddle point, and the rectangles have the pressures' part too:
///
///   ⎡ A   B   K_uΘ ⎤ ⎧δu⎫     ⎧r_u⎫
///   ⎢ Bᵀ −C   K_pΘ ⎥ ⎪δp⎪ = − ⎪r_p⎪
///   ⎣ K_Θu K_Θp K_ΘΘ ⎦ ⎩δΘ⎭     ⎩r_Θ⎭
///
/// The diagonal blocks are the matrices of the two phases. The rectangular ones have the graph of K_uu, a
/// block of `components` numbers per pair of nodes, and are added to through its slots. Prescribed degrees of
/// freedom and constraints of either field are eliminated as in BlockMatrix.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "linear/block_matrix.hpp"
#include "linear/saddle_matrix.hpp"

namespace solidus::linear {

class CoupledMatrix {
 public:
  using Slot = BlockMatrix::Slot;

  /// @param displacement, temperature  of the same mesh, prescribed degrees of freedom and constraints set;
  ///                                   must outlive this object
  /// @param saddle  of this displacement matrix; null: there is no pressure. Collective.
  CoupledMatrix(const mesh::Mesh& mesh, BlockMatrix& displacement, BlockMatrix& temperature,
                SaddleMatrix* saddle = nullptr);
  ~CoupledMatrix();
  CoupledMatrix(const CoupledMatrix&) = delete;
  CoupledMatrix& operator=(const CoupledMatrix&) = delete;

  BlockMatrix& displacement() { return displacement_; }
  BlockMatrix& temperature() { return temperature_; }
  int components() const { return displacement_.block_size(); }
  int fields() const { return temperature_.block_size(); }
  /// Null without pressures.
  SaddleMatrix* saddle() { return saddle_; }
  int pressures() const { return saddle_ != nullptr ? saddle_->fields() : 0; }

  /// Sets the rectangular blocks to zero. They are made again if the pattern of a diagonal block has changed;
  /// returns whether they were. Collective.
  bool set_zero();
  /// ∂r_u/∂Θ of a pair (row node, column node), [component][field]; slots of `displacement`, also the one
  /// without a row.
  double* force_by_temperature(Slot s) { return force_.data() + (s + 1) * components() * fields(); }
  /// ∂r_Θ/∂u of a pair (row node, column node), [field][component].
  double* heat_by_displacement(Slot s) { return heat_.data() + (s + 1) * components() * fields(); }

  /// K_pΘ of a pair, [pressure][field], and K_Θp, [field][pressure].
  double* volume_by_temperature(Slot s) { return volume_.data() + (s + 1) * pressures() * fields(); }
  double* heat_by_pressure(Slot s) { return heat_of_pressure_.data() + (s + 1) * pressures() * fields(); }

  /// y = K_Θu x for local x (ghosts up to date), y on owned nodes; ignores what is prescribed or tied.
  void multiply_heat(std::span<const double> x, std::span<double> y) const;
  /// y = K_uΘ x, likewise.
  void multiply_force(std::span<const double> x, std::span<double> y) const;
  /// y = K_Θp x and y = K_pΘ x, likewise; with pressures.
  void multiply_heat_of_pressure(std::span<const double> x, std::span<double> y) const;
  void multiply_volume(std::span<const double> x, std::span<double> y) const;

  /// Without pressures: passes all values on, rows times `force_scale` [1/N] and `heat_scale` [1/W], and
  /// returns the PETSc matrix, of type MATNEST; owned by this object. Collective.
  Mat matrix(double force_scale, double heat_scale);
  std::size_t bytes() const;

 private:
  void create_rectangles();
  void create_petsc_rectangles();

  const mesh::Mesh& mesh_;
  BlockMatrix& displacement_;
  BlockMatrix& temperature_;
  SaddleMatrix* saddle_;
  int pattern_u_ = 0, pattern_t_ = 0;
  /// A scrap block, then a block per slot.
  std::vector<double> force_, heat_, volume_, heat_of_pressure_;
  struct Petsc;
  std::unique_ptr<Petsc> petsc_;
};

}  // namespace solidus::linear
