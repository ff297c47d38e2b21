/// Derivatives at one point, compiled once here for the kernels of all shapes.
#include "mechanics/elements/coupled_rates.hpp"

#include "material/derivatives/structural_lines.hpp"
#include "material/derivatives/structural_partials.hpp"
#include "material/derivatives/thermal_derivatives_impl.hpp"

namespace solidus::mechanics {
namespace {

/// Cᵀ : a.
Sym<Lane> transposed_tangent(const material::Viscoplastic::Response<Lane>& r, const Sym<Lane>& a) {
  Sym<Lane> t = r.twice_shear * dev(a) + dot(r.left, a) * r.right;
  const Lane volumetric = r.bulk * trace(a);
  for (int i = 0; i < 3; ++i) t[i] += volumetric;
  return t;
}

}  // namespace

CoupledRates coupled_rates(const CoupledUpdate& at, std::optional<StructuralForm> form) {
  // One variation of the update of the law gives all derivatives that the coupled tangent needs: of stress,
  // internal energy, entropy and dissipation.
  const material::Variation<Lane> update(at.law, at.properties, at.start, at.strain, at.effective,
                                         at.response);
  CoupledRates d;
  d.stress = update.stress();
  if (!form) return d;
  const material::Material& material = at.law.material();
  // The structural parts are those of the lines along which the tables are continued in this step.
  const auto& now = at.point.now;
  const auto elastic =
      material::elastic_along(material, at.point.lines, at.temperature, at.point.strain_offset);
  const auto flow =
      material::hardening_along(material, now.hardening, at.point.lines.temperature, at.temperature);
  const auto partials = material::structural_partials<Lane>(
      material, elastic, flow ? &*flow : nullptr, at.temperature, now.strain_trace, now.elastic_squared,
      at.properties.elastic.solid_fraction.v >= Lane(1.0), now.hardening, now.back_squared);
  const Lane rate(1.0 / at.dt);
  // Energy form: the heat is [E − E_n − σ at work : Δε]/Δt. With a Taylor–Quinney factor what is stored as
  // cold work belongs to the energy.
  if (form == StructuralForm::energy) {
    auto energy = update.along(partials.internal_energy);
    if (material.flow && material.flow->heat_share) {
      const auto stored = update.cold_work();
      energy.temperature += stored.temperature;
      energy.strain += stored.strain;
    }
    const Lane at_end(at.stress_share);  // of σ in the stress at work
    d.heat_temperature = rate * (energy.temperature - at_end * dot(d.stress, at.increment));
    d.heat_strain =
        rate * (energy.strain - at.at_work - at_end * transposed_tangent(at.response, at.increment));
  } else {
    // Entropy form: the heat is Θ (S − S_n)/Δt − D_mech, whose derivative has the entropy itself and its
    // slope.
    const auto entropy = update.along(partials.entropy);
    const auto dissipation = update.dissipation();
    d.heat_temperature =
        rate * (entropy.value - at.point.old_entropy + at.temperature * entropy.temperature) -
        dissipation.temperature;
    d.heat_strain = Lane(rate * at.temperature) * entropy.strain - dissipation.strain;
  }
  return d;
}

material::Viscoplastic::Properties<Jet<Lane>> coupled_properties(
    const material::Viscoplastic& law, Lane temperature, Lane initial_temperature,
    const material::PointProperties<Lane>& held) {
  auto p = thermal_properties(law, temperature, initial_temperature, material::Frozen{.phase = true});
  p.elastic.thermal_strain.v = held.thermal_strain;
  p.elastic.solid_fraction.v = held.solid_fraction;
  if (law.material().chooses_viscosity()) p.elastic.viscosity = Jet<Lane>(held.viscosity);
  return p;
}

}  // namespace solidus::mechanics
