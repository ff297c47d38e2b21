/// Carbon balances of the eutectic by the lever rule or by Scheil's, in mass per cent.
#include "material/graphite.hpp"

#include <algorithm>
#include <cmath>

namespace solidus::material {

namespace {

/// Graphite of a melt that splits into austenite and graphite [mass per cent].
double by_lever(double carbon, double austenite) {
  return std::max(0.0, 100 * (carbon - austenite) / (100 - austenite));
}

}  // namespace

double Graphite::eutectic() const {
  return 4.26 - 0.31 * silicon;
}

double Graphite::austenite() const {
  return 2.08 - 0.11 * silicon;
}

double Graphite::feeding_share(double rigidity) const {
  constexpr double k_compacted = 1.5, k_nodular = 2;
  const double exponent = form == Form::flake ? 1.0 : form == Form::compacted ? k_compacted : k_nodular;
  return std::pow(rigidity, exponent);
}

double Graphite::precipitated() const {
  const double melt = eutectic(), solid = austenite();
  if (rule == Rule::lever || carbon >= melt) return by_lever(carbon, solid);
  const double partition = solid / melt;
  return std::pow(carbon / melt, 1 / (1 - partition)) * by_lever(melt, solid);
}

}  // namespace solidus::material
