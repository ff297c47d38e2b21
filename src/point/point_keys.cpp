/// The keys of a point file.
#include "point/record.hpp"
#include "point/spec.hpp"

namespace solidus::point {

namespace {

const std::vector<std::string> k_loaded = {"uniaxial", "biaxial", "plane_strain", "shear"};
const std::vector<std::string> k_ramps = {"uniaxial", "biaxial",     "plane_strain",
                                          "shear",    "constrained", "components"};

Section<ComponentValues> component_keys(const std::string& name, const std::string& doc,
                                        const std::string& unit) {
  Section<ComponentValues> s(name, doc);
  const auto add = [&](const char* component, std::optional<double> ComponentValues::*member) {
    s.quantity(component, member, unit).doc("Tensor component.");
  };
  add("xx", &ComponentValues::xx);
  add("yy", &ComponentValues::yy);
  add("zz", &ComponentValues::zz);
  add("xy", &ComponentValues::xy);
  add("yz", &ComponentValues::yz);
  add("xz", &ComponentValues::xz);
  return s;
}

void loaded_keys(Section<SegmentSpec>& s) {
  s.quantity("strain", &SegmentSpec::strain, "1")
      .when("kind", k_loaded)
      .doc("Total strain of the loaded component at the end, thermal strain included.");
  s.quantity("strain_rate", &SegmentSpec::strain_rate, "1/s")
      .when("kind", k_loaded)
      .doc("Of the loaded component; with `strain` its size gives the duration.");
  s.quantity("stress", &SegmentSpec::stress, "Pa")
      .when("kind", k_loaded)
      .doc("Of the loaded component at the end.");
  s.quantity("stress_rate", &SegmentSpec::stress_rate, "Pa/s")
      .when("kind", k_loaded)
      .doc("Of the loaded component; with `stress` its size gives the duration.");
  s.choice("hold", &SegmentSpec::hold,
           {{"nothing", Hold::nothing, "the loaded component moves"},
            {"strain", Hold::strain, "it keeps its strain: relaxation"},
            {"stress", Hold::stress, "it keeps its stress: creep"}})
      .initially("nothing")
      .when("kind", k_loaded)
      .doc("Keeps the loaded component at its present value.");
}

void free_component_keys(Section<SegmentSpec>& s) {
  const std::vector<std::string> kind = {"components"};
  s.section("strains", &SegmentSpec::strains,
            component_keys("strains", "Total strains at the end, of kind components.", "1"))
      .when("kind", kind);
  s.section("strain_rates", &SegmentSpec::strain_rates,
            component_keys("strain_rates", "Rates of total strain, of kind components.", "1/s"))
      .when("kind", kind);
  s.section("stresses", &SegmentSpec::stresses,
            component_keys("stresses", "Stresses at the end, of kind components.", "Pa"))
      .when("kind", kind);
  s.section("stress_rates", &SegmentSpec::stress_rates,
            component_keys("stress_rates", "Rates of stress, of kind components.", "Pa/s"))
      .when("kind", kind);
  s.key("hold_strain", &SegmentSpec::hold_strain)
      .choices({"xx", "yy", "zz", "xy", "yz", "xz"})
      .initially(Value::list())
      .when("kind", kind)
      .doc(
          "Components that keep their strain; components that no key of the segment names keep their "
          "stress.");
}

Section<SegmentSpec> segment_keys() {
  // The keys of a [[segment]]: what is loaded, to which target or with which rate, at which temperature, and
  // in how many steps.
  Section<SegmentSpec> s("segment",
                         "A part of the loading, linear in time from the present values to those given. "
                         "Segments follow each other in the order of the file.");
  s.choice(
       "kind", &SegmentSpec::kind,
       {{"uniaxial", SegmentKind::uniaxial, "xx is loaded, the other stresses go to zero"},
        {"biaxial", SegmentKind::biaxial, "xx and yy are loaded alike, the other stresses go to zero"},
        {"plane_strain", SegmentKind::plane_strain,
         "xx is loaded, zz keeps its strain, the other stresses go to zero"},
        {"shear", SegmentKind::shear,
         "xy is loaded (half of the angle gamma), the other stresses go to zero"},
        {"constrained", SegmentKind::constrained, "every strain is held"},
        {"components", SegmentKind::components, "strains, stresses and their rates component by component"},
        {"repeat", SegmentKind::repeat, "repeats the segments before it, for cycles"}})
      .initially("uniaxial")
      .doc("Which components are loaded, and which are free.");
  loaded_keys(s);
  free_component_keys(s);
  s.quantity("temperature", &SegmentSpec::temperature, "K")
      .positive()
      .when("kind", k_ramps)
      .doc("At the end; without it and its rate the temperature does not change.");
  s.quantity("temperature_rate", &SegmentSpec::temperature_rate, "K/s")
      .difference()
      .when("kind", k_ramps)
      .doc("With `temperature` its size gives the duration.");
  s.quantity("duration", &SegmentSpec::duration, "s")
      .positive()
      .when("kind", k_ramps)
      .doc("Left out where a target and its rate give it.");
  s.key("steps", &SegmentSpec::steps)
      .initially(50)
      .range(1, 1000000)
      .when("kind", k_ramps)
      .doc("Number of steps.");
  s.quantity("first_step", &SegmentSpec::first_step, "s")
      .positive()
      .when("kind", k_ramps)
      .doc(
          "Left out: equal steps. Else the steps grow from this one by a constant factor, for relaxation "
          "and creep over decades of time.");
  s.key("last", &SegmentSpec::last)
      .range(1, 1000)
      .when("kind", {"repeat"})
      .doc("How many of the segments before this one are repeated.");
  s.key("times", &SegmentSpec::times).range(1, 100000).when("kind", {"repeat"}).doc("How many more times.");
  s.place(&SegmentSpec::where);
  return s;
}

Section<CurveSpec> curve_keys() {
  Section<CurveSpec> s("curve",
                       "The loading with some values changed, for several curves in one picture. Without "
                       "this section there is one curve named 'history'.");
  s.key("name", &CurveSpec::name).doc("Name of its table, NAME.csv: letters, digits and . _ + -");
  s.key("label", &CurveSpec::label).initially("").doc("In the pictures; left out, the name.");
  s.key("material", &CurveSpec::material).doc("Another material.");
  s.quantity("temperature", &CurveSpec::temperature, "K").positive().doc("Another temperature at the start.");
  s.quantity("strain_rate", &CurveSpec::strain_rate, "1/s")
      .doc("In place of `strain_rate` in every segment that has one.");
  s.quantity("stress", &CurveSpec::stress, "Pa").doc("In place of `stress` in every segment that has one.");
  s.key("measured", &CurveSpec::measured)
      .doc(
          "A CSV file of measured points for the pictures and for the deviation: a header of columns of the "
          "history with units, for example strain_xx[percent],stress_xx[MPa]; the first is the abscissa.");
  s.place(&CurveSpec::where);
  return s;
}

Section<PictureSpec> picture_keys() {
  Section<PictureSpec> s("picture", "A picture with all curves, besides the overview that is always drawn.");
  s.key("file", &PictureSpec::file).doc("Its name, without ending.");
  s.key("title", &PictureSpec::title).initially("").doc("Above it.");
  s.key("x", &PictureSpec::x).doc("A column without its unit: strain_xx.");
  s.key("y", &PictureSpec::y).doc("Columns of one unit.");
  s.key("logarithmic", &PictureSpec::logarithmic)
      .choices({"x", "y"})
      .initially(Value::list())
      .doc("Axes with a logarithmic scale.");
  s.place(&PictureSpec::where);
  return s;
}

Section<PointSpec> point_keys() {
  // The keys at the top of the file come first, its sections last: this is the order of the reference.
  Section<PointSpec> s(
      "", "A history of strain, stress and temperature that a point of a material goes through.");
  s.key("title", &PointSpec::title).initially("").doc("What is tested, in one line.");
  s.key("material", &PointSpec::material)
      .doc("A name in the library, or a file (.toml) relative to this file.");
  s.quantity("temperature", &PointSpec::temperature, "K")
      .initially("20 degC")
      .positive()
      .doc("At the start.");
  s.quantity("strain_reference", &PointSpec::strain_reference, "K")
      .positive()
      .doc("The temperature at which the free material has zero strain; left out, that of the start.");
  s.choice("integration", &PointSpec::integration,
           {{"backward_euler", PointIntegration::backward_euler, "first order"},
            {"bdf2", PointIntegration::two_step,
             "second order: the two-step method of Gear; each segment begins with a step of backward Euler"}})
      .initially("backward_euler")
      .doc("Time integration of the flow.");
  s.choice("thermal", &PointSpec::thermal,
           {{"prescribed", Thermal::prescribed, "the segments give it"},
            {"adiabatic", Thermal::adiabatic, "no heat is exchanged: it follows from the first law"}})
      .initially("prescribed")
      .doc("How the temperature is determined.");
  s.sections("segment", &PointSpec::segments, segment_keys());
  s.sections("curve", &PointSpec::curves, curve_keys());
  s.sections("picture", &PointSpec::pictures, picture_keys());
  s.place(&PointSpec::where);
  return s;
}

}  // namespace

std::optional<double> ComponentValues::of(int component) const {
  const std::optional<double>* const all[6] = {&xx, &yy, &zz, &xy, &yz, &xz};
  return *all[component];
}

const Section<PointSpec>& point_section() {
  static const Section<PointSpec> section = point_keys();
  return section;
}

}  // namespace solidus::point
