/// The choices of `solidus new` for a part: temperatures, bodies, mould, sizes, riser, symmetry.
#pragma once

#include "material/material.hpp"
#include "new_case/casting_processes.hpp"
#include "new_case/new_case_text.hpp"
#include "new_case/part_measures.hpp"

namespace solidus::new_case {

/// The draft before it has been built: its end, its step, skins in air and cores in cavities come later
/// (draft_refinement.hpp). Throws InputError for options that the part cannot have.
Draft choose_draft(const NewCaseOptions& options, const CastingProcess& process,
                   const material::Material& alloy, const PartMeasures& part);

/// Gives a body of the draft material, temperature and physics by its role.
void describe(const Draft& draft, const CastingProcess& process, DraftBody& body);

}  // namespace solidus::new_case
