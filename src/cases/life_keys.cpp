/// Keys of [[die_life]]: fatigue, wear and soldering of a body from shot to shot.
#include "cases/case_keys.hpp"

namespace solidus::cases {

Section<DieLifeSpec> die_life_keys() {
  using D = DieLifeSpec;
  Section<D> s(
      "die_life",
      "Life of a die: its range of strain in every shot and how many shots it bears until its skin cracks; "
      "how many until it is worn to a depth; how long it is hot enough in a shot for metal to stick to it. "
      "The constants are yours: no card has any. Where the body only conducts heat, the range of strain is "
      "that of a skin that is held completely, an upper bound.");
  // Which body, by which law, and then the constants of that law.
  s.key("body", &D::body).doc("The body that is followed: a group of the mesh.");
  s.choice("law", &D::law,
           {{"coffin_manson", D::Law::coffin_manson,
             "half the range of strain = (strength - mean stress)/modulus (2N)^strength_exponent + ductility "
             "(2N)^ductility_exponent: Basquin, Coffin and Manson, Morrow"},
            {"table", D::Law::table, "cycles by the range of strain, `cycles`"},
            {"none", D::Law::none, "no fatigue: wear or soldering alone"}})
      .initially("coffin_manson")
      .doc("How many cycles N a range of strain is borne.");
  s.quantity("fatigue_strength", &D::strength, "Pa")
      .positive()
      .when("law", {"coffin_manson"})
      .doc("Fatigue strength coefficient.");
  s.key("strength_exponent", &D::strength_exponent)
      .range(-1, -1e-3)
      .when("law", {"coffin_manson"})
      .doc("Fatigue strength exponent b, below zero.");
  s.key("fatigue_ductility", &D::ductility)
      .at_least(0)
      .when("law", {"coffin_manson"})
      .doc("Fatigue ductility coefficient.");
  s.key("ductility_exponent", &D::ductility_exponent)
      .range(-2, -1e-3)
      .when("law", {"coffin_manson"})
      .doc("Fatigue ductility exponent c, below zero.");
  s.quantity("modulus", &D::modulus, "Pa")
      .positive()
      .when("law", {"coffin_manson"})
      .doc("Young's modulus at the temperature of the constants.");
  s.quantity("mean_stress", &D::mean_stress, "Pa")
      .initially("0 Pa")
      .when("law", {"coffin_manson"})
      .doc("Mean stress of Morrow's correction; zero: none.");
  // A table in place of the formula, and where all of it comes from.
  s.function("cycles", &D::cycles, "1")
      .of({Argument::strain})
      .positive()
      .when("law", {"table"})
      .doc(
          "A table of cycles by range of strain: { of = \"strain\", argument_unit = \"1\", unit = \"1\", "
          "points = "
          "[[0.004, 20000], [0.01, 800]] }; between and beyond its points straight in both logarithms.");
  s.key("source", &D::source)
      .initially("")
      .doc("Where the constants come from; the log of the run says it next to the life.");
  // Limits of use besides fatigue.
  s.quantity("worn_depth", &D::worn_depth, "m")
      .positive()
      .doc(
          "The depth at which the die is worn out: fields `shot_wear`, the depth that a shot wears, and "
          "`shots_until_worn`. Needs [contact.wear] on a [[contact]] of the body.");
  s.quantity("soldering_temperature", &D::soldering_temperature, "K")
      .positive()
      .doc(
          "Temperature of the die above which the casting sticks to it: field `soldering_time`, the time in "
          "a "
          "shot for which a place is hotter.");
  s.place(&D::where);
  return s;
}

}  // namespace solidus::cases
