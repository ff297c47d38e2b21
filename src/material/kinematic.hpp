/// The recall of the back strain by the law of a material (laws/kinematic_law.hpp). The law that comes with
/// the program is called directly, the others through KinematicLaw; types of automatic differentiation, which
/// only tests have, know no others.
#pragma once

#include <stdexcept>
#include <type_traits>

#include "material/laws/armstrong_frederick.hpp"

namespace solidus::material {

/// @param kind  of a law that recalls
template <class T>
[[gnu::always_inline]] inline Recall<T> kinematic_recall(KinematicHardening kind, const FlowProperties<T>& p,
                                                         const T& xi) {
  if (kind == KinematicHardening::armstrong_frederick) return ArmstrongFrederick::recall(p, xi);
  if constexpr (std::is_base_of_v<KinematicOn<T>, KinematicLaw>)
    return kinematic_law(kind).recall(p, xi);
  else
    throw std::logic_error("a law that was added knows no such type of numbers");
}

}  // namespace solidus::material
