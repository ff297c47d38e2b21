#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "input/units.hpp"
#include "material/hardening.hpp"

namespace solidus::material {
namespace {

const HardeningLawOf<NoHardening> k_none;
const HardeningLawOf<LinearHardening> k_linear;
const HardeningLawOf<Voce> k_voce;
const HardeningLawOf<Swift> k_swift;
const HardeningLawOf<MeasuredHardening> k_measured;

std::size_t law_count = 5;
bool asked = false;  ///< hardening_laws() has been called

bool same(const LawParameter& a, const LawParameter& b) {
  return std::string_view(a.unit) == b.unit && std::string_view(a.doc) == b.doc && a.least == b.least &&
         a.greatest == b.greatest && a.above_least == b.above_least;
}

}  // namespace

// The order of IsotropicHardening.
const HardeningLaw* detail::hardening_table[k_most_hardening_laws] = {&k_none, &k_linear, &k_voce, &k_swift,
                                                                      &k_measured};
bool detail::hardening_kinks[k_most_hardening_laws] = {false, false, false, false, true};

std::span<const HardeningLaw* const> hardening_laws() {
  asked = true;
  return {detail::hardening_table, law_count};
}

IsotropicHardening add_hardening_law(const HardeningLaw& law) {
  const auto refuse = [&](const std::string& why) {
    throw std::logic_error(fmt::format("the law of isotropic hardening '{}': {}", law.name(), why));
  };
  if (asked) refuse("added after the keys of the material file were made");
  if (law_count == detail::k_most_hardening_laws) refuse("there are too many laws");
  if (law.parameters().size() > k_hardening_parameters)
    refuse(fmt::format("{} parameters, at most {}", law.parameters().size(), k_hardening_parameters));
  for (std::size_t i = 0; i < law_count; ++i) {
    const HardeningLaw& other = *detail::hardening_table[i];
    if (other.name() == law.name()) refuse("the name is taken");
    for (const LawParameter& mine : law.parameters())
      for (const LawParameter& theirs : other.parameters())
        if (std::string_view(mine.key) == theirs.key && !same(mine, theirs))
          refuse(fmt::format("'{}' declares the key '{}' otherwise", other.name(), mine.key));
  }
  detail::hardening_table[law_count] = &law;
  detail::hardening_kinks[law_count] = law.kinks();
  return static_cast<IsotropicHardening>(law_count++);
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
  const Table& saturated = tables[saturation_stress];
  std::vector<double> joint(flow_stress.x().begin(), flow_stress.x().end());  // between them both are lines
  joint.insert(joint.end(), saturated.x().begin(), saturated.x().end());
  std::sort(joint.begin(), joint.end());
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
