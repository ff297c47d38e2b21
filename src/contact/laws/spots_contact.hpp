/// Conduction through the spots where rough surfaces meet, in addition to the gas between them
/// (monograph 3.46-3.48, contact/interface/asperities.hpp): h = h_S(t_N, Θ_g) + h_G(t_N, Θ_g).
#pragma once

#include "contact/interface/asperities.hpp"
#include "contact/laws/power_contact.hpp"

namespace solidus::contact {

struct SpotsContact {
  static constexpr std::string_view name = "spots",
                                    doc = "contact spots and the gas between them (3.46-3.48)";
  Asperities asperities;
  std::optional<double> hardness{};  ///< H_e [Pa], needed with a gas between the spots

  static void keys(Section<SpotsContact>& s) {
    hardness_key(s);
    s.section("asperities", &SpotsContact::asperities, asperity_keys());
  }

  static constexpr bool beside_gas = true;
  bool of_temperature() const { return !asperities.conductivity->constant(); }
  bool needs_conductivity() const { return !asperities.conductivity; }
  void take_conductivity(Table mean) { asperities.conductivity = std::move(mean); }
  LawConductance at(double pressure, double temperature) const {
    const Asperities::Pressed h = asperities.spots(pressure, temperature);
    return {h.value, h.by_pressure, h.by_temperature, h.mixed};
  }
  Separation separation(double pressure) const {
    const Asperities::PlaneDistance y = asperities.separation(pressure / *hardness);
    return {y.value, y.slope / *hardness};
  }

  std::optional<Objection> objection(bool gas_between) const {
    const Asperities& a = asperities;
    if (!(a.roughness > 0 && a.slope > 0))
      return Objection{"spots need the roughness and the slope of the asperities", "both above zero"};
    if (!(a.hardness_coefficient > 0))
      return Objection{"spots need the hardness c_1 of small indentations", "above zero"};
    if (!(a.hardness_exponent > -1 && a.hardness_exponent <= 0))
      return Objection{"the exponent c_2 of the hardness is out of range",
                       "above -1 and at most 0: small indentations are harder"};
    if (!(a.conductivity && a.conductivity->min_value() > 0))
      return Objection{
          "spots need the mean conductivity of the two bodies",
          "'conductivity' above zero, 2 k1 k2 / (k1 + k2); without it that of the two materials"};
    if (gas_between && !(hardness && *hardness > 0))
      return Objection{"the gas between spots needs the hardness", "a hardness above zero"};
    return std::nullopt;
  }
  /// Beyond these numbers `check` says something [m], [1].
  static constexpr double k_smoothest = 1e-8, k_roughest = 2e-4, k_steepest = 1;
  std::vector<Remark> remarks(std::string_view contact) const {
    std::vector<Remark> remarks;
    if (asperities.roughness < k_smoothest || asperities.roughness > k_roughest)
      remarks.push_back({false,
                         fmt::format("the surfaces of the contact '{}' have a roughness of {:g} um", contact,
                                     1e6 * asperities.roughness),
                         "usual are 0.1 um of polished to 100 um of cast surfaces"});
    if (asperities.slope > k_steepest)
      remarks.push_back({false,
                         fmt::format("the asperities of the contact '{}' have a mean slope of {:g}", contact,
                                     asperities.slope),
                         "usual are 0.03 to 0.4: a tangent, not an angle"});
    return remarks;
  }

 private:
  static Section<Asperities> asperity_keys() {
    using A = Asperities;
    Section<A> s("asperities", "The rough surfaces, for contact_law = \"spots\" (3.47, 3.48).");
    s.quantity("roughness", &A::roughness, "m")
        .positive()
        .doc("Root mean square height of both surfaces together, sqrt(s1^2 + s2^2).");
    s.key("slope", &A::slope)
        .positive()
        .doc("Mean slope of the asperities of both surfaces together, sqrt(m1^2 + m2^2).");
    s.function("conductivity", &A::conductivity, "W/m/K")
        .of({Argument::temperature})
        .positive()
        .doc("Mean conductivity of the two bodies, 2 k1 k2 / (k1 + k2); without it that of their materials.");
    s.quantity("hardness_coefficient", &A::hardness_coefficient, "Pa")
        .positive()
        .doc("c1 of the hardness of small indentations, c1 (d / 1 um)^c2, of the softer body.");
    s.key("hardness_exponent", &A::hardness_exponent)
        .initially(0.0)
        .range(-0.9, 0)
        .doc("c2, the exponent of that hardness; zero: the same whatever the size.");
    return s;
  }
};

}  // namespace solidus::contact
