#include "check/findings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "system/alike_texts.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"

namespace solidus::model {

bool share_a_stage(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return a.empty() || b.empty() || std::ranges::any_of(a, [&](const std::string& stage) {
           return std::ranges::find(b, stage) != b.end();
         });
}

Findings findings(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m) {
  // Each room of findings adds to the list, in the order in which they are printed: from what the case says
  // to what follows from its mesh.
  Findings found;
  find_in_interfaces(spec, a, found);
  find_in_interface_laws(spec, a, m, found);
  find_in_materials(spec, a, found);
  find_in_alloys(spec, a, found);
  find_in_pour(spec, a, found);
  find_in_conditions(spec, a, m, found);
  find_in_geometry(spec, a, m, found);
  find_bare_skins(spec, a, m, found);
  find_in_freezing(spec, a, m, found);
  find_in_stages(spec, a, m, found);
  find_in_leaving(spec, a, m, found);
  find_in_stage_times(spec, a, m, found);
  find_in_free_skins(spec, a, m, found);
  find_in_elements(spec, a, found);
  find_in_bending(spec, a, m, found);
  find_in_mechanics(spec, a, m, found);
  find_on_surfaces(spec, a, m, found);
  find_partly_in_contact(spec, a, found);
  find_in_numerics(spec, a, m, found);
  find_in_roles(spec, a, m, found);
  find_in_moulds(spec, a, m, found);
  find_in_risers(spec, a, m, found);
  find_in_open_risers(spec, a, m, found);
  find_in_burning(spec, a, m, found);
  find_in_probes(spec, a, m, found);
  find_in_coupling(spec, a, m, found);
  find_in_steady(spec, m, found);
  find_in_effort(spec, m, found);
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

}  // namespace solidus::model
