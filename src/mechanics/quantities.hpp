/// The fields of the mechanical phase, one row each (quantities/quantity.hpp).
#pragma once

#include <array>

#include "quantities/quantity.hpp"

namespace solidus::mechanics::fields {

using quantities::Quantity;

inline constexpr Quantity k_displacement{.name = "displacement",
                                         .unit = "m",
                                         .label = "Displacement",
                                         .doc = "Displacement since the start",
                                         .group = quantities::Group::mechanics,
                                         .rank = quantities::Rank::vector,
                                         .place = quantities::Place::node,
                                         .needs = {.mechanics = true},
                                         .worst = quantities::Extreme::greatest,
                                         .compared = true};

inline constexpr Quantity k_velocity{.name = "velocity",
                                     .unit = "m/s",
                                     .label = "Velocity",
                                     .doc = "Velocity",
                                     .group = quantities::Group::mechanics,
                                     .rank = quantities::Rank::vector,
                                     .place = quantities::Place::node,
                                     .needs = {.mechanics = true, .inertia = true}};

inline constexpr Quantity k_acceleration{.name = "acceleration",
                                         .unit = "m/s2",
                                         .label = "Acceleration",
                                         .doc = "Acceleration",
                                         .group = quantities::Group::mechanics,
                                         .rank = quantities::Rank::vector,
                                         .place = quantities::Place::node,
                                         .needs = {.mechanics = true, .inertia = true}};

inline constexpr Quantity k_stress{.name = "stress",
                                   .unit = "Pa",
                                   .label = "Stress",
                                   .doc = "Cauchy stress",
                                   .group = quantities::Group::mechanics,
                                   .rank = quantities::Rank::tensor,
                                   .place = quantities::Place::element,
                                   .needs = {.mechanics = true},
                                   .colours = quantities::Colours::by_sign};

inline constexpr Quantity k_von_mises{.name = "von_mises",
                                      .unit = "Pa",
                                      .label = "Von Mises stress",
                                      .doc = "Von Mises stress of the mean stress of the element",
                                      .group = quantities::Group::mechanics,
                                      .rank = quantities::Rank::scalar,
                                      .place = quantities::Place::element,
                                      .needs = {.mechanics = true},
                                      .worst = quantities::Extreme::greatest,
                                      .headline = "Von Mises at end",
                                      .compared = true,
                                      .pictured = true};

inline constexpr Quantity k_pressure{.name = "pressure",
                                     .unit = "Pa",
                                     .label = "Pressure",
                                     .doc = "Mean pressure, positive in compression",
                                     .group = quantities::Group::mechanics,
                                     .rank = quantities::Rank::scalar,
                                     .place = quantities::Place::element,
                                     .needs = {.mechanics = true},
                                     .colours = quantities::Colours::by_sign};

inline constexpr Quantity k_viscous_strain{.name = "viscous_strain",
                                           .unit = "1",
                                           .label = "Viscous strain",
                                           .doc = "Strain of the melt as a fluid",
                                           .group = quantities::Group::mechanics,
                                           .rank = quantities::Rank::tensor,
                                           .place = quantities::Place::element,
                                           .needs = {.mechanics = true}};

inline constexpr Quantity k_dissipation{.name = "dissipation",
                                        .unit = "W/m3",
                                        .label = "Mechanical dissipation",
                                        .doc = "Mechanical dissipation",
                                        .group = quantities::Group::mechanics,
                                        .rank = quantities::Rank::scalar,
                                        .place = quantities::Place::element,
                                        .needs = {.mechanics = true},
                                        .kept = quantities::Kept::last};

inline constexpr Quantity k_plastic_strain{.name = "plastic_strain",
                                           .unit = "1",
                                           .label = "Plastic strain tensor",
                                           .doc = "Plastic strain",
                                           .group = quantities::Group::mechanics,
                                           .rank = quantities::Rank::tensor,
                                           .place = quantities::Place::element,
                                           .needs = {.mechanics = true, .plasticity = true}};

inline constexpr Quantity k_equivalent_plastic_strain{.name = "equivalent_plastic_strain",
                                                      .unit = "1",
                                                      .label = "Plastic strain",
                                                      .doc = "Equivalent plastic strain, accumulated",
                                                      .group = quantities::Group::mechanics,
                                                      .rank = quantities::Rank::scalar,
                                                      .place = quantities::Place::element,
                                                      .needs = {.mechanics = true, .plasticity = true},
                                                      .worst = quantities::Extreme::greatest,
                                                      .headline = "Plastic strain",
                                                      .compared = true,
                                                      .shown_as = quantities::k_percent};

inline constexpr Quantity k_back_stress{.name = "back_stress",
                                        .unit = "Pa",
                                        .label = "Back stress",
                                        .doc = "Centre of the yield surface",
                                        .group = quantities::Group::mechanics,
                                        .rank = quantities::Rank::tensor,
                                        .place = quantities::Place::element,
                                        .needs = {.mechanics = true, .plasticity = true},
                                        .colours = quantities::Colours::by_sign};

inline constexpr Quantity k_flow_stress{.name = "flow_stress",
                                        .unit = "Pa",
                                        .label = "Flow stress",
                                        .doc = "Yield stress, hardening included, for slow plastic flow",
                                        .group = quantities::Group::mechanics,
                                        .rank = quantities::Rank::scalar,
                                        .place = quantities::Place::element,
                                        .needs = {.mechanics = true, .plasticity = true},
                                        .kept = quantities::Kept::last};

inline constexpr Quantity k_pore_fraction{.name = "pore_fraction",
                                          .unit = "1",
                                          .label = "Pores (share of the volume)",
                                          .doc = "Volume of the pores over that of the casting",
                                          .group = quantities::Group::criteria,
                                          .rank = quantities::Rank::scalar,
                                          .place = quantities::Place::element,
                                          .needs = {.mechanics = true, .melting = true},
                                          .worst = quantities::Extreme::greatest,
                                          .headline = "Pores, in all",
                                          .pictured = true,
                                          .shown_as = quantities::k_percent};

inline constexpr Quantity k_thermal_dissipation{.name = "thermal_dissipation",
                                                .unit = "W/m3",
                                                .label = "Thermal dissipation",
                                                .doc = "Dissipation by the change of inelastic entropy",
                                                .group = quantities::Group::mechanics,
                                                .rank = quantities::Rank::scalar,
                                                .place = quantities::Place::element,
                                                .needs = {.mechanics = true, .plasticity = true},
                                                .written = quantities::Written::on_request};

inline constexpr Quantity k_inelastic_entropy{.name = "inelastic_entropy",
                                              .unit = "J/m3/K",
                                              .label = "Inelastic entropy",
                                              .doc = "Inelastic entropy",
                                              .group = quantities::Group::mechanics,
                                              .rank = quantities::Rank::scalar,
                                              .place = quantities::Place::element,
                                              .needs = {.mechanics = true, .plasticity = true},
                                              .written = quantities::Written::on_request};

inline constexpr Quantity k_strain{.name = "strain",
                                   .unit = "1",
                                   .label = "Strain",
                                   .doc = "Strain",
                                   .group = quantities::Group::mechanics,
                                   .rank = quantities::Rank::tensor,
                                   .place = quantities::Place::element,
                                   .needs = {.mechanics = true},
                                   .written = quantities::Written::on_request};

inline constexpr Quantity k_intermediate_temperature{
    .name = "intermediate_temperature",
    .unit = "K",
    .label = "Intermediate temperature",
    .doc = "Temperature between the phases of the isentropic split",
    .group = quantities::Group::mechanics,
    .rank = quantities::Rank::scalar,
    .place = quantities::Place::element,
    .needs = {.mechanics = true, .isentropic = true},
    .written = quantities::Written::on_request,
    .colours = quantities::Colours::hot};

inline constexpr Quantity k_nodal_stress{.name = "nodal_stress",
                                         .unit = "Pa",
                                         .label = "Stress at nodes",
                                         .doc = "Stress at nodes, recovered from the elements around",
                                         .group = quantities::Group::mechanics,
                                         .rank = quantities::Rank::tensor,
                                         .place = quantities::Place::node,
                                         .needs = {.mechanics = true},
                                         .written = quantities::Written::on_request,
                                         .colours = quantities::Colours::by_sign};

inline constexpr Quantity k_nodal_von_mises{.name = "nodal_von_mises",
                                            .unit = "Pa",
                                            .label = "Von Mises stress at nodes",
                                            .doc = "Von Mises stress of the recovered stress",
                                            .group = quantities::Group::mechanics,
                                            .rank = quantities::Rank::scalar,
                                            .place = quantities::Place::node,
                                            .needs = {.mechanics = true},
                                            .written = quantities::Written::on_request};

inline constexpr Quantity k_principal_stress_1{.name = "principal_stress_1",
                                               .unit = "Pa",
                                               .label = "Largest principal stress at nodes",
                                               .doc = "Largest principal value of the recovered stress",
                                               .group = quantities::Group::mechanics,
                                               .rank = quantities::Rank::scalar,
                                               .place = quantities::Place::node,
                                               .needs = {.mechanics = true},
                                               .written = quantities::Written::on_request,
                                               .colours = quantities::Colours::by_sign};

inline constexpr Quantity k_principal_stress_2{.name = "principal_stress_2",
                                               .unit = "Pa",
                                               .label = "Middle principal stress at nodes",
                                               .doc = "Middle principal value of the recovered stress",
                                               .group = quantities::Group::mechanics,
                                               .rank = quantities::Rank::scalar,
                                               .place = quantities::Place::node,
                                               .needs = {.mechanics = true},
                                               .written = quantities::Written::on_request,
                                               .colours = quantities::Colours::by_sign};

inline constexpr Quantity k_principal_stress_3{.name = "principal_stress_3",
                                               .unit = "Pa",
                                               .label = "Least principal stress at nodes",
                                               .doc = "Least principal value of the recovered stress",
                                               .group = quantities::Group::mechanics,
                                               .rank = quantities::Rank::scalar,
                                               .place = quantities::Place::node,
                                               .needs = {.mechanics = true},
                                               .written = quantities::Written::on_request,
                                               .colours = quantities::Colours::by_sign};

/// Of the page for the browser, which makes it of the stress; no case can name it.
inline constexpr Quantity k_first_principal_stress{
    .name = "first_principal_stress",
    .unit = "Pa",
    .label = "Largest principal stress",
    .doc = "Largest principal value of the stress of the element",
    .group = quantities::Group::mechanics,
    .rank = quantities::Rank::scalar,
    .place = quantities::Place::element,
    .needs = {.mechanics = true},
    .colours = quantities::Colours::by_sign};

/// In the order of the reference page.
inline constexpr std::array k_all = {&k_displacement,
                                     &k_velocity,
                                     &k_acceleration,
                                     &k_stress,
                                     &k_von_mises,
                                     &k_pressure,
                                     &k_viscous_strain,
                                     &k_dissipation,
                                     &k_plastic_strain,
                                     &k_equivalent_plastic_strain,
                                     &k_back_stress,
                                     &k_flow_stress,
                                     &k_pore_fraction,
                                     &k_thermal_dissipation,
                                     &k_inelastic_entropy,
                                     &k_strain,
                                     &k_intermediate_temperature,
                                     &k_nodal_stress,
                                     &k_nodal_von_mises,
                                     &k_principal_stress_1,
                                     &k_principal_stress_2,
                                     &k_principal_stress_3};

}  // namespace solidus::mechanics::fields
