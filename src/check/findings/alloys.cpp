// Findings on the data of what freezes: numbers that each alone could be those of some metal.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "check/finding_family.hpp"
#include "material/laws/rate_law.hpp"
#include "material/melt.hpp"
#include "setup/body_input.hpp"

namespace solidus::check {

namespace {

// Of metals; the comments of the functions say where each comes from.
constexpr double k_silicon = 1.5e6;  // a latent heat that no metal has, but silicon [J/kg]
constexpr double k_least_entropy = 0.3e6, k_most_entropy = 2.1e6, k_most_of_silicon = 2.7e6;  // [J/(m³ K)]
constexpr double k_least_capacity = 1e6, k_most_capacity = 6e6;                               // [J/(m³ K)]
constexpr double k_light = 3500, k_least_of_light = 30;                  // [kg/m³], [W/(m K)]
constexpr double k_least_growth = 0.006;                                 // expansion times liquidus
constexpr double k_least_stiffness = 0.018e9, k_most_stiffness = 0.3e9;  // over the liquidus [Pa/K]
constexpr double k_next_to_none = 0.002;                                 // a change of volume
constexpr double k_softened = 0.5, k_stiff = 0.9;                        // at the solidus, of when cold
constexpr double k_rate = 1e-3, k_least_creep = 0.2, k_most_creep = 8;   // [1/s]; of the flow stress
constexpr double k_finest = 1e-6, k_coarsest = 1e-3;                     // secondary arms [m]
constexpr double k_thinnest = 2e-4, k_thickest = 3e-2;                   // viscosities of melts [Pa s]
constexpr double k_first_coherent = 0.2;                                 // solid fraction
constexpr double k_no_shear = 1e-3 * material::k_least_melt_share;       // of the bulk modulus

void warn(const cases::BodySpec& body, const std::string& what, const char* usual, Findings& findings) {
  findings.push_back({false, body.where,
                      fmt::format("body '{}', material '{}': {}", body.name, body.material, what), usual});
}

/// Richards' rule (J. W. Richards, 1897): metals gain about the gas constant in entropy, per mole, as they
/// melt. Per volume, which needs no molar mass, L ρ/Θ_L is 0.43 for lead, 0.7 for magnesium, 1.1 to 1.2 for
/// aluminium, iron and zinc, 1.65 for aluminium with 12 % silicon and 2.5 for silicon itself, whose latent
/// heat no metal has [MJ/(m³ K)].
void compare_entropy_of_melting(const cases::BodySpec& body, const material::Material& m,
                                Findings& findings) {
  const material::PhaseChange& freezing = *m.solidification();
  const double most = freezing.latent_heat > k_silicon ? k_most_of_silicon : k_most_entropy;
  const double entropy = freezing.latent_heat * m.density / freezing.fraction.liquidus();
  if (entropy >= k_least_entropy && entropy <= most) return;
  warn(body,
       fmt::format("a latent heat of {:.4g} kJ/kg at {:.4g} kg/m3 and a liquidus of {:.4g} K: {:.3g} MJ/m3 "
                   "for each kelvin of it",
                   1e-3 * freezing.latent_heat, m.density, freezing.fraction.liquidus(), 1e-6 * entropy),
       "metals have 0.4 to 1.7 MJ/m3/K; is the latent heat one of a kilogram, in kJ/kg?", findings);
}

/// Dulong and Petit's rule: a mole of any metal takes about 25 J/K, 7 to 15 cm³ of it. Per volume that is 1.5
/// for lead, 1.8 for magnesium, 2.4 for aluminium, 3.5 for copper and iron, 4 for nickel [MJ/(m³ K)].
void compare_heat_capacity(const cases::BodySpec& body, const material::Material& m, Findings& findings) {
  constexpr double k_cold = 293.15;  // [K]
  const double capacity = m.density * m.specific_heat.value(k_cold);
  if (capacity >= k_least_capacity && capacity <= k_most_capacity) return;
  warn(body,
       fmt::format("a specific heat of {:.4g} J/kg/K at {:.4g} kg/m3: {:.3g} MJ/m3/K at 20 degC",
                   m.specific_heat.value(k_cold), m.density, 1e-6 * capacity),
       "cold metals have 1.4 to 4 MJ/m3/K; is the specific heat one of a kilogram, in J and not in cal, and "
       "the density that of this metal?",
       findings);
}

/// Aluminium, magnesium and their alloys, lighter than titanium, conduct 50 to 240 W/(m K).
void compare_conductivity_of_light_metal(const cases::BodySpec& body, const material::Material& m,
                                         Findings& findings) {
  const double solid = m.conductivity.value(m.solidification()->fraction.solidus());
  if (m.density > k_light || solid >= k_least_of_light || solid < 3)
    return;  // below 3: findings/material.cpp
  warn(body, fmt::format("a conductivity of {:.3g} W/m/K at its solidus, at {:.4g} kg/m3", solid, m.density),
       "aluminium and magnesium conduct 50 to 240 W/m/K", findings);
}

/// Grüneisen's rule: up to their melting point metals gain about 7 % of volume, so that the expansion times
/// the melting point is near 0.02, 0.011 for tin.
void compare_expansion(const cases::BodySpec& body, const material::Material& m, Findings& findings) {
  const double liquidus = m.solidification()->fraction.liquidus(), most = m.expansion.max_value();
  if (!(most > 1e-8) || most * liquidus >= k_least_growth)
    return;  // below: findings/material.cpp, or none at all
  warn(body, fmt::format("expansion of {:.3g} 1/K at most, with a liquidus of {:.4g} K", most, liquidus),
       "metals expand by about 0.02 over their liquidus in K: 1.1e-5 (iron) to 3e-5 1/K (zinc)", findings);
}

/// Young's modulus of a cold metal over its liquidus is 0.027 (lead) to 0.16 (zinc) GPa/K.
void compare_stiffness_with_liquidus(const cases::BodySpec& body, const material::Material& m,
                                     Findings& findings) {
  constexpr double k_cold = 293.15;  // [K]
  const double liquidus = m.solidification()->fraction.liquidus(), cold = m.young_modulus.value(k_cold);
  if (cold < 1e9 || (cold >= k_least_stiffness * liquidus && cold <= k_most_stiffness * liquidus)) return;
  warn(body,
       fmt::format("a young_modulus of {:.3g} GPa at 20 degC, with a liquidus of {:.4g} K", 1e-9 * cold,
                   liquidus),
       "metals have 0.05 to 0.16 GPa for each kelvin of it: 45 (magnesium), 70 (aluminium), 210 GPa (steel)",
       findings);
}

/// A change of volume that is next to none was perhaps meant as a percentage of a percentage.
void compare_volume_change(const cases::BodySpec& body, const material::Material& m, Findings& findings) {
  const double change = m.solidification()->volume_change;
  if (change == 0 || std::abs(change) >= k_next_to_none) return;
  warn(body, fmt::format("'{}' changes the volume by {:.2g} %", m.solidification()->name, 100 * change),
       "metals shrink by 1 to 7 % as they freeze, volume_change = -0.07 to -0.01; zero: not at all",
       findings);
}

/// Metal at its solidus has next to nothing of its strength when cold.
void compare_softening(const cases::BodySpec& body, const material::Material& m, Findings& findings) {
  if (!m.flow) return;
  constexpr double k_cold = 293.15;  // [K]
  const double cold = m.flow->flow_stress.value(k_cold),
               hot = m.flow->flow_stress.value(m.solidification()->fraction.solidus());
  if (hot <= k_softened * cold) return;
  warn(body,
       fmt::format("a flow_stress of {:.3g} MPa at 20 degC and of {:.3g} MPa at its solidus", 1e-6 * cold,
                   1e-6 * hot),
       "metals have a tenth of their strength left there, and less: a table of temperature", findings);
}

/// Metal at its solidus is softer than when cold: 0.02 (steel) to 0.65 (tin) of its stiffness is left.
void compare_stiffness(const cases::BodySpec& body, const material::Material& m, Findings& findings) {
  constexpr double k_cold = 293.15;  // [K]
  const double cold = m.young_modulus.value(k_cold),
               hot = m.young_modulus.value(m.solidification()->fraction.solidus());
  if (hot < k_stiff * cold || hot > 1.2 * cold) return;  // one that rises: findings/material.cpp
  warn(body,
       fmt::format("a young_modulus of {:.3g} GPa at 20 degC and of {:.3g} GPa at its solidus", 1e-9 * cold,
                   1e-9 * hot),
       "2 % (steel) to 65 % (tin) of it are left at the solidus: a table of temperature", findings);
}

/// Metal at its solidus flows by creep: what its rate adds is of the size of its flow stress. Where it is far
/// from that, the viscosity is one of other units.
void compare_creep(const cases::BodySpec& body, const material::Material& m, Findings& findings) {
  if (!m.flow || m.flow->rate_independent()) return;
  const double solidus = m.solidification()->fraction.solidus(),
               strength = m.flow->flow_stress.value(solidus);
  const double stress = material::rate_law(m.flow->rate_dependence)
                            .overstress(material::flow_properties_at(*m.flow, solidus), k_rate)
                            .stress;
  if (!(strength > 0) || (stress >= k_least_creep * strength && stress <= k_most_creep * strength)) return;
  warn(body,
       fmt::format("at its solidus a rate of 0.001 1/s adds {:.3g} MPa to a flow_stress of {:.3g} MPa",
                   1e-6 * stress, 1e-6 * strength),
       "half to four times the flow stress there; is the viscosity in its unit?", findings);
}

/// A melt as stiff as the solid does not flow, but for a viscosity with a source, which is that of a
/// published case. The viscosity of molten metal itself has no effect on stress (material/melt.hpp).
void compare_melt_viscosity(const cases::BodySpec& body, const material::Material& m, double step,
                            Findings& findings) {
  if (m.chooses_viscosity() || m.liquid_model != material::LiquidModel::maxwell || !(step > 0)) return;
  // Compared at the solidus, where the solid is softest: melt that is stiffer than it there is so
  // everywhere.
  const double solidus = m.solidification()->fraction.solidus();
  const double young = m.young_modulus.value(solidus), poisson = m.poisson_ratio.value(solidus);
  // A viscosity acts within a step as a modulus of viscosity over step.
  const double shear = young / (1 + poisson), bulk = young / (3 * (1 - 2 * poisson));  // 2 G and k [Pa]
  const double viscosity = m.liquid_viscosity.max_value(), melt = viscosity / step;
  const char* usual = "no twice_shear_viscosity: the run chooses one by the weight of the melt and the step";
  if (melt < k_no_shear * bulk)
    warn(body,
         fmt::format(
             "a twice_shear_viscosity of {:g} Pa s makes melt {:.1g} times as stiff in shear as under "
             "pressure, in a step of {:g} s: it has no effect on stress and makes equations hard to solve",
             viscosity, melt / bulk, step),
         usual, findings);
  const bool has_source = std::ranges::any_of(m.notes, [](const material::PropertyNote& note) {
    return note.property == "twice_shear_viscosity" && !note.source.empty();
  });
  // A source lets it pass, because such melts occur in published benchmarks that one wants to
  // repeat.
  if (melt > shear && !has_source)
    warn(body,
         fmt::format(
             "a twice_shear_viscosity of {:g} Pa s makes melt {:.2g} times as stiff as the solid in a step "
             "of {:g} s: it does not flow",
             viscosity, melt / shear, step),
         usual, findings);
}

/// Data of the criteria.
void compare_casting(const cases::BodySpec& body, const material::Material& m, Findings& findings) {
  constexpr double k_minute = 60;  // [s]
  if (const auto arms = m.casting.secondary_arm_spacing(k_minute);
      arms && (*arms < k_finest || *arms > k_coarsest))
    warn(body, fmt::format("secondary arms are {:.3g} um apart where it freezes for a minute", 1e6 * *arms),
         "20 to 200 um; arm_spacing is that after one second, 7 to 50 um", findings);
  if (const auto viscosity = m.casting.melt_viscosity;
      viscosity && (*viscosity < k_thinnest || *viscosity > k_thickest))
    warn(body, fmt::format("a melt_viscosity of {:.3g} mPa s", 1e3 * *viscosity),
         "melts of metals have 0.5 to 10 mPa s", findings);
  if (const double coherency = m.casting.coherency_fraction; coherency < k_first_coherent)
    warn(body, fmt::format("it carries load from {:.3g} % solid on", 100 * coherency),
         "metal is coherent from 60 to 90 % solid on, coherency_fraction = 0.6 to 0.9", findings);
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures&, Findings& findings) {
  // Bodies that cannot freeze have no data of alloys to compare.
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const material::Material& m = a.materials[b];
    if (m.solidification() == nullptr) continue;
    // Heat first, then the mechanical properties of bodies that deform.
    if (spec.has_heat()) compare_entropy_of_melting(spec.bodies[b], m, findings);
    if (spec.has_heat()) compare_heat_capacity(spec.bodies[b], m, findings);
    if (spec.has_heat()) compare_conductivity_of_light_metal(spec.bodies[b], m, findings);
    if (spec.has_heat()) compare_casting(spec.bodies[b], m, findings);
    if (!spec.has_mechanics() || cases::only_conducts(spec.bodies[b])) continue;
    compare_softening(spec.bodies[b], m, findings);
    compare_stiffness(spec.bodies[b], m, findings);
    compare_expansion(spec.bodies[b], m, findings);
    compare_stiffness_with_liquidus(spec.bodies[b], m, findings);
    compare_volume_change(spec.bodies[b], m, findings);
    compare_creep(spec.bodies[b], m, findings);
    compare_melt_viscosity(spec.bodies[b], m, spec.time.step.value_or(0), findings);
  }
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_alloys() {
  return {
      .name = "alloys",
      .place = 40,
      .find = &find,
      .rows = {
          {Topic::materials, "latent heat of another metal",
           fmt::format(
               "latent heat times density over the liquidus in kelvin (Richards' rule) below {} or above {} "
               "MJ/m³K (silicon {}): perhaps a value per litre or mole, or in cal instead of J",
               number(1e-6 * k_least_entropy), number(1e-6 * k_most_entropy),
               number(1e-6 * k_most_of_silicon))},
          {Topic::materials, "specific heat or density of another metal",
           fmt::format("their product at 20 °C (Dulong and Petit's rule), in materials that freeze, below {} "
                       "or above {} MJ/m³K",
                       number(1e-6 * k_least_capacity), number(1e-6 * k_most_capacity))},
          {Topic::materials, "conductivity of a light metal",
           fmt::format("below {} W/m/K at the solidus, lighter than {} kg/m³", number(k_least_of_light),
                       number(k_light))},
          {Topic::materials, "expansion of what freezes",
           fmt::format("times the liquidus (Grüneisen's rule) below {}", number(k_least_growth))},
          {Topic::materials, "stiffness of another metal",
           fmt::format("Young's modulus at 20 °C over the liquidus below {} or above {} GPa/K",
                       number(1e-9 * k_least_stiffness), number(1e-9 * k_most_stiffness))},
          {Topic::materials, "next to no change of volume",
           fmt::format("not zero, below {}", percent(k_next_to_none))},
          {Topic::materials, "a strength that does not fall",
           fmt::format("a flow stress at the solidus of more than {} of that at 20 °C", percent(k_softened))},
          {Topic::materials, "a stiffness that does not fall",
           fmt::format("a Young's modulus at the solidus of more than {} of that at 20 °C",
                       percent(k_stiff))},
          {Topic::materials, "a rate dependence that adds nothing, or everything",
           fmt::format("at the solidus an overstress of less than {} or more than {} times the flow stress, "
                       "at {} 1/s",
                       number(k_least_creep), number(k_most_creep), number(k_rate))},
          {Topic::materials, "data of criteria",
           fmt::format("secondary arms below {} µm or above {} mm apart after a minute of freezing; a "
                       "viscosity of the melt below {} or above {} mPa s; `coherency_fraction` below {}",
                       number(1e6 * k_finest), number(1e3 * k_coarsest), number(1e3 * k_thinnest),
                       number(1e3 * k_thickest), number(k_first_coherent))},
          {Topic::materials, "viscosity of a melt",
           fmt::format("a `twice_shear_viscosity` without a source whose modulus in the first step is above "
                       "2G at the solidus, or below {} of the bulk modulus",
                       number(k_no_shear))}}};
}

}  // namespace solidus::check
