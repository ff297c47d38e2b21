/// Keys of [feeding] and [gas].
#include "cases/case_keys.hpp"

namespace solidus::cases {

/// Keys of [feeding]: whether the metal that shrinks is balanced, what is open to the air, and how rigid
/// moulds are.
Section<FeedingSpec> feeding_keys() {
  using F = FeedingSpec;
  Section<F> s("feeding",
               "Where the metal that shrinks takes its volume from, in runs with heat alone: pipes, sinks, "
               "cavities and pores (docs/guide/feeding.md).");
  s.key("follow", &F::follow)
      .initially(true)
      .doc(
          "Follow feeding where criteria are followed and something freezes. With mechanics there is none of "
          "it: mixed elements open pores.");
  s.key("moves_heat", &F::moves_heat)
      .initially(false)
      .doc(
          "Metal that moves takes its heat along, and emptied places conduct and store as the gas that fills "
          "them. Off: temperatures are those of a casting that stays full. For one alloy, without stages, "
          "with the closed rule.");
  s.key("vented", &F::vented)
      .initially(Value::list())
      .doc(
          "Groups of the mesh at which melt is open to the atmosphere. Empty: skins of risers, or where "
          "there "
          "are none of all that is cast, that face up and touch no other body; gravity_direction of the "
          "analysis says where up is.");
  s.key("covered", &F::covered)
      .initially(Value::list())
      .doc("Groups of the mesh at which melt is not open, whatever they are otherwise.");
  s.key("mould_rigidity", &F::mould_rigidity)
      .range(0, 1)
      .doc(
          "The share of the expansion of graphite that the mould holds, so that it feeds the casting; to the "
          "rest its wall gives way. Absent: the least of the rigidity of the moulds' cards, 1 without a "
          "mould.");
  s.place(&F::where);
  return s;
}

/// Keys of [gas]: whether it is followed, its content, and the pressure of the surroundings.
Section<GasSpec> gas_keys() {
  Section<GasSpec> s("gas",
                     "Gas in the melt, and the pores that it makes, where a card has [gas] "
                     "(docs/guide/gas.md).");
  s.key("follow", &GasSpec::follow)
      .initially(true)
      .doc("Follow gas where criteria are followed and the material of a casting has [gas].");
  s.quantity("content", &GasSpec::content, "m3/kg")
      .at_least(0)
      .doc(
          "Gas in the melt as it is poured, volume at standard state per mass: \"0.15 cm3/(100 g)\". Absent: "
          "that of the card, which is a usual one.");
  s.quantity("ambient_pressure", &GasSpec::ambient_pressure, "Pa")
      .initially("101325 Pa")
      .positive()
      .doc(
          "Of the surroundings in which the casting freezes: a vacuum test has 80 mbar, an autoclave 10 "
          "bar.");
  return s;
}

}  // namespace solidus::cases
