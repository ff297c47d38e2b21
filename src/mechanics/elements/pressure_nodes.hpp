/// Part of the mixed elements that does not depend on the law: the pressure at the nodes of a block of linear
/// simplices, its integrals and its stabilisation (mixed_kernel.hpp), eight elements at a time.
#pragma once

#include <algorithm>

#include "mechanics/elements/element_transfer.hpp"
#include "mechanics/elements/liquid_flow.hpp"
#include "mechanics/elements/mixed_kernel.hpp"
#include "mechanics/elements/padding.hpp"
#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

/// c of τ = c h²/(2Ĝ) with orthogonal sub-scales. What they leave out is of higher order, and the answer
/// hardly depends on c.
inline constexpr double k_orthogonal = 1.0;
/// c of algebraic sub-scales where the volume is nearly kept, and where it is not. They soften a body with c,
/// and hold the gradient of the pressure at a boundary (docs/decisions/0048-less-stabilisation-in-solids.md).
inline constexpr double k_algebraic = 0.25, k_algebraic_compressible = 0.05;
/// The stabilisation grows from the second to the first where 2Ĝ is less than the bulk modulus over this.
inline constexpr double k_nearly_incompressible = 5.0;

/// c of algebraic sub-scales: c_0 + (c_1 − c_0) max(0, 1 − 5 · 2Ĝ/κ), since a volume that can change holds
/// the pressure by itself.
/// @param shear_over_bulk  2Ĝ/κ, both at the start of a step, so that Newton's method need not derive c
inline Lane algebraic_factor(const Lane& shear_over_bulk) {
  const Lane kept = max(Lane(0.0), Lane(1.0) - Lane(k_nearly_incompressible) * shear_over_bulk);
  return Lane(k_algebraic_compressible) + Lane(k_algebraic - k_algebraic_compressible) * kept;
}

template <int n_nodes, AnalysisKind kind>
class PressureNodes : public MixedKernel {
 public:
  using Operator = Kinematics<n_nodes, kind, false>;
  using Vectors = typename Operator::Vectors;
  using Nodal = std::array<Lane, n_nodes>;
  static constexpr std::size_t dim = Operator::dim;
  static_assert(n_nodes == static_cast<int>(dim) + 1, "a linear simplex");

  /// @param geometry  of the block, with one point; must outlive this object
  PressureNodes(const mesh::Mesh& mesh, const mesh::ElementBlock& block, const mesh::BlockGeometry& geometry,
                const material::Material& material, Stabilisation stabilisation)
      : orthogonal_(stabilisation == Stabilisation::orthogonal),
        flow_(material, geometry.n_batches),
        geometry_(geometry) {
    const auto n = as_size(geometry.n_batches);
    compliance_.resize(n);
    twice_shear_.resize(n);
    tangent_shear_.resize(n);
    pore_compliance_.resize(n, Lane(0.0));
    tau_.resize(n);
    if constexpr (hoop) masses_ = mesh::basis_integrals(mesh, block, kind);
  }

  void use_pressure(const PressureField& field) override { field_ = field; }
  int field() const override { return field_.field; }
  bool flows() const override { return flow_.flows(); }
  void bind_pressure(const linear::BlockMatrix& matrix) override {
    pressure_slots_ = {matrix, geometry_.nodes, n_nodes, geometry_.n_elements};
  }
  void set_body_force(std::span<const double> force) override {
    body_force_.resize(as_size(geometry_.n_batches) * dim);
    for (Index batch = 0; batch < geometry_.n_batches; ++batch)
      for (std::size_t i = 0; i < dim; ++i)
        body_force_[at(batch) * dim + i] = lane_of_elements(batch, geometry_.n_elements, force.data() + i, 3);
  }
  std::array<double, 2> mean_stiffness() const override {
    Lane volume(0.0), stiffness(0.0);
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Lane w = geometry_.counted[at(batch)] * weight(batch);
      volume += w;
      stiffness += w * twice_shear_[at(batch)];
    }
    return {sum(volume), sum(stiffness)};
  }

  void add_projection_weight(std::span<double> out) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      Nodal weight;
      weight.fill(projection_weight(batch));
      scatter_pressure(weight, batch, out);
    }
  }

  void add_gradient(std::span<const double> p, std::span<double> out) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const auto g = pressure_gradient(gather_pressure(p, batch), batch);
      const Lane w = projection_weight(batch);
      for (std::size_t i = 0; i < dim; ++i) {
        const Lane value = w * g[i];
        for (std::size_t a = 0; a < n_nodes; ++a)
          for (std::size_t lane = 0; lane < k_lanes; ++lane)
            out[place(batch, a, lane) * dim + i] += value[static_cast<int>(lane)];
      }
    }
  }

  void add_projected(std::span<const double> projection, std::span<double> out) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Operator b = at_point(batch);
      const Lane w = projection_weight(batch);  // τV × the share of a node in the mean
      Nodal result{};
      for (std::size_t i = 0; i < dim; ++i) {
        Lane total(0.0);
        for (std::size_t a = 0; a < n_nodes; ++a) {
          alignas(sizeof(Lane)) double values[k_lanes];
          for (std::size_t lane = 0; lane < k_lanes; ++lane)
            values[lane] = projection[place(batch, a, lane) * dim + i];
          total += Lane::load(values);
        }
        for (std::size_t a = 0; a < n_nodes; ++a) result[a] += w * total * b.gradient[a][i];
      }
      scatter_pressure(result, batch, out);
    }
  }

  void add_schur(double scale, linear::BlockMatrix& matrix) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Nodal mass = masses(batch);
      auto terms = compliance_terms(Lane(scale), compliance_[at(batch)] + pore_compliance_[at(batch)], batch);
      const Lane softness = Lane(scale) / tangent_shear_[at(batch)];
      for (std::size_t a = 0; a < n_nodes; ++a) terms[a * n_nodes + a] += softness * mass[a];
      const Slot* const slots = pressure_slots_.of(batch);
      double* const base = matrix.block(0);
      for (std::size_t pair = 0; pair < n_nodes * n_nodes; ++pair)
        for (std::size_t lane = 0; lane < k_lanes; ++lane)
          base[slots[pair * k_lanes + lane]] += terms[pair][static_cast<int>(lane)];
    }
  }

  void add_softness(std::span<double> softness, std::span<double> volume) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Nodal mass = masses(batch);
      const Operator b = at_point(batch);
      const Lane flow = flow_.mobility(batch) * weight(batch);
      Nodal soft = mass;
      for (std::size_t a = 0; a < n_nodes; ++a) {
        soft[a] = soft[a] / tangent_shear_[at(batch)];
        for (const Lane& g : b.gradient[a]) soft[a] += flow * g * g;
      }
      scatter_pressure(mass, batch, volume);
      scatter_pressure(soft, batch, softness);
    }
  }

 protected:
  using Slot = linear::BlockMatrix::Slot;
  static constexpr bool hoop = kind == AnalysisKind::axisymmetric;
  static constexpr double share = 1.0 / n_nodes;  ///< N_a at the one point

  static std::size_t at(Index batch) { return as_size(batch); }
  const Index* nodes(Index batch) const {
    return geometry_.nodes.data() + static_cast<std::ptrdiff_t>(batch) * n_nodes * k_lanes;
  }
  Lane weight(Index batch) const { return geometry_.weight_at(batch, 0); }
  Lane inverse_radius(Index batch) const {
    if constexpr (hoop)
      return geometry_.inverse_radius[at(batch)];
    else
      return Lane(0.0);
  }
  Operator at_point(Index batch) const {
    Operator b(geometry_.gradients_at(batch, 0), geometry_.values.data(), inverse_radius(batch), nullptr);
    if (!strain_at_start_.empty()) b.initial = &strain_at_start_[at(batch)];
    return b;
  }
  /// Sets the moduli of the stabilisation, 2Ĝ and κ at the start of a step, and 1/κ_v.
  void set_step(Index batch, const Operator& b, const Lane& twice_shear, const Lane& bulk,
                const Lane& compliance) {
    twice_shear_[at(batch)] = tangent_shear_[at(batch)] = twice_shear;
    const Lane c = orthogonal_ ? Lane(k_orthogonal) : algebraic_factor(twice_shear / bulk);
    tau_[at(batch)] = c * squared_length(b) / twice_shear;
    compliance_[at(batch)] = compliance;
    pore_compliance_[at(batch)] = Lane(0.0);
  }

  /// h² of the stabilisation: that of a regular simplex with the same mean square of gradients, hence of the
  /// short way through a flat one.
  static Lane squared_length(const Operator& b) {
    Lane squares(0.0);
    for (const auto& gradient : b.gradient)
      for (const Lane& g : gradient) squares += g * g;
    return Lane(2.0 * static_cast<double>(dim)) / squares;
  }

  Lane projection_weight(Index batch) const {
    if (!orthogonal_) return Lane(0.0);
    return Lane(share) * tau_[at(batch)] * weight(batch);
  }
  std::array<Lane, dim> pressure_gradient(const Nodal& p, Index batch) const {
    const Operator b = at_point(batch);
    std::array<Lane, dim> g{};
    for (std::size_t a = 0; a < n_nodes; ++a)
      for (std::size_t i = 0; i < dim; ++i) g[i] += p[a] * b.gradient[a][i];
    return g;
  }

  Lane body_force(Index batch, std::size_t i) const {
    return body_force_.empty() ? Lane(0.0) : body_force_[at(batch) * dim + i];
  }
  /// ∫ N_a dV.
  Nodal masses(Index batch) const {
    Nodal mass;
    if constexpr (hoop)
      std::copy_n(masses_.begin() + static_cast<std::ptrdiff_t>(batch) * n_nodes, n_nodes, mass.begin());
    else
      mass.fill(Lane(share) * weight(batch));
    return mass;
  }
  /// The pressure that the law works with, ∫ p dV/V.
  Lane mean(const Nodal& p, Index batch) const {
    Lane total(0.0);
    if constexpr (hoop) {
      const Nodal mass = masses(batch);
      Lane volume(0.0);
      for (std::size_t a = 0; a < n_nodes; ++a) {
        total += mass[a] * p[a];
        volume += mass[a];
      }
      Lane mean = select(volume > Lane(0.0), total / volume, Lane(0.0));
      repeat_last_element(mean, batch, geometry_.n_elements);  // padding has no volume
      return mean;
    } else {
      for (const Lane& value : p) total += value;
      return Lane(share) * total;
    }
  }
  /// The share of each node in that mean.
  Nodal mean_shares(Index batch) const {
    Nodal shares;
    shares.fill(Lane(share));
    if constexpr (hoop) {
      const Nodal mass = masses(batch);
      Lane volume(0.0);
      for (const Lane& m : mass) volume += m;
      for (std::size_t a = 0; a < n_nodes; ++a)
        shares[a] = select(volume > Lane(0.0), mass[a] / volume, Lane(0.0));  // padding has no volume
    }
    return shares;
  }
  /// ∫ b_a N_c dV in direction i, exact: in axisymmetry the hoop part is ∫ N_a N_c 2π dA.
  Lane divergence(const Operator& b, Index batch, std::size_t a, std::size_t i, std::size_t c,
                  const Nodal& mass) const {
    Lane d = b.gradient[a][i] * mass[c];
    if constexpr (hoop)
      if (i == 0) d += hoop_integral(batch) * Lane(a == c ? 2.0 : 1.0);
    return d;
  }
  /// ∫ N_a N_c 2π dA, a ≠ c.
  Lane hoop_integral(Index batch) const { return Lane(1.0 / 12.0) * weight(batch) * inverse_radius(batch); }
  /// f_a += ∫ b_a p dV.
  void add_pressure_force(const Operator& b, Index batch, const Nodal& p, Vectors& f) const {
    const Nodal mass = masses(batch);
    for (std::size_t a = 0; a < n_nodes; ++a)
      for (std::size_t c = 0; c < n_nodes; ++c)
        for (std::size_t i = 0; i < dim; ++i) f[a][i] += divergence(b, batch, a, i, c, mass) * p[c];
  }
  /// ∫ N_c div u dV, with that of the initial strain.
  Nodal volume_change(const Operator& b, Index batch, const Vectors& u) const {
    const Nodal mass = masses(batch);
    Nodal change{};
    if (b.initial != nullptr)
      for (std::size_t c = 0; c < n_nodes; ++c) change[c] = mass[c] * trace(*b.initial);
    for (std::size_t a = 0; a < n_nodes; ++a)
      for (std::size_t c = 0; c < n_nodes; ++c)
        for (std::size_t i = 0; i < dim; ++i) change[c] += divergence(b, batch, a, i, c, mass) * u[a][i];
    return change;
  }
  /// Position of a node of an element in an array of [local node][field].
  std::size_t place(Index batch, std::size_t node, std::size_t lane) const {
    const Index local = nodes(batch)[node * k_lanes + lane];
    return as_size(local) * as_size(field_.n_fields) + as_size(field_.field);
  }
  Nodal gather_pressure(std::span<const double> p, Index batch) const {
    Nodal result;
    for (std::size_t a = 0; a < n_nodes; ++a) {
      alignas(sizeof(Lane)) double values[k_lanes];
      for (std::size_t lane = 0; lane < k_lanes; ++lane) values[lane] = p[place(batch, a, lane)];
      result[a] = Lane::load(values);
    }
    return result;
  }
  void scatter_pressure(const Nodal& values, Index batch, std::span<double> out) const {
    for (std::size_t a = 0; a < n_nodes; ++a)
      for (std::size_t lane = 0; lane < k_lanes; ++lane)
        out[place(batch, a, lane)] += values[a][static_cast<int>(lane)];
  }

  /// scale (∫ N compliance N dV + (τ + Δt K/μ) V ∇N·∇N), [node][node].
  std::array<Lane, n_nodes * n_nodes> compliance_terms(const Lane& scale, const Lane& compliance,
                                                       Index batch) const {
    const Operator b = at_point(batch);
    const Lane w = weight(batch), stabilised = scale * w * (tau_[at(batch)] + flow_.mobility(batch));
    const Nodal mass = masses(batch);
    const Lane density = select(w > Lane(0.0), scale * compliance / w, Lane(0.0));  // padding has no volume
    std::array<Lane, n_nodes * n_nodes> terms;
    for (std::size_t a = 0; a < n_nodes; ++a)
      for (std::size_t c = 0; c < n_nodes; ++c) {
        Lane product(0.0);
        for (std::size_t i = 0; i < dim; ++i) product += b.gradient[a][i] * b.gradient[c][i];
        terms[a * n_nodes + c] = density * mass[a] * mass[c] + stabilised * product;
      }
    return terms;
  }

  /// rows −= τ V ∇N·g with orthogonal sub-scales, τ V ∇N·(g + ρ g_0) with algebraic ones, and V ∇N·q.
  void subtract_stabilisation(const Operator& b, Index batch, const Nodal& p, Nodal& rows) const {
    const Lane stabilised = tau_[at(batch)];
    const auto g = pressure_gradient(p, batch);
    const auto q = liquid_flow(g, batch);
    for (std::size_t i = 0; i < dim; ++i) {
      const Lane unresolved = orthogonal_ ? g[i] : g[i] + body_force(batch, i);
      const Lane flux = weight(batch) * (stabilised * unresolved + q[i]);
      for (std::size_t a = 0; a < n_nodes; ++a) rows[a] -= flux * b.gradient[a][i];
    }
  }
  /// q where the pressure has this gradient [m].
  std::array<Lane, dim> liquid_flow(const std::array<Lane, dim>& gradient, Index batch) const {
    std::array<Lane, dim> drive;
    for (std::size_t i = 0; i < dim; ++i) drive[i] = gradient[i] + body_force(batch, i);
    return flow_.total(batch, drive);
  }
  std::size_t bytes_of_nodes() const {
    return (compliance_.capacity() + twice_shear_.capacity() + tangent_shear_.capacity() +
            pore_compliance_.capacity() + tau_.capacity() + masses_.capacity() + body_force_.capacity()) *
               sizeof(Lane) +
           pressure_slots_.bytes() + flow_.bytes();
  }

  bool orthogonal_;
  PackVector<Lane> body_force_;                 ///< of each element [N/m³], [batch][direction]; empty: none
  std::span<const Sym<Lane>> strain_at_start_;  ///< of each batch; empty: none
  PressureField field_;
  PackVector<Lane> compliance_;   ///< 1/κ_v at the start of the step [1/Pa]
  PackVector<Lane> twice_shear_;  ///< 2Ĝ of the stabilisation [Pa]
  /// 2Ĝ of the last tangent [Pa]: what the Schur complement ∇·A⁻¹∇ and multigrid's share of the divergence go
  /// by. Where metal flows by many yield strains it is a hundredth of that of the stabilisation.
  PackVector<Lane> tangent_shear_;
  PackVector<Lane> pore_compliance_;  ///< of the last tangent (pores.hpp) [1/Pa]
  LiquidFlow<dim> flow_;

 private:
  const mesh::BlockGeometry& geometry_;
  linear::LaneSlots pressure_slots_;
  PackVector<Lane> tau_;     ///< [m²/Pa]
  PackVector<Lane> masses_;  ///< ∫ N_a dV, axisymmetric only: [batch][node]
};

}  // namespace solidus::mechanics
