/// Stress in a slab that freezes from a cold wall: J. H. Weiner, B. A. Boley, Elasto-plastic thermal stresses
/// in a solidifying body, J. Mech. Phys. Solids 11 (1963) 145–154.
///
///        T_w |####:::::######|----------  T_m      # plastic, : elastic
///            |  solid, σ(ξ)  |  melt, no strength
///            0   ξ_1  ξ_2    1                     ξ = x/s(t),  s = 2 λ √(κ t)
///
/// The melt is at its freezing point T_m from the start, so the shell has Neumann's temperature
/// T = T_w + (T_m − T_w) erf(λξ)/erf(λ), √π λ exp(λ²) erf(λ) = c (T_m − T_w)/L. The slab cannot bend and
/// carries no net force: σ_y = σ_z = σ(x, t), σ_x = 0, ε_y = ε_z = ε(t), ∫_0^s σ dx = 0. It is elastic and
/// perfectly plastic with a yield stress that falls linearly to zero at T_m, Y = Y_w (T_m − T)/(T_m − T_w):
///
///   ε̇ = σ̇ (1 − ν)/E + α Ṫ + ε̇^p,  |σ| <= Y(T)
///
/// Nothing but s(t) has the dimension of a length, so σ depends on ξ only; at a point of the body
/// d/dt = −ξ/(2t) d/dξ, and ε̇ = C/(2t) with a number C. A point freezes in tension (its neighbours below are
/// colder and shrink less), unloads, and ends in compression at the wall:
///
///   ξ > ξ_2:  σ = Y             flow stops where ε̇^p = 0:  C + ξ_2 (α T' + Y' (1 − ν)/E) = 0
///   elastic:  σ = Y(ξ_2) − E/(1 − ν) [C ln(ξ/ξ_2) + α (T − T(ξ_2))]
///   ξ < ξ_1:  σ = −Y            σ elastic reaches −Y(ξ_1)
///   force:    ∫_0^1 σ dξ = 0
///
/// Three conditions for C, ξ_1, ξ_2; all integrals and slopes are in closed form up to quadrature. Material
/// constants do not depend on temperature.
#pragma once

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace solidus::analytic {

struct SlabData {
  double conductivity, specific_heat, latent, density;  ///< [W/(m K)], [J/(kg K)], [J/kg], [kg/m³]
  double wall, melting;                                 ///< T_w, T_m [K]
  double young, poisson, expansion;                     ///< [Pa], 1, [1/K]
  double wall_yield;                                    ///< Y_w [Pa]
};

struct SolidifyingSlab : SlabData {
  explicit SolidifyingSlab(const SlabData& data) : SlabData(data) {
    const double stefan = specific_heat * (melting - wall) / (latent * std::sqrt(std::numbers::pi));
    lambda_ = bisect(1e-8, 5, [&](double l) { return l * std::exp(l * l) * std::erf(l) < stefan; });
    solve();
  }

  double lambda() const { return lambda_; }
  double compressed_up_to() const { return xi1_; }  ///< ξ_1
  double stretched_from() const { return xi2_; }    ///< ξ_2
  /// C of ε̇ = C/(2t): negative, the slab shrinks.
  double strain_constant() const { return strain_; }

  double front(double time) const {  ///< s [m]
    return 2 * lambda_ * std::sqrt(conductivity / (density * specific_heat) * time);
  }
  double temperature(double x, double time) const { return at_similar(x / front(time)); }
  double yield(double xi) const { return wall_yield * (melting - at_similar(xi)) / (melting - wall); }
  /// σ_y = σ_z [Pa], zero in the melt.
  double stress(double x, double time) const { return stress_at(x / front(time)); }
  double stress_at(double xi) const {
    if (xi >= 1) return 0;
    if (xi >= xi2_) return yield(xi);
    return xi <= xi1_ ? -yield(xi) : elastic(xi);
  }
  /// Rate of plastic strain times 2t at ξ, from the strain rates: zero where elastic.
  double flow_at(double xi) const {
    if (xi >= 1 || (xi > xi1_ && xi < xi2_)) return 0;
    const double sign = xi >= xi2_ ? 1 : -1;
    return strain_ + xi * (expansion * slope(xi) + sign * yield_slope(xi) / modulus());
  }

 private:
  double modulus() const { return young / (1 - poisson); }
  double at_similar(double xi) const {
    return xi >= 1 ? melting : wall + (melting - wall) * std::erf(lambda_ * xi) / std::erf(lambda_);
  }
  double slope(double xi) const {  ///< dT/dξ
    return (melting - wall) * 2 * lambda_ / std::sqrt(std::numbers::pi) *
           std::exp(-lambda_ * lambda_ * xi * xi) / std::erf(lambda_);
  }
  double yield_slope(double xi) const { return -wall_yield * slope(xi) / (melting - wall); }
  double elastic(double xi) const {
    return yield(xi2_) -
           modulus() * (strain_ * std::log(xi / xi2_) + expansion * (at_similar(xi) - at_similar(xi2_)));
  }

  /// The point between where `below` turns from true to false.
  template <class Below>
  static double bisect(double low, double high, const Below& below) {
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      (below(middle) ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  /// C and ξ_1 that go with a ξ_2.
  void follow(double xi2) {
    xi2_ = xi2;
    strain_ = -xi2 * (expansion * slope(xi2) + yield_slope(xi2) / modulus());
    // σ + Y falls towards the wall while |ε̇| exceeds the rate of thermal strain
    xi1_ = bisect(0, xi2, [&](double xi) { return elastic(xi) + yield(xi) < 0; });
  }
  /// ∫_0^1 σ dξ by Simpson's rule on each of the three parts, on which σ is smooth.
  double force() const {
    const double limits[4] = {0, xi1_, xi2_, 1};
    double sum = 0;
    for (int part = 0; part < 3; ++part) {
      constexpr int n = 200;
      const double from = limits[part], h = (limits[part + 1] - from) / n;
      const auto value = [&](double xi) {
        return part == 0 ? -yield(xi) : part == 2 ? yield(xi) : elastic(xi);
      };
      for (int i = 0; i < n; ++i)
        sum += h / 6 * (value(from + i * h) + 4 * value(from + (i + 0.5) * h) + value(from + (i + 1) * h));
    }
    return sum;
  }
  void solve() {
    // The farther out tension begins, the less of it there is: the force falls with ξ_2.
    xi2_ = bisect(1e-3, 1 - 1e-9, [&](double xi2) {
      follow(xi2);
      return force() > 0;
    });
    follow(xi2_);
    if (!(std::abs(force()) < 1e-6 * wall_yield) || !(xi1_ > 0 && xi1_ < xi2_))
      throw std::domain_error("no compressed, elastic and stretched zone for these data");
  }

  double lambda_ = 0, xi1_ = 0, xi2_ = 1, strain_ = 0;
};

}  // namespace solidus::analytic
