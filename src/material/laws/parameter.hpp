/// A parameter of a law, declared once: the key of the material file with its checks, the reference page, the
/// tables that `solidus materials` shows and the numbers that the law reads follow from it.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

namespace solidus::material {

/// The range in which a parameter's line over temperature may be followed within a step of the isentropic
/// mapping.
enum class Continuation {
  any,       ///< as far as the step goes
  positive,  ///< while it keeps a part of its value: the law divides by it, or it has to stay positive
  modulus    ///< it may pass zero, as long as the elastic modulus outweighs it
};

struct LawParameter {
  const char* key;   ///< in the material file
  const char* unit;  ///< SI
  const char* doc;
  double least = 0, greatest = std::numeric_limits<double>::infinity();  ///< of its values, in SI
  bool above_least = true;                                               ///< `least` itself is not allowed
  bool optional = false;                                                 ///< left out, it is `left_out`
  Continuation continuation = Continuation::any;
  double left_out = 0;
};

/// The same parameter of a law that takes it as zero where it is left out.
constexpr LawParameter left_out_as_zero(LawParameter parameter) {
  parameter.optional = true;
  return parameter;
}

/// Most parameters that a law of isotropic hardening, of kinematic hardening besides its modulus and of rate
/// dependence may have: as many numbers are kept at every point.
inline constexpr std::size_t k_hardening_parameters = 4, k_kinematic_parameters = 2, k_rate_parameters = 3;
/// The same of a model of the liquid, whose numbers do not depend on temperature.
inline constexpr std::size_t k_liquid_parameters = 2;
using LiquidNumbers = std::array<double, k_liquid_parameters>;

}  // namespace solidus::material
