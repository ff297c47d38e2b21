/// How far a riser feeds, by rules from castings that were poured and radiographed.
#pragma once

#include <optional>

#include "material/material.hpp"

namespace solidus::new_case {

/// Feeding distance from the edge of a riser along a section of the thickness T. Bishop and Pellini poured
/// plates of 13 to 100 mm and bars of 50 to 200 mm of steel with 0.2 to 0.3 % C in green sand, and took as
/// sound what no radiograph showed a shrinkage in.
///
///   plate:  4.5 T up to an end, 2 T where another riser feeds from the other side
///   bar:    6 sqrt(T in inches) inches up to an end
///
/// Sources: H. F. Bishop, W. S. Pellini, "The contribution of riser and chill-edge effects to soundness of
/// cast steel plates", Transactions AFS 58 (1950) 185–197; H. F. Bishop, E. T. Myskowski, W. S. Pellini, "The
/// contribution of riser and casting end effects to soundness of cast steel bars", Transactions AFS 59 (1951)
/// 171–180.
class FeedingDistance {
 public:
  /// @param thickness  T of the section [m]
  /// @param plate      it is much wider than thick, else a bar
  /// @param to_an_end  no other riser feeds from the other side
  /// Returns the distance [m].
  double along(double thickness, bool plate, bool to_an_end) const;
};

/// The rule for an alloy; nothing where none is known: for irons, whose graphite feeds, and for other alloys,
/// for which we know of no published rule with its castings.
std::optional<FeedingDistance> feeding_distance(const material::Material& alloy);

}  // namespace solidus::new_case
