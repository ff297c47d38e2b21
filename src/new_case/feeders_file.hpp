/// Files of risers and chills, and of gating, for a part: `solidus new PART --riser FILE --gating FILE`.
#pragma once

#include <filesystem>
#include <vector>

#include "new_case/new_case_text.hpp"

namespace solidus::new_case {

struct Feeders {
  std::vector<DraftRiser> risers;
  std::vector<DraftChill> chills;
};

/// Reads [[riser]] and [[chill]] with the keys that [[mesh.riser]] and [[mesh.chill]] of a case have.
/// Throws InputError with the place of what is wrong.
Feeders read_feeders(const std::filesystem::path& file);

/// Reads [[gating]] with the keys of [[mesh.gating]]. Throws InputError, also where there is none.
std::vector<mesh::GatingSystem> read_gating(const std::filesystem::path& file);

}  // namespace solidus::new_case
