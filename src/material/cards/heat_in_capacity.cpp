/// The integral of a capacity over the freezing range against a straight line tells whether it holds latent
/// heat; if so it becomes an enthalpy or loses its peak.
#include "material/cards/heat_in_capacity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace solidus::material {

namespace {

// At the ends of the freezing range, where the specific heat may jump, the side without melt or solid goes on
// as the row before it has it.
void integrate_capacity(ImportColumns& c, std::size_t solidus, std::size_t liquidus) {
  const auto& t = c.temperature;
  const auto& heat = c.of("specific_heat");
  std::vector<double> enthalpy(t.size(), 0);
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    double cold = heat[i], hot = heat[i + 1];
    constexpr double k_jump = 1.5;
    if (i + 1 == solidus && hot > k_jump * cold) hot = cold;
    if (i == liquidus && cold > k_jump * hot) cold = hot;
    enthalpy[i + 1] = enthalpy[i] + 0.5 * (cold + hot) * (t[i + 1] - t[i]);
  }
  c.values["enthalpy"] = std::move(enthalpy);
  c.headers["enthalpy"] = c.headers["specific_heat"];
}

// A line over the freezing range.
void take_heat_out(ImportColumns& c, std::size_t solidus, std::size_t liquidus) {
  const auto& t = c.temperature;
  std::vector<double>& heat = c.values["specific_heat"];
  const std::size_t last = t.size() - 1;
  const double below = heat[solidus > 0 ? solidus - 1 : liquidus + 1],
               above = heat[liquidus < last ? liquidus + 1 : solidus - 1];
  for (std::size_t i = solidus; i <= liquidus; ++i) {
    const double width = t[liquidus] - t[solidus];
    heat[i] = std::lerp(below, above, width > 0 ? (t[i] - t[solidus]) / width : 0.5);
  }
}

}  // namespace

double heat_in_capacity(const ImportColumns& c, std::size_t solidus, std::size_t liquidus) {
  const auto& t = c.temperature;
  const auto& heat = c.of("specific_heat");
  const std::size_t last = t.size() - 1;
  // The table must have a row next to the range, which tells what a phase without latent heat has.
  if (solidus == 0 && liquidus == last) return 0;
  // A plain capacity would go straight over the range; what is far above that is heat of freezing.
  const double below = heat[solidus > 0 ? solidus - 1 : liquidus + 1],
               above = heat[liquidus < last ? liquidus + 1 : solidus - 1];
  // The integral of the column over the range against that of a straight line.
  double all = 0;
  for (std::size_t i = solidus; i < liquidus; ++i) all += 0.5 * (heat[i] + heat[i + 1]) * (t[i + 1] - t[i]);
  const double plain = 0.5 * (below + above) * (t[liquidus] - t[solidus]);
  constexpr double k_share = 0.5, k_least = 1e4;  // [J/kg]: mush differs from its phases by less
  return all - plain > std::max(k_share * plain, k_least) ? all - plain : 0;
}

std::string take_heat_once(ImportColumns& c, std::size_t solidus, std::size_t liquidus,
                           bool latent_heat_is_given) {
  // Where the peak of the capacity holds the latent heat it must count once: as an enthalpy, or not
  // at all.
  const double held = heat_in_capacity(c, solidus, liquidus);
  if (held == 0) return {};
  if (latent_heat_is_given) {
    take_heat_out(c, solidus, liquidus);
    return fmt::format(
        "the specific heat holds a heat of freezing of {:.4g} kJ/kg by its integral against its "
        "neighbours, which is taken out: --latent-heat is in its place",
        1e-3 * held);
  }
  integrate_capacity(c, solidus, liquidus);
  return fmt::format(
      "the specific heat holds the heat of freezing, {:.4g} kJ/kg by its integral against its "
      "neighbours: the heat of freezing is taken from it, once",
      1e-3 * held);
}

}  // namespace solidus::material
