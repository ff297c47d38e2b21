/// Hardening that saturates (monograph 2.60; Voce 1948):
///
///   K_ξ = (σ_∞ − σ_0)(1 − exp(−δ ξ)) + H ξ
///
/// Symbols: ξ equivalent plastic strain, σ_0, σ_∞, H [Pa], δ a number. Validity: ξ >= 0, σ_∞ >= σ_0.
#pragma once

#include "material/laws/linear.hpp"

namespace solidus::material {

struct Voce {
  static constexpr std::string_view name = "saturation";
  static constexpr std::string_view equation =
      "sigma_y = sigma_0 + (sigma_inf - sigma_0)(1 - exp(-delta xi)) + H xi (2.60; Voce)";
  enum : std::size_t { saturation_stress, saturation_rate, hardening_modulus };
  static constexpr LawParameter parameters[] = {
      {"saturation_stress", "Pa", "sigma_inf, at least the flow stress at every temperature."},
      {.key = "saturation_rate",
       .unit = "1",
       .doc = "delta: at xi = 1/delta, 63 % of the hardening is reached.",
       .continuation = Continuation::positive},
      left_out_as_zero(k_hardening_modulus)};

  template <class T>
  static HardeningStress<T> stress(const FlowProperties<T>& p, const T& xi) {
    using std::exp;
    const T rise = p.hardening[saturation_stress] - p.hardening_origin, &rate = p.hardening[saturation_rate];
    const T decay = exp(T(-rate * xi));
    return {rise * (T(1.0) - decay) + p.hardening[hardening_modulus] * xi,
            rise * rate * decay + p.hardening[hardening_modulus], p.hardening[saturation_stress]};
  }
  template <class T>
  static T energy(const FlowProperties<T>& p, const T& xi) {
    using std::exp;
    const T rise = p.hardening[saturation_stress] - p.hardening_origin, &rate = p.hardening[saturation_rate];
    const T decay = exp(T(-rate * xi));
    return rise * (xi - (T(1.0) - decay) / rate) + T(0.5) * p.hardening[hardening_modulus] * xi * xi;
  }

  static double saturation(const HardeningTables& tables) { return 5 / tables[saturation_rate].min_value(); }
  static std::optional<LawObjection> objection(const Table& flow_stress, const HardeningTables& tables);
};

}  // namespace solidus::material
