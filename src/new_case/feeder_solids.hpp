/// The solids of risers, sleeves, gating and chills as a STEP file, for the CAD program that drew the part.
#pragma once

#include <filesystem>

#include "new_case/new_case_text.hpp"

namespace solidus::new_case {

/// Writes them as they are drawn, not cut by the part: they reach as far into it as their feet do, so that a
/// CAD program can join them. Nothing is written where the draft has none. Lengths are millimetres.
/// Throws InputError where the file cannot be written.
void write_feeder_solids(const Draft& draft, const std::filesystem::path& file);

}  // namespace solidus::new_case
