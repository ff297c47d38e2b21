/// The fields of the life of dies (die_life.hpp), one row each.
#pragma once

#include <array>

#include "quantities/quantity.hpp"

namespace solidus::criteria::fields {

using quantities::Quantity;

inline constexpr Quantity k_shot_strain_range{
    .name = "shot_strain_range",
    .unit = "1",
    .label = "Range of strain in a shot",
    .doc = "Range of strain of a die in a shot; of one that only conducts heat an upper bound",
    .group = quantities::Group::criteria,
    .needs = {.heat = true},
    .no_value = -1,
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::greatest,
    .headline = "Largest range of strain",
    .answer = "largest range of strain in a shot",
    .compared = true,
    .shown_as = quantities::k_percent};

inline constexpr Quantity k_shots_until_crack{
    .name = "shots_until_crack",
    .unit = "1",
    .label = "Shots until a crack begins",
    .doc = "Shots until a crack begins by thermal fatigue, by the constants of [[die_life]]",
    .group = quantities::Group::criteria,
    .needs = {.heat = true},
    .no_value = -1,
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::least,
    .headline = "Shots until a crack",
    .answer = "fewest shots until a crack begins",
    .compared = true,
    .pictured = true};

/// Fields of DieLife, in their order.
inline constexpr std::array k_of_die_life = {&k_shot_strain_range, &k_shots_until_crack};

}  // namespace solidus::criteria::fields
