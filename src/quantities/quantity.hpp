/// A quantity that people read: a field of a run. Each is declared once, as a row in the room whose physics
/// computes it (heat/quantities.hpp, mechanics/quantities.hpp, contact/quantities.hpp, criteria/); probes,
/// `check`, results, the report, pictures, comparisons, Python and the reference page read the row.
#pragma once

#include <optional>
#include <string_view>

#include "numbers/types.hpp"

namespace solidus::quantities {

enum class Rank { scalar, vector, tensor };

/// The place of values. `contact`: nodes of contact surfaces, whose files always have all of these.
enum class Place { node, element, contact };

/// The heading under which menus show a quantity.
enum class Group { heat, mechanics, contact, criteria };

enum class Extreme { none, least, greatest };

/// Whether field files have a quantity that no list names.
enum class Written { always, on_request };

/// The moments that the page of a run keeps: `last` where the end says all (criteria) or where the quantity
/// follows from others that are kept; `none` for what tells nothing in addition to another quantity.
enum class Kept { every, last, none };

/// The colours that suit a quantity: from low to high; as of hot metal; of a share; apart by the sign.
enum class Colours { sequential, hot, share, by_sign };

/// The parts of a run that must be there so that a quantity has values of interest. Those of the run decide
/// whether the field exists, `melting` and `mechanics` also which bodies it says something of.
struct Needs {
  bool heat = false;
  bool mechanics = false;   ///< a body that only conducts heat keeps its values
  bool inertia = false;     ///< [dynamics]
  bool plasticity = false;  ///< a material that flows plastically
  bool melting = false;     ///< a body whose material freezes
  bool isentropic = false;  ///< the isentropic mapping of the mechanical phase
  bool friction = false;
};

/// The unit that people read: value · factor + offset, of a value in SI.
struct ShownUnit {
  std::string_view unit;  ///< as UDUNITS writes it, "W/m2"; where it knows none in the same manner
  std::string_view text;  ///< as people write it, "W/m²"; empty for a number
  double factor = 1, offset = 0;
};

inline constexpr ShownUnit k_percent{"%", "%", 100};

/// Returns the unit in which people read values of a SI unit: "K" as °C. Units that it does not know stay.
ShownUnit shown_unit(std::string_view si);

struct Quantity {
  std::string_view name;  ///< in cases and files: "von_mises"
  std::string_view unit;  ///< SI, of values in the program and in files: "Pa"; "1" for a number
  /// The unit in SI where UDUNITS has none, as of a root: "K^0.5 s^0.5/m". Files count it as a number.
  std::string_view root_unit = {};
  std::string_view label;  ///< of menus and axes: "Von Mises stress"
  std::string_view doc;    ///< a sentence of the reference page, without its full stop
  Group group = Group::heat;
  Rank rank = Rank::scalar;
  Place place = Place::node;
  Needs needs = {};
  std::optional<double> no_value = {};  ///< stands for "nothing to say" in files; absent: every value counts
  Written written = Written::always;
  Kept kept = Kept::every;
  Extreme worst = Extreme::none;   ///< the end of its range that a foundry engineer looks for
  std::string_view headline = {};  ///< of the figures at the head of the report; empty: it is none
  /// Its worst value among the answers of a run, "longest local solidification time"; empty: it is none.
  std::string_view answer = {};
  /// Beyond it, towards its worst end, a value is bad by the criterion itself: its answer tells the share of
  /// the castings where it is. In the unit of values.
  std::optional<double> threshold = {};
  Colours colours = Colours::sequential;
  /// Of contact: per area in contact, so that a surface that is covered in part carries it there alone.
  bool per_covered_area = false;
  bool compared = false;    ///< `solidus compare` has its difference
  bool pictured = false;    ///< it is among the pictures that every run gets
  ShownUnit shown_as = {};  ///< empty: shown_unit() of its unit

  constexpr std::string_view exact_unit() const { return root_unit.empty() ? unit : root_unit; }
  constexpr bool of_contact() const { return place == Place::contact; }
  ShownUnit shown() const { return shown_as.unit.empty() ? shown_unit(unit) : shown_as; }
  int components(AnalysisKind kind) const {
    return rank == Rank::tensor ? 6 : rank == Rank::vector ? displacement_components(kind) : 1;
  }
};

}  // namespace solidus::quantities
