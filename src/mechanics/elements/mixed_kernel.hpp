/// Interface of a mesh block of mixed elements besides BlockKernel, for the nodal pressure
/// (nodal_pressure.hpp).
///
/// Linear triangles and tetrahedra with nodal displacements u and a continuous nodal mean stress p. At the
/// one point of an element the law works at the strain dev ε(u) + ⅓ e_v 1, whose volumetric part e_v is the
/// one with which its mean stress is p:
///
///   r_u = ∫ B_devᵀ s + b p dV                         s = dev σ(dev ε + ⅓ e_v 1), b = Bᵀ 1
///   r_p = ∫ N (div u − e_v(dev ε, p̄)) dV − S p        S: the stabilisation
///
/// (in metal that freezes also pores, pores.hpp, and melt that feeds it, liquid_flow.hpp).
///
/// The law has the one point and the mean p̄ of the element; ∫ b p dV is exact, in axisymmetry with
/// ∫ N_a N_b 2π dA of the hoop, as the weight ∫ N dV is: a liquid column rests.
///
/// With g = ∇p of an element and the lumped projection Π_b = Σ_e w_e g_e / Σ_e w_e over the elements at a
/// node b, w = τV/n:
///   orthogonal sub-scales   qᵀ S p = Σ_e τ V ∇q·(g − 1/n Σ_b Π_b)
///   algebraic sub-scales    qᵀ S p = Σ_e τ V ∇q·(g + ρ g_0)             the body force of the element
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

#include "linear/saddle_matrix.hpp"
#include "mechanics/elements/block_kernel.hpp"
#include "mechanics/elements/simplices.hpp"

namespace solidus::mechanics {

/// Nodal fields of pressures, [local node][field]: bodies of different materials that share nodes have fields
/// of their own, so that the pressure may jump between them. The arrays must stay where they are.
struct PressureField {
  std::span<const double> pressure;   ///< that the kernels work with [Pa]
  std::span<double> volume_residual;  ///< r_p, added to by BlockKernel::add_forces() [m³]
  /// Σ ∫ N |Δ div u| + N |Δ e_v| dV since the start of the step, likewise [m³]
  std::span<double> volume_change;
  int n_fields = 1;
  int field = 0;  ///< that of the block
};

/// BlockKernel::add_forces() of a mixed block also adds its part of r_p, and not a number to both residuals
/// where the law finds no state.
class MixedKernel {
 public:
  virtual ~MixedKernel() = default;

  virtual void use_pressure(const PressureField& field) = 0;
  /// The number of this block's field.
  virtual int field() const = 0;
  /// Looks up the slots of a scalar matrix of this field's pressures.
  virtual void bind_pressure(const linear::BlockMatrix& matrix) = 0;
  /// Sets the body force of the algebraic sub-scales and of the flow of melt (liquid_flow.hpp).
  /// @param force  weight and other loads of each element, [element][3] [N/m³]
  virtual void set_body_force(std::span<const double> force) = 0;

  /// Whether melt flows between dendrites in some step (liquid_flow.hpp).
  virtual bool flows() const = 0;
  /// Pores (pores.hpp): a step begins with no full element; those that the pressures of the field fill are
  /// full from then on, and whether there is a new one.
  virtual void release_pores() = 0;
  virtual bool fill_pores() = 0;
  /// ∫ 1 dV and ∫ 2Ĝ dV over the counted elements.
  virtual std::array<double, 2> mean_stiffness() const = 0;
  /// w of the projection, [local node][field].
  virtual void add_projection_weight(std::span<double> out) const = 0;
  /// Σ w g, [local node][field][direction].
  virtual void add_gradient(std::span<const double> p, std::span<double> out) const = 0;
  /// out_a += Σ τ V ∇N_a·(1/n Σ_b Π_b).
  virtual void add_projected(std::span<const double> projection, std::span<double> out) const = 0;

  /// matrix += scale (∫ N (1/κ + 1/2Ĝ) N dV + (τ + Δt K/μ) V ∇N·∇N), the part with 1/2Ĝ lumped, κ and 2Ĝ at
  /// the start of the step: the Schur complement of a preconditioner. After bind_pressure().
  virtual void add_schur(double scale, linear::BlockMatrix& matrix) const = 0;
  /// softness_a += ∫ N_a/(2Ĝ) + Δt K/μ |∇N_a|² dV with 2Ĝ of add_schur() [m³/Pa] and volume_a += ∫ N_a dV
  /// [m³], both [local node][field].
  virtual void add_softness(std::span<double> softness, std::span<double> volume) const = 0;
  /// displacement += ∫ bᵀ s̄ b dV, b = Bᵀ 1: a stiffness against the divergence.
  /// @param stiffness  [local node][field] [Pa], of which an element takes the mean s̄ of its nodes
  virtual void add_augmentation(double factor, std::span<const double> stiffness,
                                linear::BlockMatrix& displacement) const = 0;
  /// After add_tangent(): the pressures' part of the tangent, p in units of `unit` [Pa/m], without the
  /// projection: ∂r_u/∂p, ∂r_p/∂u and ∂r_p/∂p = −∫ N 1/κ N dV − (τ + Δt K/μ) V ∇N·∇N with κ of now.
  virtual void add_saddle(double unit, linear::SaddleMatrix& matrix) const = 0;
};

/// Throws std::invalid_argument where the kind has no such maker.
std::unique_ptr<BlockKernel> make_mixed_kernel(const mesh::Mesh& mesh, const mesh::ElementBlock& block,
                                               AnalysisKind kind, const material::Material& material,
                                               Mapping mapping, Stabilisation stabilisation);

}  // namespace solidus::mechanics
