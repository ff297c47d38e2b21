/// The objection to a law or a scheme with the numbers that it was given, in the words of InputError.
#pragma once

#include <string>

namespace solidus {

/// The reason why the numbers of a law are refused.
struct Objection {
  std::string found, allowed;  ///< for InputError
};

}  // namespace solidus
