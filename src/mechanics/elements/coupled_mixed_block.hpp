/// The kernel of the simultaneous scheme for mixed triangles and tetrahedra (mixed_kernel.hpp): displacement,
/// pressure and temperature of the iterate, and the coupling parts of the exact tangent.
///
/// The law sees ε̂ = dev ε(u) + ⅓ e_v 1 with e_v = p̄/k(Θ) + e^θ(Θ), so heat depends on the displacement
/// through dev ε alone, on the pressure through e_v, and on the temperature also through e_v. With the
/// derivatives h_ε, h_Θ, σ_Θ of coupled_points.hpp at ε̂, h_v = ⅓ tr h_ε and e_v,Θ = e^θ_Θ − p̄ k_Θ/k²
///
///   K_uΘ = ∫ Bᵀ dev σ_Θ N dV     K_Θu = ∫ M (dev h_ε)ᵀ B dV
/// and −ψ ζ/Δt e^θ_Θ in addition to σ_Θ where melt flows (compaction.hpp);
///
///   K_pΘ = −∫ N e_v,Θ N dV       K_Θp = ∫ M h_v/k N dV         K_ΘΘ += ∫ M (h_Θ + h_v e_v,Θ) N dV
///
/// The rows of the volume are those of r_p, times the unit of the pressure (nodal_pressure.hpp).
#pragma once

#include "mechanics/elements/coupled_points.hpp"
#include "mechanics/elements/mixed_block.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

template <int n_nodes, AnalysisKind kind>
class CoupledMixedBlock final : public CoupledPoints<MixedBlock<material::Viscoplastic, n_nodes, kind>> {
  using Base = CoupledPoints<MixedBlock<material::Viscoplastic, n_nodes, kind>>;
  using Base::dim, Base::gather;
  using typename Base::Nodal, typename Base::Operator, typename Base::Vectors, typename Base::Rates,
      typename Base::MixedPoint;

 public:
  using Base::Base;

  void add_coupling(const CoupledIterate& at, linear::CoupledMatrix& matrix) override {
    for (Index batch = 0; batch < this->geometry_.n_batches; ++batch) {
      const Operator b = this->at_point(batch);
      const Lane theta = temperature_at(this->geometry_, batch, 0, at.temperature);
      const Lane pressure = this->mean(this->gather_pressure(this->field_.pressure, batch), batch);
      const MixedPoint now = this->answer(batch, b.strain(gather(at.u, batch)), pressure);
      const Sym<Lane> before =
          this->strain(b.strain(gather(at.old_u, batch)), this->kept_volume(*this->old_history_, batch));
      const Rates d = this->rates(at.form, batch, 0, theta, now.strain, now.strain - before);
      const auto p = this->jets(batch, 0, theta).elastic;
      const Lane w = this->weight(batch), swelling = Lane(1.0 / 3.0) * trace(d.heat_strain),
                 expansion = p.thermal_strain.d - pressure * p.bulk.d / (p.bulk.v * p.bulk.v);
      Vectors pull{}, heating{};
      Sym<Lane> stress = dev(d.stress);
      for (int k = 0; k < 3; ++k) stress[k] -= this->compaction().by_expansion(batch) * p.thermal_strain.d;
      b.add_force(w * stress, pull);
      b.add_force(w * dev(d.heat_strain), heating);
      add(batch, pull, heating, Lane(at.pressure_unit) * expansion,
          Lane(at.pressure_unit) * w * swelling / p.bulk.v, w * (d.heat_temperature + swelling * expansion),
          matrix);
    }
  }

 private:
  /// @param expansion  e_v,Θ times the unit of the pressure
  /// @param pressing   ∫ h_v/k dV times that unit
  /// @param warming    ∫ h_Θ + h_v e_v,Θ dV
  void add(Index batch, const Vectors& pull, const Vectors& heating, const Lane& expansion,
           const Lane& pressing, const Lane& warming, linear::CoupledMatrix& matrix) const {
    const Nodal mass = this->masses(batch), mean = this->mean_shares(batch);
    const double* const values = this->values_at(0);
    const Lane* const spread = this->points_->spread(batch);
    const linear::BlockMatrix::Slot *const slots = this->slots_of(batch), *const heat_slots =
                                                                              this->heat_slots_of(batch);
    const auto field = as_size(this->field_.field);
    for (std::size_t a = 0; a < n_nodes; ++a) {
      const Lane test = heat_share(values, spread, a);
      for (std::size_t c = 0; c < n_nodes; ++c) {
        const Lane shape(values[c]);
        const Lane volume = Lane(0.0) - mass[a] * expansion * shape, by_pressure = test * pressing * mean[c],
                   by_temperature = test * shape * warming;
        for (std::size_t lane = 0; lane < k_lanes; ++lane) {
          const std::size_t pair = (a * n_nodes + c) * k_lanes + lane;
          const auto l = static_cast<int>(lane);
          double* const force = matrix.force_by_temperature(slots[pair]);
          double* const heat = matrix.heat_by_displacement(slots[pair]);
          for (std::size_t i = 0; i < dim; ++i) {
            force[i] += (pull[a][i] * shape)[l];
            heat[i] += (test * heating[c][i])[l];
          }
          matrix.volume_by_temperature(slots[pair])[field] += volume[l];
          matrix.heat_by_pressure(slots[pair])[field] += by_pressure[l];
          *matrix.temperature().block(heat_slots[pair]) += by_temperature[l];
        }
      }
    }
  }
};

}  // namespace solidus::mechanics
