/// The kernel of the simultaneous scheme: the viscoplastic block (without flow it is viscoelastic) at the
/// temperature of the iterate, and the coupling parts of the exact tangent (monograph 4.1).
///
///   K_uΘ = ∫ B̄ᵀ σ_Θ N dV        K_Θu = ∫ M h_εᵀ B̄ dV        K_ΘΘ += ∫ M h_Θ N dV
///
/// with the derivatives of coupled_points.hpp. M is N and the share by which StructuralPoints spreads heat as
/// it is stored.
#pragma once

#include "mechanics/elements/coupled_points.hpp"
#include "mechanics/elements/law_block.hpp"

namespace solidus::mechanics {

template <int n_nodes, AnalysisKind kind, bool b_bar>
class CoupledBlock final : public CoupledPoints<LawBlock<material::Viscoplastic, n_nodes, kind, b_bar>> {
  using Base = CoupledPoints<LawBlock<material::Viscoplastic, n_nodes, kind, b_bar>>;
  using Base::dim, Base::at_point, Base::gather;
  using typename Base::Operator, typename Base::Vectors, typename Base::Rates;

 public:
  using Base::Base;

  void add_coupling(const CoupledIterate& at, linear::CoupledMatrix& matrix) override {
    for (Index batch = 0; batch < this->geometry_.n_batches; ++batch) {
      const Vectors displacement = gather(at.u, batch), old_displacement = gather(at.old_u, batch);
      Element element;
      for (int q = 0; q < this->geometry_.n_points; ++q) {
        const Operator b = at_point(batch, q);
        const Lane theta = temperature_at(this->geometry_, batch, q, at.temperature);
        const Sym<Lane> strain = b.strain(displacement);
        const Rates d = this->rates(at.form, batch, q, theta, strain, strain - b.strain(old_displacement));
        element.add(b, this->values_at(q), this->points_->spread(batch), this->geometry_.weight_at(batch, q),
                    d);
      }
      scatter(element, batch, matrix);
    }
  }

 private:
  /// K_uΘ and K_Θu, [a][b][i] with a the row's node, and K_ΘΘ, [a][b].
  struct Element {
    std::array<std::array<std::array<Lane, dim>, n_nodes>, n_nodes> force{}, heat{};
    std::array<std::array<Lane, n_nodes>, n_nodes> capacity{};

    /// @param values, spread  N_a, M_a − N_a (none: zero)
    void add(const Operator& b, const double* values, const Lane* spread, Lane weight, const Rates& d) {
      Vectors pull{}, heating{};
      b.add_force(weight * d.stress, pull);
      b.add_force(weight * d.heat_strain, heating);
      const Lane warming = weight * d.heat_temperature;
      for (std::size_t p = 0; p < n_nodes; ++p) {
        const Lane test = heat_share(values, spread, p);
        for (std::size_t q = 0; q < n_nodes; ++q) {
          const Lane shape(values[q]);
          for (std::size_t i = 0; i < dim; ++i) {
            force[p][q][i] += pull[p][i] * shape;
            heat[p][q][i] += test * heating[q][i];
          }
          capacity[p][q] += test * shape * warming;
        }
      }
    }
  };

  void scatter(const Element& element, Index batch, linear::CoupledMatrix& matrix) const {
    const linear::BlockMatrix::Slot *const slots = this->slots_of(batch), *const heat_slots =
                                                                              this->heat_slots_of(batch);
    for (std::size_t a = 0; a < n_nodes; ++a)
      for (std::size_t b = 0; b < n_nodes; ++b) {
        const std::size_t pair = (a * n_nodes + b) * k_lanes;
        for (std::size_t lane = 0; lane < k_lanes; ++lane) {
          const auto l = static_cast<int>(lane);
          double* const force = matrix.force_by_temperature(slots[pair + lane]);
          double* const heat = matrix.heat_by_displacement(slots[pair + lane]);
          for (std::size_t i = 0; i < dim; ++i) {
            force[i] += element.force[a][b][i][l];
            heat[i] += element.heat[a][b][i][l];
          }
          *matrix.temperature().block(heat_slots[pair + lane]) += element.capacity[a][b][l];
        }
      }
  }
};

}  // namespace solidus::mechanics
