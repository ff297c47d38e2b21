/// The fields of contact surfaces, one row each (quantities/quantity.hpp).
#pragma once

#include <array>

#include "quantities/quantity.hpp"

namespace solidus::contact::fields {

using quantities::Quantity;

inline constexpr Quantity k_contact_pressure{.name = "contact_pressure",
                                             .unit = "Pa",
                                             .label = "Contact pressure",
                                             .doc = "Pressure between the surfaces",
                                             .group = quantities::Group::contact,
                                             .place = quantities::Place::contact,
                                             .needs = {.mechanics = true},
                                             .worst = quantities::Extreme::greatest,
                                             .per_covered_area = true};

inline constexpr Quantity k_gap{.name = "gap",
                                .unit = "m",
                                .label = "Air gap",
                                .doc = "Width of the gap between the surfaces",
                                .group = quantities::Group::contact,
                                .place = quantities::Place::contact,
                                .needs = {},
                                .worst = quantities::Extreme::greatest,
                                .headline = "Largest gap",
                                .compared = true,
                                .pictured = true};

inline constexpr Quantity k_conductance{.name = "conductance",
                                        .unit = "W/m2/K",
                                        .label = "Heat transfer coefficient",
                                        .doc = "Conductance of contact or gap",
                                        .group = quantities::Group::contact,
                                        .place = quantities::Place::contact,
                                        .needs = {},
                                        .kept = quantities::Kept::last};

inline constexpr Quantity k_contact_heat_flux{.name = "contact_heat_flux",
                                              .unit = "W/m2",
                                              .label = "Heat flux through contact",
                                              .doc = "Heat flux into the body of the node",
                                              .group = quantities::Group::contact,
                                              .place = quantities::Place::contact,
                                              .needs = {.heat = true},
                                              .colours = quantities::Colours::by_sign,
                                              .per_covered_area = true};

inline constexpr Quantity k_frictional_heat_flux{.name = "frictional_heat_flux",
                                                 .unit = "W/m2",
                                                 .label = "Heat flux by friction",
                                                 .doc = "Part of the heat flux that friction generates",
                                                 .group = quantities::Group::contact,
                                                 .place = quantities::Place::contact,
                                                 .needs = {.heat = true, .mechanics = true, .friction = true},
                                                 .per_covered_area = true};

inline constexpr Quantity k_friction_traction{.name = "friction_traction",
                                              .unit = "Pa",
                                              .label = "Traction by friction",
                                              .doc = "Traction of friction on the master",
                                              .group = quantities::Group::contact,
                                              .rank = quantities::Rank::vector,
                                              .place = quantities::Place::contact,
                                              .needs = {.mechanics = true, .friction = true},
                                              .per_covered_area = true};

inline constexpr Quantity k_contact_status{.name = "contact_status",
                                           .unit = "1",
                                           .label = "Contact status",
                                           .doc = "0 open, 1 sticks, 2 slips",
                                           .group = quantities::Group::contact,
                                           .place = quantities::Place::contact,
                                           .needs = {.mechanics = true, .friction = true}};

inline constexpr Quantity k_slip{.name = "slip",
                                 .unit = "m",
                                 .label = "Slip",
                                 .doc = "Sliding distance, accumulated",
                                 .group = quantities::Group::contact,
                                 .place = quantities::Place::contact,
                                 .needs = {.mechanics = true, .friction = true}};

inline constexpr Quantity k_internal_variable{
    .name = "internal_variable",
    .unit = "N/m",
    .label = "Internal variable of friction",
    .doc = "Variable on which the coefficient of friction depends: work per area, or a slip [m]",
    .group = quantities::Group::contact,
    .place = quantities::Place::contact,
    .needs = {.mechanics = true, .friction = true}};

inline constexpr Quantity k_friction_coefficient{.name = "friction_coefficient",
                                                 .unit = "1",
                                                 .label = "Friction coefficient",
                                                 .doc = "Coefficient of friction",
                                                 .group = quantities::Group::contact,
                                                 .place = quantities::Place::contact,
                                                 .needs = {.mechanics = true, .friction = true}};

inline constexpr Quantity k_friction_dissipation{.name = "friction_dissipation",
                                                 .unit = "J/m2",
                                                 .label = "Work of friction",
                                                 .doc = "Dissipated work of friction per area",
                                                 .group = quantities::Group::contact,
                                                 .place = quantities::Place::contact,
                                                 .needs = {.mechanics = true, .friction = true}};

inline constexpr Quantity k_wear_depth{.name = "wear_depth",
                                       .unit = "m",
                                       .label = "Wear depth",
                                       .doc = "Wear depth",
                                       .group = quantities::Group::contact,
                                       .place = quantities::Place::contact,
                                       .needs = {.mechanics = true, .friction = true},
                                       .shown_as = {"um", "µm", 1e6}};

inline constexpr Quantity k_interface_temperature{
    .name = "interface_temperature",
    .unit = "K",
    .label = "Temperature of the interface",
    .doc = "Temperature of the interface itself (monograph 3.41)",
    .group = quantities::Group::contact,
    .place = quantities::Place::contact,
    .needs = {.heat = true, .mechanics = true},
    .colours = quantities::Colours::hot};

/// In the order of the reference page.
inline constexpr std::array k_all = {&k_contact_pressure,     &k_gap,
                                     &k_conductance,          &k_contact_heat_flux,
                                     &k_frictional_heat_flux, &k_friction_traction,
                                     &k_contact_status,       &k_slip,
                                     &k_internal_variable,    &k_friction_coefficient,
                                     &k_friction_dissipation, &k_wear_depth,
                                     &k_interface_temperature};

}  // namespace solidus::contact::fields
