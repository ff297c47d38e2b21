/// The answers of a run as rows: their members of "answers" in summary.json with their units, and how tables
/// of several runs (`compare`, `study`, `uncertain`) call and show them. Python reads the rows from `solidus
/// explain --tables --json`.
#pragma once

#include <array>

#include "quantities/column.hpp"
#include "quantities/quantity.hpp"

namespace solidus::results {

/// The object whose member an answer is: "answers" itself, each of its castings, or each of its contacts.
/// `criteria`: in this place come the worst values of the fields that have an answer.
enum class AnswerOf { run, casting, contact, criteria };

struct AnswerRow {
  /// `name` is the member, `label` what tables call it, in which {} stands for the casting or contact, `unit`
  /// that of the number in the file.
  quantities::Column column;
  AnswerOf of = AnswerOf::run;
  /// Where the number stands in the member: "value" with its unit; empty: the member is the number.
  std::string_view number = {};
  quantities::ShownUnit shown = {};  ///< empty: that of the unit
  quantities::ShownUnit unit_shown() const {
    return shown.unit.empty() ? quantities::shown_unit(column.unit) : shown;
  }
};

namespace answer {

inline constexpr AnswerRow k_solid_fraction{
    .column = {.name = "solid_fraction", .unit = "1", .label = "{}: solid fraction", .doc = "By volume"},
    .of = AnswerOf::casting};
inline constexpr AnswerRow k_last_melt_froze{
    .column = {.name = "last_melt_froze",
               .unit = "s",
               .label = "{}: last melt froze",
               .doc = "When and where its last melt froze, since pouring"},
    .of = AnswerOf::casting,
    .number = "value"};
inline constexpr AnswerRow k_hottest_melt{
    .column = {.name = "hottest_melt",
               .unit = "K",
               .label = "{}: hottest melt",
               .doc = "Temperature and place of the node that is least solid, where it is not solid"},
    .of = AnswerOf::casting,
    .number = "value"};
inline constexpr AnswerRow k_yield{
    .column = {.name = "yield",
               .unit = "1",
               .label = "yield",
               .doc = "Mass of the parts over that of all that is poured, where there are risers or gating"},
    .shown = quantities::k_percent};
inline constexpr AnswerRow k_pools_cut_off{
    .column = {.name = "pools_cut_off",
               .unit = "1",
               .label = "pools cut off",
               .doc = "Number of pools that were closed off from what feeds them, with the largest"},
    .number = "number"};
inline constexpr AnswerRow k_criteria{
    .column = {.name = "criteria",
               .unit = "",
               .label = "",
               .doc = "The worst value of each field that has an answer, from `criteria` of the summary"},
    .of = AnswerOf::criteria};
inline constexpr AnswerRow k_largest_gap{.column = {.name = "largest_gaps",
                                                    .unit = "m",
                                                    .label = "largest gap of {}",
                                                    .doc = "The widest place of each contact that is open"},
                                         .of = AnswerOf::contact,
                                         .number = "value"};
inline constexpr AnswerRow k_largest_distortion{.column = {.name = "largest_distortion",
                                                           .unit = "m",
                                                           .label = "largest distortion",
                                                           .doc = "Of what was cast, with its place"},
                                                .number = "value"};
inline constexpr AnswerRow k_pores{
    .column = {.name = "pores",
               .unit = "1",
               .label = "pores, share of the casting",
               .doc = "Pores of mixed elements: their share of the casting, volume and densest place"},
    .number = "share_of_casting",
    .shown = quantities::k_percent};
inline constexpr AnswerRow k_largest_von_mises{.column = {.name = "largest_von_mises",
                                                          .unit = "Pa",
                                                          .label = "largest von Mises stress",
                                                          .doc = "Of what was cast, else of all bodies"},
                                               .number = "value"};

/// In the order of tables of several runs.
inline constexpr std::array k_all = {
    &k_solid_fraction, &k_last_melt_froze, &k_hottest_melt,       &k_yield, &k_pools_cut_off,
    &k_criteria,       &k_largest_gap,     &k_largest_distortion, &k_pores, &k_largest_von_mises};

}  // namespace answer

}  // namespace solidus::results
