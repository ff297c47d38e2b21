/// The upper half of a symmetric or skew element matrix, and its additions: isotropic, rank-one or general
/// tangent (monograph 6.33).
#pragma once

#include "mechanics/elements/kinematics.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

/// Blocks K_ab for a <= b, dim × dim each, in rows of a.
template <int n_nodes, int dim>
struct ElementMatrix {
  using Vectors = NodalVectors<Lane, n_nodes, dim>;
  static constexpr std::size_t n_pairs = n_nodes * (n_nodes + 1) / 2;
  std::array<std::array<Lane, dim * dim>, n_pairs> pairs{};
};

/// K_ab += κ b̄_a b̄_bᵀ + 2Ĝ (B_aᵀ I B_b − ⅓ b_a b_bᵀ); both moduli already times the weight of the point.
template <int n_nodes, AnalysisKind kind, bool b_bar>
void add_isotropic(const Kinematics<n_nodes, kind, b_bar>& b, Lane bulk, Lane twice_shear,
                   ElementMatrix<n_nodes, Kinematics<n_nodes, kind, b_bar>::dim>& k) {
  constexpr std::size_t dim = Kinematics<n_nodes, kind, b_bar>::dim;
  const Lane shear = Lane(0.5) * twice_shear, minus_third = Lane(-1.0 / 3.0) * twice_shear;
  std::size_t pair = 0;
  for (std::size_t p = 0; p < n_nodes; ++p) {
    std::array<Lane, dim> volumetric, deviatoric, g;
    for (std::size_t i = 0; i < dim; ++i) {
      volumetric[i] = b_bar ? bulk * b.mean_divergence(p, i) : (bulk + minus_third) * b.divergence(p, i);
      deviatoric[i] = minus_third * b.divergence(p, i);
      g[i] = shear * b.gradient[p][i];
    }
    for (std::size_t q = p; q < n_nodes; ++q, ++pair) {
      auto& block = k.pairs[pair];
      Lane product(0.0);
      for (std::size_t i = 0; i < dim; ++i) product += g[i] * b.gradient[q][i];
      for (std::size_t i = 0; i < dim; ++i)
        for (std::size_t j = 0; j < dim; ++j) {
          Lane entry = volumetric[i] * b.mean_divergence(q, j) + g[j] * b.gradient[q][i];
          if constexpr (b_bar) entry += deviatoric[i] * b.divergence(q, j);
          if (i == j) entry += product;
          block[i * dim + j] += entry;
        }
      if constexpr (kind == AnalysisKind::axisymmetric)
        block[0] += twice_shear * b.hoop_value[p] * b.hoop_value[q];
    }
  }
}

/// K_ab += factor v_a v_bᵀ: a rank-one tangent c t ⊗ t with v = B̄ᵀ t.
template <int n_nodes, int dim>
void add_product(const typename ElementMatrix<n_nodes, dim>::Vectors& v, Lane factor,
                 ElementMatrix<n_nodes, dim>& k) {
  constexpr auto size = as_size(dim);
  std::size_t pair = 0;
  for (std::size_t p = 0; p < n_nodes; ++p) {
    std::array<Lane, size> scaled;
    for (std::size_t i = 0; i < size; ++i) scaled[i] = factor * v[p][i];
    for (std::size_t q = p; q < n_nodes; ++q, ++pair)
      for (std::size_t i = 0; i < size; ++i)
        for (std::size_t j = 0; j < size; ++j) k.pairs[pair][i * size + j] += scaled[i] * v[q][j];
  }
}

/// K_ab += ½ factor (v_a z_bᵀ + z_a v_bᵀ): the symmetric part of a tangent l ⊗ r with v = B̄ᵀ l, z = B̄ᵀ r.
template <int n_nodes, int dim>
void add_symmetric_product(const typename ElementMatrix<n_nodes, dim>::Vectors& v,
                           const typename ElementMatrix<n_nodes, dim>::Vectors& z, Lane factor,
                           ElementMatrix<n_nodes, dim>& k) {
  constexpr auto size = as_size(dim);
  const Lane half = Lane(0.5) * factor;
  std::size_t pair = 0;
  for (std::size_t p = 0; p < n_nodes; ++p) {
    std::array<Lane, size> half_v, half_z;
    for (std::size_t i = 0; i < size; ++i) {
      half_v[i] = half * v[p][i];
      half_z[i] = half * z[p][i];
    }
    for (std::size_t q = p; q < n_nodes; ++q, ++pair)
      for (std::size_t i = 0; i < size; ++i)
        for (std::size_t j = 0; j < size; ++j)
          k.pairs[pair][i * size + j] += half_v[i] * z[q][j] + half_z[i] * v[q][j];
  }
}

/// K_ab += factor v_a z_bᵀ split into its symmetric and its skew part: a tangent l ⊗ r with v = B̄ᵀ l,
/// z = B̄ᵀ r.
template <int n_nodes, int dim>
void add_product(const typename ElementMatrix<n_nodes, dim>::Vectors& v,
                 const typename ElementMatrix<n_nodes, dim>::Vectors& z, Lane factor,
                 ElementMatrix<n_nodes, dim>& symmetric, ElementMatrix<n_nodes, dim>& skew) {
  constexpr auto size = as_size(dim);
  const Lane half = Lane(0.5) * factor;
  std::size_t pair = 0;
  for (std::size_t p = 0; p < n_nodes; ++p)
    for (std::size_t q = p; q < n_nodes; ++q, ++pair)
      for (std::size_t i = 0; i < size; ++i)
        for (std::size_t j = 0; j < size; ++j) {
          const Lane here = half * v[p][i] * z[q][j], mirrored = half * z[p][i] * v[q][j];
          symmetric.pairs[pair][i * size + j] += here + mirrored;
          skew.pairs[pair][i * size + j] += here - mirrored;
        }
}

/// K_ab += B̄_aᵀ C B̄_b for a symmetric C, or a skew one and a skew K, already times the weight of the point.
template <int n_nodes, AnalysisKind kind, bool b_bar>
void add_general(const Kinematics<n_nodes, kind, b_bar>& b, const Sym4<Lane>& c,
                 ElementMatrix<n_nodes, Kinematics<n_nodes, kind, b_bar>::dim>& k) {
  constexpr std::size_t dim = Kinematics<n_nodes, kind, b_bar>::dim;
  std::array<Lane, 6> trace_stress{};  // C 1
  if constexpr (b_bar)
    for (int i = 0; i < 6; ++i) trace_stress[as_size(i)] = c[i][0] + c[i][1] + c[i][2];
  for (std::size_t q = 0; q < n_nodes; ++q)
    for (std::size_t j = 0; j < dim; ++j) {
      const Sym<Lane> t = b.unit_stress(c, trace_stress, q, j);
      const Lane trace_t = trace(t);
      for (std::size_t p = 0; p <= q; ++p) {
        // pairs before row p: n + (n − 1) + … + (n − p + 1)
        const std::size_t pair = p * n_nodes - p * (p + 1) / 2 + q;
        for (std::size_t i = 0; i < dim; ++i) k.pairs[pair][i * dim + j] += b.force(p, i, t, trace_t);
      }
    }
}

}  // namespace solidus::mechanics
