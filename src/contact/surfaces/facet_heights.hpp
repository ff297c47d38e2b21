/// Height over the faces of a surface of the smooth one that they stand for.
///
/// Faces with linear shape functions are facets between nodes that lie on a curved surface. With its normal n
/// and n_b − n_a ≈ S (x_b − x_a), the surface lies above the place Σ N_a x_a of a facet, along n, by
///
///   t = ½ Σ_{a<b} N_a N_b (x_b − x_a)ᵀ S (x_b − x_a)
///
/// which of a chord of the length h is κ h²/8 in its middle. A gap between two such surfaces is smaller by
/// both heights than that between the facets, and facets of one curved fit, which leave gaps and overlaps,
/// touch. Faces with quadratic shape functions follow the surface and have no height.
#pragma once

#include <span>
#include <vector>

#include "contact/surfaces/surface.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

/// What facets do to the gap of a point [m].
struct FacetGap {
  double height = 0;  ///< both heights at the point, which the gap between the facets is too large by
  double bound = 0;   ///< largest heights on both faces, without sign
  /// Share of the place where one face is curved outward and the other inward, as in a fit.
  double fits = 0;
};

class FacetHeights {
 public:
  /// In the reference configuration. Edges sharper than the feature angle of contact stay sharp.
  explicit FacetHeights(const ContactSurface& surface);
  /// t at the values N of the face's shape functions [m].
  double at(Index face, std::span<const double> shape) const;
  /// The largest t of the face without sign [m].
  double largest(Index face) const { return largest_[as_size(face)]; }
  /// The angle by which the normal of the surface turns along an edge of the face or of one that shares a
  /// node with it, the largest [rad].
  double turn(Index face) const { return turn_[as_size(face)]; }
  /// Above zero where the face is convex, below where it is concave.
  double outward(Index face) const { return outward_[as_size(face)]; }

 private:
  void measure_turns(const ContactSurface& surface, double feature_angle);

  std::vector<std::size_t> first_;  ///< of every face in pair_
  std::vector<double> pair_;        ///< ½ (x_b − x_a)ᵀ S (x_b − x_a), a < b [m]
  std::vector<double> largest_;     ///< [face]
  std::vector<double> turn_;        ///< [face] [rad]
  std::vector<double> outward_;     ///< [face]: the sum of its pairs, above zero where it is convex [m]
};

/// Half of the facets' share of a gap for each side at one place.
/// @param master_face  below zero: a master without faces
FacetGap facet_gap(const FacetHeights& slave, Index slave_face, std::span<const double> slave_shape,
                   const FacetHeights* master, Index master_face, std::span<const double> master_shape);

}  // namespace solidus::contact
