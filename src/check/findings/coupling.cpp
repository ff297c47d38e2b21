// Findings on the coupling of deformation and heat.
#include <fmt/format.h>

#include <algorithm>

#include "check/coupling_estimate.hpp"
#include "check/finding_family.hpp"
#include "coupling/scheme_names.hpp"
#include "setup/scheme_input.hpp"

namespace solidus::check {

namespace {

constexpr double k_late = 0.03;  // of what changes evenly over the run

/// A scheme that conducts heat before deformation has taken up its share is late by δ_K steps.
void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  if (!spec.exchanges_heat() || !(m.effort.steps > 0)) return;
  // The lag in steps, over the number of steps, is the share of the run by which temperatures come
  // late.
  const std::vector<CouplingEstimate> estimates = coupling_estimates(spec, a.materials, a.mesh, a.start);
  const double steps = heat_lag(spec, estimates, setup::keeps_strain(spec, a.materials, a.start));
  const double share = steps / m.effort.steps;
  if (share < k_late) return;
  // The body with the strongest coupling is the one named.
  const CouplingEstimate& strongest = *std::max_element(
      estimates.begin(), estimates.end(),
      [](const CouplingEstimate& l, const CouplingEstimate& r) { return l.decisive() < r.decisive(); });
  findings.push_back(
      {false, strongest.where,
       fmt::format("deformation takes up {:.2g} times the heat that '{}' stores at rest, and the {} scheme "
                   "conducts before it does: temperatures lag by {:.2g} steps, {:.0f} % of what changes "
                   "evenly over {:.0f} steps",
                   strongest.decisive(), strongest.body, spec.coupling.scheme->name(), steps, 100 * share,
                   m.effort.steps),
       fmt::format(
           "coupling.scheme = {} does not lag; shorter steps lag less. In metals it is below 0.1 times: "
           "are expansion and Poisson's ratio right?",
           coupling::names_of_schemes([](const coupling::SchemeTraits& t) {
             return t.mapping == mechanics::Mapping::simultaneous;
           }))});
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_coupling() {
  return {.name = "coupling",
          .place = 300,
          .find = &find,
          .rows = {{Topic::mechanics, "temperatures lag",
                    fmt::format("in a scheme that conducts heat before the deformation takes up its part of "
                                "it: by {} or more of temperatures that change evenly over the run "
                                "([theory](../theory/coupling_stability.md#9-what-the-program-computes))",
                                percent(k_late))}}};
}

}  // namespace solidus::check
