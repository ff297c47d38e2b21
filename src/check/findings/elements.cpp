/// Elements of the mesh that cannot do what a casting needs.
#include <fmt/format.h>

#include <algorithm>

#include "cases/roles.hpp"
#include "check/finding_family.hpp"
#include "mechanics/elements/simplices.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/cast_bodies.hpp"

namespace solidus::check {

namespace {

/// The shrinkage of a metal on freezing, of its volume, where pores could take it up: those of a card that
/// gives the viscosity of its melt never do.
double shrinkage(const material::Material& metal) {
  const material::PhaseChange* freezing = metal.solidification();
  if (freezing == nullptr || !metal.chooses_viscosity()) return 0;
  return std::max(0.0, -freezing->volume_change);
}

/// Metal that shrinks without pores and without flow through its mush draws in its walls instead, and
/// elements with one pressure each do not hold a melt at rest on a mesh that is not regular.
void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures&, Findings& findings) {
  if (!a.mechanics) return;
  for (const results::CastBody& cast : setup::cast_bodies(spec, a.materials, a.start)) {
    const auto body = as_size(cast.body);
    const double shrinks = shrinkage(a.materials[body]);
    if (shrinks == 0 || cases::only_conducts(spec.bodies[body])) continue;
    const bool others = std::ranges::any_of(a.mesh.blocks, [&](const mesh::ElementBlock& block) {
      return block.body == cast.body && block.size() > 0 &&
             !mechanics::is_mixed(block, a.materials[body], spec.mechanics.simplices);
    });
    if (!parallel::any_process(others)) continue;
    findings.push_back(
        {false, spec.mesh.where,
         fmt::format(
             "'{}' shrinks by {:.3g} % as it freezes, and its elements neither open pores nor feed: its "
             "walls draw in where nothing feeds it{}",
             cast.name, 100 * shrinks, spec.analysis.gravity > 0 ? ", and its melt does not rest" : ""),
         "mixed triangles or tetrahedra (element tri3 or tet4) do all of it"});
  }
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_elements() {
  return {
      .name = "elements",
      .place = 140,
      .find = &find,
      .rows = {{Topic::mesh, "elements that cannot form pores",
                "a casting that deforms and shrinks as it freezes has elements in which neither pores nor "
                "feeding are modelled; not reported where its material gives the viscosity of the melt"}}};
}

}  // namespace solidus::check
