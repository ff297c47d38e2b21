/// The strain operator at a quadrature point and its transpose, standard or B-bar (monograph 6.11–6.31).
///
///   ε = Σ_a B_a u_a,   B̄_a = B_a + ⅓ 1 ⊗ (b̄_a − b_a)                                  (6.24)
///   b_a = ∇N_a (axisymmetric: + N_a/r in the radial direction)                           (6.11)
///   b̄_a = Ψ · H⁻¹ ∫ Ψ b_a dV,   H = ∫ Ψ ⊗ Ψ dV                                          (6.18, 6.23)
///
/// with the volumetric modes Ψ of law_block.hpp: one constant in elements of first order, linear ones in
/// those of second order.
///
/// In axisymmetry the hoop strain u_r/r belongs to the volumetric part as the others do.
#pragma once

#include <array>

#include "numbers/index_casts.hpp"
#include "numbers/simd.hpp"
#include "numbers/tensor.hpp"
#include "numbers/types.hpp"

namespace solidus::mechanics {

/// Vectors at the nodes of one element: [node][component].
template <class T, int n_nodes, int dim>
using NodalVectors = std::array<std::array<T, dim>, n_nodes>;

/// Index of strain components in Sym: the shear of x and y is 3, of y and z 4, of x and z 5.
template <int dim>
inline constexpr std::array<std::array<int, 3>, 3> k_component{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};

template <int n_nodes, AnalysisKind kind, bool b_bar>
struct Kinematics {
  static constexpr int dim = displacement_components(kind);
  static constexpr bool hoop = kind == AnalysisKind::axisymmetric;
  using Vectors = NodalVectors<Lane, n_nodes, dim>;

  Vectors gradient;                      ///< ∂N_a/∂x_i
  std::array<Lane, n_nodes> hoop_value;  ///< N_a/r, axisymmetric only
  Vectors excess;                        ///< (b̄_a − b_a)/3, B-bar only
  const Sym<Lane>* initial = nullptr;    ///< a strain besides that of the displacement; null: none

  /// @param g       ∂N_a/∂x_i, [node][dim]
  /// @param values  N_a, [node]
  /// @param mean    b̄_a, [node][dim]; read with B-bar only
  Kinematics(const Lane* g, const double* values, Lane inverse_radius, const Lane* mean) {
    for (std::size_t a = 0; a < n_nodes; ++a) {
      for (std::size_t i = 0; i < dim; ++i) gradient[a][i] = g[a * dim + i];
      if constexpr (hoop) hoop_value[a] = Lane(values[a]) * inverse_radius;
      if constexpr (b_bar)
        for (std::size_t i = 0; i < dim; ++i)
          excess[a][i] = Lane(1.0 / 3.0) * (mean[a * dim + i] - divergence(a, i));
    }
  }

  /// b_a in direction i.
  Lane divergence(std::size_t a, std::size_t i) const {
    if constexpr (hoop)
      if (i == 0) return gradient[a][0] + hoop_value[a];
    return gradient[a][i];
  }
  /// b̄_a in direction i, or b_a without B-bar.
  Lane mean_divergence(std::size_t a, std::size_t i) const {
    if constexpr (b_bar)
      return divergence(a, i) + Lane(3.0) * excess[a][i];
    else
      return divergence(a, i);
  }

  /// ε(u), with the initial strain where there is one.
  Sym<Lane> strain(const Vectors& u) const {
    std::array<std::array<Lane, dim>, dim> h{};
    Lane hoop_strain(0.0), correction(0.0);
    for (std::size_t a = 0; a < n_nodes; ++a) {
      for (std::size_t i = 0; i < dim; ++i)
        for (std::size_t j = 0; j < dim; ++j) h[i][j] += u[a][i] * gradient[a][j];
      if constexpr (hoop) hoop_strain += hoop_value[a] * u[a][0];
      if constexpr (b_bar)
        for (std::size_t i = 0; i < dim; ++i) correction += excess[a][i] * u[a][i];
    }
    Sym<Lane> e;
    e[0] = h[0][0];
    e[1] = h[1][1];
    e[3] = Lane(0.5) * (h[0][1] + h[1][0]);
    if constexpr (hoop) e[2] = hoop_strain;
    if constexpr (dim == 3) {
      e[2] = h[2][2];
      e[4] = Lane(0.5) * (h[1][2] + h[2][1]);
      e[5] = Lane(0.5) * (h[0][2] + h[2][0]);
    }
    if constexpr (b_bar)
      for (int i = 0; i < 3; ++i) e[i] += correction;
    if (initial != nullptr)
      for (int k = 0; k < 6; ++k) e[k] += (*initial)[k];
    return e;
  }

  /// B̄_aᵀ t in direction i.
  Lane force(std::size_t a, std::size_t i, const Sym<Lane>& t, Lane trace_t) const {
    Lane f(0.0);
    for (std::size_t j = 0; j < dim; ++j) f += t[k_component<dim>[i][j]] * gradient[a][j];
    if constexpr (hoop)
      if (i == 0) f += t[2] * hoop_value[a];
    if constexpr (b_bar) f += excess[a][i] * trace_t;
    return f;
  }

  void add_force(const Sym<Lane>& t, Vectors& f) const {
    const Lane trace_t = trace(t);
    for (std::size_t a = 0; a < n_nodes; ++a)
      for (std::size_t i = 0; i < dim; ++i) f[a][i] += force(a, i, t, trace_t);
  }

  /// C B_b e_j: the stress that a unit displacement of node b in direction j causes.
  Sym<Lane> unit_stress(const Sym4<Lane>& c, const std::array<Lane, 6>& trace_stress, std::size_t b,
                        std::size_t j) const {
    Sym<Lane> t;
    for (int k = 0; k < 6; ++k) {
      for (std::size_t l = 0; l < dim; ++l) t[k] += c[k][as_size(k_component<dim>[j][l])] * gradient[b][l];
      if constexpr (hoop)
        if (j == 0) t[k] += c[k][2] * hoop_value[b];
      if constexpr (b_bar) t[k] += trace_stress[as_size(k)] * excess[b][j];
    }
    return t;
  }
};

}  // namespace solidus::mechanics
