/// Temperatures between which a body freezes, and the time within a step at which a node passes them.
#pragma once

#include <cstddef>

#include "criteria/criterion.hpp"
#include "heat/storage/nodal_enthalpy.hpp"

namespace solidus::criteria {

/// Temperature, and on an isothermal change the heat content, is linear in time within a step.
struct FreezingLevels {
  double solidus = 0, liquidus = 0;                  ///< [K]
  bool solidus_jump = false, liquidus_jump = false;  ///< part of the change is isothermal there
  bool freezes = false;

  static FreezingLevels of(const material::Material& material);
  /// The share of the step at which an owned node passes the liquidus, or the solidus, on its way down.
  double begin(const heat::NodalEnthalpy& storage, Index node, const CriterionInput& old,
               const CriterionInput& next) const;
  double end(const heat::NodalEnthalpy& storage, Index node, const CriterionInput& old,
             const CriterionInput& next) const;
};

/// The share at which something linear passes a level downwards; one where it does not.
double passing(double from, double to, double level);

}  // namespace solidus::criteria
