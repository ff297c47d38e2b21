// Findings on radiation of surfaces that see each other.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "check/finding_family.hpp"
#include "heat/radiation/view_factors.hpp"
#include "parallel/parallel.hpp"

namespace solidus::check {

namespace {

constexpr double k_own_view = 0.1;  // of all that a skin sees: by so much less does it radiate
constexpr Index k_most_faces = 300000;

/// A skin that radiates to surroundings of one temperature and sees itself in their place: it gets back what
/// it loses.
void skins_that_see_themselves(const cases::CaseSpec& spec, const setup::Assembly& a, Findings& findings) {
  using C = cases::ThermalConditionSpec;
  // All surfaces that radiate to surroundings at the start, since they see each other too.
  const C* first = nullptr;
  std::vector<std::string> names;
  std::vector<mesh::Surface> surfaces;
  Index faces = 0;
  for (const C& c : spec.thermal_conditions) {
    if (c.kind != C::Kind::radiation || c.sees != C::Sees::ambient ||
        !cases::holds(c.stages, a.first_stage()))
      continue;
    const auto found = a.mesh.surfaces.find(c.group);
    if (found == a.mesh.surfaces.end()) continue;
    if (first == nullptr) first = &c;
    names.push_back("'" + c.name + "'");
    surfaces.push_back(found->second);
    for (const mesh::ElementBlock& block : found->second.faces) faces += block.n_counted;
  }
  if (first == nullptr || parallel::global_sum(static_cast<double>(faces)) > k_most_faces) return;
  // A few rays of a few parts of the skin tell the share to one in a hundred.
  constexpr std::size_t k_parts = 200, k_rays = 64;
  const heat::RadiatingFaces seen = heat::radiating_faces(a.mesh, spec.analysis.kind, surfaces, k_parts);
  const double own = heat::share_of_own_view(seen, spec.analysis.kind, k_rays);
  if (own < k_own_view) return;
  findings.push_back(
      {false, first->where,
       fmt::format("{:.0f} % of what the surfaces of {} see is these surfaces themselves, but they radiate "
                   "to surroundings of one temperature: they lose too much heat",
                   100 * own, fmt::join(names, ", ")),
       "radiation = \"enclosure\" in these conditions"});
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures&, Findings& findings) {
  if (spec.has_heat()) skins_that_see_themselves(spec, a, findings);
}

}  // namespace

// The place of the family among the others, its search, and the row of the reference page.
FindingFamily findings_enclosures() {
  return {.name = "enclosures",
          .place = 115,
          .find = &find,
          .rows = {{Topic::conditions, "radiation to one ambient temperature from a surface that sees itself",
                    fmt::format("{} or more of its view factors are to itself; computed up to {} faces",
                                percent(k_own_view), number(k_most_faces))}}};
}

}  // namespace solidus::check
