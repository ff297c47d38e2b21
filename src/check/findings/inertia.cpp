// Findings on inertia that only costs.
#include <fmt/format.h>

#include "check/finding_family.hpp"

namespace solidus::check {

namespace {

constexpr double k_long = 0.1;  // steps [s]

/// Waves cross a casting in microseconds: inertia over steps so much longer only costs.
void find(const cases::CaseSpec& spec, const setup::Assembly&, const CaseMeasures&, Findings& findings) {
  if (!spec.has_mechanics() || !spec.dynamics || !spec.time.step || *spec.time.step < k_long) return;
  findings.push_back({false, spec.time.where,
                      fmt::format("inertia with steps of {:g} s: waves cross the bodies within a millisecond",
                                  *spec.time.step),
                      "no [dynamics]: castings freeze in equilibrium; inertia is for shocks and vibrations"});
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_inertia() {
  return {.name = "inertia",
          .place = 200,
          .find = &find,
          .rows = {{Topic::mechanics, "inertia", fmt::format("with steps above {} s", number(k_long))}}};
}

}  // namespace solidus::check
