/// An interface that presses, rubs and conducts, of the blocks of ../contact/bodies.hpp.
#pragma once

#include "contact/laws/gas_gap.hpp"
#include "contact/laws/power_contact.hpp"
#include "contact/points/parameters.hpp"

namespace solidus::test {

inline contact::ContactParameters rubbing_interface() {
  contact::ContactParameters s;
  s.name = "interface";
  s.slave = "upper_bottom";
  s.master = "lower_top";
  s.penalty = 1e12;
  s.penalty_is_factor = false;
  s.stabilisation = 0;
  s.friction = contact::FrictionParameters{};
  s.friction->coefficient.terms = {Table(0.2)};
  s.friction->tangential_penalty = 1e11;
  contact::HeatTransferSpec h;
  h.contact_law = contact::contact_law(contact::PowerContact{3e3, 0.95, 1e9});
  h.gap_law = contact::gap_law(contact::GasGap{.conductivity = 0.05, .open_conductance = 2e3});
  s.heat = h;
  return s;
}

}  // namespace solidus::test
