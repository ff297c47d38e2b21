/// Probes and profiles become what the recorder samples.
#include "setup/run_input.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "coupling/all_fields.hpp"

namespace solidus::setup {

namespace {

/// @param probe  ProbeSpec or ProfileColumnSpec
template <class S>
results::Sampled sampled(const cases::CaseSpec& spec, const S& probe) {
  results::Sampled result;
  result.column = {probe.name, probe.unit};
  result.field = probe.field;
  result.where = probe.where;
  try {
    result.component = results::component_index(
        probe.component, coupling::field_of(probe.field).components(spec.analysis.kind), spec.analysis.kind);
  } catch (const std::invalid_argument& error) {
    throw InputError(probe.where,
                     fmt::format("probe '{}' of the field '{}': {}", probe.name, probe.field, error.what()));
  }
  return result;
}

results::Statistic statistic(cases::ProbeSpec::Kind kind) {
  switch (kind) {
    case cases::ProbeSpec::Kind::minimum:
      return results::Statistic::minimum;
    case cases::ProbeSpec::Kind::maximum:
      return results::Statistic::maximum;
    case cases::ProbeSpec::Kind::integral:
      return results::Statistic::integral;
    default:
      return results::Statistic::mean;
  }
}

results::PointProbe point_probe(const cases::CaseSpec& spec, const cases::ProbeSpec& probe) {
  results::PointProbe result{sampled(spec, probe)};
  for (std::size_t i = 0; i < probe.point.size(); ++i) result.at[i] = probe.point[i];
  if (probe.body)
    for (std::size_t b = 0; b < spec.bodies.size(); ++b)
      if (spec.bodies[b].name == *probe.body) result.body = static_cast<int>(b);
  return result;
}

}  // namespace

std::vector<results::Probe> probes(const cases::CaseSpec& spec) {
  std::vector<results::Probe> result;
  for (const cases::ProbeSpec& probe : spec.probes) {
    // A difference is one of two other probes, and a global one a column of the history under
    // another name.
    switch (probe.kind) {
      case cases::ProbeSpec::Kind::point:
        result.emplace_back(point_probe(spec, probe));
        break;
      case cases::ProbeSpec::Kind::mean:
      case cases::ProbeSpec::Kind::minimum:
      case cases::ProbeSpec::Kind::maximum:
      case cases::ProbeSpec::Kind::integral:
        result.emplace_back(results::GroupProbe{sampled(spec, probe), probe.group, statistic(probe.kind)});
        break;
      case cases::ProbeSpec::Kind::difference:
        result.emplace_back(results::LinearProbe{
            {probe.name, probe.unit}, {{1.0, probe.of[0]}, {-1.0, probe.of[1]}}, probe.where});
        break;
      case cases::ProbeSpec::Kind::global:
        result.emplace_back(
            results::GlobalProbe{{probe.name, probe.unit}, probe.global, probe.factor, probe.where});
        break;
    }
  }
  return result;
}

std::vector<results::Profile> profiles(const cases::CaseSpec& spec) {
  std::vector<results::Profile> result;
  for (const cases::ProfileSpec& profile : spec.profiles) {
    result.push_back({profile.name, profile.group, profile.length_unit, {}, profile.where});
    for (const cases::ProfileColumnSpec& column : profile.columns)
      result.back().columns.push_back(sampled(spec, column));
  }
  return result;
}

}  // namespace solidus::setup
