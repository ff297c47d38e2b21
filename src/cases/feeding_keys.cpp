/// Keys of [feeding] and [gas].
#include "cases/case_keys.hpp"

namespace solidus::cases {

/// Keys of [feeding]: whether the metal that shrinks is balanced, what is open to the air, and how rigid
/// moulds are.
Section<FeedingSpec> feeding_keys() {
  using F = FeedingSpec;
  Section<F> s("feeding",
               "Feeding of the shrinkage in runs with heat alone: pipes, sinks, cavities and pores "
               "(docs/guide/feeding.md).");
  s.key("follow", &F::follow)
      .initially(true)
      .doc(
          "Compute feeding where criteria.follow is true and something freezes. It has no effect with "
          "mechanics, where mixed elements open pores instead.");
  s.key("moves_heat", &F::moves_heat)
      .initially(false)
      .doc(
          "Metal that moves takes its heat along, and emptied places conduct and store heat as the gas in "
          "them. With false, temperatures are those of a casting that stays full. For one alloy, without "
          "stages, with the closed rule.");
  s.key("vented", &F::vented)
      .initially(Value::list())
      .doc(
          "Groups of the mesh at which melt is open to the atmosphere. Empty: surfaces of risers (without "
          "risers, of all castings) that face up and touch no other body; up is against gravity_direction of "
          "[analysis].");
  s.key("covered", &F::covered)
      .initially(Value::list())
      .doc(
          "Groups of the mesh at which melt is not open to the atmosphere, although `vented` or its default "
          "would include them.");
  s.key("mould_rigidity", &F::mould_rigidity)
      .range(0, 1)
      .doc(
          "The fraction of the graphite expansion that the mould resists, so that it feeds the casting; the "
          "rest moves the mould wall. Without it the smallest `rigidity` of the moulds' materials, 1 without "
          "a mould.");
  s.quantity("wall_movement", &F::wall_movement, "m")
      .at_least(0)
      .doc(
          "The length by which the graphite expansion moves the mould wall at most: what it yields as a "
          "fraction of a casting then falls with the modulus, volume over skin in contact with other bodies. "
          "Without it the wall moves by the fraction that mould_rigidity says, whatever the size.");
  s.place(&F::where);
  return s;
}

/// Keys of [gas]: whether it is followed, its content, and the pressure of the surroundings.
Section<GasSpec> gas_keys() {
  Section<GasSpec> s(
      "gas",
      "Gas in the melt and the pores that it forms, where a material file has [gas] (docs/guide/gas.md).");
  s.key("follow", &GasSpec::follow)
      .initially(true)
      .doc("Compute gas pores where criteria.follow is true and the material of a casting has [gas].");
  s.quantity("content", &GasSpec::content, "m3/kg")
      .at_least(0)
      .doc(
          "Gas in the melt as it is poured, volume at standard state per mass: \"0.15 cm3/(100 g)\". Without "
          "it the usual content that the material file gives.");
  s.quantity("ambient_pressure", &GasSpec::ambient_pressure, "Pa")
      .initially("101325 Pa")
      .positive()
      .doc(
          "Of the surroundings in which the casting freezes: a vacuum test has 80 mbar, an autoclave 10 "
          "bar.");
  return s;
}

}  // namespace solidus::cases
