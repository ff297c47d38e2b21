#include "cases/feeder_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

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

Section<GatingBlockSpec> gating_keys() {
  using G = GatingBlockSpec;
  Section<G> s(
      "gating",
      "The way of the metal into a part: an upright sprue, a level runner and an ingate, as one body "
      "of metal, as far as they lie outside of the parts and risers. Runner and ingate lie on one "
      "floor and lead straight from the sprue to the part.");
  s.key("name", &G::name).initially("gating").doc("Its name, as a group of the mesh.");
  s.quantity("gate", &G::gate, "m")
      .doc(
          "Middle of the end of the ingate, three coordinates: on the surface of a part or, where that is "
          "curved, somewhat inside.");
  s.quantity("gate_size", &G::gate_size, "m").doc("Width and height of the ingate.");
  s.quantity("gate_length", &G::gate_length, "m")
      .positive()
      .doc("Length of the ingate from 'gate' to the runner.");
  s.quantity("runner_size", &G::runner_size, "m").doc("Width and height of the runner.");
  s.quantity("sprue", &G::sprue, "m")
      .doc("Middle of the top of the sprue, three coordinates. Its foot is on the floor of the runner.");
  s.quantity("foot_diameter", &G::foot_diameter, "m").positive().doc("Diameter of the sprue at its foot.");
  s.quantity("top_diameter", &G::top_diameter, "m").positive().doc("Diameter of the sprue at its top.");
  s.place(&G::where);
  return s;
}

Section<ChillBlockSpec> chill_keys() {
  using C = ChillBlockSpec;
  Section<C> s("chill",
               "A block against the geometry: the part of a box outside of the parts, risers and gating.");
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

void check_gating(const GatingBlockSpec& g) {
  // Numbers of coordinates and sizes come first, since everything after them reads them.
  for (const auto& [key, point] : {std::pair{"gate", &g.gate}, std::pair{"sprue", &g.sprue}})
    if (point->size() != 3)
      throw InputError(g.where, fmt::format("'{}' has {} coordinates", key, point->size()), "three");
  for (const auto& [key, size] :
       {std::pair{"gate_size", &g.gate_size}, std::pair{"runner_size", &g.runner_size}})
    if (size->size() != 2 || !(std::min((*size)[0], (*size)[1]) > 0))
      throw InputError(g.where, fmt::format("'{}' is no width and height", key), "two lengths above 0");
  // The runner has to be there between the ingate and the sprue, and the sprue above the runner.
  const double along = std::hypot(g.sprue[0] - g.gate[0], g.sprue[1] - g.gate[1]);
  if (!(along > g.gate_length + 0.5 * g.foot_diameter))
    throw InputError(g.where,
                     fmt::format("the sprue stands {:g} m from 'gate', where the ingate of {:g} m and the "
                                 "foot of the sprue have no room",
                                 along, g.gate_length),
                     "a sprue further away, or a shorter ingate");
  const double roof = g.gate[2] - 0.5 * g.gate_size[1] + std::max(g.gate_size[1], g.runner_size[1]);
  if (!(g.sprue[2] > roof))
    throw InputError(g.where,
                     fmt::format("the sprue ends at {:g} m, and the runner reaches {:g} m", g.sprue[2], roof),
                     "a sprue whose top is above the runner");
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

void check_feeders(const std::vector<RiserBlockSpec>& risers, const std::vector<GatingBlockSpec>& gatings,
                   const std::vector<ChillBlockSpec>& chills) {
  // Risers, their sleeves, gating and chills become groups of one mesh, and so their names have to differ
  // among all of them.
  std::set<std::string> names;
  const auto add = [&](const std::string& name, const SourceLocation& where) {
    if (!names.insert(name).second)
      throw InputError(where, fmt::format("two of risers, gating and chills have the name '{}'", name),
                       "a name of its own for each: name = \"riser_2\"");
  };
  for (const RiserBlockSpec& r : risers) {
    check_riser(r);
    add(r.name, r.where);
    if (r.sleeve > 0) add(r.name + "_sleeve", r.where);
  }
  for (const GatingBlockSpec& g : gatings) {
    check_gating(g);
    add(g.name, g.where);
  }
  for (const ChillBlockSpec& c : chills) {
    check_chill(c);
    add(c.name, c.where);
  }
}

}  // namespace solidus::cases
