/// Findings: values of a case that are possible but not sensible, and that no check of a single key detects.
/// One file per family (finding_family.hpp).
#pragma once

#include <string>
#include <vector>

#include "cases/case_spec.hpp"
#include "check/case_measures.hpp"
#include "setup/assembly.hpp"

namespace solidus::check {

struct Finding {
  bool is_error = false;  ///< no sensible case looks so; else a warning
  SourceLocation where;
  std::string what;   ///< the finding, with its number
  std::string usual;  ///< the usual range, or the value that was perhaps meant
};
using Findings = std::vector<Finding>;

/// Whether a quantity is one number, everywhere and always.
inline bool is_number(const Function& f) {
  return f.place == nullptr && f.of == Argument::constant;
}

/// Whether two lists of stages have one in common; an empty list means all stages.
bool share_a_stage(const std::vector<std::string>& a, const std::vector<std::string>& b);

/// The findings of all families (finding_family.hpp) in a case that is built, in the order of their places.
/// Collective.
Findings findings(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m);

/// Warns of the findings, once of those that several bodies or contacts share (system/alike_texts.hpp);
/// throws InputError for the first error.
void report(const Findings& findings);

}  // namespace solidus::check
