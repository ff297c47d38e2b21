/// Makes the analytic masters of contact from [[rigid_surface]].
#pragma once

#include "cases/case_spec.hpp"
#include "contact/surfaces/master_analytic.hpp"

namespace solidus::setup {

/// In axisymmetry the surface's line in the plane of radius and axis: a cylinder is a plane at its radius, a
/// sphere a circle. Expects what check_rigid_surfaces() lets through.
contact::RigidSurface rigid_surface(const cases::RigidSurfaceSpec& spec, AnalysisKind kind);

/// Shapes and motions that the analysis has, and contacts that can work with them; names are checked with the
/// mesh (mesh_checks.hpp).
/// Throws InputError with the place of the first that is not.
void check_rigid_surfaces(const cases::CaseSpec& spec);

}  // namespace solidus::setup
