/// A gap that conducts the same however wide it is: h = h_o [W/(m² K)].
#pragma once

#include "contact/laws/gap_law.hpp"

namespace solidus::contact {

/// The key of a conductance at a gap of zero, which several laws have.
template <class Law>
void open_conductance_key(Section<Law>& s) {
  s.quantity("open_conductance", &Law::open_conductance, "W/m2/K")
      .positive()
      .doc(
          "h_o, the conductance at a gap of zero; without it that of contact. With "
          "spots and gas it follows from the asperities.");
}

struct ConstantGap {
  static constexpr std::string_view name = "constant", doc = "the same for every gap";
  std::optional<double> open_conductance{};  ///< h_o; absent: that of contact

  static void keys(Section<ConstantGap>& s) { open_conductance_key(s); }

  template <class T>
  T conductance(const T&) const {
    return T(*open_conductance);
  }
  std::optional<Objection> begin(const ContactSide& side) {
    if (!open_conductance) open_conductance = side.conductance;
    if (!open_conductance)
      return Objection{
          "a closed interface that conducts by its pressure alone, with a constant conductance of "
          "the gap, needs open_conductance",
          "a conductance"};
    if (!(*open_conductance >= 0))
      return Objection{"the conductance across the open gap is negative", "zero or more"};
    return std::nullopt;
  }
};

}  // namespace solidus::contact
