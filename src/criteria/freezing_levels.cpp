/// Times within a step at which a temperature passes a level, linear in between.
#include "criteria/freezing_levels.hpp"

#include <algorithm>

#include "numbers/index_casts.hpp"

namespace solidus::criteria {

double passing(double from, double to, double level) {
  return from > to ? std::clamp((from - level) / (from - to), 0.0, 1.0) : 1.0;
}

FreezingLevels FreezingLevels::of(const material::Material& material) {
  FreezingLevels levels;
  const material::PhaseChange* change = material.solidification();
  if (change == nullptr) return levels;
  const material::PhaseFraction& fraction = change->fraction;
  levels.freezes = true;
  levels.solidus = fraction.solidus();
  levels.liquidus = fraction.liquidus();
  levels.solidus_jump = fraction.above(levels.solidus) < 1;
  levels.liquidus_jump = fraction.below(levels.liquidus) > 0;
  return levels;
}

double FreezingLevels::begin(const heat::NodalEnthalpy& storage, Index node, const CriterionInput& old,
                             const CriterionInput& next) const {
  const auto i = as_size(node);
  if (liquidus_jump && !next.heat.enthalpy.empty())
    return passing(old.heat.enthalpy[i], next.heat.enthalpy[i], storage.upper(node, liquidus));
  return passing(old.heat.temperature[i], next.heat.temperature[i], liquidus);
}

double FreezingLevels::end(const heat::NodalEnthalpy& storage, Index node, const CriterionInput& old,
                           const CriterionInput& next) const {
  const auto i = as_size(node);
  if (solidus_jump && !next.heat.enthalpy.empty())
    return passing(old.heat.enthalpy[i], next.heat.enthalpy[i], storage.lower(node, solidus));
  return passing(old.heat.temperature[i], next.heat.temperature[i], solidus);
}

}  // namespace solidus::criteria
