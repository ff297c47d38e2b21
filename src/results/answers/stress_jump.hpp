/// The jump of stress from element to element: what elements of first order leave of a stress that they
/// cannot follow, as in bending or where temperature has a gradient (docs/theory/mechanics.md).
#pragma once

#include <span>
#include <vector>

#include "mesh/mesh.hpp"
#include "results/answers/answers.hpp"
#include "results/fields/field.hpp"

namespace solidus::results {

/// Of each body the root of
///
///   Σ_i Σ_{e at i} V_e |σ_e − σ_i|² / n_e  /  Σ_e V_e |σ_e|²
///
/// with σ_i the mean around a node by volume, deviators alone: zero where the stress is even, towards one
/// where it means nothing. Zero for bodies without stress. Collective.
/// @param fields  of the bodies; without "stress" nothing is returned
std::vector<double> stress_jumps(const mesh::Mesh& mesh, AnalysisKind kind, const FieldSet& fields);

/// Tells people of bodies of first-order elements whose stress jumps by more than half of its size.
/// Collective.
/// @param castings  bodies that freeze: elements of second order neither open pores nor feed in them
void tell_stress_jumps(const mesh::Mesh& mesh, AnalysisKind kind, const FieldSet& fields,
                       std::span<const CastBody> castings);

}  // namespace solidus::results
