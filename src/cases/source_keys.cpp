/// Keys of [[source]] and [[deposition]]: where heat and metal come in, in which shape, how much, and along
/// which path.
#include "cases/case_keys.hpp"

namespace solidus::cases {

namespace {

/// Declares the sizes of the shapes.
void shape_keys(Section<SourceSpec>& s) {
  using S = SourceSpec;
  s.quantity("radius", &S::radius, "m")
      .positive()
      .when("kind", {"gaussian", "cylinder", "line"})
      .doc(
          "Radius; of \"gaussian\" and \"line\" 95 % of the power lies within it, exp(-3) of the peak on "
          "it.");
  s.quantity("width", &S::width, "m")
      .positive()
      .when("kind", {"double_ellipsoid"})
      .doc(
          "Semi-axis a, across the path: there the power density is exp(-3) of its peak, as at the end of "
          "the other semi-axes.");
  s.quantity("depth", &S::depth, "m")
      .positive()
      .when("kind", {"double_ellipsoid", "cylinder", "line"})
      .doc("Semi-axis b in depth, or the depth of the cylinder or line, along `direction`.");
  s.quantity("front", &S::front, "m")
      .positive()
      .when("kind", {"double_ellipsoid"})
      .doc("Length in front of the centre.");
  s.quantity("rear", &S::rear, "m")
      .positive()
      .when("kind", {"double_ellipsoid"})
      .doc("Length behind the centre; without it as `front`.");
  s.key("front_share", &S::front_share)
      .range(0, 1)
      .when("kind", {"double_ellipsoid"})
      .doc(
          "Share of the power in front of the centre; without it front/(front + rear), with which the power "
          "density is continuous at the centre.");
  s.key("direction", &S::direction)
      .initially(Value::list())
      .doc("Direction of the beam into the metal, of any length; empty: down the last axis.");
}

/// Keys of the path: a file, or a straight line.
Section<PathSpec> path_keys(const std::string& doc) {
  using P = PathSpec;
  Section<P> s("path", doc);
  s.key("file", &P::file)
      .initially("")
      .doc(
          "A file of points with times, relative to this file: CSV with the columns t, x, y and, in space, "
          "z, "
          "and `on` (0 to 1, from a point to the next); or, by its ending .gcode, .nc, .ngc or .tap, G-code "
          "(G0, G1, G4, G20, G21, G90, G91, M2, M3, M4, M5, M30).");
  s.quantity("from", &P::from, "m")
      .initially(Value::list())
      .doc("Without a file: where a straight line begins.");
  s.quantity("to", &P::to, "m").initially(Value::list()).doc("Without a file: where it ends.");
  s.quantity("speed", &P::speed, "m/s").positive().doc("Without a file: the speed along the line.");
  s.quantity("start", &P::start, "s")
      .initially("0 s")
      .at_least(0)
      .doc("When the line begins; it is added to the times of a file.");
  return s;
}

}  // namespace

/// Keys of [[source]].
Section<SourceSpec> source_keys() {
  using S = SourceSpec;
  using Kind = heat::TravellingShape::Kind;
  Section<S> s("source",
               "Heat that travels along a path: a torch, a laser, an electron beam. It is on from the first "
               "point of its path to the last. For heat that does not move, or that is released in a whole "
               "body: [[thermal_condition]].");
  s.key("name", &S::name).doc("A name of your choice; history.csv has its power by this name.");
  s.key("group", &S::groups).or_one().doc("The bodies that it heats; with kind = \"gaussian\" the surfaces.");
  s.choice("kind", &S::kind,
           {{"double_ellipsoid", Kind::double_ellipsoid,
             "Goldak's: two quarters of ellipsoids, in front and behind; below a surface"},
            {"gaussian", Kind::gaussian, "a normal distribution on a surface"},
            {"cylinder", Kind::cylinder, "uniform in a cylinder from the path down to `depth`"},
            {"line", Kind::line, "a normal distribution around a line from the path down to `depth`"}})
      .doc("The shape.");
  s.function("power", &S::power, "W")
      .of({Argument::time})
      .at_least(0)
      .doc("Power of the source; in a plane analysis still that of the whole source.");
  s.function("efficiency", &S::efficiency, "1")
      .of({Argument::time})
      .initially(1)
      .range(0, 1)
      .doc("Share of the power that reaches the metal.");
  shape_keys(s);
  s.section("path", &S::path,
            path_keys("The path of the source: of its centre on the surface of the metal."));
  s.key("step_share", &S::step_share)
      .initially(0.5)
      .range(0.01, 10)
      .doc(
          "An adaptive step is no longer than this share of the time in which the source moves by its own "
          "length "
          "(front and rear, or twice the radius).");
  s.place(&S::where);
  return s;
}

/// Keys of [[deposition]].
Section<DepositionSpec> deposition_keys() {
  using D = DepositionSpec;
  Section<D> s("deposition",
               "A body that is deposited element by element, at its initial temperature: each element takes "
               "part from its activation on, and is then free of stress in its deformed place.");
  s.key("name", &D::name).doc("A name of your choice.");
  s.key("body", &D::body).doc("Group of the mesh: the body that grows.");
  s.choice(
       "kind", &D::kind,
       {{"front", D::Kind::front,
         "an element is activated when a moving plane reaches its centre; elements behind the plane at its "
         "start exist from the start"},
        {"path", D::Kind::path,
         "when the point that follows a path passes its centre, within `width` and `depth`"},
        {"times", D::Kind::times, "at the time that `time` gives at its centre"}})
      .doc("When an element is activated.");
  s.quantity("from", &D::from, "m")
      .initially(Value::list())
      .when("kind", {"front"})
      .doc("A point of the plane at its start.");
  s.key("normal", &D::normal)
      .initially(Value::list())
      .when("kind", {"front"})
      .doc("The direction in which the plane moves, of any length.");
  s.quantity("speed", &D::speed, "m/s").positive().when("kind", {"front"}).doc("The speed of the plane.");
  s.quantity("start", &D::start, "s")
      .initially("0 s")
      .at_least(0)
      .when("kind", {"front"})
      .doc("When the plane begins to move.");
  s.section(
      "path", &D::path,
      path_keys(
          "The path of a deposition of kind = \"path\": of the centre line of the upper side of its bead."));
  s.quantity("width", &D::width, "m").positive().when("kind", {"path"}).doc("Width of the bead.");
  s.quantity("depth", &D::depth, "m")
      .positive()
      .when("kind", {"path"})
      .doc("Depth of the bead below the path.");
  s.key("direction", &D::direction)
      .initially(Value::list())
      .when("kind", {"path"})
      .doc("Direction from the path into the bead, of any length; empty: down the last axis.");
  s.function("time", &D::time, "s")
      .anywhere(Key::Place::position)
      .when("kind", {"times"})
      .doc("When an element is activated; with zero or less it exists from the start.");
  s.quantity("interval", &D::interval, "s")
      .positive()
      .doc(
          "Activation is moved to multiples of this time; without it elements are activated at up to 400 "
          "different times. Adaptive steps end there.");
  s.key("bare", &D::bare)
      .initially("")
      .doc(
          "Surface group of the mesh whose conditions also act on faces inside the mesh, as long as there is "
          "an element on one side only; empty: such faces are insulated. Faces that get covered leave their "
          "group in any case.");
  s.place(&D::where);
  return s;
}

}  // namespace solidus::cases
