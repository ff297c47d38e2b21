/// Why a law or a scheme with its numbers makes none, in the words of InputError.
#pragma once

#include <string>

namespace solidus {

/// Why the numbers of a law make none.
struct Objection {
  std::string found, allowed;  ///< for InputError
};

}  // namespace solidus
