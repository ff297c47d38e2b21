// A finding that no file of src/, python/ and web/ names: walls that melt does not fill.
#include <fmt/format.h>

#include "check/finding_family.hpp"

namespace solidus::check {
namespace {

/// Twice the volume over the skin of what melt fills in sand [m].
constexpr double k_thinnest = 2e-3;

void find(const cases::CaseSpec& spec, const setup::Assembly&, const CaseMeasures& m, Findings& findings) {
  for (const Pour& pour : m.pours) {
    const BodyMeasures& body = m.bodies[pour.body];
    const double thickness = 2 * body.volume / body.skin;
    if (thickness < k_thinnest)
      findings.push_back(
          {false, spec.bodies[pour.body].where,
           fmt::format("the walls of '{}' are {:.3g} mm thick in the mean: melt freezes on its way",
                       spec.bodies[pour.body].name, 1e3 * thickness),
           "3 mm and more in sand"});
  }
}

FindingFamily thin_walls() {
  return {.name = "thin walls",
          .place = 75,
          .find = &find,
          .rows = {{Topic::pour, "thin walls",
                    fmt::format("a body that is poured has 2 V/A below {} mm", number(1e3 * k_thinnest))}}};
}

const AddFindings k_thin_walls{thin_walls()};

}  // namespace
}  // namespace solidus::check
