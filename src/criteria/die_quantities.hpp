/// The fields of wear and soldering of dies (die_wear.hpp, soldering.hpp), one row each.
#pragma once

#include <array>

#include "quantities/quantity.hpp"

namespace solidus::criteria::fields {

using quantities::Quantity;

inline constexpr Quantity k_shot_wear{
    .name = "shot_wear",
    .unit = "m",
    .label = "Wear in a shot",
    .doc = "Depth that a die loses to wear in a shot, by the law of its contact",
    .group = quantities::Group::criteria,
    .needs = {.heat = true, .mechanics = true},
    .no_value = -1,
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::greatest,
    .answer = "largest depth of wear in a shot",
    .compared = true,
    .shown_as = {"um", "µm", 1e6}};

inline constexpr Quantity k_shots_until_worn{
    .name = "shots_until_worn",
    .unit = "1",
    .label = "Shots until worn",
    .doc = "Shots until a die has lost the depth `worn_depth` of [[die_life]] to wear",
    .group = quantities::Group::criteria,
    .needs = {.heat = true, .mechanics = true},
    .no_value = -1,
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::least,
    .headline = "Shots until worn",
    .answer = "fewest shots until worn",
    .compared = true,
    .pictured = true};

inline constexpr Quantity k_soldering_time{
    .name = "soldering_time",
    .unit = "s",
    .label = "Time hot enough to solder",
    .doc = "Time in a shot for which a die is hotter than the `soldering_temperature` of [[die_life]]",
    .group = quantities::Group::criteria,
    .needs = {.heat = true},
    .no_value = -1,
    .kept = quantities::Kept::last,
    .worst = quantities::Extreme::greatest,
    .headline = "Longest soldering time",
    .answer = "longest time hot enough to solder in a shot",
    .compared = true,
    .pictured = true};

/// Fields of DieWear, in their order.
inline constexpr std::array k_of_die_wear = {&k_shot_wear, &k_shots_until_worn};

/// Fields of Soldering.
inline constexpr std::array k_of_soldering = {&k_soldering_time};

}  // namespace solidus::criteria::fields
