/// Coupling number: the strength of the coupling of deformation and temperature of a material
/// (docs/theory/coupling_stability.md, 5).
///
///   δ = β² Θ/(C (λ + 2μ)),  β = 3 α_eff k,  3 α_eff = de^θ/dΘ                             (monograph 4.2.4)
///   δ_K = β² Θ/(C K*),  K* = λ + 2μ in uniaxial strain, λ + μ in plane strain, k in three dimensions
///
/// The quasi-static isothermal split is stable for every step where δ_K < 1. α_eff holds the slope of α(Θ):
/// with secant values it is α + α_Θ (Θ − Θ_ref). C is the capacity at constant strain, without latent heat.
/// Symbols: k bulk modulus, λ, μ Lamé's [Pa], e^θ volumetric thermal strain, Θ absolute temperature [K].
#pragma once

#include "material/material.hpp"

namespace solidus::material {

/// δ_K by what the surroundings allow, [1].
struct CouplingNumber {
  double uniaxial = 0;  ///< δ itself
  double plane = 0;     ///< 2 (1 − ν) δ: plane strain, axisymmetry without axial displacement
  double bound = 0;     ///< 3 (1 − ν)/(1 + ν) δ = C_p/C − 1: whatever the shape and the supports
};

/// At a temperature [K]. What is not solid has no shear modulus: all three are the last.
CouplingNumber coupling_number(const Material& material, double temperature);

/// The temperature between two [K] at which the coupling is strongest, to the sampling of each piece of the
/// tables by a tenth.
double strongest_coupling(const Material& material, double from, double to);

}  // namespace solidus::material
