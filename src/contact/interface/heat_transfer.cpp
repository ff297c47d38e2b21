/// A law for the closed interface and one for the gap, joined at zero penetration. They are checked at all
/// temperatures at which one of their tables bends: continuous there, and monotone within the transition if
/// it is smoothed.
#include "contact/interface/heat_transfer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contact/laws/constant_gap.hpp"
#include "contact/laws/power_contact.hpp"
#include "numbers/types.hpp"

namespace solidus::contact {

namespace {

std::vector<TableAt> tables_of(const HeatTransferSpec& spec,
                               std::optional<Table> HeatTransferSpec::AtTemperature::*member) {
  std::vector<TableAt> tables;
  for (const HeatTransferSpec::AtTemperature& at : spec.families)
    if (at.*member) tables.push_back({at.temperature, *(at.*member)});
  return tables;
}

/// The cubic from the start's value with slope zero to value and slope of the end.
LawConductance transition(double x, double width, const LawConductance& start, const LawConductance& end) {
  const double t = x / width, t2 = t * t, t3 = t2 * t;
  const double to_end = 3 * t2 - 2 * t3, to_slope = (t3 - t2) * width;
  const double of_end = 6 * (t - t2) / width, of_slope = 3 * t2 - 2 * t;
  const double rise = end.value - start.value, warmed = end.by_temperature - start.by_temperature;
  return {start.value + to_end * rise + to_slope * end.slope, of_end * rise + of_slope * end.slope,
          start.by_temperature + to_end * warmed + to_slope * end.mixed,
          of_end * warmed + of_slope * end.mixed};
}

}  // namespace

HeatTransferSpec without_bodies(HeatTransferSpec spec) {
  if (spec.contact_law != nullptr && spec.contact_law->needs_conductivity())
    spec.contact_law = spec.contact_law->with_conductivity(Table(1.0));
  return spec;
}

HeatTransferLaw::HeatTransferLaw(HeatTransferSpec spec) : spec_(std::move(spec)) {
  // Widths only mean something to the smoothed law: given without it they are an oversight, which
  // is better told.
  if (!spec_.smooth && (spec_.transition_gap || spec_.transition_pressure))
    throw InputError(spec_.where, "a width of transition is given, but the law is not smooth",
                     "smooth = true, or no width");
  transition_gap_ = spec_.transition_gap.value_or(transition_gap_);
  transition_pressure_ = spec_.transition_pressure.value_or(transition_pressure_);
  // Laws come first, since the checks below evaluate them.
  prepare_laws();
  check_continuity();
  if (spec_.smooth) check_transition();

  const double e1 = spec_.slave_emissivity, e2 = spec_.master_emissivity;
  if (!(e1 >= 0 && e1 <= 1 && e2 >= 0 && e2 <= 1))
    throw InputError(spec_.where, "an emissivity is not between 0 and 1", "0 to 1");
}

double HeatTransferLaw::slave_resistance(double pressure, double temperature) const {
  const std::optional<double> of_law =
      spec_.contact_law->slave_resistance(std::max(pressure, 0.0), std::max(temperature, 0.0));
  return of_law.value_or(spec_.slave_resistance.value_or(0.5));
}

double HeatTransferLaw::radiation_factor(double area_ratio) const {
  const double slave = spec_.slave_emissivity, master = spec_.master_emissivity, share = 1 / area_ratio;
  if (!(slave > 0 && master > 0)) return 0;
  return k_stefan_boltzmann / (1 / slave - 1 + std::max(1.0, share) + share * (1 / master - 1));
}

double HeatTransferLaw::radiation_by_area(double area_ratio) const {
  const double factor = radiation_factor(area_ratio);
  if (!(factor > 0)) return 0;
  const double smaller = area_ratio < 1 ? 1 : area_ratio > 1 ? 0 : 0.5;  // the master has the smaller area
  return factor * factor / k_stefan_boltzmann * (smaller + 1 / spec_.master_emissivity - 1) /
         (area_ratio * area_ratio);
}

void HeatTransferLaw::prepare_laws() {
  using At = HeatTransferSpec::AtTemperature;
  // Without laws contact follows a power of the pressure and the gap keeps one conductance. Each law is told
  // what it needs of the other: whether gas fills the roughness, and the conductance without pressure at
  // which the gap begins.
  if (spec_.contact_law == nullptr) spec_.contact_law = contact::contact_law(PowerContact{});
  if (spec_.gap_law == nullptr) spec_.gap_law = contact::gap_law(ConstantGap{});
  const bool fills = spec_.gap_law->fills_roughness();
  spec_.contact_law =
      spec_.contact_law->ready(fills, tables_of(spec_, &At::contact_conductance), spec_.where);
  if (spec_.slave_resistance && spec_.contact_law->slave_resistance(0, 300))
    throw InputError(spec_.where, "'slave_resistance' with a law that has both sides",
                     "one of them: the law says which share lies on the slave's side");
  between_asperities_ = fills && spec_.contact_law->rough();
  spec_.gap_law = spec_.gap_law->beside({spec_.contact_law->without_pressure(), between_asperities_},
                                        tables_of(spec_, &At::gap_table), spec_.where);
  of_temperature_ = spec_.contact_law->of_temperature() || spec_.gap_law->of_temperature();
  for (const std::vector<double>& at : {spec_.contact_law->temperatures(), spec_.gap_law->temperatures()})
    temperatures_.insert(temperatures_.end(), at.begin(), at.end());
  constexpr double k_any = 300;
  if (temperatures_.empty()) temperatures_.push_back(k_any);
}

void HeatTransferLaw::check_continuity() const {
  // The conductance must not jump as the gap opens.
  for (const double temperature : temperatures_) {
    const double shut = closed(0, temperature).value, opened = open(0, temperature).value;
    if (!(shut >= 0 && opened >= 0 && std::isfinite(shut) && std::isfinite(opened)))
      throw InputError(
          spec_.where,
          fmt::format("at {:.6g} K the closed interface without pressure conducts {:.6g}, a gap of "
                      "zero {:.6g} W/(m2 K)",
                      temperature, shut, opened),
          "finite conductances of zero or more");
    if (std::abs(opened - shut) > 1e-6 * shut)
      throw InputError(
          spec_.where,
          fmt::format("the conductance of the closed interface, {:.6g} W/(m2 K), is not that of "
                      "a gap of zero, {:.6g} W/(m2 K){}",
                      shut, opened,
                      temperatures_.size() == 1 ? "" : fmt::format(", at {:.6g} K", temperature)),
          "equal values, so that heat does not jump when the gap opens");
  }
}

void HeatTransferLaw::check_transition() const {
  if (!(transition_gap_ > 0 && transition_pressure_ > 0))
    throw InputError(spec_.where, "a transition has no width", "widths above zero");
  // The cubic lies between its ends while its end slope is at most three times the mean one.
  const auto require_monotone = [&](double from, double to, double rise, const char* key) {
    const double mean = to - from;
    const double rounding = 1e-12 * std::max(from, to);
    if (rise * mean >= -rounding * std::abs(rise) && std::abs(rise) <= 3 * std::abs(mean) + rounding) return;
    throw InputError(spec_.where, fmt::format("the law bends too much within '{}' to be smoothed", key),
                     "a narrower transition");
  };
  const double p = transition_pressure_, g = transition_gap_;
  for (const double temperature : temperatures_) {
    const double at_contact = closed(0, temperature).value;
    const LawConductance pressed = closed(p, temperature), parted = open(g, temperature);
    require_monotone(at_contact, pressed.value, p * pressed.slope, "transition_pressure");
    require_monotone(at_contact, parted.value, g * parted.slope, "transition_gap");
  }
}

Conductance HeatTransferLaw::at(double penetration, double pressure, double temperature) const {
  // The factors vary the two branches of the law for studies of uncertainty: one multiplies the
  // conductance of contact, the other what a gap conducts by itself.
  const double closed_factor = spec_.conductance_factor, gap_factor = spec_.gap_factor;
  // Without either factor the law is as given.
  Conductance h = given(penetration, pressure, temperature);
  if (closed_factor == 1 && gap_factor == 1) return h;
  const Conductance contact = given(0, 0, temperature);
  // A gap that conducts nothing, or more than contact, has no resistance of its own to be varied.
  const bool resists = h.value > 0 && h.value < contact.value;
  if (penetration >= 0 || closed_factor == gap_factor || !resists)
    return {closed_factor * h.value, closed_factor * h.by_penetration, closed_factor * h.by_pressure,
            closed_factor * h.by_temperature};
  // An open gap is two resistances in series, contact's and the gap's own; each is varied by its
  // factor.
  const double shared = 1 / closed_factor - 1 / gap_factor;
  const double varied = 1 / (shared / contact.value + 1 / (gap_factor * h.value));
  const double by_given = varied / h.value * varied / h.value / gap_factor;
  const double by_contact = varied / contact.value * varied / contact.value * shared;
  return {varied, by_given * h.by_penetration, 0,
          by_given * h.by_temperature + by_contact * contact.by_temperature};
}

Conductance HeatTransferLaw::given(double penetration, double pressure, double temperature) const {
  const double warmth = std::max(temperature, 0.0);
  const bool parted = penetration < 0;
  const double x = parted ? -penetration : std::max(pressure, 0.0);
  const double width = parted ? transition_gap_ : transition_pressure_;
  const auto branch = [&](double of) { return parted ? open(of, warmth) : closed(of, warmth); };
  LawConductance h = spec_.smooth && x < width ? transition(x, width, branch(0), branch(width)) : branch(x);
  if (temperature < 0) h.by_temperature = 0;
  return {h.value, parted ? -h.slope : 0, parted ? 0 : h.slope, h.by_temperature};
}

LawConductance HeatTransferLaw::open(double gap, double temperature) const {
  const double between = between_asperities_ ? spec_.contact_law->separation(0).value : 0.0;
  return spec_.gap_law->at(gap + between, temperature);
}

LawConductance HeatTransferLaw::closed(double pressure, double temperature) const {
  // Spots of contact and the gas between them conduct side by side; where the law knows how far rough
  // surfaces are apart, gas fills that distance.
  const LawConductance pressed = spec_.contact_law->at(pressure, temperature);
  if (!spec_.contact_law->beside_gas()) return pressed;
  if (!between_asperities_) {
    const LawConductance gas = open(0, temperature);
    return {gas.value + pressed.value, pressed.slope, gas.by_temperature + pressed.by_temperature,
            pressed.mixed};
  }
  const Separation y = spec_.contact_law->separation(pressure);
  const LawConductance gas = spec_.gap_law->at(y.value, temperature);
  return {gas.value + pressed.value, gas.slope * y.slope + pressed.slope,
          gas.by_temperature + pressed.by_temperature, gas.mixed * y.slope + pressed.mixed};
}

}  // namespace solidus::contact
