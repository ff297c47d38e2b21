/// Estimate of the freezing time of a casting before anything is computed: Chvorinov's rule with a constant
/// that comes from the case's own data.
///
///   t = C (V/A)²
///
/// V [m³] volume of the metal, A [m²] its cooled skin, of the thickest place of the casting with the metal
/// around it that heat reaches until it is solid (check/local_shape.hpp), or of all of it. C [s/m²] is not a
/// number from a book: the freezing of a plate, cylinder or ball with the same V/A, and with the depth R of
/// that place below the cooled skin, is computed in one dimension,
///
///   ∂h/∂t = r^(1−n) ∂/∂r ( r^(n−1) k(Θ) ∂Θ/∂r ),   n = R A/V between 1 (plate) and 2
///
/// (a bar; where R A/V is larger walls meet, next to which no mould cools the place, unless it is round
/// itself: then up to 3, a ball), with the enthalpy h(Θ) of the material, next to it every mould that the
/// skin faces as shells of its volume, by how much of it there is behind each third of the skin, with the
/// conductance of the contact (and the gap that the metal's own shrinkage opens where contact may open),
/// films, radiation and fluxes as they are. So C holds superheat, latent heat, the mould's √(k ρ C) and its
/// finite thickness, the resistance of the interface and that of the metal, whichever governs.
///
/// A larger body behind a mould, such as the sand around a sleeve or a chill, takes heat as a half space
/// does. Metal that is poured with it and shares faces with it, as a casting does with its riser, is a fin on
/// its skin: a shell of its volume on the area that both share, that loses heat through its own cooled skin
/// evenly over its volume. So a riser gives heat to the casting below it, and the casting is liquid where it
/// meets the riser until its fin is solid there.
///
/// The estimate neglects smaller bodies behind a mould, the flow of metal and heat that goes along the mould.
/// Measured: docs/guide/findings.md.
///
/// Source: N. Chvorinov, "Theorie der Erstarrung von Gussstücken", Die Giesserei 27 (1940) 177–186, 201–208,
/// 222–225.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "material/material.hpp"

namespace solidus::check {

/// A part of the cooled skin that faces another body.
struct MouldSide {
  double share = 0;  ///< of the cooled skin
  const material::Material* material = nullptr;
  double start = 0;         ///< [K]
  double volume_ratio = 0;  ///< its volume over that of the casting
  /// Between the skins, of the gap [m] and both skins' temperatures [K] [W/(m² K)].
  std::function<double(double gap, double metal, double mould)> conductance;
  bool may_open = false;  ///< the casting may shrink away from it
  /// Heat into its outer side per area of the casting's cooled skin [W/m²], of its temperature [K] and the
  /// time [s].
  std::function<double(double temperature, double time)> outer_heat;
};

/// A part of the skin that exchanges heat with surroundings; all such parts of a casting together.
struct OpenSide {
  /// Into the body, per area of the whole cooled skin [W/m²].
  std::function<double(double temperature, double time)> heat;
};

/// Metal that is poured with the body and shares faces with it.
struct PouredNeighbour {
  const material::Material* metal = nullptr;  ///< it solidifies
  double start = 0;                           ///< [K]
  double share = 0;         ///< area of the shared faces over that of the body's cooled skin
  double volume_ratio = 0;  ///< its volume over that of the body
  /// Heat into it through its own cooled skin, per its volume [W/m³], of its temperature [K] and the time
  /// [s].
  std::function<double(double temperature, double time)> heat;
};

struct FreezingProblem {
  const material::Material* metal = nullptr;  ///< it solidifies
  double start = 0;                           ///< [K]
  double modulus = 0;                         ///< V/A [m]
  double depth = 0;                           ///< R, of the deepest place below the cooled skin [m]
  std::vector<MouldSide> moulds;
  std::vector<OpenSide> open;
  std::vector<PouredNeighbour> neighbours;
  double roundness = 2;  ///< R A/V close to that place: 3 in a ball, less where walls meet
};

struct FreezingEstimate {
  std::optional<double> time;  ///< until the last place is at its solidus [s]; absent: it stays liquid
  std::string governed_by;     ///< part of the way of heat with the largest drop of temperature
  double mould_reach = 0;      ///< √(α t) of the mould with the largest share [m]; zero: no mould
  /// Temperature that everything comes to where it never freezes [K].
  double rest = 0;
  bool gave_up = false;  ///< the estimate found no end: nothing of it holds
  /// [neighbour] until it is at its solidus where it meets the body [s]; of an estimate with a time.
  std::vector<double> neighbours;
};

/// Takes some milliseconds. No MPI.
FreezingEstimate estimate_freezing(const FreezingProblem& problem);

}  // namespace solidus::check
