/// The fields of the criteria that every program has, one row each (quantities/quantity.hpp).
#pragma once

#include <array>

#include "criteria/die_quantities.hpp"
#include "criteria/life_quantities.hpp"
#include "quantities/quantity.hpp"

namespace solidus::criteria::fields {

inline constexpr Quantity k_solidified_at{
    .name = "solidified_at",
    .unit = "s",
    .label = "Solid at (time)",
    .doc = "Time since the start of the run at which the metal became solid",
    .group = quantities::Group::criteria,
    .needs = {.heat = true, .melting = true},
    .no_value = -1,
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::greatest,
    .headline = "Freezes last",
    .compared = true,
    .pictured = true};

inline constexpr Quantity k_local_solidification_time{.name = "local_solidification_time",
                                                      .unit = "s",
                                                      .label = "Local solidification time",
                                                      .doc = "Time from liquidus to solidus",
                                                      .group = quantities::Group::criteria,
                                                      .needs = {.heat = true, .melting = true},
                                                      .no_value = 0,
                                                      .kept = quantities::Kept::last,
                                                      .worst = quantities::Extreme::greatest,
                                                      .headline = "Longest freezing",
                                                      .answer = "longest local solidification time"};

inline constexpr Quantity k_cooling_rate{.name = "cooling_rate",
                                         .unit = "K/s",
                                         .label = "Cooling rate",
                                         .doc = "Cooling rate near the end of freezing",
                                         .group = quantities::Group::criteria,
                                         .needs = {.heat = true, .melting = true},
                                         .no_value = 0,
                                         .kept = quantities::Kept::last,
                                         .worst = quantities::Extreme::least};

inline constexpr Quantity k_thermal_gradient{.name = "thermal_gradient",
                                             .unit = "K/m",
                                             .label = "Thermal gradient",
                                             .doc = "Gradient of temperature near the end of freezing",
                                             .group = quantities::Group::criteria,
                                             .needs = {.heat = true, .melting = true},
                                             .no_value = 0,
                                             .kept = quantities::Kept::last,
                                             .worst = quantities::Extreme::least};

inline constexpr Quantity k_front_speed{.name = "front_speed",
                                        .unit = "m/s",
                                        .label = "Speed of the front",
                                        .doc = "Speed of the front near the end of freezing",
                                        .group = quantities::Group::criteria,
                                        .needs = {.heat = true, .melting = true},
                                        .no_value = 0,
                                        .kept = quantities::Kept::last};

inline constexpr Quantity k_secondary_arm_spacing{.name = "secondary_arm_spacing",
                                                  .unit = "m",
                                                  .label = "Dendrite arm spacing",
                                                  .doc = "Spacing of secondary dendrite arms",
                                                  .group = quantities::Group::criteria,
                                                  .needs = {.heat = true, .melting = true},
                                                  .no_value = 0,
                                                  .kept = quantities::Kept::last,
                                                  .worst = quantities::Extreme::greatest,
                                                  .answer = "largest arm spacing",
                                                  .shown_as = {"um", "µm", 1e6}};

inline constexpr Quantity k_niyama{.name = "niyama",
                                   .unit = "1",
                                   .root_unit = "K^0.5 s^0.5/m",
                                   .label = "Niyama criterion",
                                   .doc =
                                       "Niyama criterion, temperature gradient over the square root of the "
                                       "cooling rate: where it is low, shrinkage porosity threatens",
                                   .group = quantities::Group::criteria,
                                   .needs = {.heat = true, .melting = true},
                                   .no_value = 0,
                                   .kept = quantities::Kept::last,
                                   .worst = quantities::Extreme::least,
                                   .headline = "Least Niyama",
                                   .answer = "least Niyama",
                                   .compared = true,
                                   .pictured = true,
                                   .shown_as = {"K0.5 s0.5/mm", "√(K s)/mm", 1e-3}};

inline constexpr Quantity k_dimensionless_niyama{.name = "dimensionless_niyama",
                                                 .unit = "1",
                                                 .label = "Dimensionless Niyama",
                                                 .doc = "Dimensionless Niyama criterion",
                                                 .group = quantities::Group::criteria,
                                                 .needs = {.heat = true, .melting = true},
                                                 .no_value = 0,
                                                 .kept = quantities::Kept::last,
                                                 .worst = quantities::Extreme::least,
                                                 .answer = "least dimensionless Niyama"};

inline constexpr Quantity k_shrinkage_porosity{
    .name = "shrinkage_porosity",
    .unit = "1",
    .label = "Shrinkage porosity (estimate)",
    .doc = "Estimate of shrinkage porosity by the dimensionless Niyama criterion",
    .group = quantities::Group::criteria,
    .needs = {.heat = true, .melting = true},
    .no_value = 0,
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::greatest,
    .headline = "Porosity (estimate)",
    .answer = "largest estimate of porosity",
    .pictured = true,
    .shown_as = quantities::k_percent};

inline constexpr Quantity k_critical_strain_rate{
    .name = "critical_strain_rate",
    .unit = "1/s",
    .label = "Critical strain rate",
    .doc = "Strain rate across the dendrites above which a hot tear may open, by Rappaz, Drezet and Gremaud",
    .group = quantities::Group::criteria,
    .needs = {.heat = true, .melting = true},
    .no_value = -1,
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::least,
    .compared = true,
    .pictured = true,
    .shown_as = {"1/s", "1/s"}};

inline constexpr Quantity k_tearing_tendency{
    .name = "tearing_tendency",
    .unit = "1",
    .label = "Tearing tendency (ends held)",
    .doc =
        "Pressure drop of the melt over the critical one, for a casting held at its ends that cools "
        "everywhere as at this place: above 1 a tear may open",
    .group = quantities::Group::criteria,
    .needs = {.heat = true, .melting = true},
    .no_value = -1,
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::greatest,
    .headline = "Tearing tendency",
    .answer = "tearing tendency, ends held",
    .threshold = 1,
    .compared = true,
    .pictured = true};

inline constexpr Quantity k_vulnerable_share{
    .name = "vulnerable_share",
    .unit = "1",
    .label = "Cracking susceptibility (Clyne, Davies)",
    .doc = "Time between solid fractions of 0.9 and 0.99 over that between 0.4 and 0.9, by Clyne and Davies",
    .group = quantities::Group::criteria,
    .needs = {.heat = true, .melting = true},
    .no_value = -1,
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::greatest,
    .answer = "Clyne and Davies' ratio"};

inline constexpr Quantity k_plate_thickness{
    .name = "plate_thickness",
    .unit = "m",
    .label = "Thickness by freezing time",
    .doc =
        "Thickness of the plate that would freeze in the same time in the same mould: twice the modulus "
        "(volume over cooling surface) of the place",
    .group = quantities::Group::criteria,
    .needs = {.heat = true, .melting = true},
    .no_value = 0,
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::greatest,
    .answer = "thickest place by its freezing time",
    .compared = true,
    .pictured = true,
    .shown_as = {"mm", "mm", 1e3}};

inline constexpr Quantity k_liquid_pool{.name = "liquid_pool",
                                        .unit = "1",
                                        .label = "Pool of melt",
                                        .doc = "Number of the pool of melt, 0: none",
                                        .group = quantities::Group::criteria,
                                        .needs = {.heat = true, .melting = true},
                                        .no_value = 0,
                                        .kept = quantities::Kept::every};

inline constexpr Quantity k_pool_volume{.name = "pool_volume",
                                        .unit = "m3",
                                        .label = "Volume of the pool",
                                        .doc = "Volume of the pool of melt",
                                        .group = quantities::Group::criteria,
                                        .needs = {.heat = true, .melting = true},
                                        .no_value = 0,
                                        .kept = quantities::Kept::none};

inline constexpr Quantity k_feeding_zone{
    .name = "feeding_zone",
    .unit = "1",
    .label = "Feeding zone",
    .doc =
        "Number of the pool of melt that the place belonged to last, before its solid fraction passed "
        "criteria.feeding_limit; 0: none",
    .group = quantities::Group::criteria,
    .needs = {.heat = true, .melting = true},
    .no_value = 0,
    .kept = quantities::Kept::last};

inline constexpr Quantity k_strain_in_liquid{.name = "strain_in_liquid",
                                             .unit = "1",
                                             .label = "Strain in the melt",
                                             .doc = "Equivalent strain accumulated below coherency",
                                             .group = quantities::Group::criteria,
                                             .place = quantities::Place::element,
                                             .needs = {.mechanics = true, .melting = true},
                                             .kept = quantities::Kept::last,
                                             .worst = quantities::Extreme::greatest,
                                             .shown_as = quantities::k_percent};

inline constexpr Quantity k_strain_since_coherency{.name = "strain_since_coherency",
                                                   .unit = "1",
                                                   .label = "Strain since coherency",
                                                   .doc = "Equivalent strain since the metal became coherent",
                                                   .group = quantities::Group::criteria,
                                                   .place = quantities::Place::element,
                                                   .needs = {.mechanics = true},
                                                   .kept = quantities::Kept::last,
                                                   .worst = quantities::Extreme::greatest,
                                                   .shown_as = quantities::k_percent};

inline constexpr Quantity k_brittle_strain{
    .name = "brittle_strain",
    .unit = "1",
    .label = "Strain in the brittle range",
    .doc = "Largest principal strain accumulated in the brittle range of solid fractions",
    .group = quantities::Group::criteria,
    .place = quantities::Place::element,
    .needs = {.mechanics = true, .melting = true},
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::greatest,
    .shown_as = quantities::k_percent};

inline constexpr Quantity k_distortion{
    .name = "distortion",
    .unit = "m",
    .label = "Distortion",
    .doc = "Displacement since coherency without the rigid motion of the body",
    .group = quantities::Group::criteria,
    .rank = quantities::Rank::vector,
    .needs = {.mechanics = true},
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::greatest,
    .headline = "Largest distortion",
    .compared = true,
    .pictured = true};

inline constexpr Quantity k_emptied{
    .name = "emptied",
    .unit = "1",
    .label = "Emptied (pipe, cavity)",
    .doc = "Empty fraction of the volume around a node, with heat alone: pipe, sink, cavity",
    .group = quantities::Group::criteria,
    .needs = {.heat = true, .melting = true},
    .kept = quantities::Kept::every,
    .worst = quantities::Extreme::greatest,
    .compared = true,
    .pictured = true,
    .shown_as = quantities::k_percent};

inline constexpr Quantity k_unfed_pores{.name = "unfed_pores",
                                        .unit = "1",
                                        .label = "Pores (feeding)",
                                        .doc =
                                            "Pores between dendrites that melt did not reach, as a fraction "
                                            "of the volume around a node, with heat alone",
                                        .group = quantities::Group::criteria,
                                        .needs = {.heat = true, .melting = true},
                                        .kept = quantities::Kept::every,
                                        .worst = quantities::Extreme::greatest,
                                        .headline = "Pores (feeding)",
                                        .compared = true,
                                        .pictured = true,
                                        .shown_as = quantities::k_percent};

inline constexpr Quantity k_gas_pores{.name = "gas_pores",
                                      .unit = "1",
                                      .label = "Gas pores",
                                      .doc =
                                          "Pores of gas that came out of solution as the metal froze, as a "
                                          "fraction of the volume around a node",
                                      .group = quantities::Group::criteria,
                                      .needs = {.heat = true, .melting = true},
                                      .kept = quantities::Kept::every,
                                      .worst = quantities::Extreme::greatest,
                                      .headline = "Gas pores",
                                      .compared = true,
                                      .pictured = true,
                                      .shown_as = quantities::k_percent};

inline constexpr Quantity k_kou_index{
    .name = "kou_index",
    .unit = "K",
    .label = "Kou's index",
    .doc =
        "Slope of the temperature over the square root of the solid fraction near the end of freezing, by "
        "Kou: the steeper, the longer grains stay apart while they contract",
    .group = quantities::Group::criteria,
    .needs = {.heat = true, .melting = true},
    .no_value = -1,
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::greatest,
    .answer = "Kou's index",
    .shown_as = {"K", "K"}};

inline constexpr Quantity k_strained_tendency{
    .name = "strained_tendency",
    .unit = "1",
    .label = "Tearing tendency (strain taken)",
    .doc =
        "Pressure drop of the melt at the computed strain rate of the mushy zone, over the critical one: "
        "above 1 a tear may open",
    .group = quantities::Group::criteria,
    .place = quantities::Place::element,
    .needs = {.heat = true, .mechanics = true, .melting = true},
    .no_value = -1,
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::greatest,
    .headline = "Tearing tendency (strain)",
    .answer = "tearing tendency, strain taken",
    .threshold = 1,
    .compared = true,
    .pictured = true};

inline constexpr Quantity k_cracking_index{
    .name = "cracking_index",
    .unit = "1",
    .label = "Cracking index (Won, Yeo)",
    .doc =
        "Strain accumulated in the brittle range of solid fractions over the critical one of Won, Yeo, Seol "
        "and Oh: above 1 an internal crack may form",
    .group = quantities::Group::criteria,
    .place = quantities::Place::element,
    .needs = {.heat = true, .mechanics = true, .melting = true},
    .no_value = -1,
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::greatest,
    .headline = "Cracking index",
    .answer = "cracking index, strain taken",
    .threshold = 1,
    .compared = true,
    .pictured = true};

inline constexpr Quantity k_tensile_strength{
    .name = "tensile_strength",
    .unit = "Pa",
    .label = "Tensile strength (by table)",
    .doc = "Tensile strength of a test bar cut from the place, by the tables [[local]] of the card",
    .group = quantities::Group::criteria,
    .needs = {.heat = true, .melting = true},
    .no_value = -1,
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::least,
    .compared = true,
    .pictured = true};

inline constexpr Quantity k_elongation{
    .name = "elongation",
    .unit = "1",
    .label = "Elongation (by table)",
    .doc = "Elongation at fracture of a test bar cut from the place, by the tables [[local]] of the card",
    .group = quantities::Group::criteria,
    .needs = {.heat = true, .melting = true},
    .no_value = -1,
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::least,
    .compared = true,
    .pictured = true,
    .shown_as = quantities::k_percent};

inline constexpr Quantity k_hardness{
    .name = "hardness",
    .unit = "1",
    .label = "Brinell hardness (by table)",
    .doc = "Brinell hardness of the place, by the tables [[local]] of the card",
    .group = quantities::Group::criteria,
    .needs = {.heat = true, .melting = true},
    .no_value = -1,
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::greatest,
    .compared = true,
    .pictured = true,
    .shown_as = {"1", "HB"}};

inline constexpr Quantity k_grain_size{.name = "grain_size",
                                       .unit = "m",
                                       .label = "Grain size (by table)",
                                       .doc = "Grain size, by the tables [[local]] of the card",
                                       .group = quantities::Group::criteria,
                                       .needs = {.heat = true, .melting = true},
                                       .no_value = -1,
                                       .kept = quantities::Kept::last,
                                       .worst = quantities::Extreme::greatest,
                                       .shown_as = {"um", "µm", 1e6}};

/// Fields of Freezing, in their order.
inline constexpr std::array k_of_freezing = {&k_solidified_at,
                                             &k_local_solidification_time,
                                             &k_cooling_rate,
                                             &k_thermal_gradient,
                                             &k_front_speed,
                                             &k_secondary_arm_spacing,
                                             &k_niyama,
                                             &k_dimensionless_niyama,
                                             &k_shrinkage_porosity,
                                             &k_critical_strain_rate,
                                             &k_tearing_tendency,
                                             &k_vulnerable_share,
                                             &k_kou_index,
                                             &k_plate_thickness};

/// Fields of Pools, in their order.
inline constexpr std::array k_of_pools = {&k_liquid_pool, &k_pool_volume, &k_feeding_zone};

/// Fields of Feeding, in their order.
inline constexpr std::array k_of_feeding = {&k_emptied, &k_unfed_pores};
/// Fields of GasPores, and further ones of Feeding where there is gas.
inline constexpr std::array k_of_gas = {&k_gas_pores};

/// Fields of StrainCriteria, in their order.
inline constexpr std::array k_of_strain = {&k_strain_in_liquid, &k_strain_since_coherency, &k_brittle_strain,
                                           &k_distortion};

/// Fields of MushStrain, in their order.
inline constexpr std::array k_of_mush_strain = {&k_strained_tendency, &k_cracking_index};

/// Fields of LocalProperties, in their order.
inline constexpr std::array k_of_local_properties = {&k_tensile_strength, &k_elongation, &k_hardness,
                                                     &k_grain_size};

}  // namespace solidus::criteria::fields
