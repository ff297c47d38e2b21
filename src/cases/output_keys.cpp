/// Keys of [output], probes and profiles.
#include "cases/case_keys.hpp"
#include "coupling/all_fields.hpp"
#include "results/output/field_format.hpp"

namespace solidus::cases {

namespace {

/// The kinds of probe that sample a field.
const std::vector<std::string> k_sampling = {"point", "mean", "minimum", "maximum", "integral"};

}  // namespace

/// Keys of [[probe]]. `kind` decides whether it is a point, a group or the difference of two other probes.
Section<ProbeSpec> probe_keys() {
  using P = ProbeSpec;
  Section<P> s("probe", "A column of history.csv.");
  s.key("name", &P::name).doc("Header of the column; the unit is added in brackets.");
  s.choice("kind", &P::kind,
           {{"point", P::Kind::point, "the field at a point"},
            {"mean", P::Kind::mean, "its mean over a group"},
            {"minimum", P::Kind::minimum, "its least value in a group"},
            {"maximum", P::Kind::maximum, "its greatest value in a group"},
            {"integral", P::Kind::integral, "its integral over a group"},
            {"difference", P::Kind::difference, "the difference of two other probes"},
            {"global", P::Kind::global,
             "a column that history.csv always has, under another name, times a factor"}})
      .initially("point")
      .doc("What is evaluated.");
  s.key("field", &P::field).choices(coupling::field_names(true)).when("kind", k_sampling).doc("The field.");
  s.key("component", &P::component)
      .initially("")
      .when("kind", k_sampling)
      .doc(
          "Component of a vector or tensor: \"x\", \"r\", \"xx\", ...; axisymmetric: r (radial) and z "
          "(axial), rr, zz (axial), "
          "tt (hoop) and rz.");
  s.quantity("point", &P::point, "m").when("kind", {"point"}).doc("Coordinates of the point.");
  s.key("body", &P::body).when("kind", {"point"}).doc("The body to evaluate, where a point lies on two.");
  s.key("group", &P::group)
      .when("kind", {"mean", "minimum", "maximum", "integral"})
      .doc("Group of the mesh: a body or a surface.");
  s.key("of", &P::of).when("kind", {"difference"}).doc("Two probes: the first minus the second.");
  s.key("global", &P::global)
      .when("kind", {"global"})
      .doc("The column's name, without its unit: \"cycle\", \"contact_force\", ...");
  s.key("factor", &P::factor)
      .initially(1.0)
      .when("kind", {"global"})
      .doc("What it is multiplied with: 0.01 for the force on 10 mm of a body in plane strain.");
  s.key("unit", &P::unit)
      .doc(
          "Unit of the column: \"degC\", \"mm\"; \"1\" for a fraction; with kind = \"global\" also \"\": no "
          "conversion, and a header without unit.");
  s.place(&P::where);
  return s;
}

namespace {

/// Keys of one column of a profile.
Section<ProfileColumnSpec> profile_column_keys() {
  using C = ProfileColumnSpec;
  Section<C> s("column", "A column of the table.");
  s.key("name", &C::name).doc("Header of the column; the unit is added in brackets.");
  s.key("field", &C::field).choices(coupling::field_names(true)).doc("The field, one at nodes.");
  s.key("component", &C::component)
      .initially("")
      .doc("Component of a vector or tensor, as in [[probe]]; \"magnitude\" of a vector.");
  s.key("unit", &C::unit).doc("Unit of the column.");
  s.place(&C::where);
  return s;
}

}  // namespace

/// Keys of [[profile]]: values along a line.
Section<ProfileSpec> profile_keys() {
  using P = ProfileSpec;
  Section<P> s("profile",
               "A table NAME.csv of fields along a group of nodes: one row per node, with its coordinates. "
               "It is written whenever fields are, and replaced each time.");
  s.key("name", &P::name).doc("A name of your choice: that of the file.");
  s.key("group", &P::group).doc("Group of the mesh: a surface, a body, points.");
  s.key("length_unit", &P::length_unit).initially("mm").doc("Unit of the coordinates.");
  s.sections("column", &P::columns, profile_column_keys());
  s.place(&P::where);
  return s;
}

/// Keys of [output]: when fields are written, which ones, in which formats, and in which units answers are
/// told.
Section<OutputSpec> output_keys() {
  Section<OutputSpec> s("output", "What is written, and when.");
  s.quantity("every", &OutputSpec::every, "s")
      .positive()
      .doc("Fields are written at each multiple of this time.");
  s.quantity("times", &OutputSpec::times, "s")
      .initially(Value::list())
      .positive()
      .doc("Fields are written at these times, met exactly.");
  s.key("stage_ends", &OutputSpec::stage_ends)
      .initially(true)
      .doc("Fields are written at the end of every stage too.");
  s.key("fields", &OutputSpec::fields)
      .initially(Value::list())
      .choices(coupling::field_names(false))
      .doc("The fields to write; empty: all except those that are written on request only.");
  for (const results::FieldFormat& format : results::field_formats())
    if (!format.doc.empty())
      s.key(std::string(format.name), &OutputSpec::formats).initially(false).doc(std::string(format.doc));
  s.key("checkpoint_every", &OutputSpec::checkpoint_every)
      .at_least(1)
      .doc(
          "A checkpoint is written every so many steps, in addition to those at every time at which fields "
          "are written and at the end of a run.");
  s.key("folder", &OutputSpec::folder)
      .doc("Results folder; `-o` takes precedence; without both it is results/CASE/VARIANT.");
  s.key("length_unit", &OutputSpec::length_unit)
      .initially("mm")
      .doc("Unit of places, gaps and distortion in the answers at the end of a run: \"mm\", \"inch\".");
  s.key("temperature_unit", &OutputSpec::temperature_unit)
      .initially("degC")
      .doc("Unit of temperatures there: \"degC\", \"degF\", \"K\".");
  s.key("stress_unit", &OutputSpec::stress_unit)
      .initially("MPa")
      .doc("Unit of stresses there: \"MPa\", \"ksi\".");
  s.place(&OutputSpec::where);
  return s;
}

}  // namespace solidus::cases
