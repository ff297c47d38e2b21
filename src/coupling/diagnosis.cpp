/// One sentence for each physical cause, from numbers that run/diagnose.cpp has found.
#include "coupling/diagnosis.hpp"

#include <fmt/format.h>

#include <cmath>

#include "numbers/types.hpp"

namespace solidus::coupling {

namespace {

std::string degrees(double temperature) {
  if (!std::isfinite(temperature)) return "no number";
  constexpr double k_near_zero = 50;  // below it degrees Celsius would hide what is left [K]
  return temperature < k_near_zero ? fmt::format("{:.3g} K", temperature)
                                   : fmt::format("{:.4g} degC", temperature - k_zero_celsius);
}

std::string place(const Diagnosis& d) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) mm", 1e3 * d.place[0], 1e3 * d.place[1], 1e3 * d.place[2]);
}

/// The temperature of the place, and how solid it is where it is not.
std::string state_there(const Diagnosis& d) {
  if (!(d.temperature > 0)) return place(d);
  std::string text = place(d) + ", " + degrees(d.temperature);
  if (d.solid_fraction < 1) text += fmt::format(", {:.3g} % solid", 100 * d.solid_fraction);
  return text;
}

/// Below this share of its size in a try a body hardly moves, and below this change a place hardly cools [K]:
/// limits of the iteration have ended the run, not the load.
constexpr double k_hardly = 1e-5, k_hardly_cools = 0.1;

std::string way(const Diagnosis& d) {
  if (!std::isfinite(d.moved)) return "in the failing try its displacements are no numbers";
  if (d.moved > d.size)
    return fmt::format("in the failing try it goes farther than its {:.3g} mm from corner to corner",
                       1e3 * d.size);
  return fmt::format(
      "in the failing try it moves {:.3g} mm, {:.2g} % of its {:.3g} mm from corner to corner (usual in a "
      "step: below 1 %)",
      1e3 * d.moved, 100 * d.moved / d.size, 1e3 * d.size);
}

std::string and_way(const Diagnosis& d) {
  return d.in_try && d.moved > 0 ? "; " + way(d) : std::string();
}

std::string points(const Diagnosis& d) {
  const ContactPoints& c = d.contact;
  if (c.all == 0) return "no contact is on it";
  if (!d.in_try)
    return fmt::format("{} of its {} contact points were closed at the last step", c.before, c.all);
  return fmt::format("{} of its {} contact points were closed at the last step, {} are in the failing try",
                     c.before, c.all, c.now);
}

std::string held(const Diagnosis& d) {
  return d.supported ? points(d) : "contact alone holds it: " + points(d);
}

std::string uncarried(const Diagnosis& d) {
  return fmt::format("nothing carries body '{}'{}: no displacement of it is prescribed{}, and {}{}", d.body,
                     d.weight > 0 ? fmt::format(", which weighs {:.3g} N", d.weight) : std::string(),
                     d.weight > 0 ? " against its weight" : "",
                     d.contact.all == 0
                         ? "no contact is on it"
                         : fmt::format("none of its {} contact points is closed", d.contact.all),
                     and_way(d));
}

std::string melt(const Diagnosis& d) {
  return fmt::format("the melt of body '{}' flows without an equilibrium{}: at {}: {}; {}", d.body,
                     d.weight > 0 ? " under its weight" : "", state_there(d), way(d), held(d));
}

std::string limit_load(const Diagnosis& d) {
  std::string text = fmt::format("body '{}' is at its limit load: ", d.body);
  text += d.yielding > 0 ? fmt::format("{:.0f} % of its volume flows plastically", 100 * d.yielding)
                         : "flow has heated it at " + state_there(d);
  if (d.elongation > 0)
    text += fmt::format(", and it is strained by up to {:.3g} % (usual: below 10 %)", 100 * d.elongation);
  return text + and_way(d) + "; " + held(d);
}

std::string unbalanced(const Diagnosis& d) {
  if (d.moved <= k_hardly * d.size)
    return fmt::format(
        "the iteration of forces ends before body '{}' is in balance, although it hardly moves: {:.3g} mm in "
        "the "
        "failing try; {}",
        d.body, 1e3 * d.moved, held(d));
  return fmt::format(
      "body '{}' finds no equilibrium: at {}: {}; {:.0f} % of its volume flows plastically; {}", d.body,
      state_there(d), way(d), 100 * d.yielding, held(d));
}

std::string change_of_heat(const Diagnosis& d) {
  std::string text = fmt::format("{} of body '{}' goes from {} to {}", place(d), d.body,
                                 degrees(d.temperature), degrees(d.tried_temperature));
  if (d.step > 0) text += fmt::format(" in a try of {:.3g} s", d.step);
  return text + fmt::format("; the largest change anywhere is {:.3g} K", d.largest_change);
}

}  // namespace

std::string text(const Diagnosis& d) {
  // One sentence for each kind of failure: what the body or the contact does, where, and what it has reached.
  // The numbers are those of the last step and of the failing try, and units are those that a user reads.
  switch (d.physics) {
    case Physics::unknown:
      return {};
    case Physics::nothing_carries:
      return uncarried(d);
    case Physics::comes_off:
      return fmt::format("body '{}' comes off what it lies on; {}{}", d.body, held(d), and_way(d));
    case Physics::slides:
      return fmt::format("body '{}' is free to slide or to turn: contact alone holds it{}: {}", d.body,
                         d.rubs ? "" : ", without friction", points(d));
    case Physics::runs_out:
      return d.detail;
    case Physics::melt_flows:
      return melt(d);
    case Physics::limit_load:
      return limit_load(d);
    case Physics::law:
      return fmt::format("the material law finds no state in a try of {:.3g} s: {}", d.step, d.detail);
    case Physics::points_change:
      return fmt::format(
          "contact of body '{}' does not come to rest: {} of its {} points change between open, sticking and "
          "slipping in the last iteration; {}{}",
          d.body, d.contact.changed, d.contact.all, held(d), and_way(d));
    case Physics::no_equilibrium:
      return unbalanced(d);
    case Physics::multipliers:
      return fmt::format("the contact pressure on body '{}', {:.3g} % solid, does not come to rest: {}; {}",
                         d.body, 100 * d.solid_fraction, d.detail, held(d));
    case Physics::contact_heat:
      return fmt::format(
          "heat through contact '{}' does not come to rest: {}; there the contact passes {:.3g} times in a "
          "step what its surface stores (conductance times step over heat capacity)",
          d.contact_name, change_of_heat(d), d.conductance_number);
    case Physics::heat:
      if (d.largest_change <= k_hardly_cools)
        return fmt::format(
            "the iteration of heat ends before body '{}' is in balance at {}, although temperatures hardly "
            "change: by "
            "{:.3g} K at most in a try of {:.3g} s",
            d.body, state_there(d), d.largest_change, d.step);
      return "the heat of a step is not balanced: " + change_of_heat(d);
    case Physics::cold_law:
      return fmt::format(
          "more heat is taken than there is: in a try of {:.3g} s a temperature of {:.3g} K is reached: {}",
          d.step, d.tried_temperature, d.detail);
    case Physics::cold:
      return "more heat is taken than there is: " + change_of_heat(d);
    case Physics::phases:
      return d.body.empty()
                 ? std::string("heat and deformation of a step do not agree")
                 : fmt::format("heat and deformation of a step do not agree; body '{}': {}", d.body, held(d));
  }
  return {};
}

}  // namespace solidus::coupling
