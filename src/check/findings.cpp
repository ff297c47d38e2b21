/// All families are asked one after the other; what they find is reported together.
#include "check/findings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "check/finding_family.hpp"
#include "system/alike_texts.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"

namespace solidus::check {

bool share_a_stage(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return a.empty() || b.empty() || std::ranges::any_of(a, [&](const std::string& stage) {
           return std::ranges::find(b, stage) != b.end();
         });
}

Findings findings(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m) {
  // Families come in the order of their places, in which findings are printed: from what the case says to
  // what follows from its mesh.
  Findings found;
  for (const FindingFamily& family : finding_families())
    if (family.find != nullptr) family.find(spec, a, m, found);
  return found;
}

void report(const Findings& findings) {
  for (const Finding& finding : findings)
    if (finding.is_error) throw InputError(finding.where, finding.what, finding.usual);
  std::vector<std::string> texts;
  for (const Finding& finding : findings) {
    const std::string place = finding.where.text();
    texts.push_back(fmt::format("{}{}{}; {}", place, place.empty() ? "" : ": ", finding.what, finding.usual));
  }
  for (const std::string& text : logging::told_once(texts)) logging::warn("{}", text);
}

}  // namespace solidus::check
