/// The keys of a file of `materials/liquidus`.
#include "input/document.hpp"
#include "material/liquidus_system.hpp"

namespace solidus::material {
namespace {

Section<LiquidusSystem::Solute> solute_keys() {
  using S = LiquidusSystem::Solute;
  Section<S> s("solute", "An element in the melt.");
  s.key("name", &S::name).doc("Its symbol.");
  s.quantity("slope", &S::slope, "K").difference().doc("Of the liquidus, for each weight per cent.");
  s.key("partition", &S::partition).range(0, 20).doc("Partition coefficient k between solid and melt.");
  s.key("up_to", &S::up_to).range(0, 100).doc("Weight per cent to which the straight line is meant.");
  s.key("source", &S::source).initially("").doc("Where the data come from.");
  s.place(&S::where);
  return s;
}

Section<LiquidusSystem::Slope> slope_keys() {
  using S = LiquidusSystem::Slope;
  Section<S> s("other", "Another solute in the melt next to two solids.");
  s.key("name", &S::name).doc("Its symbol.");
  s.quantity("slope", &S::slope, "K")
      .difference()
      .range(-100, 0)
      .doc("Of the temperature, for each weight per cent.");
  s.key("partition", &S::partition)
      .range(0, 1)
      .initially(0.0)
      .doc(
          "Partition coefficient k between the primary solid and the melt next to two solids, for Scheil's "
          "equation; 0: that of the solute.");
  s.place(&S::where);
  return s;
}

Section<LiquidusSystem::Eutectic> eutectic_keys() {
  using E = LiquidusSystem::Eutectic;
  Section<E> s("eutectic", "Where the primary solid and a second phase freeze together.");
  s.key("solute", &E::solute).doc("Of the second phase.");
  s.quantity("temperature", &E::temperature, "K").positive().doc("Of the binary eutectic.");
  s.key("solvent_share", &E::solvent_share)
      .range(0, 1)
      .doc("Mass fraction of the primary solid in what freezes there.");
  s.sections("other", &E::other, slope_keys());
  s.key("source", &E::source).initially("").doc("Where the data come from.");
  s.place(&E::where);
  return s;
}

Section<LiquidusSystem::Last> last_keys() {
  using L = LiquidusSystem::Last;
  Section<L> s("last", "Where the rest freezes at one temperature.");
  s.key("solutes", &L::solutes).doc("The alloy must hold all of them; the first such entry counts.");
  s.quantity("temperature", &L::temperature, "K").positive().doc("Of the last eutectic.");
  s.key("source", &L::source).initially("").doc("Where the data come from.");
  s.place(&L::where);
  return s;
}

}  // namespace

const Section<LiquidusSystem>& liquidus_section() {
  static const Section<LiquidusSystem> section = [] {
    using L = LiquidusSystem;
    Section<L> s("", "A corner of a phase diagram as straight lines.");
    s.key("title", &L::title).initially("").doc("What it is, in one line.");
    s.key("solvent", &L::solvent).doc("Symbol of the element that the alloys consist of.");
    s.quantity("melting_point", &L::melting_point, "K").positive().doc("Of the solvent.");
    s.key("source", &L::source).initially("").doc("Where the melting point comes from.");
    s.sections("solute", &L::solutes, solute_keys());
    s.sections("eutectic", &L::eutectics, eutectic_keys());
    s.sections("last", &L::last, last_keys());
    s.place(&L::where);
    return s;
  }();
  return section;
}

}  // namespace solidus::material
