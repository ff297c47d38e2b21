#include "heat/loads/channel_film.hpp"

#include <cmath>
#include <numbers>

namespace solidus::heat {

namespace {

double dittus_boelter(double reynolds, double prandtl, bool heated) {
  return 0.023 * std::pow(reynolds, 0.8) * std::pow(prandtl, heated ? 0.4 : 0.3);
}

double gnielinski(double reynolds, double prandtl) {
  const double root = 1 / (0.79 * std::log(reynolds) - 1.64), eighth = root * root / 8;
  return eighth * (reynolds - 1000) * prandtl /
         (1 + 12.7 * std::sqrt(eighth) * (std::cbrt(prandtl * prandtl) - 1));
}

}  // namespace

double nusselt(ChannelLaw law, double laminar, double reynolds, double prandtl, bool heated) {
  if (reynolds <= k_laminar_reynolds) return laminar;
  const bool of_dittus = law == ChannelLaw::dittus_boelter;
  const auto turbulent = [&](double re) {
    return of_dittus ? dittus_boelter(re, prandtl, heated) : gnielinski(re, prandtl);
  };
  // The straight line of the transition, up to where the law begins to hold.
  const double from = of_dittus ? 1e4 : 4e3;
  if (reynolds >= from) return turbulent(reynolds);
  const double share = (reynolds - k_laminar_reynolds) / (from - k_laminar_reynolds);
  return (1 - share) * laminar + share * turbulent(from);
}

double reynolds_number(double mass_flow, double diameter, double viscosity) {
  return 4 * mass_flow / (std::numbers::pi * diameter * viscosity);
}

}  // namespace solidus::heat
