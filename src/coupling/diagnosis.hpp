/// The physical state behind a step that could not be taken, in the terms of a casting: which body, held by
/// what, how hot, how far it moved. run/diagnose.hpp finds it, text() says it.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace solidus::coupling {

enum class Physics {
  unknown,          ///< nothing of what follows is known
  nothing_carries,  ///< a body that neither a support nor a closed contact holds
  comes_off,        ///< a body that contact alone holds comes off it in the failing try
  slides,           ///< a body that contact alone holds has a free motion: its equations are singular
  runs_out,         ///< melt has left its mould
  melt_flows,       ///< melt goes far in the failing try
  limit_load,       ///< a body yields in most of its volume
  law,              ///< a constitutive law finds no state, while its body hardly moves
  points_change,    ///< points of contact change between open, sticking and slipping without end
  no_equilibrium,   ///< forces stay out of balance, and none of these causes is seen
  multipliers,      ///< penetrations stay larger than the augmented Lagrangian may leave
  contact_heat,     ///< heat through a contact is large against what its surface stores
  heat,             ///< the balance of heat is not found, away from such a contact
  cold,             ///< a place gives off more heat than it has
  cold_law,         ///< the same, in the temperature that a constitutive law is asked at
  phases            ///< heat and deformation do not agree
};

/// Points of the contacts of a body, over all processes.
struct ContactPoints {
  std::int64_t all = 0;
  std::int64_t before = 0;   ///< closed at the last step
  std::int64_t now = 0;      ///< closed in the failing try
  std::int64_t changed = 0;  ///< in its last iteration
};

/// Fields that a kind of physics does not need stay as they are here.
struct Diagnosis {
  Physics physics = Physics::unknown;
  std::string body;
  double size = 0;                ///< of the body as drawn, from corner to corner [m]
  double weight = 0;              ///< of the body [N], per metre in plane strain; zero: no gravity
  bool in_try = false;            ///< the failing try has left a displacement, of which `moved` and `now` are
  double moved = 0;               ///< the farthest way of a node in the failing try [m]
  std::array<double, 3> place{};  ///< of that node, or of the one that is out of balance, as drawn [m]
  double temperature = 0;         ///< there at the last step [K]; zero: not known
  double solid_fraction = 1;      ///< there
  bool molten = false;            ///< the metal there is below coherency
  double elongation = 0;          ///< largest change of length of an edge of its elements at the last step
  double yielding = 0;            ///< share of the body's volume that flows plastically in the failing try
  bool supported = true;          ///< displacements of it are prescribed, against its weight if it has one
  bool rubs = false;              ///< a contact of the body has friction
  ContactPoints contact;          ///< of the body
  double tried_temperature = 0;   ///< there in the failing try, where heat has failed [K]
  double largest_change = 0;      ///< of any temperature there [K]
  double step = 0;                ///< the failing one, the shortest tried [s]; zero: a steady state
  std::string contact_name;       ///< of the contact through which heat passes there; empty: none
  double conductance_number = 0;  ///< h A Δt/C: conductance times step over heat capacity of that node
  std::string detail;             ///< words of the law or of the watch on melts
};

/// The physics in a sentence; empty where it is unknown.
std::string text(const Diagnosis& d);

}  // namespace solidus::coupling
