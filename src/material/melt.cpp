/// The modulus of a melt is the largest that neither its weight nor its shell notices, but not so small
/// that it drowns in rounding.
#include "material/melt.hpp"

#include <fmt/format.h>

namespace solidus::material {

namespace {

double shear_at(const Material& material, double theta) {
  return material.young_modulus.value(theta) / (2 * (1 + material.poisson_ratio.value(theta)));
}

/// σ_s: the yield stress at the solidus, or what stands for it without plasticity; may be zero.
double shell_strength(const Material& material) {
  const double solidus = material.solidification()->fraction.solidus();
  return material.flow ? material.flow->flow_stress.value(solidus)
                       : k_shell_strain * shear_at(material, solidus);
}

}  // namespace

MushViscosity mush_viscosity(const Material& material) {
  const double coherency = material.casting.coherency_fraction;
  if (coherency >= 1) return {};
  double strength = shell_strength(material);
  if (!(strength > 0))
    strength = k_shell_strain * shear_at(material, material.solidification()->fraction.solidus());
  return {.coherency = coherency,
          .at_coherency = k_mush_strength * strength / k_mush_rate,
          .rise = -std::log(k_mush_strength) / (1 - coherency),
          .onset = -std::log(k_mush_onset) / k_mush_onset_width};
}

namespace {

double relaxation_time(const Material& material, double section) {
  const double liquidus = material.solidification()->fraction.liquidus();
  const double conductivity = material.conductivity.value(liquidus),
               capacity = material.density * material.specific_heat.value(liquidus);
  const double diffusivity = conductivity > 0 && capacity > 0 ? conductivity / capacity : k_metal_diffusivity;
  return k_melt_time * (section > 0 ? section * section : k_section * k_section) / diffusivity;
}

}  // namespace

MeltModulus melt_modulus(const Material& material, double gravity, double extent, double section) {
  using Bound = MeltModulus::Bound;
  // The scale is the pressure of the melt's own weight: below some multiples of it the melt would
  // sag.
  if (!material.mechanical() || !material.chooses_viscosity()) return {};
  const double liquidus = material.solidification()->fraction.liquidus();
  const double head = material.density * gravity * extent;
  MeltModulus melt{.extent = head > 0 ? extent : 0.0};
  const auto set = [&melt](double share, double reference, Bound bound) {
    melt.modulus = share * reference;
    melt.reference = reference;
    melt.bound = bound;
  };
  // A multiple of the pressure of the melt's own weight, less where the shell is weaker than that, but no
  // less than what the arithmetic can tell from the bulk modulus.
  if (head > 0)
    set(k_melt_heads, head, Bound::head);
  else
    set(k_melt_heads, k_weightless_head, Bound::weightless);
  // A shell that is weaker than that must not be carried by its melt.
  const double strength = shell_strength(material);
  if (strength > 0 && k_melt_strengths * strength < melt.modulus)
    set(k_melt_strengths, strength, Bound::strength);
  // The least modulus keeps a share of the bulk modulus, since both are in one matrix.
  const double bulk =
      material.young_modulus.value(liquidus) / (3 * (1 - 2 * material.poisson_ratio.value(liquidus)));
  if (k_least_melt_share * bulk > melt.modulus) set(k_least_melt_share, bulk, Bound::arithmetic);
  melt.mush = mush_viscosity(material);
  melt.time = relaxation_time(material, section);
  melt.bulk = bulk;
  return melt;
}

std::string measured_against(const MeltModulus& melt) {
  using Bound = MeltModulus::Bound;
  switch (melt.bound) {
    case Bound::head:
      return fmt::format("{:g} times the metallostatic head of {:.3g} Pa (rho g H, H = {:.3g} m)",
                         k_melt_heads, melt.reference, melt.extent);
    case Bound::weightless:
      return fmt::format("{:g} times {:g} Pa, for there is no gravity", k_melt_heads, melt.reference);
    case Bound::strength:
      return fmt::format("{:g} times the strength of the shell of {:.3g} Pa at the solidus", k_melt_strengths,
                         melt.reference);
    case Bound::arithmetic:
      break;
  }
  return fmt::format("{:g} of the bulk modulus of {:.3g} Pa, the least that the arithmetic can resolve",
                     k_least_melt_share, melt.reference);
}

}  // namespace solidus::material
