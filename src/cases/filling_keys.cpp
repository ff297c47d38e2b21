/// Keys of [filling].
#include "cases/case_keys.hpp"

namespace solidus::cases {

/// Keys of [filling]: where the metal comes in, how fast and how hot, where the air leaves, and how fine the
/// cubes of the cavity are.
Section<FillingSpec> filling_keys() {
  using F = FillingSpec;
  Section<F> s("filling",
               "How the metal fills the mould. Its presence makes `solidus run` fill first, by OpenFOAM, and "
               "start from the temperatures at the end of filling (docs/guide/filling.md).");
  s.key("gate", &F::gate)
      .doc(
          "Group of faces through which the metal comes in, on the surface of the castings. Without it a "
          "square at gate_at.");
  s.quantity("gate_at", &F::gate_at, "m")
      .initially(Value::list())
      .doc(
          "A point near the surface of the castings, three coordinates: the gate is a square of cubes around "
          "the nearest point of it. Empty: the top of the body with the role `gating`, else a low point of "
          "the thickest wall.");
  s.quantity("gate_width", &F::gate_width, "m")
      .positive()
      .doc(
          "Side of the square at gate_at. Without it so wide that the metal enters at 0.5 m/s, at least four "
          "cubes.");
  s.quantity("time", &F::time, "s")
      .positive()
      .doc(
          "Time until the mould is full, at a steady rate. Without it and `rate`: 1.6 s times the cube root "
          "of (wall thickness in mm times mass in kg).");
  s.quantity("rate", &F::rate, "kg/s").positive().doc("Mass flow of the metal, in place of `time`.");
  s.quantity("head", &F::head, "m")
      .positive()
      .doc(
          "Height of the metal above the gate that drives the flow, in place of `time`: metal that freezes "
          "or rises in the mould slows it.");
  s.quantity("times", &F::times, "s")
      .initially(Value::list())
      .doc("Times from the start of filling at which speed, pressure or tilt are given, rising from 0 s.");
  s.quantity("speed", &F::speed, "m/s")
      .initially(Value::list())
      .doc(
          "Speed of the metal in the gate at `times`, linear between them and constant after the last: a "
          "shot with its slow and its fast part.");
  s.quantity("pressure", &F::pressure, "Pa")
      .initially(Value::list())
      .doc(
          "Pressure in the gate above that of the atmosphere, at `times`, linear between them: low-pressure "
          "casting. It lifts the metal as high as it can carry it.");
  s.quantity("tilt", &F::tilt, "rad")
      .initially(Value::list())
      .doc(
          "Angle by which the mould is rotated about tilt_axis at `times`, linear between them; the mesh "
          "stays as at angle 0, and gravity is rotated instead, the other way.");
  s.key("tilt_axis", &F::tilt_axis)
      .initially(Value::list())
      .doc("Direction of the tilting axis, three numbers; by the right-hand rule.");
  s.quantity("temperature", &F::temperature, "K")
      .positive()
      .doc(
          "Temperature of the metal in the gate. Without it the highest initial temperature of the "
          "castings.");
  s.key("vents", &F::vents)
      .or_one()
      .initially(Value::list())
      .doc(
          "Groups of faces through which the air leaves. Empty: every local highest point of the cavity, "
          "where air would be trapped.");
  s.key("cells", &F::cells)
      .initially(10000)
      .range(200, 5000000)
      .doc("Approximate number of cubes in the cavity; a run takes some 6 microseconds per cube and step.");
  s.quantity("cell_size", &F::cell_size, "m").positive().doc("Edge of the cubes, in place of `cells`.");
  s.key("result", &F::result)
      .doc(
          "Folder of a finished filling, as `solidus fill` writes it (relative to this file): the run starts "
          "from it. Without it `solidus run` computes the filling first, and sets this key.");
  s.place(&F::where);
  return s;
}

}  // namespace solidus::cases
