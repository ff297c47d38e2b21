/// A layer in uniaxial strain between two rigid walls, quasi-static, with both directions of the coupling:
/// one face insulated, the other suddenly at Θ_0 + ΔΘ.
///
///     u = 0, insulated ▐░░░░▒▒▒▒▌ u = 0, θ = 1          0 <= x <= l,  θ = (Θ − Θ_0)/ΔΘ
///
/// Equilibrium makes the stress uniform, σ = (λ+2μ) ε − βΔΘ θ, and ∫ε dx = 0 makes it −βΔΘ times the mean θ̄;
/// then ε = βΔΘ (θ − θ̄)/(λ+2μ), and the linear energy equation C Θ̇ + βΘ_0 ε̇ = k Θ'' becomes
///
///   (1 + δ) θ̇ − δ dθ̄/dt = a θ'',   a = k/C,  β = 3αK,  δ = β²Θ_0/(C (λ+2μ))
///
/// whose Laplace transform is (cosh qx + δ sinh(ql)/(ql)) / (s (cosh ql + δ sinh(ql)/(ql))), q² = (1+δ) s/a.
/// The poles are at ql = iν with tan ν = −ν/δ, ν_n between (n − ½)π and nπ (δ = 0: at (n − ½)π), so
///
///   θ = 1 + Σ_n A_n [cos(ν_n x/l) + δ sin ν_n/ν_n] exp(−ν_n² a t/((1+δ) l²)),
///   A_n = −2/(sin ν_n [ν_n + δ(1+δ)/ν_n]).
///
/// The mean is the part that the coupling does not delay: the wall pressure βΔΘ θ̄ shows it.
/// Validity: linear theory, |ΔΘ| << Θ_0; t > 0, with terms enough for a t/l² >= 1e-3.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace solidus::analytic {

class CoupledLayer {
 public:
  /// @param coupling δ >= 0;  @param diffusivity k/C [m²/s];  @param length l [m]
  CoupledLayer(double coupling, double diffusivity, double length)
      : coupling_(coupling), diffusivity_(diffusivity), length_(length) {
    constexpr int k_terms = 60;  // exp(−ν²·1e-3) < 1e-15 at the last
    for (int n = 1; n <= k_terms; ++n) {
      double low = (n - 0.5) * std::numbers::pi, high = n * std::numbers::pi;
      const double sign = std::sin(low);  // cos ν + δ sin ν/ν has it at low and the other at high
      for (int i = 0; i < 60 && coupling > 0; ++i) {
        const double middle = 0.5 * (low + high);
        (sign * (std::cos(middle) + coupling * std::sin(middle) / middle) > 0 ? low : high) = middle;
      }
      terms_.push_back({low, -2 / (std::sin(low) * (low + coupling * (1 + coupling) / low))});
    }
  }

  double temperature(double x, double time) const {
    return sum(time, [&](double nu) { return std::cos(nu * x / length_) + coupling_ * std::sin(nu) / nu; });
  }
  /// θ̄; the pressure on the walls is βΔΘ times it.
  double mean_temperature(double time) const {
    return sum(time, [&](double nu) { return (1 + coupling_) * std::sin(nu) / nu; });
  }
  /// u (λ+2μ)/(βΔΘ) = ∫_0^x (θ − θ̄) dx [m].
  double displacement(double x, double time) const {
    double r = 0;
    for (const Term& t : terms_)
      r += t.amplitude * (std::sin(t.nu * x / length_) - std::sin(t.nu) * x / length_) * length_ / t.nu *
           decay(t.nu, time);
    return r;
  }

 private:
  struct Term {
    double nu, amplitude;
  };
  double decay(double nu, double time) const {
    return std::exp(-nu * nu * diffusivity_ * time / ((1 + coupling_) * length_ * length_));
  }
  template <class Shape>
  double sum(double time, const Shape& shape) const {
    double r = 1;
    for (const Term& t : terms_) r += t.amplitude * shape(t.nu) * decay(t.nu, time);
    return r;
  }

  double coupling_, diffusivity_, length_;
  std::vector<Term> terms_;
};

}  // namespace solidus::analytic
