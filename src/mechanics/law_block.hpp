/// The kernels of the displacement formulation: forces, tangent and update of one mesh block for one law,
/// shape and analysis kind, eight elements at a time.
#pragma once

#include <array>
#include <optional>

#include "mechanics/element_matrix.hpp"
#include "mechanics/padding.hpp"
#include "mechanics/point_block.hpp"

namespace solidus::mechanics {

template <class Law, int n_nodes, AnalysisKind kind, bool b_bar>
class LawBlock : public PointBlock<Law, n_nodes, kind, b_bar> {
 protected:
  using Base = PointBlock<Law, n_nodes, kind, b_bar>;
  using Base::dim, Base::gather, Base::nodes_of, Base::geometry_;

 public:
  using typename Base::Operator, typename Base::Vectors, typename Base::Properties, typename Base::Response,
      typename Base::Matrix;

  LawBlock(const mesh::Mesh& mesh, const mesh::Block& block, const material::Material& material)
      : Base(mesh, block, material) {}

  double prepare(const StepStart& start) override {
    this->begin_step(start);
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
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Vectors displacement = gather(u, batch);
      Vectors f{};
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Operator b = at_point(batch, q);
        const auto response = this->update(batch, q, b.strain(displacement));
        b.add_force(geometry_.weight_at(batch, q) * response.stress, f);
        if (response.status != material::Status::converged) this->spoil(f);
      }
      total += this->counted(batch) * this->squares(f);
      scatter<n_nodes, Operator::dim>(f, nodes_of(batch), forces);
    }
    return sum(total);
  }

  void add_tangent(std::span<const double> u, algebra::BlockMatrix& matrix) override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Vectors displacement = gather(u, batch);
      Matrix symmetric;
      std::optional<Matrix> skew;
      if (!this->law_.symmetric()) skew.emplace();
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Operator b = at_point(batch, q);
        const Lane w = geometry_.weight_at(batch, q);
        const auto response = this->update(batch, q, b.strain(displacement));
        if constexpr (IsotropicTangent<Response>) {
          add_isotropic(b, w * response.bulk, w * response.twice_shear, symmetric);
        } else {
          Sym4<Lane> c = response.tangent;
          for (auto& row : c.c)
            for (auto& entry : row) entry *= w;
          add_general(b, c, symmetric);
        }
        if constexpr (RankOneTangent<Response>) this->add_flow(b, batch, q, response, w, symmetric, skew);
        if constexpr (AdiabaticTangent<Response>)
          this->add_rank_one(b, response.thermal_left, response.thermal_right, w * response.thermal_factor,
                             Lane(1.0), symmetric, skew);
      }
      scatter<1>(symmetric, this->slots_of(batch), matrix);
      if (skew) scatter<-1>(*skew, this->slots_of(batch), matrix);
    }
  }

  BlockWork finish(std::span<const double> old_u, std::span<const double> u, BlockHistory& trial) override {
    typename Base::Tally tally;
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Vectors old_displacement = gather(old_u, batch), displacement = gather(u, batch);
      typename Base::Average average;
      for (int q = 0; q < geometry_.n_points; ++q) {
        const Operator b = at_point(batch, q);
        const Sym<Lane> strain = b.strain(displacement);
        this->record(batch, q, b.strain(old_displacement), strain, this->update(batch, q, strain), trial,
                     average, tally);
      }
      this->keep(batch, average);
    }
    return this->total(tally);
  }

  void rest(const StepStart& start) override {
    prepare(start);
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Vectors displacement = gather(start.held_displacement, batch);
      for (int q = 0; q < geometry_.n_points; ++q)
        this->points_.rest(batch, q,
                           this->deformation(at_point(batch, q).strain(displacement),
                                             this->old_state(batch, q), this->is_solid(batch, q)));
    }
  }

  std::string failure(std::span<const double> u) const override {
    for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
      const Vectors displacement = gather(u, batch);
      for (int q = 0; q < geometry_.n_points; ++q) {
        std::string text = this->failure_at(batch, q, at_point(batch, q).strain(displacement));
        if (!text.empty()) return text;
      }
    }
    return {};
  }

 protected:  // for the kernel of the simultaneous scheme (coupled_block.hpp)
  Operator at_point(Index batch, int point) const {
    if constexpr (b_bar)
      if (batch != held_batch_) hold_mean(batch);
    return operator_at(batch, point, b_bar ? mean_.data() : nullptr);
  }

 private:
  Operator operator_at(Index batch, int point, const Lane* mean) const {
    return Operator(geometry_.gradients_at(batch, point), this->values_at(point),
                    this->inverse_radius(batch, point), mean);
  }
  /// b̄_a of 6.23.
  void hold_mean(Index batch) const {
    const std::array<Lane, n_nodes * dim> unused{};
    std::array<Lane, n_nodes * dim> total{};
    Lane volume(0.0);
    for (int q = 0; q < geometry_.n_points; ++q) {
      const Operator b = operator_at(batch, q, unused.data());
      const Lane w = geometry_.weight_at(batch, q);
      volume += w;
      for (std::size_t a = 0; a < n_nodes; ++a)
        for (std::size_t i = 0; i < dim; ++i) total[a * dim + i] += w * b.divergence(a, i);
    }
    const Lane inverse = select(volume > Lane(0.0), Lane(1.0) / volume, Lane(0.0));
    for (std::size_t i = 0; i < n_nodes * dim; ++i) {
      mean_[i] = inverse * total[i];
      repeat_last_element(mean_[i], batch, geometry_.n_elements);  // padding has no volume
    }
    held_batch_ = batch;
  }

  // B-bar only: of the batch that was asked for last, as the gradients are.
  mutable Index held_batch_ = -1;
  mutable std::array<Lane, n_nodes * dim> mean_{};  ///< b̄_a, [node][dim]
};

}  // namespace solidus::mechanics
