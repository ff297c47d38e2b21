/// The keys of [external] in a material file, and what they must be together.
#include "material/cards/external_keys.hpp"

#include <fmt/format.h>

#include "material/material.hpp"

namespace solidus::material {

namespace {

Section<ExternalData> external_keys() {
  // The keys of [external]: what is called and how, its constants, and how the heat that it makes is known.
  using E = ExternalData;
  Section<E> s(
      "external",
      "The law of the solid from a shared object, instead of [plasticity] "
      "(docs/guide/external_laws.md). It is loaded only with --trust-laws. It holds above the "
      "coherency_fraction of [casting]; metal with a lower solid fraction follows the Maxwell model.");
  s.key("library", &E::library).doc("The shared object, relative to this file.");
  s.choice("interface", &E::interface,
           {{"mfront", ExternalInterface::mfront, "the generic interface of MFront, version 1"},
            {"umat", ExternalInterface::umat, "a UMAT of Abaqus, as Fortran compilers make it"}})
      .doc("How the library is called.");
  s.key("behaviour", &E::behaviour)
      .initially("")
      .doc("Name of the behaviour; of a UMAT the symbol, by default umat_.");
  s.key("properties", &E::properties)
      .initially(Value::list({}))
      .doc("Its properties (PROPS), in the order and units of the law: strains without unit, stress in Pa.");
  s.key("state_variables", &E::state_variables)
      .range(0, 100000)
      .when("interface", {"umat"})
      .doc("How many state variables a UMAT has (NSTATV).");
  s.key("external_state_variables", &E::external_state_variables)
      .initially(Value::list({}))
      .when("interface", {"mfront"})
      .doc("Values of its external state variables besides the temperature, which do not change.");
  s.key("initial_state", &E::initial_state)
      .initially(Value::list({}))
      .doc("Its state variables at the start; empty: all zero.");
  s.key("unsymmetric", &E::unsymmetric)
      .initially(false)
      .doc("True: the tangent is not symmetric, as with non-associated flow.");
  s.choice(
       "dissipation", &E::dissipation,
       {{"automatic", ExternalDissipation::automatic,
         "the dissipated energy of MFront where the law computes it, else taylor_quinney"},
        {"share", ExternalDissipation::share, "taylor_quinney times the inelastic work"},
        {"law", ExternalDissipation::law, "MFront: the dissipated energy; UMAT: SPD + SCD"},
        {"rpl", ExternalDissipation::rpl, "UMAT: RPL, without heat of elastic strain, which Solidus adds"}})
      .initially("automatic")
      .doc("The part of the inelastic work that becomes heat; the rest is stored.");
  s.key("taylor_quinney", &E::heat_share)
      .initially(0.9)
      .range(0, 1)
      .doc(
          "Fraction of the inelastic work that becomes heat, where the law does not compute it (Taylor and "
          "Quinney).");
  s.place(&E::where);
  return s;
}

}  // namespace

const Section<ExternalData>& external_section() {
  static const Section<ExternalData> section = external_keys();
  return section;
}

void add_external(Material& material, ExternalData data) {
  // The law needs the elastic data of the card: thermal strain, the heat of deformation and the
  // solvers use them.
  const std::string of = " of '" + material.name + "'";
  if (!material.mechanical())
    throw InputError(
        data.where, "the law from outside" + of + " has no elastic properties in addition",
        "young_modulus, poisson_ratio and expansion: those of the law, for thermal strain, heat of "
        "deformation and solvers");
  if (material.flow)
    throw InputError(data.where, "[plasticity] and [external]" + of + " are both the law of the solid",
                     "one of them");
  if (material.liquid_model != LiquidModel::maxwell)
    throw InputError(data.where, "a law from outside" + of + " goes with one model of the melt",
                     "liquid_model = \"maxwell\"");
  if (data.library.empty()) throw InputError(data.where, "the library" + of + " has no name");
  // The two interfaces differ in what must be said: an MFront library may hold several behaviours,
  // a UMAT does not tell how many state variables it has.
  const bool umat = data.interface == ExternalInterface::umat;
  if (data.behaviour.empty() && !umat)
    throw InputError(data.where, "the library of [external] may hold several behaviours",
                     "behaviour = \"its name\"");
  data.coherency_fraction = material.casting.coherency_fraction;
  if (data.behaviour.empty()) data.behaviour = "umat_";
  if (umat && !data.state_variables)
    throw InputError(data.where, "only its author knows how many state variables a UMAT has",
                     "state_variables, NSTATV; perhaps 0");
  if (!umat && data.dissipation == ExternalDissipation::rpl)
    throw InputError(data.where, "dissipation = \"rpl\" is for UMATs", "\"automatic\", \"share\" or \"law\"");
  material.notes.push_back({"external", fmt::format("{} of {}", data.behaviour, data.library), 0, 0});
  set_external_law(material, std::make_shared<ExternalLaw>(std::move(data)));
}

}  // namespace solidus::material
