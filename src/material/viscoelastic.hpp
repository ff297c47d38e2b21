/// Thermo-viscoelastic law from melt to solid: a Maxwell element for the deviator (monograph 2.50, 2.104;
/// errata).
///
///   σ = p 1 + s,   p = k (tr ε − e^θ)                                                (2.57b)
///   spring  G/f_S:  dev ε − ε^v_{n+1} = f_S s / (2G)                                  (2.50)
///   dashpot η/λ:    ε^v_{n+1} = ε^v_n + Δt λ s / η,   λ = 1 − f_S                     (2.104, backward
///   Euler)
///   =>  s = 2Ĝ (dev ε − ε^v_n),   1/(2Ĝ) = f_S/(2G) + Δt λ/η
/// exact in both limits (solid 2G, liquid η/Δt) without division by f_S or λ.
///
/// Symbols: k bulk [Pa], G shear modulus [Pa], η viscosity of s = η ε̇ [Pa s], f_S solid fraction, e^θ
/// volumetric thermal strain. Validity: infinitesimal strain. Source: Chiumenti, Agelet de Saracibar,
/// Cervera, CIMNE monograph 48 (1999).
#pragma once

#include "material/elasticity.hpp"
#include "material/time_integration.hpp"
#include "numbers/tensor.hpp"

namespace solidus::material {

enum class Status { converged, cut_the_step, outside_range };

class Viscoelastic {
 public:
  template <class T>
  using Properties = PointProperties<T>;

  template <class T>
  struct State {
    Sym<T> viscous_strain;  ///< ε^v, deviatoric
  };

  template <class T>
  struct Response {
    Sym<T> stress;        ///< σ [Pa]
    T bulk, twice_shear;  ///< the isotropic algorithmic tangent: κ and 2Ĝ [Pa]
    State<T> state;       ///< at t_{n+1}
    T dissipation;        ///< D_mech = s : ε̇^v [W/m³] (2.116)
    Status status = Status::converged;
  };

  /// Keeps a reference to the material.
  explicit Viscoelastic(const Material& material) : material_(&material) {}

  /// @param initial_temperature Θ_0 of 2.51 [K]
  template <class T>
  Properties<T> properties_at(const T& temperature, const T& initial_temperature) const {
    return material::properties_at(*material_, temperature, initial_temperature);
  }
  /// With the phases of a step (elasticity.hpp).
  template <class T>
  Properties<T> properties_at(const T& temperature, const T& initial_temperature,
                              const PhaseState<T>& phase) const {
    return material::properties_at(*material_, temperature, initial_temperature, phase);
  }

  /// @param old    history at t_n
  /// @param strain total strain at t_{n+1}
  template <class T>
  static Response<T> update(const PointProperties<T>& p, const State<T>& old, const Sym<T>& strain,
                            const TimeStep& step) {
    const T lambda = T(1.0) - p.solid_fraction;
    const T fluidity = T(step.dt) * lambda / p.viscosity;  // Δt λ/η
    const T twice_shear = T(2.0) * p.shear / (p.solid_fraction + fluidity * T(2.0) * p.shear);
    const T pressure = p.bulk * (trace(strain) - p.thermal_strain);  // 2.57b
    const Sym<T> s = twice_shear * (dev(strain) - old.viscous_strain);
    Response<T> r;
    r.stress = s;
    for (int i = 0; i < 3; ++i) r.stress[i] += pressure;
    r.bulk = p.bulk;
    r.twice_shear = twice_shear;
    r.state.viscous_strain = old.viscous_strain + fluidity * s;
    r.dissipation = lambda / p.viscosity * dot(s, s);  // 2.116
    return r;
  }

  bool symmetric() const { return true; }
  const Material& material() const { return *material_; }

 private:
  const Material* material_;
};

}  // namespace solidus::material
