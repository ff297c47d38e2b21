/// A law from outside is loaded only with the user's word, and must go with the scheme of the case.
#include "cases/external_laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupling/scheme_names.hpp"
#include "material/external_law.hpp"
#include "numbers/types.hpp"

namespace solidus::cases {

namespace {

/// The difference of moduli, relative, from which on the energies of the program are not those of the law.
constexpr double k_moduli = 0.01;

/// Advises on other schemes: those that hold the temperature by themselves, and those that can be told to.
std::string isothermal_schemes() {
  return "scheme = " + coupling::names_of_schemes([](const coupling::SchemeTraits& t) {
           return t.mapping == mechanics::Mapping::isothermal;
         }) +
         ", or another one whose mechanical phase is told to hold the temperature (solidus explain coupling)";
}

void check_scheme(const CaseSpec& spec, const material::Material& material) {
  const std::string of = name_of_law(material);
  // The isothermal split calls the law as it is: at a temperature, without derivatives by it. A law of the
  // program holds the temperature in the isentropic one too: what sand heats itself by is next to nothing.
  if (spec.coupled()) switch (spec.coupling.scheme->traits().mapping) {
      case mechanics::Mapping::isothermal:
        break;
      case mechanics::Mapping::isentropic:
        if (external_law(material)->built_in()) break;
        throw InputError(
            spec.coupling.where,
            fmt::format(
                "scheme = \"{}\" holds the entropy of every point, which {} does not tell as a function "
                "of temperature",
                spec.coupling.scheme->name(), of),
            isothermal_schemes());
      case mechanics::Mapping::simultaneous:
        throw InputError(
            spec.coupling.where,
            fmt::format("scheme = \"{}\" needs the change of stress with temperature, which {} does not give",
                        spec.coupling.scheme->name(), of),
            isothermal_schemes());
    }
  if (spec.mechanics.integration != mechanics::TimeIntegration::backward_euler)
    throw InputError(spec.coupling.where,
                     "the two-step method extrapolates state, which " + of + " does not allow",
                     "integration = \"backward_euler\"");
}

/// Stiffness of the undeformed solid; on engineering shears [Pa].
Sym4<double> stiffness(const material::ExternalLaw& law, const material::PointProperties<double>& elastic,
                       double temperature) {
  const std::vector<double> old(law.size(), 0.0);
  std::vector<double> now(law.size());
  constexpr double step = 1;  // [s]
  return law
      .update(material::ExternalLaw::Properties<double>{elastic, temperature, temperature}, old.data(),
              now.data(), Sym<double>{}, step)
      .tangent;
}

void check_moduli(const material::Material& material, const material::ExternalLaw& law) {
  // Both stiffnesses of the undeformed solid are compared over the range of temperatures; the heat of
  // deformation is computed with the moduli of the material.
  for (const double temperature : temperatures_of_law(material)) {
    const auto elastic =
        material::properties_at(material, temperature, temperature, material::PhaseState<double>{1.0, 0.0});
    const Sym4<double> expected = Sym4<double>::isotropic(elastic.bulk, 2 * elastic.shear);
    const Sym4<double> found = stiffness(law, elastic, temperature);
    double difference = 0;
    for (int i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j)
        difference = std::max(difference, std::abs(found[i][j] - expected[i][j]));
    if (difference <= k_moduli * expected[0][0]) continue;
    throw InputError(
        law.data().where,
        fmt::format(
            "at {:.5g} degC the undeformed solid of '{}' has C_1111 = {:.5g} GPa and C_1212 = {:.5g} GPa, "
            "by young_modulus and poisson_ratio of '{}' {:.5g} and {:.5g} GPa: heat of deformation would "
            "be that of another material",
            temperature - k_zero_celsius, law.data().behaviour, 1e-9 * found[0][0], 1e-9 * found[3][3],
            material.name, 1e-9 * expected[0][0], 1e-9 * expected[3][3]),
        "the moduli of the law in the material file, within 1 %, or structural_heating = \"none\"");
  }
}

}  // namespace

void load_external_law(const CaseSpec& spec, material::Material& material) {
  const material::ExternalLaw* const law = external_law(material);
  if (law == nullptr) return;
  check_scheme(spec, material);
  std::shared_ptr<const material::ExternalLaw> loaded = material::load_external_law(material, *law);
  // A law of the program takes the moduli of the material file.
  if (!loaded->built_in() && spec.coupled() &&
      spec.coupling.structural_heating != CouplingSpec::StructuralHeatForm::none)
    check_moduli(material, *loaded);
  set_external_law(material, std::move(loaded));
}

}  // namespace solidus::cases
