/// Laws with the interface of Abaqus' user subroutine UMAT (Abaqus User Subroutines Reference Guide, "UMAT"),
/// as Fortran compilers make it: the symbol `umat_`, everything by reference, lengths of texts at the end.
///
/// Always three-dimensional: NDI = 3, NSHR = 3, components 11, 22, 33, 12, 13, 23 with engineering shear
/// strains, whatever the analysis; ε_33 and the shears out of the plane are then zero. Strains are without
/// thermal strain, as Abaqus passes them with *EXPANSION. One step and increment without end: KSTEP = KINC =
/// 1, NOEL = NPT = 1. What a law of infinitesimal strain does not read is not a number, so that a law that
/// reads it fails instead of computing something else: COORDS, CELENT, DFGRD0, DFGRD1; DROT is the identity.
/// PNEWDT < 1 cuts the step.
#pragma once

#include <memory>

#include "material/external_law.hpp"
#include "material/outside/shared_object.hpp"

namespace solidus::material {

/// Throws InputError: no such symbol, keys that the interface lacks or needs.
std::shared_ptr<const ExternalLibrary> make_umat_library(const SharedObject& object,
                                                         const ExternalData& data);

}  // namespace solidus::material
