/// Plates that freeze as long as a place of a casting does.
///
/// A foundry engineer compares places by the modulus, volume over cooled skin. That of a place within a
/// casting has no definition, but the time in which it froze has: the place is as thick as the plate of the
/// same metal, in the same mould, whose middle freezes in that time (N. Chvorinov, Die Giesserei 27 (1940)
/// 177: t = C (V/A)², of a plate V/A is half of its thickness).
#pragma once

#include <vector>

namespace solidus::criteria {

/// Times in which plates of a body's metal freeze in its mould; empty: not known.
struct PlateTimes {
  std::vector<double> thickness;  ///< rising [m]
  std::vector<double> time;       ///< since pouring, rising [s]
  /// The plate that freezes in a time: between those of the table, and beyond them, by a power law. Zero
  /// where nothing is known or the time is none.
  double thickness_of(double seconds) const;
};

}  // namespace solidus::criteria
