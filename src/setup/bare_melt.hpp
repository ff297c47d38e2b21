/// Melt that loses its mould: a stage in which a mould, a core or a die leaves before the skin of the casting
/// that it held is coherent. Nothing holds such metal then: it would run out.
#pragma once

#include "setup/assembly.hpp"

namespace solidus::setup {

/// Throws InputError, at the place of the stage in the case file, if metal below coherency on more than a
/// tenth of the area that a contact held before this stage is left without it, and its body deforms; says so
/// with a warning where the body only conducts heat. Collective.
/// @param number  of the stage that begins, in Assembly::stages
/// @param begins  its state
void check_no_bare_melt(const cases::CaseSpec& spec, const Assembly& a, std::size_t number,
                        const coupling::State& begins);

}  // namespace solidus::setup
