/// Finds why a step could not be taken, from the last committed state and from what the failing try has left:
/// the bodies and what holds them, their melt, their flow, their contacts and the heat that passes through
/// them.
#pragma once

#include <string>

#include "cases/case_spec.hpp"
#include "coupling/diagnosis.hpp"
#include "setup/assembly.hpp"

namespace solidus::run {

/// @param a        its contacts are brought to `last`
/// @param ran_out  MeltWatch::ran_out()
/// @param dt       of the failing try [s]; zero: a steady state
/// Collective; the same on every process.
coupling::Diagnosis diagnose(const cases::CaseSpec& spec, setup::Assembly& a, const std::string& ran_out,
                             const coupling::State& last, const StepRejected& rejected, double dt);

}  // namespace solidus::run
