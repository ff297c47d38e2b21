/// The fields that a case can name, with their units inside the program; results/state_fields.hpp makes them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "numbers/types.hpp"

namespace solidus::model {

struct FieldInfo {
  enum class Rank { scalar, vector, tensor };
  const char* name;
  const char* unit;
  Rank rank = Rank::scalar;
  bool of_contact = false;  ///< of contact surfaces, which always carry all of theirs

  int components(AnalysisKind kind) const {
    return rank == Rank::tensor ? 6 : rank == Rank::vector ? displacement_components(kind) : 1;
  }
};

/// The name must be one of the list.
const FieldInfo& field_info(std::string_view name);
std::vector<std::string> field_names(bool with_contact);

}  // namespace solidus::model
