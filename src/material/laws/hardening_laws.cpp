/// The list of isotropic hardening laws, and what more than one of them needs.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "input/units.hpp"
#include "material/laws/linear.hpp"
#include "material/laws/measured_hardening.hpp"
#include "material/laws/swift.hpp"
#include "material/laws/voce.hpp"

namespace solidus::material {
namespace {

const HardeningLawOf<NoHardening> k_none;
const HardeningLawOf<LinearHardening> k_linear;
const HardeningLawOf<Voce> k_voce;
const HardeningLawOf<Swift> k_swift;
const HardeningLawOf<MeasuredHardening> k_measured;

}  // namespace

// The order of IsotropicHardening.
constinit LawList<HardeningLaw> detail::hardening_list{"law of isotropic hardening",
                                                       k_hardening_parameters,
                                                       {&k_none, &k_linear, &k_voce, &k_swift, &k_measured},
                                                       5};

bool detail::hardening_kinks[LawList<HardeningLaw>::k_most] = {false, false, false, false, true};

std::span<const HardeningLaw* const> hardening_laws() {
  return detail::hardening_list.all();
}

IsotropicHardening add_hardening_law(const HardeningLaw& law) {
  const std::size_t place = detail::hardening_list.add(law);
  detail::hardening_kinks[place] = law.kinks();
  return static_cast<IsotropicHardening>(place);
}

void set_hardening(Flow& flow, const std::map<std::string_view, Table>& numbers) {
  flow.hardening = {};
  const auto parameters = hardening_law(flow.isotropic).parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto number = numbers.find(parameters[i].key);
    if (number != numbers.end())
      flow.hardening[i] = number->second;
    else if (!parameters[i].optional)
      throw std::invalid_argument(fmt::format("the hardening parameter {} is missing", parameters[i].key));
  }
}

std::optional<LawObjection> Voce::objection(const Table& flow_stress, const HardeningTables& tables) {
  // The saturation stress must not lie below the flow stress at any temperature: the law would
  // soften.
  const Table& saturated = tables[saturation_stress];
  std::vector<double> joint(flow_stress.x().begin(), flow_stress.x().end());  // between them both are lines
  joint.insert(joint.end(), saturated.x().begin(), saturated.x().end());
  std::sort(joint.begin(), joint.end());
  // Both are linear between these temperatures, so that comparing there is enough.
  for (const double theta : joint)
    if (saturated.value(theta) < flow_stress.value(theta))
      return LawObjection{
          saturation_stress,
          fmt::format("the saturation stress at {:.6g} degC is {:.6g} MPa, below the flow stress {:.6g} MPa",
                      units::to_display(theta, "K", "degC"), 1e-6 * saturated.value(theta),
                      1e-6 * flow_stress.value(theta)),
          "at least the flow stress at every temperature: softening is not supported"};
  return std::nullopt;
}

}  // namespace solidus::material
