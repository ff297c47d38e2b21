/// A parameter of a law, declared once: the key of the material file with its checks, the reference page, the
/// tables that `solidus materials` shows and the numbers that the law reads follow from it.
#pragma once

#include <cstddef>
#include <limits>

namespace solidus::material {

/// How far a parameter's line over temperature may be followed within a step of the isentropic mapping.
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
  bool optional = false;                                                 ///< left out, it is zero
  Continuation continuation = Continuation::any;
};

/// The same parameter of a law that takes it as zero where it is left out.
constexpr LawParameter left_out_as_zero(LawParameter parameter) {
  parameter.optional = true;
  return parameter;
}

/// Most parameters that a law of isotropic hardening may have: as many numbers are kept at every point.
inline constexpr std::size_t k_hardening_parameters = 4;

}  // namespace solidus::material
