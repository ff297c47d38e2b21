/// Properties are compared with the temperatures of their body after every step; each is told once.
#include "run/range_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "material/cards/library.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/body_input.hpp"
#include "system/log.hpp"

namespace solidus::run {

namespace {

bool is_thermal(const std::string& property) {
  return property == "conductivity" || property == "specific_heat";
}

/// By how much temperatures may leave the data [K].
double margin(const material::LeftRange& range) {
  return range.refused ? 0.0 : std::max(10.0, 0.05 * (range.valid_to - range.valid_from));
}

/// Returns the properties that act in this body and leave their data at these temperatures.
std::vector<material::LeftRange> left_ranges(const cases::CaseSpec& spec, std::size_t body,
                                             const material::Material& material, double low, double high) {
  std::vector<material::LeftRange> left;
  // Thermal and mechanical properties act up to different temperatures.
  const auto add = [&](bool thermal, double hottest) {
    if (low > hottest) return;
    for (const material::LeftRange& range : material::left_ranges(material, low, hottest))
      if (is_thermal(range.property) == thermal &&
          (low < range.valid_from - margin(range) || hottest > range.valid_to + margin(range)))
        left.push_back(range);
  };
  // Mechanical properties act where the body deforms.
  if (spec.has_heat()) add(true, high);
  if (!spec.has_mechanics() || cases::only_conducts(spec.bodies[body])) return left;
  const material::PhaseChange* freezing = material.solidification();
  add(false, freezing != nullptr ? std::min(high, freezing->fraction.solidus()) : high);
  return left;
}

/// " of 1380 degC", "s of 20 to 1380 degC".
std::string span_text(double low, double high) {
  const std::string from = fmt::format("{:.0f}", low - k_zero_celsius),
                    to = fmt::format("{:.0f}", high - k_zero_celsius);
  return from == to ? fmt::format(" of {} degC", to) : fmt::format("s of {} to {} degC", from, to);
}

}  // namespace

std::string left_data(const cases::CaseSpec& spec, std::size_t body, const material::Material& material,
                      double low, double high, std::vector<std::string>& said) {
  std::string text;
  double from = 0, to = 0;  // of the range named last
  // Properties are told once for a body, those with the same range together, in one sentence. A table that
  // refuses to be extrapolated ends the run.
  for (const material::LeftRange& left : left_ranges(spec, body, material, low, high)) {
    const std::string holds = fmt::format("its data hold from {:.1f} to {:.1f} degC",
                                          left.valid_from - k_zero_celsius, left.valid_to - k_zero_celsius);
    const std::string used = fmt::format("body '{}', material '{}': ", spec.bodies[body].name, material.name);
    // A table that may not be extrapolated ends the run with its place.
    if (left.refused)
      throw InputError(spec.bodies[body].where,
                       fmt::format("{}{} is used between {:.1f} and {:.1f} degC, {}", used, left.property,
                                   low - k_zero_celsius, high - k_zero_celsius, holds),
                       "a table that reaches further, or another extrapolation");
    if (std::find(said.begin(), said.end(), left.property) != said.end()) continue;
    said.push_back(left.property);
    // Properties of one range share one pair of brackets.
    if (text.empty())
      text = fmt::format("{}data that do not reach its temperature{}: {}", used, span_text(low, high),
                         left.property);
    else if (left.valid_from == from && left.valid_to == to)
      text.insert(text.rfind(" ("), ", " + left.property);
    else
      text += ", " + left.property;
    if (left.valid_from != from || left.valid_to != to)
      text += fmt::format(" ({:.0f} to {:.0f} degC)", left.valid_from - k_zero_celsius,
                          left.valid_to - k_zero_celsius);
    from = left.valid_from;
    to = left.valid_to;
  }
  return text;
}

void RangeWatch::look(const coupling::State& state) {
  const std::vector<double>& temperature = a_.heat ? state.heat.temperature : a_.phases.temperature;
  // The range of temperatures of each body that takes part, over all processes.
  std::vector<double> low(spec_.bodies.size(), 1e300), high(spec_.bodies.size(), -1e300);
  for (const mesh::ElementBlock& block : a_.mesh.blocks) {
    if (a_.heat && !heat::active(*a_.heat).body(block.body)) continue;
    for (const Index i : block.nodes) {
      const auto b = as_size(block.body);
      low[b] = std::min(low[b], temperature[as_size(i)]);
      high[b] = std::max(high[b], temperature[as_size(i)]);
    }
  }
  // After the extremes of all processes are known.
  for (std::size_t b = 0; b < low.size(); ++b) {
    const double lowest = parallel::global_min(low[b]), highest = parallel::global_max(high[b]);
    if (lowest > highest) continue;  // it has gone
    const std::string text = left_data(spec_, b, a_.materials[b], lowest, highest, warned_[b]);
    if (!text.empty()) logging::warn("{}", text);
  }
}

}  // namespace solidus::run
