/// Hardening by measured flow curves: K_ξ = σ(ξ, Θ) − σ(0, Θ), linear between the points (flow_curves.hpp).
/// Symbols: ξ equivalent plastic strain, σ true stress [Pa]. Validity: ξ >= 0.
#pragma once

#include "material/laws/hardening_law.hpp"

namespace solidus::material {

struct MeasuredHardening {
  static constexpr std::string_view name = "table",
                                    equation = "sigma_y(xi, T) from [[plasticity.flow_curve]]";
  static constexpr bool kinks = true;

  template <class T>
  static HardeningStress<T> stress(const FlowCurves& curves, const FlowProperties<T>& p, const T& xi) {
    const auto at = point(curves, core(xi), core(p.temperature));
    const T dx = xi - T(core(xi)), dt = p.temperature - T(core(p.temperature)) + p.beyond;
    const T slope = T(at.slope) + T(at.slope_theta) * dt;
    return {T(at.stress) + slope * dx + T(at.stress_theta) * dt, slope};
  }
  template <class T>
  static T energy(const FlowCurves& curves, const FlowProperties<T>& p, const T& xi) {
    const auto at = point(curves, core(xi), core(p.temperature));
    const T dx = xi - T(core(xi)), dt = p.temperature - T(core(p.temperature)) + p.beyond;
    const T slope = T(at.slope) + T(at.slope_theta) * dt;
    return T(at.energy) + (T(at.stress) + T(0.5) * slope * dx + T(at.stress_theta) * dt) * dx +
           T(at.energy_theta) * dt;
  }

 private:
  template <class T>
  struct Point {
    T stress, slope, energy, stress_theta, slope_theta, energy_theta;  ///< FlowCurves::Value
  };
  static Point<double> point(const FlowCurves& curves, double xi, double theta) {
    const FlowCurves::Value v = curves.at(xi, theta);
    return {v.stress, v.slope, v.energy, v.stress_theta, v.slope_theta, v.energy_theta};
  }
  static Point<Lane> point(const FlowCurves& curves, Lane xi, Lane theta) {
    Point<Lane> r;
    for (int i = 0; i < k_lanes; ++i) {
      const FlowCurves::Value v = curves.at(xi[i], theta[i]);
      r.stress.set(i, v.stress);
      r.slope.set(i, v.slope);
      r.energy.set(i, v.energy);
      r.stress_theta.set(i, v.stress_theta);
      r.slope_theta.set(i, v.slope_theta);
      r.energy_theta.set(i, v.energy_theta);
    }
    return r;
  }
};

}  // namespace solidus::material
