#include "cases/feeder_keys.hpp"

#include <fmt/format.h>

#include <set>

namespace solidus::cases {

Section<RiserBlockSpec> riser_keys() {
  using R = RiserBlockSpec;
  Section<R> s("riser",
               "An upright cylinder of metal on the geometry, or next to it: the part of the cylinder "
               "outside of the parts.");
  s.key("name", &R::name).initially("riser").doc("Its name, as a group of the mesh.");
  s.quantity("foot", &R::foot, "m").doc("Centre of its foot, three coordinates; it may lie inside a part.");
  s.quantity("diameter", &R::diameter, "m").positive().doc("Its diameter.");
  s.quantity("height", &R::height, "m").positive().doc("Its height above the foot, along z, with the neck.");
  s.quantity("neck_diameter", &R::neck_diameter, "m")
      .positive()
      .doc("Diameter of its neck, at most that of the riser. Without it there is none.");
  s.quantity("neck_height", &R::neck_height, "m")
      .initially("0 mm")
      .at_least(0)
      .doc("Height above the foot at which the neck ends and the sleeve begins.");
  s.quantity("neck_to", &R::neck_to, "m")
      .initially(Value::list())
      .doc(
          "Of a riser next to the part: a point in the part to which the neck leads from the axis of the "
          "riser; the neck is horizontal where the riser reaches the height of that point.");
  s.quantity("sleeve", &R::sleeve, "m")
      .initially("0 mm")
      .at_least(0)
      .doc("Thickness of a sleeve around it, from the neck to its top: a body NAME_sleeve. 0: none.");
  s.place(&R::where);
  return s;
}

Section<ChillBlockSpec> chill_keys() {
  using C = ChillBlockSpec;
  Section<C> s("chill", "A block against the geometry: the part of a box outside of the parts and risers.");
  s.key("name", &C::name).initially("chill").doc("Its name, as a group of the mesh.");
  s.quantity("lowest", &C::lowest, "m")
      .doc("A corner of the box, three coordinates; it may lie inside a part.");
  s.quantity("highest", &C::highest, "m").doc("The opposite corner, above the first in each coordinate.");
  s.place(&C::where);
  return s;
}

namespace {

void check_riser(const RiserBlockSpec& r) {
  // Numbers of coordinates come first, since everything after them reads three.
  if (r.foot.size() != 3)
    throw InputError(r.where, fmt::format("'foot' has {} coordinates", r.foot.size()), "three");
  if (!r.neck_to.empty() && r.neck_to.size() != 3)
    throw InputError(r.where, fmt::format("'neck_to' has {} coordinates", r.neck_to.size()), "three");
  // A neck that is wider than the riser, or as high, would leave no riser above it.
  if (r.neck_diameter && *r.neck_diameter > r.diameter)
    throw InputError(
        r.where,
        fmt::format("'neck_diameter' is {:g} m, wider than the riser, {:g} m", *r.neck_diameter, r.diameter),
        "a neck of at most the diameter of the riser");
  if (r.neck_height >= r.height)
    throw InputError(
        r.where, fmt::format("'neck_height' is {:g} m, and the riser {:g} m high", r.neck_height, r.height),
        "a neck that ends below the top of the riser");
  // A neck needs its diameter and either a height or a point to which it leads; half of these is told as what
  // is missing.
  if (!r.neck_to.empty() && !r.neck_diameter)
    throw InputError(r.where, "'neck_to' is there without 'neck_diameter'", "the diameter of the neck");
  if (r.neck_to.empty() && r.neck_diameter && !(r.neck_height > 0))
    throw InputError(r.where, "'neck_diameter' is there without 'neck_height'", "the height of the neck");
  if (!r.neck_to.empty() && r.sleeve > 0)
    throw InputError(r.where, "a riser with 'neck_to' has a 'sleeve', which would cut its neck",
                     "a riser next to the part without a sleeve");
}

void check_chill(const ChillBlockSpec& c) {
  if (c.lowest.size() != 3 || c.highest.size() != 3)
    throw InputError(c.where, "the box of a chill has no two corners",
                     "lowest and highest of three coordinates each");
  // Each pair of coordinates is compared, so that the message can name the axis.
  for (std::size_t i = 0; i < 3; ++i)
    if (!(c.highest[i] > c.lowest[i]))
      throw InputError(
          c.where,
          fmt::format("'highest' is {:g} m in {} and 'lowest' {:g} m", c.highest[i], "xyz"[i], c.lowest[i]),
          "a box with each coordinate of 'highest' above that of 'lowest'");
}

}  // namespace

void check_feeders(const std::vector<RiserBlockSpec>& risers, const std::vector<ChillBlockSpec>& chills) {
  // Risers, their sleeves and chills become groups of one mesh, and so their names have to differ among all
  // of them.
  std::set<std::string> names;
  const auto add = [&](const std::string& name, const SourceLocation& where) {
    if (!names.insert(name).second)
      throw InputError(where, fmt::format("two risers or chills have the name '{}'", name),
                       "a name of its own for each: name = \"riser_2\"");
  };
  for (const RiserBlockSpec& r : risers) {
    check_riser(r);
    add(r.name, r.where);
    if (r.sleeve > 0) add(r.name + "_sleeve", r.where);
  }
  for (const ChillBlockSpec& c : chills) {
    check_chill(c);
    add(c.name, c.where);
  }
}

}  // namespace solidus::cases
