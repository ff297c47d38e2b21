/// Each watch keeps the worst step and speaks once, while the run goes on or at its end.
#include "run/audit_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

#include "coupling/energy_scale.hpp"
#include "system/alike_texts.hpp"
#include "system/log.hpp"

namespace solidus::run {

namespace {

/// The scheme closes the first law to its residuals.
bool closes_first_law(const cases::CaseSpec& spec) {
  return !spec.coupled() ||
         (spec.coupling.structural_heating == cases::CouplingSpec::StructuralHeatForm::energy &&
          !spec.coupling.as_printed);
}

}  // namespace

void StabilityWatch::step(const coupling::StepRecord& record, const coupling::State&) {
  const coupling::StabilityAudit& l = record.stability;
  // Growth within the tolerance of residuals and rounding is no sign of anything.
  if (warned_ || !admissibility_.holds() || !(l.increment() > l.tolerance)) return;
  const coupling::SchemeKind& scheme = *spec_.coupling.scheme;
  logging::warn(
      "t = {:g} s, step {}: the functional L of stability grew by {:.3g} J ({:+.3g} in the mechanical, "
      "{:+.3g} in "
      "the thermal phase; {:.1g} J are residuals and rounding), though nothing feeds it; {}",
      record.time, record.number, l.increment(), l.mechanical, l.thermal, l.tolerance,
      scheme.traits().needs_weak_coupling
          ? fmt::format("the {} split is unstable here: scheme = \"{}\" in [coupling]", scheme.name(),
                        coupling::k_stable_scheme)
          : "try smaller steps, a smaller mechanics.tolerance, smoother property tables");
  warned_ = true;
}

void FirstLawWatch::begin(const coupling::State& state) {
  if (heat_ != nullptr) heat_content_ = coupling::heat_content(*heat_, state.heat);
}

void FirstLawWatch::step(const coupling::StepRecord& record, const coupling::State&) {
  sum_ += record.energy;
  unsolved_ += std::abs(record.energy.unbalanced) + record.heat.residual * record.energy.heat_exchanged;
}

void FirstLawWatch::report() const {
  constexpr double k_rounding = 1e-9, k_seen = 1e-3;  // of the scale
  const double defect = std::abs(sum_.defect()), scale = coupling::energy_scale(sum_, heat_content_);
  const bool closes = closes_first_law(spec_);
  if (!(defect > unsolved_ + (closes ? k_rounding : k_seen) * scale)) return;
  const bool printed = spec_.coupled() && (spec_.coupling.structural_heating !=
                                               cases::CouplingSpec::StructuralHeatForm::energy ||
                                           spec_.coupling.as_printed);
  logging::warn("the first law is violated by {:.2g} of the {}, {:.3g} J; {}", defect / scale,
                scale == sum_.heat_exchanged ? "heat exchanged" : "energy at hand", sum_.defect(),
                printed ? "structural_heating = \"energy\" in [coupling] closes it, smaller steps lose less"
                        : "smaller steps lose less");
}

void WallWatch::step(const coupling::StepRecord& record, const coupling::State&) {
  for (std::size_t i = 0; i < largest_.size(); ++i) {
    const coupling::ContactSummary& now = record.contacts[i];
    if (!(now.left_area > 0)) continue;
    Largest& largest = largest_[i];
    largest.area = std::max(largest.area, now.left_area);
    if (now.left_gap > largest.gap) {
      largest.gap = now.left_gap;
      largest.time = record.time;
    }
  }
}

void WallWatch::report() const {
  // Pairs by the largest gap, the worst first.
  std::vector<std::size_t> order(largest_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return largest_[i].gap; });
  std::vector<std::string> texts;
  for (const std::size_t i : order)
    if (largest_[i].area > 0)
      texts.push_back(fmt::format(
          "contact '{}': liquid metal left its wall, {:.3g} mm2 of it at most, by up to {:.3g} mm at "
          "t = {:g} s; more than {:.3g} mm, 1 % of the free contraction, counts",
          contacts_[i]->parts().spec.name, 1e6 * largest_[i].area, 1e3 * largest_[i].gap, largest_[i].time,
          1e3 * contacts_[i]->parts().spec.leaving_gap));
  for (const std::string& text : logging::told_once(texts)) logging::warn("{}", text);
}

}  // namespace solidus::run
