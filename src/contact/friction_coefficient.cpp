#include "contact/friction_coefficient.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace solidus::contact {
namespace {

[[noreturn]] void refuse_thermal_hardening(const SourceLocation& where, double from, double at, double to,
                                           double then) {
  throw InputError(
      where,
      fmt::format("the initial coefficient of friction rises with temperature, from {:.6g} at {:.6g} K to "
                  "{:.6g} at {:.6g} K: slip there would take entropy away (3.59, 3.60)",
                  from, at, to, then),
      "a coefficient at zero internal variable that falls or stays level with temperature");
}

void check_positive(const SourceLocation& where, double coefficient) {
  if (!(coefficient > 0))
    throw InputError(where, fmt::format("a coefficient of friction is {:.6g}", coefficient),
                     "coefficients above zero; for contact without friction leave [contact.friction] out");
}

}  // namespace

FrictionCoefficient::FrictionCoefficient(FrictionCoefficientSpec spec) : spec_(std::move(spec)) {
  if (spec_.terms.empty() == spec_.curves.empty())
    throw InputError(spec_.where,
                     spec_.terms.empty() ? "no coefficient of friction" : "two coefficients of friction",
                     "either coefficient (a number, or terms of a polynomial) or curves over the internal "
                     "variable");
  if (!(spec_.unit > 0))
    throw InputError(spec_.where, "the unit of the internal variable is not positive", "a unit above zero");
  per_unit_ = 1 / spec_.unit;
  if (!spec_.terms.empty())
    check_terms();
  else
    check_curves();
}

void FrictionCoefficient::check_terms() {
  const Table& initial = spec_.terms.front();
  for (std::size_t i = 0; i < initial.y().size(); ++i) {
    check_positive(spec_.where, initial.y()[i]);
    if (i > 0 && initial.y()[i] > initial.y()[i - 1])
      refuse_thermal_hardening(spec_.where, initial.y()[i - 1], initial.x()[i - 1], initial.y()[i],
                               initial.x()[i]);
  }
  const auto depends = [](const Table& t) { return !t.constant(); };
  hardening_depends_on_temperature_ = std::any_of(spec_.terms.begin() + 1, spec_.terms.end(), depends);
  if (hardening_depends_on_temperature_ || depends(initial)) return;
  for (const Table& term : spec_.terms) numbers_.push_back(term.y()[0]);
}

void FrictionCoefficient::check_curves() {
  auto& curves = spec_.curves;
  std::sort(curves.begin(), curves.end(),
            [](const FrictionCurve& a, const FrictionCurve& b) { return a.temperature < b.temperature; });
  for (const FrictionCurve& curve : curves) {
    if (!curve.coefficient.constant() && curve.coefficient.x().front() != 0)
      throw InputError(spec_.where,
                       fmt::format("a friction curve starts at {:.6g}", curve.coefficient.x().front()),
                       "curves that start at an internal variable of 0");
    check_positive(spec_.where, curve.coefficient.min_value());
  }
  for (std::size_t i = 1; i < curves.size(); ++i) {
    const FrictionCurve &a = curves[i - 1], &b = curves[i];
    if (a.temperature == b.temperature)
      throw InputError(spec_.where, fmt::format("two friction curves at {:.6g} K", a.temperature),
                       "one curve per temperature, each with its temperature");
    const double from = a.coefficient.value(0), to = b.coefficient.value(0);
    if (to > from) refuse_thermal_hardening(spec_.where, from, a.temperature, to, b.temperature);
  }
  hardening_depends_on_temperature_ = curves.size() > 1;
}

FrictionCoefficient::Between FrictionCoefficient::between(double theta) const {
  const auto& curves = spec_.curves;
  if (theta < curves.front().temperature)
    return {&curves.front().coefficient, &curves.front().coefficient, 0, 0};
  std::size_t i = curves.size() - 1;
  if (theta >= curves[i].temperature) return {&curves[i].coefficient, &curves[i].coefficient, 0, 0};
  while (curves[i].temperature > theta) --i;  // there are few
  const double per_kelvin = 1 / (curves[i + 1].temperature - curves[i].temperature);
  return {&curves[i].coefficient, &curves[i + 1].coefficient, (theta - curves[i].temperature) * per_kelvin,
          per_kelvin};
}

FrictionCoefficient::Point FrictionCoefficient::point(double zeta, double theta) const {
  const double z = zeta * per_unit_;
  Point r;
  if (!spec_.terms.empty()) {
    const auto initial = spec_.terms.front().line(theta);
    r.initial = initial.value;
    r.initial_theta = initial.slope;
    // Horner's rule for Σ c_p z^(p−1), its derivative and Σ c_p z^(p−1)/(p + 1), p >= 1.
    double value = 0, slope = 0, theta_value = 0, theta_slope = 0, stored = 0, stored_theta = 0;
    for (std::size_t p = spec_.terms.size() - 1; p > 0; --p) {
      const auto c = spec_.terms[p].line(theta);
      const double share = 1.0 / static_cast<double>(p + 1);
      slope = slope * z + value;
      value = value * z + c.value;
      theta_slope = theta_slope * z + theta_value;
      theta_value = theta_value * z + c.slope;
      stored = stored * z + c.value * share;
      stored_theta = stored_theta * z + c.slope * share;
    }
    r.value = r.initial + value * z;
    r.zeta = (slope * z + value) * per_unit_;
    r.theta = theta_value * z;
    r.zeta_theta = (theta_slope * z + theta_value) * per_unit_;
    r.stored = stored * z * zeta;
    r.stored_theta = stored_theta * z * zeta;
    return r;
  }
  const Between at = between(theta);
  const auto one = [&](const Table& table) {
    const auto line = table.line(z);
    const double initial = table.value(0);
    return Point{line.value,
                 line.slope * per_unit_,
                 0,
                 0,
                 initial,
                 0,
                 (table.integral(0, z) - initial * z) * spec_.unit,
                 0};
  };
  r = one(*at.first);
  if (at.second == at.first) return r;
  const Point b = one(*at.second);
  const auto mix = [&](double& first, double second) {
    const double difference = second - first;
    first += at.share * difference;
    return at.per_kelvin * difference;
  };
  r.initial_theta = mix(r.initial, b.initial);
  r.theta = mix(r.value, b.value) - r.initial_theta;
  r.zeta_theta = mix(r.zeta, b.zeta);
  r.stored_theta = mix(r.stored, b.stored);
  return r;
}

FrictionCoefficient::Bounds FrictionCoefficient::slopes(double from, double to, double theta) const {
  const double a = from * per_unit_, b = to * per_unit_;
  Bounds r{0, 0};
  if (!spec_.terms.empty()) {
    double at_a = 1, at_b = 1;  // z^(p−1)
    for (std::size_t p = 1; p < spec_.terms.size(); ++p, at_a *= a, at_b *= b) {
      const double c = static_cast<double>(p) * spec_.terms[p].value(theta);
      r.low += std::min(c * at_a, c * at_b);
      r.high += std::max(c * at_a, c * at_b);
    }
  } else {
    const auto of_table = [&](const Table& table) {
      Bounds t{table.derivative(a), table.derivative(a)};
      const auto x = table.x();
      for (auto i = std::upper_bound(x.begin(), x.end(), a); i != x.end() && *i <= b; ++i) {
        const double slope = *i == x.back() ? 0 : table.derivative(*i);  // level beyond
        t = {std::min(t.low, slope), std::max(t.high, slope)};
      }
      return t;
    };
    const Between at = between(theta);
    const Bounds first = of_table(*at.first), second = of_table(*at.second);
    r = {first.low + at.share * (second.low - first.low), first.high + at.share * (second.high - first.high)};
  }
  return {r.low * per_unit_, r.high * per_unit_};
}

}  // namespace solidus::contact
