/// View factors of clusters of faces by rays, made reciprocal and closed.
///
///   S_ij ≈ A_i F_ij = ∫_i ∫_j cosθ_i cosθ_j/(π r²) dA dA     and E_i = A_i F_i∞ to the open part
///
/// From places that are spread evenly over a cluster rays go out by the law of cosines (of Lambert); what
/// they meet first counts. Places and directions are a sequence of low discrepancy in four dimensions
/// (Roberts' generalised golden ratio), shifted for each cluster (Cranley and Patterson, SIAM J. Numer. Anal.
/// 13, 1976). Then S ← ½ (S + Sᵀ), and factors d of the clusters are found with
///
///   d_i (Σ_j S_ij d_j + E_i) = A_i                                    to 1e-12
///
/// so that S stays symmetric and every row closes. In a plane rays stay in it; about an axis faces are rings
/// of flat facets.
#pragma once

#include <vector>

#include "heat/radiation/radiating_faces.hpp"
#include "numbers/types.hpp"

namespace solidus::heat {

struct ViewFactors {
  struct Entry {
    std::size_t to;
    double exchange;  ///< A_i F_ij [m²]
  };
  std::vector<std::size_t> start;  ///< of each cluster in `entries`, one more at the end
  std::vector<Entry> entries;      ///< symmetric
  std::vector<double> area, open;  ///< A_i and E_i of each cluster [m²]
  double corrected =
      0;  ///< the largest |Σ_j F_ij + F_i∞ − 1| before the factors d: what rays leave to chance

  std::size_t size() const { return area.size(); }
  /// y = S x.
  std::vector<double> multiply(const std::vector<double>& x) const;
  std::size_t bytes() const {
    return start.capacity() * sizeof(std::size_t) + entries.capacity() * sizeof(Entry) +
           (area.capacity() + open.capacity()) * sizeof(double);
  }
};

/// @param rays  of each cluster
/// Collective: processes share the clusters; the same to the last bit on any number of them. Throws
/// InputError where the factors do not close.
ViewFactors view_factors(const RadiatingFaces& faces, AnalysisKind kind, std::size_t rays);

/// The share of the rays from faces that meets one of them: zero of a convex skin. Collective as above.
double share_of_own_view(const RadiatingFaces& faces, AnalysisKind kind, std::size_t rays);

}  // namespace solidus::heat
