/// How long a die bears its shots and up to which limits it is used, as the case gives it.
#pragma once

#include <optional>
#include <string>

#include "input/keys.hpp"
#include "system/errors.hpp"

namespace solidus::cases {

/// Life of one body; setup/criteria_input.hpp makes a criteria::FatigueLaw and criteria::DieLimits of it.
struct DieLifeSpec {
  enum class Law { coffin_manson, table, none };
  std::string body;  ///< group of the mesh
  Law law = Law::coffin_manson;
  double strength = 0, strength_exponent = 0;    ///< [Pa], below zero
  double ductility = 0, ductility_exponent = 0;  ///< [1], below zero
  double modulus = 0;                            ///< [Pa]
  double mean_stress = 0;                        ///< [Pa]
  Function cycles;                               ///< of the range of strain
  std::string source;                            ///< of the constants
  std::optional<double> worn_depth;              ///< at which it is worn out [m]; absent: not asked
  std::optional<double> soldering_temperature;   ///< [K]; absent: not asked
  SourceLocation where;
};

}  // namespace solidus::cases
