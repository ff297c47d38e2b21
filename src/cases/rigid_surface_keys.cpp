/// Keys of [[rigid_surface]].
#include "cases/case_keys.hpp"

namespace solidus::cases {

/// Keys of [[rigid_surface]]: shape, place, motion and temperature of a tool without a mesh.
Section<RigidSurfaceSpec> rigid_surface_keys() {
  using R = RigidSurfaceSpec;
  using Shape = contact::RigidSurface::Shape;
  Section<R> s("rigid_surface",
               "A tool without a mesh: a rigid surface with a prescribed motion. The `master` of "
               "a [[contact]] with large sliding names it.");
  s.key("name", &R::name).doc("A name of your choice, of no group of the mesh.");
  s.choice("shape", &R::shape,
           {{"plane", Shape::plane, "infinite; in axisymmetry the disc or cone that the line sweeps"},
            {"cylinder", Shape::cylinder,
             "infinite; in plane strain along z, in axisymmetry about the axis of revolution"},
            {"sphere", Shape::sphere, "in a solid; in axisymmetry with its centre on the axis"}})
      .doc("Its shape.");
  s.quantity("point", &R::point, "m")
      .doc(
          "A point of the plane, a point of the cylinder's axis, or the centre of the sphere, before any "
          "motion.");
  s.key("normal", &R::normal)
      .when("shape", {"plane"})
      .doc("Direction out of the tool, of any length: it points towards the body that the plane meets.");
  s.key("axis", &R::axis)
      .initially(Value::list())
      .when("shape", {"cylinder"})
      .doc("Direction of the cylinder's axis, of any length; in a solid only, and needed there.");
  s.quantity("radius", &R::radius, "m").positive().when("shape", {"cylinder", "sphere"}).doc("Its radius.");
  s.key("hollow", &R::hollow)
      .initially(false)
      .when("shape", {"cylinder", "sphere"})
      .doc("The tool is outside and the body inside: a bore, a cup.");
  s.function("ux", &R::ux, "m").of({Argument::time}).doc("Its displacement along x; without it none.");
  s.function("uy", &R::uy, "m")
      .of({Argument::time})
      .doc("Its motion along y; in axisymmetry along the axis.");
  s.function("uz", &R::uz, "m")
      .of({Argument::time})
      .doc("Its motion along z; in axisymmetry along the axis.");
  s.function("rotation", &R::rotation, "rad")
      .of({Argument::time})
      .doc("The angle by which it has rotated, by the right-hand rule; not in axisymmetry.");
  s.quantity("rotation_centre", &R::rotation_centre, "m")
      .initially(Value::list())
      .doc("The point about which it turns; without it `point`. The centre moves with ux, uy, uz.");
  s.key("rotation_axis", &R::rotation_axis)
      .initially(Value::list())
      .doc("The direction about which it turns, in a solid; a cylinder without it turns about its axis.");
  s.function("temperature", &R::temperature, "K")
      .of({Argument::time})
      .doc(
          "Its temperature, the same everywhere, where heat passes into it ([contact.heat]). Friction in a "
          "thermomechanical analysis needs both.");
  s.place(&R::where);
  return s;
}

}  // namespace solidus::cases
