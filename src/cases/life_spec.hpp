/// How long a die bears its shots, as the case gives it.
#pragma once

#include <optional>
#include <string>

#include "input/keys.hpp"
#include "system/errors.hpp"

namespace solidus::cases {

/// The fatigue of one body; setup/criteria_input.hpp makes a criteria::FatigueLaw of it.
struct DieLifeSpec {
  enum class Law { coffin_manson, table };
  std::string body;  ///< group of the mesh
  Law law = Law::coffin_manson;
  double strength = 0, strength_exponent = 0;    ///< [Pa], below zero
  double ductility = 0, ductility_exponent = 0;  ///< [1], below zero
  double modulus = 0;                            ///< [Pa]
  double mean_stress = 0;                        ///< [Pa]
  Function cycles;                               ///< of the range of strain
  std::string source;                            ///< of the constants
  SourceLocation where;
};

}  // namespace solidus::cases
