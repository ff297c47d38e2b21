/// The kernels of the displacement formulation: forces, tangent and update of one mesh block for one law,
/// shape and analysis kind, eight elements at a time.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "mechanics/elements/element_matrix.hpp"
#include "mechanics/elements/kept_tangents.hpp"
#include "mechanics/elements/padding.hpp"
#include "mechanics/elements/point_block.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

/// Number of the volumetric modes Ψ of B-bar (6.14): the constant, and in quads and hexes of second order
/// also the element's own coordinates ξ, η, ζ. One constant would cost those an order; all that their
/// divergence can be leaves a melt no way to flow: a 20-node hex would have 27 points that keep their volume
/// for 12 displacements.
template <int n_nodes, AnalysisKind kind>
inline constexpr std::size_t k_volumetric_modes = n_nodes == (kind == AnalysisKind::solid ? 20 : 8)
                                                      ? displacement_components(kind) + 1
                                                      : 1;

template <class Law, int n_nodes, AnalysisKind kind, bool b_bar>
class LawBlock : public PointBlock<Law, n_nodes, kind, b_bar> {
 protected:
  using Base = PointBlock<Law, n_nodes, kind, b_bar>;
  using Base::dim, Base::gather, Base::nodes_of, Base::geometry_;

 public:
  using typename Base::Operator, typename Base::Vectors, typename Base::Properties, typename Base::Response,
      typename Base::Matrix;

  LawBlock(const mesh::Mesh& mesh, const mesh::ElementBlock& block, const material::Material& material)
      : Base(mesh, block, material), tangents_(this->law_.symmetric()) {
    if constexpr (b_bar)
      for (const mesh::QuadraturePoint& point : mesh::stiffness_rule(block.shape)) {
        modes_.push_back(1.0);
        for (std::size_t k = 1; k < n_modes; ++k) modes_.push_back(point.xi[k - 1]);
      }
  }

  double prepare(const StepStart& start) override {
    this->begin_step(start);
    tangents_.clear();
    Lane scale(0.0);
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      [[maybe_unused]] const Vectors held_displacement = gather(start.held_displacement, batch);
      Vectors f{};
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Operator b = at_point(batch, q);
        Sym<Lane> held_strain;
        if constexpr (HoldsEntropy<Properties>) held_strain = b.strain(held_displacement);
        const Lane bulk = this->set_properties(start, batch, q, held_strain);
        this->add_stiffness(b, bulk * geometry_.weight_at(batch, q), f);
      }
      scale += this->counted(batch) * this->squares(f);
    }
    return sum(scale);
  }

  double add_forces(std::span<const double> u, std::span<double> forces) override {
    Lane total(0.0);
    Workspace<Law> space(this->law_);
    if constexpr (KeepsStateInPlace<Law>) tangents_.begin(u, this->properties_.size());
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Vectors displacement = gather(u, batch);
      Vectors f{};
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Operator b = at_point(batch, q);
        const Sym<Lane> strain = b.strain(displacement);
        const Response response = this->update(batch, q, strain, space);
        if constexpr (KeepsStateInPlace<Law>) tangents_.keep(this->index(batch, q), response.tangent);
        b.add_force(geometry_.weight_at(batch, q) * response.stress, f);
        if (response.status != material::Status::converged) this->invalidate(f);
      }
      total += this->counted(batch) * this->squares(f);
      scatter<n_nodes, Operator::dim>(f, nodes_of(batch), forces);
    }
    return sum(total);
  }

  void add_tangent(std::span<const double> u, linear::BlockMatrix& matrix) override {
    // Element matrices are summed point by point in lanes of elements. A law that keeps its state may have
    // stored its tangent with the last residual at the same displacement, which then serves here.
    Workspace<Law> space(this->law_);
    const bool kept = KeepsStateInPlace<Law> && tangents_.are_at(u);
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Vectors displacement = gather(u, batch);
      // Only an unsymmetric law has a skew part, which is scattered with the opposite sign to the transposed
      // place.
      Matrix symmetric;
      std::optional<Matrix> skew;
      if (!this->law_.symmetric()) skew.emplace();
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Operator b = at_point(batch, q);
        const Lane w = geometry_.weight_at(batch, q);
        const Sym<Lane> strain = b.strain(displacement);
        // An isotropic tangent needs two moduli, and a rank-one part where the point flows and where the
        // update is adiabatic; anything else is a full 6×6 matrix.
        if constexpr (IsotropicTangent<Response>) {
          const Response response = this->update(batch, q, strain, space);
          add_isotropic(b, w * response.bulk, w * response.twice_shear, symmetric);
          if constexpr (RankOneTangent<Response>) this->add_flow(b, batch, q, response, w, symmetric, skew);
          if constexpr (AdiabaticTangent<Response>)
            this->add_rank_one(b, response.thermal_left, response.thermal_right, w * response.thermal_factor,
                               Lane(1.0), symmetric, skew);
        } else {
          const Sym4<Lane> full =
              kept ? tangents_.at(this->index(batch, q)) : this->update(batch, q, strain, space).tangent;
          add_general(b, symmetric_part(full, w), symmetric);
          if (skew) add_general(b, skew_part(full, w), *skew);
        }
      }
      scatter<1>(symmetric, this->slots_of(batch), matrix);
      if (skew) scatter<-1>(*skew, this->slots_of(batch), matrix);
    }
  }

  BlockWork finish(std::span<const double> old_u, std::span<const double> u, const BlockEnd& end) override {
    auto* const averages = this->begin_finish(end);
    StepSums sums;
    Workspace<Law> space(this->law_);
    if constexpr (KeepsStateInPlace<Law>) space.wants_tangent = false;
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Vectors old_displacement = gather(old_u, batch), displacement = gather(u, batch);
      typename Base::Average average;
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Operator b = at_point(batch, q);
        const Sym<Lane> strain = b.strain(displacement);
        this->record(batch, q, b.strain(old_displacement), strain, this->update(batch, q, strain, space), end,
                     average, sums);
      }
      this->keep(batch, average, averages);
    }
    this->hand_out_deformation(end);
    return sums.total(this->dt_);
  }

  FlowChange restart_flow(const StepStart& start, std::span<const double> old_u, std::span<const double> u,
                          const BlockEnd& end) override {
    auto* const averages = this->begin_restart(end);
    typename Base::Restart restart;
    Workspace<Law> space(this->law_);
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Vectors old_displacement = gather(old_u, batch), displacement = gather(u, batch);
      typename Base::Average average;
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Operator b = at_point(batch, q);
        this->restart_point(start, batch, q, b.strain(old_displacement), b.strain(displacement), space,
                            end.history, average, restart);
      }
      this->keep(batch, average, averages);
    }
    this->hand_out_deformation(end);
    return this->total(restart);
  }

  std::shared_ptr<const StructuralPoints> held_deformation(const StepStart& start) override {
    prepare(start);
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Vectors displacement = gather(start.held_displacement, batch);
      for (int q = 0; q < geometry_.n_points; ++q)
        this->hold_point(batch, q, at_point(batch, q).strain(displacement));
    }
    return this->deformation_held(start);
  }

  LawFailure failure(std::span<const double> u) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Vectors displacement = gather(u, batch);
      for (int q = 0; q < geometry_.n_points; ++q) {
        LawFailure found = this->failure_at(batch, q, at_point(batch, q).strain(displacement));
        if (!found.text.empty()) return found;
      }
    }
    return {};
  }

  FlowingVolume flowing(std::span<const double> u) const override {
    FlowingVolume volume;
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Vectors displacement = gather(u, batch);
      for (int q = 0; q < geometry_.n_points; ++q)
        this->add_flowing(batch, q, at_point(batch, q).strain(displacement), volume);
    }
    return volume;
  }

  std::size_t bytes() const override {
    if constexpr (KeepsStateInPlace<Law>)
      return Base::bytes() + tangents_.bytes();
    else
      return Base::bytes();
  }

 protected:  // for the kernel of the simultaneous scheme (coupled_block.hpp)
  Operator at_point(Index batch, int point) const {
    if constexpr (b_bar) {
      if (batch != held_batch_) hold_mean(batch);
      if constexpr (n_modes > 1) {
        NodalValues mean = mean_[0];
        for (std::size_t k = 1; k < n_modes; ++k) {
          const Lane mode(mode_at(point, k));
          for (std::size_t i = 0; i < n_values; ++i) mean[i] += mode * mean_[k][i];
        }
        return operator_at(batch, point, mean.data());
      }
      return operator_at(batch, point, mean_[0].data());
    }
    return operator_at(batch, point, nullptr);
  }

 private:
  static constexpr std::size_t n_values = n_nodes * dim, n_modes = k_volumetric_modes<n_nodes, kind>;
  using NodalValues = std::array<Lane, n_values>;  ///< [node][dim]

  Operator operator_at(Index batch, int point, const Lane* mean) const {
    Operator b(geometry_.gradients_at(batch, point), this->values_at(point),
               this->inverse_radius(batch, point), mean);
    b.initial = this->initial_strain(batch, point);
    return b;
  }
  /// Ψ_k at a point.
  double mode_at(int point, std::size_t k) const { return modes_[as_size(point) * n_modes + k]; }
  /// H⁻¹ ∫ Ψ b_a dV of 6.23, the factors of Ψ in b̄_a.
  void hold_mean(Index batch) const {
    const NodalValues unused{};
    std::array<NodalValues, n_modes> total{};
    std::array<std::array<Lane, n_modes>, n_modes> h{};  // (6.18)
    for (int q = 0; q < geometry_.n_points; ++q) {
      const Operator b = operator_at(batch, q, unused.data());
      const Lane w = geometry_.weight_at(batch, q);
      for (std::size_t k = 0; k < n_modes; ++k) {
        const Lane of_mode = Lane(mode_at(q, k)) * w;
        for (std::size_t l = 0; l < n_modes; ++l) h[k][l] += of_mode * Lane(mode_at(q, l));
        for (std::size_t a = 0; a < n_nodes; ++a)
          for (std::size_t i = 0; i < dim; ++i) total[k][a * dim + i] += of_mode * b.divergence(a, i);
      }
    }
    const LaneMask has_volume = h[0][0] > Lane(0.0);  // padding has none
    // Elimination without pivoting: H is positive definite.
    for (std::size_t k = 0; k < n_modes; ++k) {
      const Lane inverse = select(has_volume, Lane(1.0) / h[k][k], Lane(0.0));
      for (std::size_t l = 0; l < n_modes; ++l) {
        if (l == k) continue;
        const Lane factor = inverse * h[l][k];
        for (std::size_t m = k; m < n_modes; ++m) h[l][m] -= factor * h[k][m];
        for (std::size_t i = 0; i < n_values; ++i) total[l][i] -= factor * total[k][i];
      }
    }
    for (std::size_t k = 0; k < n_modes; ++k) {
      const Lane inverse = select(has_volume, Lane(1.0) / h[k][k], Lane(0.0));
      for (std::size_t i = 0; i < n_values; ++i) {
        mean_[k][i] = inverse * total[k][i];
        repeat_last_element(mean_[k][i], batch, geometry_.n_elements);
      }
    }
    held_batch_ = batch;
  }

  KeptTangents tangents_;  ///< of a law whose state lies in place, which is not to be asked twice
  // B-bar only: the modes, [point][mode]; and of the batch that was asked for last, as the gradients are,
  // the factors of Ψ in b̄_a, [mode][node][dim].
  std::vector<double> modes_;
  mutable Index held_batch_ = -1;
  mutable std::array<NodalValues, n_modes> mean_{};
};

}  // namespace solidus::mechanics
