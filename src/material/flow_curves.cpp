/// Curves are merged to one grid, which is exact; a look-up finds both intervals by buckets and
/// interpolates bilinearly.
#include "material/flow_curves.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus::material {
namespace {

constexpr std::size_t k_max_buckets = 4096;

void check_rising(const std::vector<double>& x, const char* what) {
  if (x.empty()) throw std::invalid_argument(std::string("flow curves need at least one ") + what);
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]))
      throw std::invalid_argument(std::string("a ") + what + " of the flow curves is not a finite number");
    if (i > 0 && x[i] <= x[i - 1])
      throw std::invalid_argument(std::string("the ") + what + "s of the flow curves do not rise");
  }
}

void check_curve(const double* stresses, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isfinite(stresses[i]) || stresses[i] < 0)
      throw std::invalid_argument("a stress of the flow curves is negative or not a finite number");
    if (i > 0 && stresses[i] < stresses[i - 1])
      throw std::invalid_argument("a flow curve falls with strain; softening is not supported");
  }
}

/// The curve at a strain: linear between its points, level beyond the last one.
double stress_of(const FlowCurve& curve, double strain) {
  const auto right = std::upper_bound(curve.strains.begin(), curve.strains.end(), strain);
  const auto i = as_size(right - curve.strains.begin());
  if (i == curve.strains.size()) return curve.stresses.back();
  const double t = (strain - curve.strains[i - 1]) / (curve.strains[i] - curve.strains[i - 1]);
  return curve.stresses[i - 1] + t * (curve.stresses[i] - curve.stresses[i - 1]);
}

}  // namespace

FlowCurves::Axis::Axis(std::vector<double> rising) : points(std::move(rising)) {
  // One point has no interval.
  if (points.size() < 2) return;
  const double range = points.back() - points.front();
  // Buckets as wide as the shortest interval find an interval at once.
  double shortest = range;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    shortest = std::min(shortest, points[i + 1] - points[i]);
  const auto count = static_cast<std::size_t>(std::min(std::ceil(range / shortest), double{k_max_buckets}));
  scale = static_cast<double>(count) / range;
  // Each bucket knows the interval in which it begins: a search then looks at one or two intervals.
  for (std::size_t b = 0, i = 0; b < count; ++b) {
    const double start = points.front() + static_cast<double>(b) / scale;
    while (i + 2 < points.size() && points[i + 1] <= start) ++i;
    bucket.push_back(i);
  }
}

std::size_t FlowCurves::Axis::interval(double x) const {
  if (x >= points.back()) return points.size() - 1;
  const double place = (x - points.front()) * scale;
  if (!(place > 0)) return 0;  // a NaN too
  std::size_t i = bucket[std::min(static_cast<std::size_t>(place), bucket.size() - 1)];
  while (i + 1 < points.size() && points[i + 1] <= x) ++i;
  while (i > 0 && x < points[i]) --i;  // the bucket's start is rounded
  return i;
}

FlowCurves::FlowCurves(std::vector<double> strains, std::vector<double> temperatures,
                       std::vector<double> stresses) {
  // Strains and temperatures rise, the first strain is zero, and each curve has a stress for every
  // strain.
  check_rising(strains, "strain");
  check_rising(temperatures, "temperature");
  if (strains.front() != 0) throw std::invalid_argument("the flow curves do not start at zero strain");
  const std::size_t n = strains.size();
  if (stresses.size() != n * temperatures.size())
    throw std::invalid_argument("the flow curves have " + std::to_string(stresses.size()) + " stresses for " +
                                std::to_string(n) + " strains and " + std::to_string(temperatures.size()) +
                                " temperatures");
  // A piece of a curve from each strain: stress beyond the initial one, slope, and the energy up to there.
  for (std::size_t row = 0; row < temperatures.size(); ++row) {
    const double* sigma = stresses.data() + row * n;
    check_curve(sigma, n);
    double energy = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const bool last = i + 1 == n;
      const double length = last ? 0 : strains[i + 1] - strains[i];
      const double rise = sigma[i] - sigma[0];
      pieces_.push_back({rise, last ? 0 : (sigma[i + 1] - sigma[i]) / length, energy});
      if (!last) energy += length * (rise + 0.5 * (sigma[i + 1] - sigma[i]));
    }
  }
  strain_ = Axis(std::move(strains));
  temperature_ = Axis(std::move(temperatures));
  stresses_ = std::move(stresses);
}

FlowCurves FlowCurves::merged(std::vector<FlowCurve> curves) {
  // Curves by temperature; each is checked before it is joined.
  std::sort(curves.begin(), curves.end(),
            [](const FlowCurve& a, const FlowCurve& b) { return a.temperature < b.temperature; });
  std::vector<double> strains, temperatures, stresses;
  for (const FlowCurve& curve : curves) {
    check_rising(curve.strains, "strain");
    if (curve.strains.front() != 0) throw std::invalid_argument("a flow curve does not start at zero strain");
    if (curve.stresses.size() != curve.strains.size())
      throw std::invalid_argument("a flow curve needs as many stresses as strains");
    check_curve(curve.stresses.data(), curve.stresses.size());
    temperatures.push_back(curve.temperature);
    strains.insert(strains.end(), curve.strains.begin(), curve.strains.end());
  }
  // The union of all strains: each curve is exact at its own, and linear between.
  std::sort(strains.begin(), strains.end());
  strains.erase(std::unique(strains.begin(), strains.end()), strains.end());
  for (const FlowCurve& curve : curves)
    for (const double strain : strains) {
      // Interpolation may round a level part downwards; the curve does not fall.
      const double sigma = stress_of(curve, strain);
      stresses.push_back(strain == 0 ? sigma : std::max(sigma, stresses.back()));
    }
  return {std::move(strains), std::move(temperatures), std::move(stresses)};
}

FlowCurves::Piece FlowCurves::on_curve(std::size_t row, std::size_t interval, double beyond) const {
  const Piece& start = pieces_[row * strain_.points.size() + interval];
  return {start.stress + start.slope * beyond, start.slope,
          start.energy + beyond * (start.stress + 0.5 * start.slope * beyond)};
}

FlowCurves::Value FlowCurves::at(double strain, double temperature) const {
  // The piece in strain is the same for all curves, since they share their strains.
  const std::size_t i = strain_.interval(strain);
  const double beyond = strain - strain_.points[i];
  // Outside of the temperatures the nearest curve holds; between two of them everything is linear.
  const std::vector<double>& thetas = temperature_.points;
  if (thetas.size() == 1 || temperature < thetas.front() || temperature > thetas.back()) {
    const Piece one = on_curve(temperature > thetas.front() ? thetas.size() - 1 : 0, i, beyond);
    return {one.stress, one.slope, one.energy, 0, 0, 0};
  }
  // The two curves between which the temperature lies, and its share between them.
  const std::size_t row = std::min(temperature_.interval(temperature), thetas.size() - 2);
  const Piece cold = on_curve(row, i, beyond), hot = on_curve(row + 1, i, beyond);
  const double width = thetas[row + 1] - thetas[row];
  const double t = (temperature - thetas[row]) / width;
  const auto between = [t](double a, double b) { return (1 - t) * a + t * b; };
  return {between(cold.stress, hot.stress), between(cold.slope, hot.slope),
          between(cold.energy, hot.energy), (hot.stress - cold.stress) / width,
          (hot.slope - cold.slope) / width, (hot.energy - cold.energy) / width};
}

}  // namespace solidus::material
