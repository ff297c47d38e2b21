/// The keys of [granular] in a material file, and what they must be together.
#include "material/cards/granular_keys.hpp"

#include "material/cards/library.hpp"
#include "material/granular.hpp"
#include "material/material.hpp"

namespace solidus::material {

namespace {

/// Declares cone and cut-offs.
void strength_keys(Section<GranularData>& s) {
  using G = GranularData;
  const std::vector<Argument> temperature{Argument::temperature};
  s.function("cohesion", &G::cohesion, "Pa")
      .positive()
      .of(temperature)
      .doc(
          "Mohr-Coulomb cohesion c with all of the binder: the strength in uniaxial compression is "
          "2 c cos(friction_angle)/(1 - sin(friction_angle)).");
  s.quantity("friction_angle", &G::friction_angle, "rad")
      .range(0.01, 1.2)
      .doc(
          "Mohr-Coulomb friction angle of the cone, which touches the compressive corners of the "
          "Mohr-Coulomb pyramid.");
  s.quantity("dilatancy_angle", &G::dilatancy_angle, "rad")
      .initially("0 degree")
      .range(0, 1.2)
      .doc(
          "Angle by which sliding grains move apart; at most friction_angle. Where it is less the tangent is "
          "not symmetric.");
  s.function("tension_cutoff", &G::tension_cutoff, "Pa")
      .at_least(0)
      .of(temperature)
      .doc(
          "The tensile mean stress at which the material opens, with all of the binder; at most cohesion "
          "cot(friction_angle), the apex of the cone.");
  s.function("crushing_pressure", &G::crushing_pressure, "Pa")
      .positive()
      .of(temperature)
      .doc("The pressure at which grains are pushed into the pores between them; without it, none.");
}

/// Declares what becomes of the bonds and how the law is regularised.
void bond_keys(Section<GranularData>& s) {
  using G = GranularData;
  s.quantity("residual_cohesion", &G::residual_cohesion, "Pa")
      .initially("0 Pa")
      .at_least(0)
      .doc("Cohesion without binder or with all bonds broken.");
  s.key("softening_strain", &G::softening_strain)
      .range(1e-6, 10)
      .doc(
          "Plastic strain, slip and opening, at which no bond is left: cohesion and tension_cutoff fall in "
          "proportion to it. Without it bonds do not break.");
  s.function("burnout_rate", &G::burnout_rate, "1/s")
      .at_least(0)
      .of({Argument::temperature})
      .doc("Fraction of the remaining binder that burns per second. Without it no binder burns.");
  s.key("burnt_stiffness", &G::burnt_stiffness)
      .initially(1.0)
      .range(1e-4, 1)
      .doc("Fraction of young_modulus that remains without binder.");
  s.key("residual_stiffness", &G::residual_stiffness)
      .initially(1e-3)
      .range(0, 0.1)
      .doc(
          "Fraction of the stiffness that remains when the material yields (grains still touch). It keeps "
          "the equations of loose sand solvable.");
  s.quantity("relaxation_time", &G::relaxation_time, "s")
      .initially("0 s")
      .at_least(0)
      .doc(
          "Time constant with which stress above the strength decays (Duvaut and Lions), so that "
          "localisation bands of a softening solid do not shrink to one element.");
}

Section<GranularData> granular_keys() {
  Section<GranularData> s(
      "granular",
      "The law of a mould, core or shell of grains and a binder, instead of [plasticity]: "
      "a Drucker-Prager cone with limits in tension and compression, and a binder that burns out "
      "(docs/guide/sand.md).");
  strength_keys(s);
  bond_keys(s);
  s.key("source", &GranularData::source).initially("").doc("Source of the angles and fractions.");
  s.place(&GranularData::where);
  return s;
}

}  // namespace

const Section<GranularData>& granular_section() {
  static const Section<GranularData> section = granular_keys();
  return section;
}

void add_granular(Material& material, const GranularData& data) {
  const std::string of = " of '" + material.name + "'";
  if (!material.mechanical())
    throw InputError(data.where, "[granular]" + of + " has no elastic properties in addition",
                     "young_modulus, poisson_ratio and expansion");
  if (material.solidification() != nullptr)
    throw InputError(data.where, "[granular] is no law of a metal that melts, as" + of + " does",
                     "[plasticity], or a material without solidification");
  if (material.flow || external_law(material) != nullptr)
    throw InputError(data.where, "[granular]" + of + " is not its only law of the solid",
                     "[plasticity], [external] or [granular]");
  // Notes say where the tables come from and where they hold.
  const auto note = [&material](const char* property, const Function& f) {
    material.notes.push_back(note_of(property, f));
  };
  note("granular.cohesion", data.cohesion);
  note("granular.tension_cutoff", data.tension_cutoff);
  if (data.burnout_rate) note("granular.burnout_rate", *data.burnout_rate);
  if (data.crushing_pressure) note("granular.crushing_pressure", *data.crushing_pressure);
  if (!data.source.empty()) material.notes.push_back({"granular", data.source, 0, 0});
  set_external_law(material, make_granular_law(material, data));
}

}  // namespace solidus::material
