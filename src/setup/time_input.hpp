/// Makes the options of the simulation from the section [time], and checks that its keys agree.
#pragma once

#include <span>

#include "cases/case_spec.hpp"
#include "coupling/simulation.hpp"

namespace solidus::setup {

/// Throws InputError for keys that are missing or contradict each other or the analysis.
void check_time(const cases::CaseSpec& spec);

/// End, step sizes and limits, and all output times of a transient run; the limit of the displacement error
/// is that of displacement_error().
coupling::TimeOptions time_options(const cases::CaseSpec& spec);

/// The error of the displacement that a step may commit [m].
/// @param sections  of the bodies that deform (sections_of), [body] [m]
double displacement_error(const cases::TimeSpec& t, std::span<const double> sections);

/// The share of a skin in contact that may become coherent in a step [1]: the one given, else
/// StepLimits::skin times the root of the displacement error asked for over the default one, 0.001 to 0.5.
/// @param sections  as above; empty: not known, so that the displacement error does not count
double skin_change(const cases::TimeSpec& t, std::span<const double> sections);

/// The change of the solid share in a step [1]: the one given, else with heat alone 0.1, and where bodies
/// deform `standard` times the same root.
/// @param sections  as above
double solid_fraction_change(const cases::TimeSpec& t, std::span<const double> sections, double standard);

}  // namespace solidus::setup
