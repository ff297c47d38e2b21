/// Finds temperature and potential of a node from its heat content, or the reverse, by one look-up.
#pragma once

#include <optional>
#include <vector>

#include "heat/iteration/heat_system.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "heat/storage/storage_curve.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::heat {

/// Nodes of one material have its curve (storage_curve.hpp); at the others the curves of their materials are
/// added up, by NodalEnthalpy and NodalPotential.
class NodeCurves {
 public:
  /// Both must outlive this object; the potential is that which the system has at a call.
  NodeCurves(const NodalEnthalpy& storage, HeatSystem& system);

  /// @param heat  H of the node [J]
  /// Returns temperature and potential [K] and dv/dH [K/J], which is zero on a plateau.
  StorageCurve::AtHeat at_heat(Index node, double heat) const {
    const std::optional<NodeShare> share = only_share(node);
    if (!share) return sum_at_heat(node, heat);
    StorageCurve::AtHeat at = curves_[as_size(share->body)].at_heat(heat / share->weight);
    at.slope /= share->weight;
    return at;
  }
  /// @param near  a temperature from which the search starts where several materials meet
  /// Returns the temperature [K], H [J] at both ends of a plateau and dv/dH [K/J]; zero where at_heat() has
  /// to tell it: at plateaus and at nodes of several materials.
  StorageCurve::AtPotential at_potential(Index node, double potential, double near) const {
    const std::optional<NodeShare> share = only_share(node);
    if (!share) return sum_at_potential(node, potential, near);
    const StorageCurve::AtPotential at = curves_[as_size(share->body)].at_potential(potential);
    return {at.temperature, share->weight * at.lower, share->weight * at.upper, at.slope / share->weight};
  }

 private:
  /// Nothing where several materials store heat or conduct it.
  std::optional<NodeShare> only_share(Index node) const {
    const std::optional<NodeShare> share = storage_.only_share(node);
    return share && system_.parts().elements.nodal().is_of(node, share->body) ? share : std::nullopt;
  }
  StorageCurve::AtHeat sum_at_heat(Index node, double heat) const;
  StorageCurve::AtPotential sum_at_potential(Index node, double potential, double near) const;

  const NodalEnthalpy& storage_;
  HeatSystem& system_;
  std::vector<StorageCurve> curves_;  ///< [body]
};

}  // namespace solidus::heat
