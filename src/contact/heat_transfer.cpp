#include "contact/heat_transfer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/types.hpp"

namespace solidus::contact {

HeatTransferLaw::HeatTransferLaw(HeatTransferSpec spec) : spec_(std::move(spec)) {
  const auto refuse = [&](bool wrong, const char* what, const char* allowed) {
    if (wrong) throw InputError(spec_.where, what, allowed);
  };
  refuse(!(spec_.conductance >= 0), "the conductance of an interface is negative", "zero or more");
  refuse(!(spec_.exponent >= 0), "the exponent of contact conduction is negative", "zero or more");
  refuse(spec_.exponent > 0 && !(spec_.hardness && *spec_.hardness > 0),
         "pressure-dependent conduction (exponent above zero) needs the hardness", "a hardness above zero");
  open_conductance_ = spec_.open_conductance.value_or(spec_.conductance);
  refuse(!(open_conductance_ >= 0), "the conductance across the open gap is negative", "zero or more");
  if (spec_.gap_law == HeatTransferSpec::GapLaw::gas) {
    refuse(!(spec_.gas_conductivity > 0), "the gap law 'gas' needs the conductivity of the gas",
           "above zero");
    refuse(!(open_conductance_ > 0), "the gap law 'gas' needs a conductance at zero gap", "above zero");
  }
  if (spec_.gap_law == HeatTransferSpec::GapLaw::table)
    refuse(!(spec_.gap_table.min_value() >= 0), "the gap table holds a negative conductance", "zero or more");

  at_contact_ = open(0);
  if (spec_.exponent == 0 && std::abs(at_contact_ - spec_.conductance) > 1e-6 * spec_.conductance)
    throw InputError(
        spec_.where,
        fmt::format("the conductance of the closed interface, {:.6g} W/(m2 K), is not that of a gap of zero, "
                    "{:.6g} W/(m2 K)",
                    spec_.conductance, at_contact_),
        "equal values, so that heat does not jump when the gap opens");

  const double e1 = spec_.slave_emissivity, e2 = spec_.master_emissivity;
  refuse(!(e1 >= 0 && e1 <= 1 && e2 >= 0 && e2 <= 1), "an emissivity is not between 0 and 1", "0 to 1");
  if (e1 > 0 && e2 > 0) radiation_factor_ = k_stefan_boltzmann / (1 / e1 + 1 / e2 - 1);
}

double HeatTransferLaw::open(double gap) const {
  using GapLaw = HeatTransferSpec::GapLaw;
  switch (spec_.gap_law) {
    case GapLaw::table:
      return std::max(spec_.gap_table.value(gap), 0.0);  // a linear extrapolation may cross zero
    case GapLaw::gas:
      return spec_.gas_conductivity / (gap + spec_.gas_conductivity / open_conductance_);
    case GapLaw::constant:
      break;
  }
  return open_conductance_;
}

double HeatTransferLaw::slope(double opening, double pressure, double penalty) const {
  using GapLaw = HeatTransferSpec::GapLaw;
  if (opening <= 0) {
    if (spec_.exponent == 0 || !(pressure > 0)) return 0;
    return -penalty * spec_.exponent * (closed(pressure) - at_contact_) / pressure;
  }
  const double h = open(opening);
  switch (spec_.gap_law) {
    case GapLaw::table:
      return h > 0 ? spec_.gap_table.derivative(opening) : 0.0;
    case GapLaw::gas:
      return -h * h / spec_.gas_conductivity;
    case GapLaw::constant:
      break;
  }
  return 0;
}

double HeatTransferLaw::closed(double pressure) const {
  if (spec_.exponent == 0) return spec_.conductance;
  return at_contact_ +
         spec_.conductance * std::pow(std::max(pressure, 0.0) / *spec_.hardness, spec_.exponent);
}

}  // namespace solidus::contact
