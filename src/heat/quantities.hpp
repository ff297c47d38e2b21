/// The fields of the thermal phase, one row each (quantities/quantity.hpp).
#pragma once

#include <array>

#include "quantities/quantity.hpp"

namespace solidus::heat::fields {

using quantities::Quantity;

inline constexpr Quantity k_temperature{.name = "temperature",
                                        .unit = "K",
                                        .label = "Temperature",
                                        .doc = "Temperature",
                                        .group = quantities::Group::heat,
                                        .needs = {.heat = true},
                                        .worst = quantities::Extreme::greatest,
                                        .colours = quantities::Colours::hot,
                                        .compared = true,
                                        .pictured = true};

inline constexpr Quantity k_heat_flux{.name = "heat_flux",
                                      .unit = "W/m2",
                                      .label = "Heat flux",
                                      .doc = "Heat flux by conduction, mean over the element",
                                      .group = quantities::Group::heat,
                                      .rank = quantities::Rank::vector,
                                      .place = quantities::Place::element,
                                      .needs = {.heat = true},
                                      .written = quantities::Written::on_request,
                                      .colours = quantities::Colours::by_sign};

inline constexpr Quantity k_conduction_dissipation{.name = "conduction_dissipation",
                                                   .unit = "W/m3",
                                                   .label = "Dissipation by conduction",
                                                   .doc = "Dissipation by conduction, k |∇Θ|²/Θ",
                                                   .group = quantities::Group::heat,
                                                   .place = quantities::Place::element,
                                                   .needs = {.heat = true},
                                                   .written = quantities::Written::on_request};

inline constexpr Quantity k_solid_fraction{
    .name = "solid_fraction",
    .unit = "1",
    .label = "Solid fraction",
    .doc = "Solid fraction of the metal; 1 in materials that do not melt",
    .group = quantities::Group::heat,
    .needs = {.heat = true, .melting = true},
    .worst = quantities::Extreme::least,
    .colours = quantities::Colours::share,
    .compared = true,
    .pictured = true};

/// In the order of the reference page.
inline constexpr std::array k_all = {&k_temperature, &k_heat_flux, &k_conduction_dissipation,
                                     &k_solid_fraction};

}  // namespace solidus::heat::fields
