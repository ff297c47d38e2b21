/// Freezing of a half-space from a cold wall: similarity solutions.
///
///        T_w |=========|~~~~~~~~|----------------  T_0 (far away)
///            |  solid  |  mushy |    liquid
///            0      X_S(t)    X_L(t)            x
///
/// Temperatures depend on ξ = x/(2√t) only, and the fronts are at X = 2 ξ √t. Without a freezing range X_S =
/// X_L (F. Neumann's lectures about 1860; H.S. Carslaw, J.C. Jaeger, Conduction of Heat in Solids, 1959, 11.2
/// III). With a range over which the solid fraction falls linearly the mushy zone is a third medium whose
/// capacity includes L/(T_L − T_S) (ibid. 11.2 VI), and both fronts carry no latent heat. Conductivity and
/// sensible capacity are the same everywhere here.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

namespace solidus::analytic {

struct StefanData {
  double conductivity, capacity, latent;  ///< [W/(m K)], [J/(m³ K)], [J/m³]
  double wall, solidus, liquidus, start;  ///< temperatures [K]
};

struct Stefan : StefanData {
  explicit Stefan(const StefanData& data) : StefanData(data) {
    fronts_ = solidus == liquidus ? isothermal() : with_range();
    frozen_at_one_second_ = integrate_frozen(1.0);
  }
  /// ξ of the solidus and the liquidus front [m/√s].
  std::pair<double, double> fronts() const { return fronts_; }
  double front(double xi, double time) const { return 2 * xi * std::sqrt(time); }

  double temperature(double x, double time) const {
    const auto [xi_s, xi_l] = fronts();
    const double xi = x / (2 * std::sqrt(time)), a = std::sqrt(diffusivity()),
                 m = std::sqrt(mushy_diffusivity());
    if (xi <= xi_s) return wall + (solidus - wall) * std::erf(xi / a) / std::erf(xi_s / a);
    if (xi >= xi_l) return start - (start - liquidus) * std::erfc(xi / a) / std::erfc(xi_l / a);
    return solidus + (liquidus - solidus) * (std::erf(xi / m) - std::erf(xi_s / m)) /
                         (std::erf(xi_l / m) - std::erf(xi_s / m));
  }
  /// Volume frozen per area of wall at the time, the mushy zone by its solid fraction [m].
  double frozen(double time) const { return frozen_at_one_second_ * std::sqrt(time); }

 private:
  double integrate_frozen(double time) const {
    const auto [xi_s, xi_l] = fronts();
    double sum = front(xi_s, time);
    constexpr int n = 2000;  // midpoint rule over the mushy zone
    const double width = (front(xi_l, time) - sum) / n, from = sum;
    for (int i = 0; i < n && width > 0; ++i)
      sum += width * (liquidus - temperature(from + (i + 0.5) * width, time)) / (liquidus - solidus);
    return sum;
  }
  double diffusivity() const { return conductivity / capacity; }
  double mushy_diffusivity() const {
    return liquidus > solidus ? conductivity / (capacity + latent / (liquidus - solidus)) : diffusivity();
  }
  /// dT/dξ at the cold side of the solidus and the hot side of the liquidus, times √π/2.
  double solid_slope(double xi) const {
    const double a = std::sqrt(diffusivity());
    return (solidus - wall) * std::exp(-xi * xi / (a * a)) / (a * std::erf(xi / a));
  }
  double liquid_slope(double xi) const {
    const double a = std::sqrt(diffusivity());
    return (start - liquidus) * std::exp(-xi * xi / (a * a)) / (a * std::erfc(xi / a));
  }
  template <class Falling>
  static double root(double low, double high, const Falling& f) {
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      (f(middle) > 0 ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
  std::pair<double, double> isothermal() const {
    // k dT/dx (solid) − k dT/dx (liquid) = L dX/dt
    const double scale = 2 * conductivity / std::sqrt(std::numbers::pi), far = 5 * std::sqrt(diffusivity());
    const double xi = root(1e-12 * far, far, [&](double x) {
      return scale * (solid_slope(x) - liquid_slope(x)) - 2 * latent * x;
    });
    return {xi, xi};
  }
  std::pair<double, double> with_range() const {
    const double m = std::sqrt(mushy_diffusivity()), far = 5 * std::sqrt(diffusivity());
    // Continuity of the flux at the solidus gives erf(ξ_L/m); then the liquidus must match.
    const auto liquidus_front = [&](double xi_s) {
      const double e = std::erf(xi_s / m) +
                       (liquidus - solidus) * std::exp(-xi_s * xi_s / (m * m)) / (m * solid_slope(xi_s));
      return e >= 1 ? HUGE_VAL : root(xi_s, 30 * m, [&](double x) { return e - std::erf(x / m); });
    };
    const auto mushy_slope = [&](double xi_s, double xi_l) {
      return (liquidus - solidus) * std::exp(-xi_l * xi_l / (m * m)) /
             (m * (std::erf(xi_l / m) - std::erf(xi_s / m)));
    };
    const double xi_s = root(1e-9 * far, far, [&](double x) {
      const double xi_l = liquidus_front(x);
      return std::isfinite(xi_l) ? mushy_slope(x, xi_l) - liquid_slope(xi_l) : -1.0;
    });
    return {xi_s, liquidus_front(xi_s)};
  }

  std::pair<double, double> fronts_;
  double frozen_at_one_second_ = 0;
};

}  // namespace solidus::analytic
