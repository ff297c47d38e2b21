/// A family of findings: what it looks for, the rows of the reference page that say so, and its place in the
/// order. A family describes itself in its own file:
///
///   void find(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m, Findings& findings);
///
///   const AddFindings k_cold_rooms{{  // at namespace scope: `check`, runs and the reference page have it
///       .name = "cold rooms",
///       .place = 65,
///       .find = &find,
///       .rows = {{Topic::conditions, "a cold room", fmt::format("below {:g} K", k_coldest)}}}};
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "check/findings.hpp"

namespace solidus::check {

/// The subjects of findings, which are the sections of the reference page in their order.
enum class Topic { contacts, materials, pour, mesh, conditions, mechanics, probes, effort };

constexpr std::string_view name(Topic topic) {
  constexpr std::string_view k_names[] = {"contacts",   "materials", "what is poured", "mesh",
                                          "conditions", "mechanics", "probes",         "effort"};
  return k_names[static_cast<std::size_t>(topic)];
}

/// One line of the reference page. Its numbers are made of the constants that the search compares with.
struct FindingRow {
  Topic topic;
  std::string finding;         ///< what is found: "a chill that takes up no heat"
  std::string when = {};       ///< empty: the finding says it
  std::string as = "warning";  ///< "error" where no sensible case looks so, or both with their conditions
};

/// Looks for the findings of a family and appends them. Collective: all processes find the same.
using FindFindings = void (*)(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                              Findings& findings);

struct FindingFamily {
  std::string_view name;         ///< for messages and tests; no two families share it
  int place = 0;                 ///< findings come in the order of these numbers, which differ
  FindFindings find = nullptr;   ///< null: other rooms give the warnings of its rows, which say when
  std::vector<FindingRow> rows;  ///< at least one for whatever it finds
};

/// All families, built in and added, in the order of their places.
const std::vector<FindingFamily>& finding_families();

/// Throws std::logic_error where another family has the name or the place.
void add_findings(FindingFamily family);

/// Adds a family while the program starts, as an object at namespace scope.
struct AddFindings {
  explicit AddFindings(FindingFamily family) { add_findings(std::move(family)); }
};

/// A number as the reference page writes it: 0.05, 25 000, 1e6.
std::string number(double value);
/// A share as the reference page writes it: "5 %".
std::string percent(double share);

}  // namespace solidus::check
