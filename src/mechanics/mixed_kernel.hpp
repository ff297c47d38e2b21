/// What the pressure of mixed elements asks of a mesh block beside BlockKernel (pressure_equation.hpp).
///
/// Linear triangles and tetrahedra with nodal displacements u and a continuous nodal mean stress p. At the
/// one point of an element the law works at the strain dev ε(u) + ⅓ e_v 1, whose volumetric part e_v is the
/// one with which its mean stress is p:
///
///   r_u = ∫ B_devᵀ s + b p dV                         s = dev σ(dev ε + ⅓ e_v 1), b = Bᵀ 1
///   r_p = ∫ N (div u − e_v(dev ε, p̄)) dV − S p        S: the stabilisation
///
/// The law has the one point and the mean p̄ of the element; ∫ b p dV is exact, in axisymmetry with
/// ∫ N_a N_b 2π dA of the hoop, as the weight ∫ N dV is: a liquid column rests.
///
/// With g = ∇p of an element and the lumped projection Π_b = Σ_e w_e g_e / Σ_e w_e over the elements at a
/// node b, w = τV/n:
///   orthogonal sub-scales   qᵀ S p = Σ_e τ V ∇q·(g − 1/n Σ_b Π_b)
///   algebraic sub-scales    qᵀ S p = Σ_e τ V ∇q·(g + ρ g_0)             the body force ρ g_0 of the element
/// Both are symmetric: S p is the slope of Σ_e ½ τ V ‖g − Π‖² or ‖g + ρ g_0‖².
///
/// τ = c h²/(2Ĝ) with the secant modulus 2Ĝ at the start of the step. R. Codina, CMAME 190 (2000) 1579; M.
/// Chiumenti, Q. Valverde, C. Agelet de Saracibar, M. Cervera, CMAME 191 (2002) 5253; M. Cervera, M.
/// Chiumenti, Q. Valverde, C. Agelet de Saracibar, CMAME 192 (2003) 5249. The projection is weighted with τ,
/// as symmetry wants it.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "algebra/coupled_matrix.hpp"
#include "mechanics/block_kernel.hpp"
#include "mechanics/simplices.hpp"

namespace solidus::mechanics {

/// Nodal fields of pressures, [local node][field]: bodies of different materials that share nodes have fields
/// of their own, so that the pressure may jump between them.
struct PressureField {
  int n_fields = 1;
  int field = 0;  ///< that of the block
};

class MixedKernel {
 public:
  virtual ~MixedKernel() = default;

  /// Collects the pressure from this array, [local node][field] [Pa], which must stay where it is.
  virtual void use_pressure(std::span<const double> pressure, PressureField field) = 0;
  /// Looks up the slots of a matrix of pressures.
  virtual void bind_pressure(const algebra::BlockMatrix& matrix) = 0;
  /// Of the algebraic sub-scales [N/m³]; zero with orthogonal ones.
  virtual void set_body_force(const std::array<double, 3>& force) = 0;
  /// A stiffness of this share of 2Ĝ against the divergence of u is part of add_tangent(); an iterative
  /// solver has the operator without it by add_divergence(). Zero: none.
  virtual void set_augmentation(double share) = 0;

  /// ∫ 1 dV and ∫ 2Ĝ dV over the counted elements.
  virtual std::array<double, 2> mean_stiffness() const = 0;
  /// w of the projection, [local node][field].
  virtual void add_projection_weight(std::span<double> out) const = 0;
  /// Σ w g, [local node][field][direction].
  virtual void add_gradient(std::span<const double> p, std::span<double> out) const = 0;
  /// out_a += Σ τ V ∇N_a·(1/n Σ_b Π_b).
  virtual void add_projected(std::span<const double> projection, std::span<double> out) const = 0;

  /// defect += ∫ N (div u − e_v) dV − τ V ∇N·(∇p + ρ g_0) at u and the pressure in use; size += the sum of
  /// the magnitudes of the volume changes, [local node][field] [m³]. Not numbers where the law finds no
  /// state.
  virtual void add_volume_defect(std::span<const double> u, std::span<double> defect,
                                 std::span<double> size) = 0;
  /// matrix += ∫ N 1/κ N dV + τ V ∇N·∇N with the volumetric stiffness κ at the start of the step, times
  /// `scale`.
  virtual void add_compliance(double scale, algebra::BlockMatrix& matrix) const = 0;
  /// matrix += ∫ N 1/(2Ĝ) N dV, lumped, times `scale`.
  virtual void add_mass(double scale, algebra::BlockMatrix& matrix) const = 0;
  /// After add_tangent(): the pressures' share of the tangent, p in units of `unit` [Pa], without the
  /// projection: ∂r_u/∂p, ∂r_p/∂u and −(compliance as of add_compliance, with κ of now).
  virtual void add_saddle(double unit, algebra::CoupledMatrix& matrix) const = 0;
  /// y += factor × the augmentation's forces of x, both [local node][component].
  virtual void add_divergence(double factor, std::span<const double> x, std::span<double> y) const = 0;
};

/// One maker per analysis kind, each in its own translation unit.
/// Throws std::invalid_argument for another shape than the linear triangle or tetrahedron of the kind.
template <AnalysisKind kind>
std::unique_ptr<BlockKernel> make_mixed_block(const mesh::Mesh& mesh, const mesh::Block& block,
                                              const material::Material& material, Mapping mapping,
                                              Stabilisation stabilisation);
using MixedMaker = std::unique_ptr<BlockKernel>(const mesh::Mesh&, const mesh::Block&,
                                                const material::Material&, Mapping, Stabilisation);
template <>
MixedMaker make_mixed_block<AnalysisKind::plane_strain>;
template <>
MixedMaker make_mixed_block<AnalysisKind::axisymmetric>;
template <>
MixedMaker make_mixed_block<AnalysisKind::solid>;

/// Throws std::invalid_argument where the kind has no such maker.
std::unique_ptr<BlockKernel> make_mixed_kernel(const mesh::Mesh& mesh, const mesh::Block& block,
                                               AnalysisKind kind, const material::Material& material,
                                               Mapping mapping, Stabilisation stabilisation);

}  // namespace solidus::mechanics
