/// A curve of the phase fraction f(Θ) as a plug-in: a struct like Scheil (laws/scheil.hpp).
///
///   struct Quadratic {
///     static constexpr std::string_view name = "quadratic", doc = "…";
///     double solidus = 0, liquidus = 0;  // [K]
///     static void keys(Section<Quadratic>& s) { s.quantity("solidus", &Quadratic::solidus, "K")…; }
///     FractionRange range() const { return {solidus, liquidus}; }   // throws std::invalid_argument for none
///     double fraction(double temperature) const;                    // inside of the range
///   };
///   const AddFractionLaw<Quadratic> k_quadratic;   // at namespace scope: the key kind knows "quadratic"
///
/// f falls from one, or from what it has at the lower end, to zero; the rest freezes at one temperature
/// there. The curve is sampled until its chords are within 1e-6 of it, so that its slope is that of what the
/// program computes with. A law may declare `PhaseFraction curve() const` instead of `range` and `fraction`.
#pragma once

#include <functional>
#include <utility>

#include "input/kinds.hpp"
#include "material/phase_change.hpp"

namespace solidus::material {

/// The temperatures between which a phase fraction is neither one nor zero [K].
struct FractionRange {
  double low = 0, high = 0;
};

class FractionLaw {
 public:
  virtual ~FractionLaw() = default;
  /// Throws std::invalid_argument for numbers that make no curve.
  virtual PhaseFraction curve() const = 0;
};

/// The curve f over a range, with an isothermal rest at its lower end.
PhaseFraction sampled_fraction(const std::function<double(double)>& f, FractionRange range);

template <class Law>
PhaseFraction fraction_curve(const Law& law) {
  if constexpr (requires { law.curve(); })
    return law.curve();
  else
    return sampled_fraction([&law](double temperature) { return law.fraction(temperature); }, law.range());
}

template <class Law>
class FractionLawOf final : public FractionLaw {
 public:
  Law data;
  PhaseFraction curve() const override { return fraction_curve(data); }
};

/// All curves, built in and added; the key kind of [phase_change.fraction].
Kinds<FractionLaw>& fraction_laws();

/// Adds a law while the program starts, as an object at namespace scope.
template <class Law>
struct AddFractionLaw {
  AddFractionLaw() { fraction_laws().add(kind_of<FractionLaw, FractionLawOf<Law>>()); }
};

/// Keys that several laws have.
template <class Law>
void liquidus_key(Section<Law>& s) {
  s.quantity("liquidus", static_cast<double Law::*>(&Law::liquidus), "K")
      .positive()
      .doc("Temperature above which the fraction is 0.");
}
template <class Law>
void solidus_key(Section<Law>& s) {
  s.quantity("solidus", static_cast<double Law::*>(&Law::solidus), "K")
      .positive()
      .doc("Temperature below which the fraction is 1.");
}

}  // namespace solidus::material
