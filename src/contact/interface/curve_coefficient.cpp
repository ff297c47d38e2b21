/// Friction measured as curves over the internal variable at several temperatures: linear between the
/// points of a curve and between curves, with exact integrals for the stored energy.
#include "contact/laws/curve_coefficient.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace solidus::contact {

CurveCoefficient::CurveCoefficient(std::vector<FrictionCurve> curves) : curves_(std::move(curves)) {
  std::sort(curves_.begin(), curves_.end(),
            [](const FrictionCurve& a, const FrictionCurve& b) { return a.temperature < b.temperature; });
}

std::optional<Objection> CurveCoefficient::objection() const {
  // Each curve by itself: it begins at an unused surface and is above zero, since friction without
  // a coefficient has no cone to return to.
  for (const FrictionCurve& curve : curves_) {
    if (!curve.coefficient.constant() && curve.coefficient.x().front() != 0)
      return Objection{fmt::format("a friction curve starts at {:.6g}", curve.coefficient.x().front()),
                       "curves that start at an internal variable of 0"};
    if (const auto wrong = not_positive(curve.coefficient.min_value())) return wrong;
  }
  // Curves are in order of temperature, one for each, and may not start higher where it is hotter.
  for (std::size_t i = 1; i < curves_.size(); ++i) {
    const FrictionCurve &a = curves_[i - 1], &b = curves_[i];
    if (a.temperature == b.temperature)
      return Objection{fmt::format("two friction curves at {:.6g} K", a.temperature),
                       "one curve per temperature, each with its temperature"};
    const double from = a.coefficient.value(0), to = b.coefficient.value(0);
    if (to > from) return hardens_with_temperature(from, a.temperature, to, b.temperature);
  }
  return std::nullopt;
}

CurveCoefficient::Between CurveCoefficient::between(double theta) const {
  if (theta < curves_.front().temperature)
    return {&curves_.front().coefficient, &curves_.front().coefficient, 0, 0};
  std::size_t i = curves_.size() - 1;
  if (theta >= curves_[i].temperature) return {&curves_[i].coefficient, &curves_[i].coefficient, 0, 0};
  while (curves_[i].temperature > theta) --i;  // there are few
  const double per_kelvin = 1 / (curves_[i + 1].temperature - curves_[i].temperature);
  return {&curves_[i].coefficient, &curves_[i + 1].coefficient, (theta - curves_[i].temperature) * per_kelvin,
          per_kelvin};
}

CoefficientValue CurveCoefficient::value(const InternalValue& in, double theta) const {
  const Between at = between(theta);
  const auto a = at.first->line(in.z);
  if (at.second == at.first) return {a.value, a.slope * in.per_unit};
  const auto b = at.second->line(in.z);
  return {a.value + at.share * (b.value - a.value), (a.slope + at.share * (b.slope - a.slope)) * in.per_unit};
}

CoefficientPoint CurveCoefficient::point(const InternalValue& in, double theta) const {
  const Between at = between(theta);
  // On one curve: value, slope by the internal variable, and the work above the initial value, which is
  // stored.
  const auto one = [&](const Table& table) {
    const auto line = table.line(in.z);
    const double initial = table.value(0);
    return CoefficientPoint{line.value,
                            line.slope * in.per_unit,
                            0,
                            0,
                            initial,
                            0,
                            (table.integral(0, in.z) - initial * in.z) * in.unit,
                            0};
  };
  CoefficientPoint r = one(*at.first);
  if (at.second == at.first) return r;
  const CoefficientPoint b = one(*at.second);
  // Between two curves everything is linear in temperature; what depends on hardening changes apart from the
  // initial value.
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

CoefficientBounds CurveCoefficient::slopes(double from, double to, double theta) const {
  const auto of_table = [&](const Table& table) {
    CoefficientBounds t{table.derivative(from), table.derivative(from)};
    const auto x = table.x();
    // Slopes change at the points of the table only; beyond the last one it is level.
    for (auto i = std::upper_bound(x.begin(), x.end(), from); i != x.end() && *i <= to; ++i) {
      const double slope = *i == x.back() ? 0 : table.derivative(*i);  // level beyond
      t = {std::min(t.low, slope), std::max(t.high, slope)};
    }
    return t;
  };
  // Between two curves everything is linear in temperature, so the bounds of slopes are too.
  const Between at = between(theta);
  const CoefficientBounds first = of_table(*at.first), second = of_table(*at.second);
  return {first.low + at.share * (second.low - first.low),
          first.high + at.share * (second.high - first.high)};
}

}  // namespace solidus::contact
