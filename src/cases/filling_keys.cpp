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
          "Group of faces through which the metal comes in, on the skin of what is cast. Absent: a square at "
          "gate_at.");
  s.quantity("gate_at", &F::gate_at, "m")
      .initially(Value::list())
      .doc(
          "A point near the skin of what is cast, three coordinates: the gate is a square of cubes around "
          "the "
          "nearest place. Empty: the top of the gating where a body has this role, else a low place of the "
          "thickest wall.");
  s.quantity("gate_width", &F::gate_width, "m")
      .positive()
      .doc(
          "Of the square at gate_at. Absent: so wide that the metal enters at 0.5 m/s, at least four cubes.");
  s.quantity("time", &F::time, "s")
      .positive()
      .doc(
          "Until the mould is full, at a steady rate. Absent, as `rate`: 1.6 s times the cube root of the "
          "thickness of the wall in mm times the mass in kg.");
  s.quantity("rate", &F::rate, "kg/s").positive().doc("Of the metal, in place of `time`.");
  s.quantity("head", &F::head, "m")
      .positive()
      .doc(
          "Height of the metal above the gate that drives it in, in place of `time`: what freezes or rises "
          "in the mould slows it.");
  s.quantity("times", &F::times, "s")
      .initially(Value::list())
      .doc("Times from the start of filling at which speed, pressure or tilt are given, rising from 0 s.");
  s.quantity("speed", &F::speed, "m/s")
      .initially(Value::list())
      .doc(
          "Of the metal in the gate at `times`, straight between them and kept after the last: a shot with "
          "its "
          "slow and its fast part.");
  s.quantity("pressure", &F::pressure, "Pa")
      .initially(Value::list())
      .doc(
          "Above the atmosphere in the gate at `times`, straight between them: low pressure from below. "
          "Metal "
          "comes as far as it lifts it.");
  s.quantity("tilt", &F::tilt, "rad")
      .initially(Value::list())
      .doc(
          "Angle by which the mould has turned about tilt_axis at `times`, straight between them; the mesh "
          "stands as at 0 and gravity turns the other way.");
  s.key("tilt_axis", &F::tilt_axis)
      .initially(Value::list())
      .doc("Direction of the axis of tilt, three numbers; by the rule of the right hand.");
  s.quantity("temperature", &F::temperature, "K")
      .positive()
      .doc("Of the metal in the gate. Absent: the highest initial temperature of what is cast.");
  s.key("vents", &F::vents)
      .or_one()
      .initially(Value::list())
      .doc(
          "Groups of faces through which the air leaves. Empty: every highest place of the cavity, where air "
          "would be caught.");
  s.key("cells", &F::cells)
      .initially(10000)
      .range(200, 5000000)
      .doc("Cubes of which the cavity is made, about; a run takes some 6 microseconds per cube and step.");
  s.quantity("cell_size", &F::cell_size, "m").positive().doc("Edge of the cubes, in place of `cells`.");
  s.key("result", &F::result)
      .doc(
          "Folder of a filling that is done, as `solidus fill` leaves it (relative to this file): the run "
          "starts "
          "from it. Absent: `solidus run` fills first, and sets this key.");
  s.place(&F::where);
  return s;
}

}  // namespace solidus::cases
