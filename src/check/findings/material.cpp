// Findings on properties: factors of a thousand between units.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/roles.hpp"
#include "check/finding_family.hpp"
#include "material/laws/rate_law.hpp"
#include "setup/body_input.hpp"

namespace solidus::check {

namespace {

struct Usual {
  const char* property;
  const char* unit;
  double low, high;
};

// Properties outside of these ranges are those of other units, with some room for materials of the
// laboratory.
constexpr double k_least_density = 10, k_least_of_metals = 1000, k_most_density = 25000;         // [kg/m³]
constexpr double k_least_conductivity = 0.01, k_least_conductivity_of_metals = 3;                // [W/(m K)]
constexpr double k_most_conductivity = 500, k_most_conductivity_with_flow = 1000;                // [W/(m K)]
constexpr double k_least_heat = 80, k_most_heat = 20000;                                         // [J/(kg K)]
constexpr double k_least_latent = 2e4, k_most_latent = 2e6;                                      // [J/kg]
constexpr double k_least_modulus = 1e5, k_least_modulus_of_metals = 1e9, k_most_modulus = 2e12;  // [Pa]
constexpr double k_dense = 5000, k_conducts = 8;  // what is denser and conducts more counts as metal
constexpr double k_stiffening = 1.2;              // a modulus when hot, of that when cold
constexpr double k_most_shrinking = -1e-5, k_most_expansion = 1.2e-4, k_least_expansion = 1e-8;  // [1/K]
constexpr double k_most_expansion_of_metals = 5e-5;               // of zinc near its melting point [1/K]
constexpr double k_most_change = 0.15, k_most_gain = 0.035;       // of the volume
constexpr double k_least_strength = 1e6;                          // [Pa]
constexpr double k_widest_range = 400;                            // from solidus to liquidus [K]
constexpr double k_least_poisson = 0.12, k_most_hardening = 0.2;  // [1], of Young's modulus
constexpr double k_rate = 1e-3;                                   // of castings [1/s]
constexpr double k_least_rate_stress = 1e-5, k_most_rate_stress = 100;  // of the strength
constexpr double k_hump = 2.5;           // of the specific heat around the freezing range
constexpr double k_much_latent = 1.2e5;  // above all that changes in the solid [J/kg]
constexpr double k_least_of_melt = 0.2;  // conductivity of the melt, of that of the solid
constexpr double k_cold_table = 150, k_cold_table_end = 1800;  // of a table in °C that was read as K [K]

/// Adds a warning that names body and material.
void warn_of_material(const cases::BodySpec& body, const std::string& what, const char* usual,
                      Findings& findings) {
  findings.push_back({false, body.where,
                      fmt::format("body '{}', material '{}': {}", body.name, body.material, what), usual});
}

void compare(const cases::BodySpec& body, const Usual& usual, double low, double high, Findings& findings) {
  if (low >= usual.low && high <= usual.high) return;
  findings.push_back({false, body.where,
                      fmt::format("body '{}', material '{}': {} of {:g} {}", body.name, body.material,
                                  usual.property, high > usual.high ? high : low, usual.unit),
                      fmt::format("usual are {:g} to {:g} {}", usual.low, usual.high, usual.unit)});
}

/// Whether a point of the table is as many kelvins as the liquidus or solidus, but was read in degrees
/// Celsius.
bool has_shifted_point(const material::Property& property, const material::PhaseChange* freezing) {
  if (freezing == nullptr) return false;
  const auto x = property.table->x();
  return std::any_of(x.begin(), x.end(), [&](double t) {
    return std::abs(t - k_zero_celsius - freezing->fraction.liquidus()) < 0.6 ||
           std::abs(t - k_zero_celsius - freezing->fraction.solidus()) < 0.6;
  });
}

/// A table of temperature whose first point is a room's in K, or that would reach far below any casting's.
void compare_argument(const cases::BodySpec& body, const material::Property& property, double coldest,
                      const material::PhaseChange* freezing, Findings& findings) {
  if (property.table->constant()) return;
  // Read as Celsius, a first point of 273, 293 or 298 is a room in kelvins.
  const double first = property.table->x().front(), last = property.table->x().back();
  const double celsius = first - k_zero_celsius;
  const auto near = [](double p, double q) { return std::abs(p - q) < 0.6; };
  const bool room = near(celsius, 273) || near(celsius, 293) || near(celsius, 298);
  // Near 300 it is doubtful, unless another point lies where the solidus or liquidus would be in
  // kelvins.
  const bool shifted = celsius > 270 && celsius < 330 && has_shifted_point(property, freezing);
  if ((room || shifted) && coldest < first - 150)
    findings.push_back(
        {false, body.where,
         fmt::format("body '{}', material '{}': the table of {} begins at {:.6g} degC, but the case "
                     "goes down to {:.0f} degC",
                     body.name, body.material, property.name, celsius, coldest - k_zero_celsius),
         "are its temperatures in K? argument_unit = \"K\""});
  // The other mistake: degrees Celsius read as kelvins make a table start far below any case.
  if (first < k_cold_table && last < k_cold_table_end && last > 300)
    findings.push_back(
        {false, body.where,
         fmt::format("body '{}', material '{}': the table of {} runs from {:.6g} K to {:.6g} K", body.name,
                     body.material, property.name, first, last),
         "are its temperatures in degC? argument_unit = \"degC\""});
}

/// Elastic properties and expansion.
void compare_solid(const cases::BodySpec& body, const material::Material& m, Findings& findings) {
  // A material as dense and conducting as metal counts as one, also where its card has no freezing.
  const bool metal =
      m.solidification() != nullptr || (m.density > k_dense && m.conductivity.min_value() > k_conducts);
  if (const double stiffest = m.young_modulus.max_value(); metal && stiffest < k_least_modulus_of_metals)
    findings.push_back({false, body.where,
                        fmt::format("body '{}', material '{}': young_modulus of {:g} Pa at most", body.name,
                                    body.material, stiffest),
                        "cold metals have 10 to 400 GPa"});
  // Moduli of all solids next, then expansions with their sign: some materials shrink as they get
  // warmer.
  compare(body, {"young_modulus", "Pa", k_least_modulus, k_most_modulus}, m.young_modulus.min_value(),
          m.young_modulus.max_value(), findings);
  compare(body, {"expansion", "1/K", k_most_shrinking, k_most_expansion}, m.expansion.min_value(),
          m.expansion.max_value(), findings);
  // Three times the usual is the expansion of the volume, given for that of length.
  const double largest = std::max(std::abs(m.expansion.min_value()), std::abs(m.expansion.max_value()));
  if (m.solidification() != nullptr && m.expansion.max_value() > k_most_expansion_of_metals &&
      m.expansion.max_value() < k_most_expansion)
    findings.push_back(
        {false, body.where,
         fmt::format("body '{}', material '{}': expansion of {:g} 1/K", body.name, body.material,
                     m.expansion.max_value()),
         "metals expand by 0.5e-5 to 4e-5 1/K; is it that of the volume, three times as large?"});
  if (largest > 0 && largest < k_least_expansion)
    findings.push_back(
        {false, body.where,
         fmt::format("body '{}', material '{}': expansion of {:g} 1/K", body.name, body.material, largest),
         "usual are 5e-7 to 3e-5 1/K, or zero"});
}

/// Volume that no metal gains or loses as it freezes, a strength or stiffness that no metal has.
void compare_strength(const cases::BodySpec& body, const material::Material& m, Findings& findings) {
  const auto say = [&](const std::string& what, const char* usual) {
    findings.push_back({false, body.where,
                        fmt::format("body '{}', material '{}': {}", body.name, body.material, what), usual});
  };
  // Any phase change counts here, those in the solid too.
  for (const material::PhaseChange& change : m.phase_changes)
    if (std::abs(change.volume_change) > k_most_change)
      say(fmt::format("'{}' changes the volume by {:.3g} %", change.name, 100 * change.volume_change),
          "metals shrink by 1 to 7 % as they freeze (-0.07 to -0.01), bismuth and silicon expand by up to 10 "
          "%");
  if (m.flow && m.solidification() != nullptr && m.flow->flow_stress.max_value() < k_least_strength)
    say(fmt::format("flow_stress of {:g} Pa at most", m.flow->flow_stress.max_value()),
        "cold metals have 10 to 2000 MPa");
  // Graphite and ceramics may stiffen.
  const Table& young = m.young_modulus;
  if (m.solidification() != nullptr && !young.constant() &&
      young.y().back() > k_stiffening * young.y().front())
    say(fmt::format("young_modulus rises with temperature, from {:.3g} to {:.3g} GPa",
                    1e-9 * young.y().front(), 1e-9 * young.y().back()),
        "metals soften as they warm; are the columns of the table in their places?");
}

/// Ratios of the elastic and plastic properties that no metal has.
void compare_ratios(const cases::BodySpec& body, const material::Material& m, Findings& findings) {
  if (const double least = m.poisson_ratio.min_value();
      m.solidification() != nullptr && least < k_least_poisson)
    warn_of_material(body, fmt::format("poisson_ratio of {:g}", least), "metals have 0.2 to 0.45", findings);
  // Only freezing: changes in the solid may well gain volume.
  for (const material::PhaseChange& change : m.phase_changes)
    if (change.solidification && change.volume_change > k_most_gain)
      warn_of_material(
          body,
          fmt::format("'{}' makes the volume larger by {:.3g} %", change.name, 100 * change.volume_change),
          "metals shrink by 1 to 7 % as they freeze, volume_change = -0.07 to -0.01; grey iron and bismuth "
          "expand by up to 3.3 %, silicon by 10 %",
          findings);
  // Hardening is compared where it is one number of a line; other laws have no one modulus.
  if (!m.flow || m.flow->isotropic != material::IsotropicHardening::linear) return;
  const double stiff = m.young_modulus.max_value(), hardening = m.flow->hardening[0].max_value();
  if (hardening > k_most_hardening * stiff)
    warn_of_material(body,
                     fmt::format("hardening_modulus of {:.3g} GPa with a young_modulus of {:.3g} GPa",
                                 1e-9 * hardening, 1e-9 * stiff),
                     "metals harden with 0.001 to 0.05 of their young_modulus", findings);
}

/// Compares the strength that viscosity adds at a casting's rates: other units are off by powers of ten.
void compare_rate(const cases::BodySpec& body, const material::Material& m, Findings& findings) {
  if (!m.flow || m.flow->rate_independent()) return;
  constexpr double k_cold = 293.15;  // [K]
  const double strength = m.flow->flow_stress.max_value();
  const double stress = material::rate_law(m.flow->rate_dependence)
                            .overstress(material::flow_properties_at(*m.flow, k_cold), k_rate)
                            .stress;
  if (!(strength > 0) || (stress < k_most_rate_stress * strength && stress >= k_least_rate_stress * strength))
    return;
  warn_of_material(
      body,
      fmt::format("at 0.001 1/s its rate adds {:.3g} MPa to a flow_stress of {:.3g} MPa", 1e-6 * stress,
                  1e-6 * strength),
      "a tenth to ten times the flow stress; are the viscosity and the drag_stress in their units?",
      findings);
}

/// A specific heat with a hump where the metal freezes holds the latent heat already.
void compare_latent_heat(const cases::BodySpec& body, const material::Material& m, Findings& findings) {
  // A hump is a value within the range of freezing, and a little to its sides, far above those
  // around.
  const material::PhaseFraction& fraction = m.solidification()->fraction;
  constexpr double k_beside = 5;  // [K]
  const double low = fraction.solidus() - k_beside, high = fraction.liquidus() + k_beside;
  const Table& c = m.specific_heat;
  // Around it the larger of the cold and the hot end counts, so that a rise from one to the other
  // is none.
  const double around = std::max(c.value(c.x().front()), c.value(high + 100));
  double most = 0;
  for (std::size_t i = 0; i < c.x().size(); ++i)
    if (c.x()[i] > low && c.x()[i] < high) most = std::max(most, c.y()[i]);
  if (most > k_hump * around)
    warn_of_material(
        body,
        fmt::format("the specific heat rises to {:.4g} J/kg/K where it freezes, in addition to a "
                    "latent heat of {:.4g} kJ/kg: is it counted twice?",
                    most, 1e-3 * m.solidification()->latent_heat),
        "specific_heat without the latent heat, 500 to 1300 J/kg/K, on a line across the range", findings);
}

/// Heat as of freezing that no solid fraction belongs to: of a body that is no casting by its role, or of a
/// card that does not say that it freezes.
void compare_phase_changes(const cases::BodySpec& body, const material::Material& m, Findings& findings) {
  for (const material::PhaseChange& change : m.phase_changes)
    if (change.latent_heat > k_much_latent && !change.solidification && body.role &&
        !cases::is_poured(*body.role))
      findings.push_back(
          {false, body.where,
           fmt::format("the {} '{}' is of '{}', which melts from {:.0f} degC on and takes up {:.4g} kJ/kg",
                       name(*body.role), body.name, body.material, change.fraction.solidus() - k_zero_celsius,
                       1e-3 * change.latent_heat),
           "materials of moulds, cores and chills have no phase change: a sand, 'steel_mould', 'iron_chill', "
           "'copper_chill'"});
    else if (change.latent_heat > k_much_latent && !change.solidification)
      warn_of_material(body,
                       fmt::format("'{}' releases {:.4g} kJ/kg and is no solidification: nothing freezes",
                                   change.name, 1e-3 * change.latent_heat),
                       "solidification = true; changes in the solid release 1 to 90 kJ/kg", findings);
}

/// Metal conducts less as it melts, but not that much less.
void compare_melt(const cases::BodySpec& body, const material::Material& m, Findings& findings) {
  constexpr double k_beside = 1;  // [K]
  const material::PhaseFraction& fraction = m.solidification()->fraction;
  const double solid = m.conductivity.value(fraction.solidus() - k_beside),
               melt = m.conductivity.value(fraction.liquidus() + k_beside);
  if (melt >= k_least_of_melt * solid) return;
  findings.push_back({false, body.where,
                      fmt::format("body '{}', material '{}': conductivity of {:g} W/m/K in the melt, {:g} "
                                  "W/m/K in the solid",
                                  body.name, body.material, melt, solid),
                      "melts conduct 0.4 to 1.5 times what the solid does at its solidus"});
}

/// The lowest temperature that starts, surroundings and prescribed ones name [K].
double coldest(const cases::CaseSpec& spec, const setup::Assembly& a) {
  double low = a.coldest_start();
  for (const cases::ThermalConditionSpec& c : spec.thermal_conditions) {
    using Kind = cases::ThermalConditionSpec::Kind;
    const bool ambient = c.kind == Kind::film || c.kind == Kind::radiation;
    const Function& f = ambient ? c.ambient : c.temperature;
    if ((ambient || c.kind == Kind::temperature) && f.place == nullptr)
      low = std::min(low, f.table.min_value());
  }
  return low;
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures&, Findings& findings) {
  // The coldest temperature that the case knows, with which the first points of tables are
  // compared.
  const double low = coldest(spec, a);
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const material::Material& m = a.materials[b];
    const bool metal = m.solidification() != nullptr;
    // The arguments of the tables, then the numbers of the solid, heat, phase changes and the melt, in this
    // order.
    for (const material::Property& property : m.properties())
      if (spec.has_heat()) compare_argument(spec.bodies[b], property, low, m.solidification(), findings);
    if (spec.has_mechanics() && m.mechanical() && !cases::only_conducts(spec.bodies[b]))
      compare_solid(spec.bodies[b], m, findings), compare_strength(spec.bodies[b], m, findings),
          compare_ratios(spec.bodies[b], m, findings), compare_rate(spec.bodies[b], m, findings);
    // Limits of metals are narrower than those of all materials.
    compare(spec.bodies[b], {"density", "kg/m3", metal ? k_least_of_metals : k_least_density, k_most_density},
            m.density, m.density, findings);
    if (!spec.has_heat()) continue;
    // Melts are given a larger conductivity by some, for their flow.
    const double solid = metal ? m.conductivity.value(m.solidification()->fraction.solidus()) : 0.0;
    const bool as_melt = solid > 0 && solid <= k_most_conductivity;
    compare(spec.bodies[b],
            {"conductivity", "W/m/K", metal ? k_least_conductivity_of_metals : k_least_conductivity,
             as_melt ? k_most_conductivity_with_flow : k_most_conductivity},
            m.conductivity.min_value(), m.conductivity.max_value(), findings);
    // What freezes has more to compare: conductivities and heats of the melt and the range of
    // freezing.
    compare(spec.bodies[b], {"specific heat", "J/kg/K", k_least_heat, k_most_heat},
            m.specific_heat.min_value(), m.specific_heat.max_value(), findings);
    compare_phase_changes(spec.bodies[b], m, findings);
    if (metal) compare_melt(spec.bodies[b], m, findings);
    if (metal) compare_latent_heat(spec.bodies[b], m, findings);
    if (metal)
      compare(spec.bodies[b], {"latent heat", "J/kg", k_least_latent, k_most_latent},
              m.solidification()->latent_heat, m.solidification()->latent_heat, findings);
    if (metal)
      if (const double range =
              m.solidification()->fraction.liquidus() - m.solidification()->fraction.solidus();
          range > k_widest_range)
        findings.push_back({false, spec.bodies[b].where,
                            fmt::format("body '{}', material '{}': it freezes over {:.0f} K",
                                        spec.bodies[b].name, spec.bodies[b].material, range),
                            "alloys freeze over 0 to 250 K; are solidus and liquidus right?"});
  }
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_material() {
  return {
      .name = "materials",
      .place = 30,
      .find = &find,
      .rows = {{Topic::materials,
                fmt::format("a melt that conducts less than {} of what the solid does at its solidus",
                            percent(k_least_of_melt))},
               {Topic::materials, "density, conductivity, specific heat, latent heat",
                fmt::format("outside of {} (metals {}) to {} kg/m³, {} (metals {}) to {} W/m/K, {} to {} "
                            "J/kg/K, {} to {} kJ/kg",
                            number(k_least_density), number(k_least_of_metals), number(k_most_density),
                            number(k_least_conductivity), number(k_least_conductivity_of_metals),
                            number(k_most_conductivity), number(k_least_heat), number(k_most_heat),
                            number(1e-3 * k_least_latent), number(1e-3 * k_most_latent))},
               {Topic::materials, "elastic modulus, expansion",
                fmt::format(
                    "outside of {} to {} Pa, metals below {} GPa (metals: materials that freeze, or are "
                    "denser than {} kg/m³ and conduct more than {} W/m/K); a modulus that rises by {} with "
                    "temperature; an expansion beyond {} 1/K ({} in materials that freeze: probably that of "
                    "the volume), below {} 1/K",
                    number(k_least_modulus), number(k_most_modulus), number(1e-9 * k_least_modulus_of_metals),
                    number(k_dense), number(k_conducts), percent(k_stiffening - 1), number(k_most_expansion),
                    number(k_most_expansion_of_metals), number(k_least_expansion))},
               {Topic::materials, "change of volume, strength, freezing range",
                fmt::format("above {}; a flow stress below {} MPa at its highest; above {} K",
                            percent(k_most_change), number(1e-6 * k_least_strength), number(k_widest_range))},
               {Topic::materials, "sign of the change of volume",
                fmt::format("metal expands by more than {} as it freezes", percent(k_most_gain))},
               {Topic::materials, "ratios of properties",
                fmt::format(
                    "a metal with a Poisson's ratio below {}; a `hardening_modulus` above {} of Young's "
                    "modulus; a rate that adds less than {} or more than {} times the flow stress at {} 1/s",
                    number(k_least_poisson), percent(k_most_hardening), number(k_least_rate_stress),
                    number(k_most_rate_stress), number(k_rate))},
               {Topic::materials, "a mould of an alloy",
                fmt::format("the role is neither casting nor riser, and a phase change has more than {} "
                            "kJ/kg of latent heat",
                            number(1e-3 * k_much_latent))},
               {Topic::materials, "latent heat counted twice, or not at all",
                fmt::format("a specific heat that rises to {} times its values around where the metal "
                            "freezes; more than {} kJ/kg in a phase change that is no `solidification`",
                            number(k_hump), number(1e-3 * k_much_latent))},
               {Topic::materials, "a table in K was read as °C",
                "it begins at 273, 293 or 298 °C, or near 300 °C with a point whose number is the solidus or "
                "liquidus in kelvin, and the case is colder"},
               {Topic::materials, "a table in °C was read as K",
                fmt::format("it begins below {} K and ends below {} K", number(k_cold_table),
                            number(k_cold_table_end))}}};
}

}  // namespace solidus::check
