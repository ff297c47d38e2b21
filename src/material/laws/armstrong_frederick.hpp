/// Recall in proportion to the back stress: r is a parameter, and q saturates (Armstrong and Frederick 1966).
#pragma once

#include "material/laws/kinematic_law.hpp"

namespace solidus::material {

struct ArmstrongFrederick {
  static constexpr std::string_view name = "armstrong_frederick",
                                    equation =
                                        "dq = 2/3 K d(eps_vp) - recall q d(xi) (Armstrong and Frederick)";
  static constexpr LawParameter parameters[] = {
      {"recall", "1", "The back stress of a tensile test saturates at K/recall."}};

  template <class T>
  static Recall<T> recall(const FlowProperties<T>& p, const T&) {
    return {p.recall[0], T(0.0)};
  }
};

}  // namespace solidus::material
