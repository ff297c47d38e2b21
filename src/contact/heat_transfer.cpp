#include "contact/heat_transfer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/types.hpp"

namespace solidus::contact {

HeatTransferLaw::HeatTransferLaw(HeatTransferSpec spec) : spec_(std::move(spec)) {
  using ContactLaw = HeatTransferSpec::ContactLaw;
  using GapLaw = HeatTransferSpec::GapLaw;
  if (!spec_.smooth && (spec_.transition_gap || spec_.transition_pressure))
    throw InputError(spec_.where, "a width of transition is given, but the law is not smooth",
                     "smooth = true, or no width");
  transition_gap_ = spec_.transition_gap.value_or(transition_gap_);
  transition_pressure_ = spec_.transition_pressure.value_or(transition_pressure_);
  read_tables();
  check_contact();
  if (spec_.open_conductance)
    open_conductance_ = *spec_.open_conductance;
  else if (spec_.contact_law == ContactLaw::power)
    open_conductance_ = spec_.conductance;
  else if (spec_.contact_law == ContactLaw::table)
    open_conductance_ = contact_tables_.at(0, temperatures_.front()).value;
  check_gap();

  const bool jumps = spots() && spec_.gap_law == GapLaw::gas && spec_.temperature_jump > 0;
  of_temperature_ = contact_tables_.of_temperature() || gap_tables_.of_temperature() || jumps ||
                    (spots() && !spec_.asperities.conductivity.constant());
  check_continuity();
  if (spec_.smooth) check_transition();

  const double e1 = spec_.slave_emissivity, e2 = spec_.master_emissivity;
  if (!(e1 >= 0 && e1 <= 1 && e2 >= 0 && e2 <= 1))
    throw InputError(spec_.where, "an emissivity is not between 0 and 1", "0 to 1");
  if (e1 > 0 && e2 > 0) radiation_factor_ = k_stefan_boltzmann / (1 / e1 + 1 / e2 - 1);
}

void HeatTransferLaw::read_tables() {
  using At = HeatTransferSpec::AtTemperature;
  const auto family = [&](const std::optional<Table>& single, std::optional<Table> At::*member,
                          const char* key) {
    if (single) return TableFamily(*single);
    std::vector<double> temperature;
    std::vector<Table> tables;
    for (const At& at : spec_.families) {
      if (!(at.*member)) continue;
      if (!temperature.empty() && !(at.temperature > temperature.back()))
        throw InputError(spec_.where, fmt::format("the temperatures of '{}' do not increase", key),
                         "the sections [[contact.heat.at]] from cold to hot");
      temperature.push_back(at.temperature);
      tables.push_back(*(at.*member));
    }
    return tables.empty() ? TableFamily() : TableFamily(std::move(temperature), std::move(tables));
  };
  const auto read = [&](bool wanted, const std::optional<Table>& single, std::optional<Table> At::*member,
                        const char* law, const char* key) {
    const bool given = std::any_of(spec_.families.begin(), spec_.families.end(),
                                   [member](const At& at) { return (at.*member).has_value(); });
    if (given && (single || !wanted))
      throw InputError(
          spec_.where,
          single ? fmt::format("'{}' is given both for all temperatures and in [[contact.heat.at]]", key)
                 : fmt::format("[[contact.heat.at]] has '{}', which needs {} = \"table\"", key, law),
          "one of them");
    if (wanted && !single && !given)
      throw InputError(spec_.where, fmt::format("{} = \"table\" needs '{}'", law, key),
                       "a table, here or for some temperatures in [[contact.heat.at]]");
    TableFamily tables = wanted ? family(single, member, key) : TableFamily();
    if (wanted && !(tables.min_value() >= 0))
      throw InputError(spec_.where, fmt::format("'{}' holds a negative conductance", key), "zero or more");
    return tables;
  };
  contact_tables_ = read(spec_.contact_law == HeatTransferSpec::ContactLaw::table, spec_.contact_conductance,
                         &At::contact_conductance, "contact_law", "contact_conductance");
  gap_tables_ = read(spec_.gap_law == HeatTransferSpec::GapLaw::table, spec_.gap_table, &At::gap_table,
                     "gap_law", "gap_conductance");
  for (const TableFamily* tables : {&contact_tables_, &gap_tables_})
    temperatures_.insert(temperatures_.end(), tables->temperatures().begin(), tables->temperatures().end());
  constexpr double k_any = 300;  // without families nothing that is checked depends on it
  if (temperatures_.empty()) temperatures_.push_back(k_any);
}

void HeatTransferLaw::check_contact() const {
  const auto refuse = [&](bool wrong, const char* what, const char* allowed) {
    if (wrong) throw InputError(spec_.where, what, allowed);
  };
  const bool hard = spec_.hardness && *spec_.hardness > 0;
  if (spec_.contact_law == HeatTransferSpec::ContactLaw::power) {
    refuse(!(spec_.conductance >= 0), "the conductance of an interface is negative", "zero or more");
    refuse(!(spec_.exponent >= 0), "the exponent of contact conduction is negative", "zero or more");
    refuse(spec_.exponent > 0 && !hard,
           "pressure-dependent conduction (exponent above zero) needs the hardness", "a hardness above zero");
  }
  if (!spots()) return;
  const Asperities& a = spec_.asperities;
  refuse(!(a.roughness > 0 && a.slope > 0), "spots need the roughness and the slope of the asperities",
         "both above zero");
  refuse(!(a.hardness_coefficient > 0), "spots need the hardness c_1 of small indentations", "above zero");
  refuse(!(a.hardness_exponent > -1 && a.hardness_exponent <= 0),
         "the exponent c_2 of the hardness is out of range",
         "above -1 and at most 0: small indentations are harder");
  refuse(!(a.conductivity.min_value() > 0), "spots need the mean conductivity of the two bodies",
         "above zero: 2 k1 k2 / (k1 + k2)");
  refuse(spec_.gap_law == HeatTransferSpec::GapLaw::gas && !hard, "the gas between spots needs the hardness",
         "a hardness above zero");
}

void HeatTransferLaw::check_gap() const {
  const auto refuse = [&](bool wrong, const char* what, const char* allowed) {
    if (wrong) throw InputError(spec_.where, what, allowed);
  };
  using GapLaw = HeatTransferSpec::GapLaw;
  const bool between_spots = spots() && spec_.gap_law == GapLaw::gas;
  refuse(spec_.temperature_jump != 0 && !between_spots, "a temperature jump belongs to the gas between spots",
         "contact_law = \"spots\" and gap_law = \"gas\"; or none");
  refuse(!(open_conductance_ >= 0), "the conductance across the open gap is negative", "zero or more");
  if (spec_.gap_law == GapLaw::constant)
    refuse(spots() && !spec_.open_conductance,
           "spots with a constant conductance of the gap need open_conductance", "a conductance");
  if (spec_.gap_law != GapLaw::gas) return;
  refuse(!(spec_.gas_conductivity > 0), "the gap law 'gas' needs the conductivity of the gas", "above zero");
  if (between_spots) {
    refuse(spec_.open_conductance.has_value(),
           "the conductance of the gas between spots follows from their roughness",
           "no open_conductance with contact_law = \"spots\" and gap_law = \"gas\"");
    refuse(!(spec_.temperature_jump >= 0), "the temperature jump of the gas is negative", "zero or more");
  } else {
    refuse(!(open_conductance_ > 0), "the gap law 'gas' needs a conductance at zero gap", "above zero");
  }
}

void HeatTransferLaw::check_continuity() const {
  for (const double temperature : temperatures_) {
    const double shut = closed(0, temperature).value, opened = open(0, temperature).value;
    if (std::abs(opened - shut) > 1e-6 * shut)
      throw InputError(
          spec_.where,
          fmt::format("the conductance of the closed interface, {:.6g} W/(m2 K), is not that of "
                      "a gap of zero, {:.6g} W/(m2 K){}",
                      shut, opened, spec_.families.empty() ? "" : fmt::format(", at {:.6g} K", temperature)),
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
    const Branch pressed = closed(p, temperature), parted = open(g, temperature);
    require_monotone(at_contact, pressed.value, p * pressed.slope, "transition_pressure");
    require_monotone(at_contact, parted.value, g * parted.slope, "transition_gap");
  }
}

Conductance HeatTransferLaw::at(double opening, double pressure, double temperature) const {
  const double warmth = std::max(temperature, 0.0);
  const bool parted = opening > 0;
  const double x = parted ? opening : std::max(pressure, 0.0);
  const double width = parted ? transition_gap_ : transition_pressure_;
  const auto branch = [&](double of) { return parted ? open(of, warmth) : closed(of, warmth); };
  Branch h = spec_.smooth && x < width ? transition(x, width, branch(0), branch(width)) : branch(x);
  if (temperature < 0) h.by_temperature = 0;
  return {h.value, parted ? h.slope : 0, parted ? 0 : h.slope, h.by_temperature};
}

HeatTransferLaw::Branch HeatTransferLaw::open(double gap, double temperature) const {
  using GapLaw = HeatTransferSpec::GapLaw;
  switch (spec_.gap_law) {
    case GapLaw::table: {
      const auto h = gap_tables_.at(gap, temperature);
      if (!(h.value > 0)) return {};  // a linear extrapolation may cross zero
      return {h.value, h.by_argument, h.by_temperature, h.mixed};
    }
    case GapLaw::gas: {
      const double k = spec_.gas_conductivity;
      if (!spots()) {
        const double h = k / (gap + k / open_conductance_);
        return {h, -h * h / k, 0, 0};
      }
      const double jump = spec_.temperature_jump;
      const double h = k / (gap + spec_.asperities.separation(0).value + jump * temperature);
      const double by_distance = -h * h / k;
      return {h, by_distance, by_distance * jump, 2 * by_distance * by_distance * jump / h};
    }
    case GapLaw::constant:
      break;
  }
  return {open_conductance_, 0, 0, 0};
}

HeatTransferLaw::Branch HeatTransferLaw::closed(double pressure, double temperature) const {
  using ContactLaw = HeatTransferSpec::ContactLaw;
  if (spec_.contact_law == ContactLaw::table) {
    const auto h = contact_tables_.at(pressure, temperature);
    if (!(h.value > 0)) return {};
    return {h.value, h.by_argument, h.by_temperature, h.mixed};
  }
  if (spots()) return pressed_spots(pressure, temperature);
  if (spec_.exponent == 0) return {spec_.conductance, 0, 0, 0};
  const Branch gas = open(0, temperature);
  if (!(pressure > 0)) return {gas.value, 0, gas.by_temperature, 0};
  const double h = spec_.conductance * std::pow(pressure / *spec_.hardness, spec_.exponent);
  return {gas.value + h, spec_.exponent * h / pressure, gas.by_temperature, 0};
}

HeatTransferLaw::Branch HeatTransferLaw::pressed_spots(double pressure, double temperature) const {
  const Asperities::Pressed spots = spec_.asperities.spots(pressure, temperature);
  if (spec_.gap_law != HeatTransferSpec::GapLaw::gas) {
    const Branch gas = open(0, temperature);
    return {gas.value + spots.value, spots.by_pressure, gas.by_temperature + spots.by_temperature,
            spots.mixed};
  }
  const Asperities::Separation y = spec_.asperities.separation(pressure / *spec_.hardness);
  const double k = spec_.gas_conductivity, jump = spec_.temperature_jump;
  const double h = k / (y.value + jump * temperature);
  const double by_distance = -h * h / k, by_pressure = y.slope / *spec_.hardness;
  return {h + spots.value, by_distance * by_pressure + spots.by_pressure,
          by_distance * jump + spots.by_temperature,
          2 * by_distance * by_distance * jump / h * by_pressure + spots.mixed};
}

/// The cubic from the start's value with slope zero to value and slope of the end.
HeatTransferLaw::Branch HeatTransferLaw::transition(double x, double width, const Branch& start,
                                                    const Branch& end) {
  const double t = x / width, t2 = t * t, t3 = t2 * t;
  const double to_end = 3 * t2 - 2 * t3, to_slope = (t3 - t2) * width;
  const double of_end = 6 * (t - t2) / width, of_slope = 3 * t2 - 2 * t;
  const double rise = end.value - start.value, warmed = end.by_temperature - start.by_temperature;
  return {start.value + to_end * rise + to_slope * end.slope, of_end * rise + of_slope * end.slope,
          start.by_temperature + to_end * warmed + to_slope * end.mixed,
          of_end * warmed + of_slope * end.mixed};
}

}  // namespace solidus::contact
