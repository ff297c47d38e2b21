/// Keys of [[jet]] and [[shot_sleeve]].
#include "cases/case_keys.hpp"

namespace solidus::cases {

Section<JetSpec> jet_keys() {
  using J = JetSpec;
  Section<J> s(
      "jet",
      "Water from a round nozzle that hits a surface, such as the end of a bubbler's bore or the back "
      "of an insert: a film whose coefficient is the mean by Martin's correlation over a circle.");
  s.key("name", &J::name).doc("A name of your choice; history.csv has its heat under it.");
  s.key("group", &J::group).doc("Surface group of the mesh that it hits.");
  s.quantity("nozzle", &J::nozzle, "m").positive().doc("Inner diameter D of the nozzle.");
  s.quantity("distance", &J::distance, "m")
      .positive()
      .doc("H from the nozzle to the surface, 2 to 12 diameters.");
  s.quantity("radius", &J::radius, "m")
      .positive()
      .doc("Radius r of the circle over which the coefficient is averaged, 2.5 to 7.9 diameters.");
  s.quantity("flow", &J::flow, "m3/s").positive().doc("Volume flow (\"6 l/min\"), Re = 2000 to 400 000.");
  s.quantity("inlet_temperature", &J::inlet, "K").positive().doc("Temperature of the water.");
  s.key("stages", &J::stages)
      .or_one()
      .initially(Value::list())
      .doc("The stages in which it flows; empty: all.");
  s.place(&J::where);
  return s;
}

Section<ShotSleeveSpec> shot_sleeve_keys() {
  using S = ShotSleeveSpec;
  Section<S> s(
      "shot_sleeve",
      "The sleeve of a cold chamber machine, in which metal loses heat before it is in the die. The "
      "body's initial_temperature is then that of the metal when it has been poured into the sleeve.");
  s.key("body", &S::body).doc("Name of the [[body]] that is cast.");
  s.quantity("diameter", &S::diameter, "m").positive().doc("Inner diameter.");
  s.quantity("length", &S::length, "m").positive().doc("Length of the pool of metal in it.");
  s.key("filling", &S::filling)
      .range(0.05, 1)
      .doc("Share of the cross-section that metal fills while it waits.");
  s.quantity("time", &S::time, "s").positive().doc("From the end of pouring until the die is full.");
  s.quantity("temperature", &S::temperature, "K").positive().doc("Temperature of the sleeve's wall.");
  s.quantity("coefficient", &S::coefficient, "W/m2/K")
      .positive()
      .doc("Heat transfer between metal and sleeve.");
  s.place(&S::where);
  return s;
}

}  // namespace solidus::cases
