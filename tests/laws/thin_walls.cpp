// A finding that no file of src/, python/ and web/ names: walls that melt does not fill.
#include <fmt/format.h>

#include "check/finding_family.hpp"

namespace {

using namespace solidus;

/// Twice the volume over the skin of what melt fills in sand [m].
constexpr double k_thinnest = 2e-3;

void find(const cases::CaseSpec& spec, const setup::Assembly&, const check::CaseMeasures& m,
          check::Findings& findings) {
  for (const check::Pour& pour : m.pours) {
    const check::BodyMeasures& body = m.bodies[pour.body];
    const double thickness = 2 * body.volume / body.skin;
    if (thickness < k_thinnest)
      findings.push_back(
          {false, spec.bodies[pour.body].where,
           fmt::format("the walls of '{}' are {:.3g} mm thick in the mean: melt freezes on its way",
                       spec.bodies[pour.body].name, 1e3 * thickness),
           "3 mm and more in sand"});
  }
}

const check::AddFindings k_thin_walls{{.name = "thin walls",
                                       .place = 75,
                                       .find = &find,
                                       .rows = {{check::Topic::pour, "thin walls",
                                                 fmt::format("a body that is poured has 2 V/A below {} mm",
                                                             check::number(1e3 * k_thinnest))}}}};

}  // namespace
