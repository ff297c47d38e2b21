/// The isentropic return mapping of the mechanical phase (monograph 4.72–4.124): the law at the intermediate
/// temperature Θ̄ at which the elastic entropy keeps its value.
///
///   S^E(ε, γ, Θ̄) = S^E_n,   Φ(ε, γ, Θ̄) = x(γ)                                            (4.97)
///
/// γ is eliminated: the second equation is the isothermal return mapping at Θ̄, and the first one becomes
/// F(Θ̄) = 0 with F' = S_Θ + S_γ γ_Θ = C/Θ̄ + (Φ_Θ)²/D > 0, a monotone function that Newton's method with a
/// bracket always solves. One step is the full 2×2 step that 4.99 approximates. Without plastic flow F is the
/// trial equation ΔS^E = 0.
///
/// Everything dissipative keeps its value at Θ_n: f_S and e^pc (4.76, 4.81), σ_0 of the yield radius (4.85),
/// η_l, η, n, D and the recall; energies follow Θ̄. So the update is the stationary point of an incremental
/// internal energy (docs/decisions/0006), and its tangent is symmetric but where back strain is recalled:
///
///   dσ/dε = dσ/dε|_Θ + σ_Θ ⊗ σ_Θ / F',   F' = C/Θ̄ of the whole update
///
/// In a step every table is its line near Θ_n, because the entropy −Ψ_Θ of a table jumps where it bends.
/// The Newton iteration is smooth and reads no table.
///
/// Validity: Θ̄ within a factor of two around Θ_n; beyond it the status is outside_range. Where moduli or
/// capacity keep less than a quarter of their value along their lines, at `lowest` or `highest`, these say
/// nothing any more: Θ̄ stays there, the incremental energy is stationary within [lowest, highest], and the
/// update and its tangent are the isothermal ones at that temperature.
#pragma once

#include "material/viscoplastic.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::material {

/// The templates are compiled for double and Lane (isentropic.cpp); who needs other types of numbers includes
/// isentropic_impl.hpp.
class Isentropic {
 public:
  template <class T>
  using State = Viscoplastic::State<T>;

  /// Properties of the law at Θ_n: lines for those that follow the temperature, values for those that are
  /// frozen.
  template <class T>
  struct Properties {
    T temperature;      ///< Θ_n [K]
    T lowest, highest;  ///< the range of Θ̄ in which the lines hold [K]
    T entropy{};        ///< S^E_n, set by the caller from entropy() [J/(m³ K)]
    Table::Line<T> young, poisson, expansion;
    Table::Line<T> capacity;  ///< C_v = ρ c [J/(m³ K)]
    T strain_offset;          ///< e^θ less 3 α (Θ − Θ_ref): initial strain, frozen straining
    T solid_fraction, viscosity;
    T held_shear;  ///< G(Θ_S) above the solidus where the model of the liquid holds it, else zero [Pa]
    FlowProperties<T> flow, flow_slope;  ///< values and slopes; slopes of frozen ones are zero
  };

  template <class T>
  struct Response : Viscoplastic::Response<T> {
    T temperature{};     ///< Θ̄ [K]
    T entropy_defect{};  ///< S^E − S^E_n that the iteration or the end of the range left [J/(m³ K)]
    /// The adiabatic part of the tangent: thermal_factor thermal_left ⊗ thermal_right, in addition to the
    /// members of the base. thermal_left = ∂σ/∂Θ, and thermal_right = thermal_left for a symmetric law.
    Sym<T> thermal_left, thermal_right;
    T thermal_factor{};  ///< 1/F' [m³ K²/J], zero at the end of the range
  };

  /// Keeps a reference to the material.
  explicit Isentropic(const Material& material) : law_(material) {}

  /// @param temperature, initial_temperature Θ_n, Θ_0 [K]
  template <class T>
  Properties<T> properties_at(const T& temperature, const T& initial_temperature) const {
    return properties_at(temperature, initial_temperature,
                         phase_state_at(material(), temperature, initial_temperature));
  }
  /// With the phases of a step (elasticity.hpp).
  template <class T>
  Properties<T> properties_at(const T& temperature, const T& initial_temperature,
                              const PhaseState<T>& phase) const;

  /// S^E_n of the committed state, its sensible part counted from Θ_n [J/(m³ K)]. Where solid has melted
  /// since the last mechanical phase, a Maxwell spring G/f_S keeps at most an elastic strain of
  /// k_spring_strain.
  template <class T>
  T entropy(const Properties<T>& p, const Sym<T>& strain, const State<T>& state) const;

  /// @param p      with its entropy set
  /// @param start  history at the start of the effective step (time_integration.hpp)
  /// @param strain total strain at t_{n+1}
  template <class T>
  Response<T> update(const Properties<T>& p, const State<T>& start, const Sym<T>& strain,
                     const TimeStep& step) const;

  /// The law's properties along the lines.
  template <class T>
  Viscoplastic::Properties<Jet<T>> at_temperature(const Properties<T>& p, const T& temperature) const;

  bool symmetric() const { return law_.symmetric(); }
  const Material& material() const { return law_.material(); }
  const Viscoplastic& isothermal() const { return law_; }

  /// Elastic strain ‖dev ε^E‖/f_S that a spring of the mushy zone keeps: s = 0.02 G, far beyond any yield.
  static constexpr double k_spring_strain = 0.01;

 private:
  Viscoplastic law_;
};

/// The tangent as a 6×6 matrix.
template <class T>
Sym4<T> full_tangent(const Isentropic::Response<T>& r) {
  Sym4<T> c = full_tangent(static_cast<const Viscoplastic::Response<T>&>(r));
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) c[i][as_size(j)] += r.thermal_factor * r.thermal_left[i] * r.thermal_right[j];
  return c;
}

}  // namespace solidus::material
