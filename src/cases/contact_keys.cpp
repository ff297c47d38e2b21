/// Keys of contacts, interfaces and their heat, in the order of the manual.
#include "cases/case_keys.hpp"
#include "contact/laws/contact_law.hpp"
#include "contact/laws/gap_law.hpp"

namespace solidus::cases {

namespace {

/// Keys of one table of heat laws at a temperature of the interface.
Section<contact::HeatTransferSpec::AtTemperature> heat_table_keys() {
  using T = contact::HeatTransferSpec::AtTemperature;
  Section<T> s("at",
               "Tables at one temperature, in place of those in [contact.heat]; from cold to hot, linear "
               "between them and constant outside.");
  s.quantity("temperature", &T::temperature, "K")
      .positive()
      .doc("Mean temperature of the two surfaces at which these tables hold.");
  s.function("contact_conductance", &T::contact_conductance, "W/m2/K")
      .of({Argument::pressure})
      .at_least(0)
      .doc("Conductance as a table of the pressure, with contact_law = \"table\".");
  s.function("gap_conductance", &T::gap_table, "W/m2/K")
      .of({Argument::gap})
      .at_least(0)
      .doc("Conductance as a table of the gap, with gap_law = \"table\".");
  return s;
}

}  // namespace

/// Keys of the heat that passes through an interface: a law for closed contact, one for the gap, what smooths
/// the change between them, how resistance is divided, and radiation.
Section<contact::HeatTransferSpec> contact_heat_keys() {
  using H = contact::HeatTransferSpec;
  Section<H> s("heat", "Heat through the interface; without this section it is insulated.");
  s.kinds("contact_law", &H::contact_law, contact::contact_laws())
      .initially("power")
      .doc("Heat where the bodies touch.");
  s.kinds("gap_law", &H::gap_law, contact::gap_laws()).doc("Heat across the open gap.");
  s.sections("at", &H::families, heat_table_keys());
  s.key("smooth", &H::smooth)
      .initially(false)
      .doc("A continuous slope from contact to gap: cubic polynomials replace the laws in the transition.");
  s.quantity("transition_gap", &H::transition_gap, "m")
      .positive()
      .doc("Gap up to which the cubic polynomial replaces the law; without it 1 um.");
  s.quantity("transition_pressure", &H::transition_pressure, "Pa")
      .positive()
      .doc("Pressure up to which the cubic polynomial replaces the law; without it 0.1 MPa.");
  s.key("slave_resistance", &H::slave_resistance)
      .range(0.001, 0.999)
      .doc(
          "Fraction of the interface's resistance that lies between the slave (with `surfaces`: the first "
          "one) and the temperature of the interface: h1 = h / share, h2 = h / (1 - share) (3.45). It "
          "divides the heat of "
          "friction and places a coating on one side; without it a half, or what contact_law = \"sides\" "
          "says.");
  s.key("slave_emissivity", &H::slave_emissivity)
      .initially(0.0)
      .range(0, 1)
      .doc(
          "Emissivity of the slave's surface; where both are given, the surfaces radiate across the "
          "interface as grey bodies.");
  s.key("master_emissivity", &H::master_emissivity)
      .initially(0.0)
      .range(0, 1)
      .doc("Emissivity of the master's surface.");
  s.place(&H::where);
  return s;
}

/// Keys of [[interface]], which becomes contacts between the bodies named once the mesh is there.
Section<BodyInterfaceSpec> body_interface_keys() {
  using I = BodyInterfaceSpec;
  Section<I> s(
      "interface",
      "Contact between bodies, whose facing surfaces are found automatically: each pair A, B becomes a "
      "[[contact]] between the groups `A_to_B` and `B_to_A`. The part of the surface of A that faces no "
      "other body is the group `A_free`, for films; the part in a plane of symmetry is `A_symmetry`. Nodes "
      "that two such "
      "bodies share are split.");
  s.key("name", &I::name).initially("").doc("A name of your choice, that of the contact; without it `A_B`.");
  s.key("bodies", &I::bodies)
      .or_one()
      .doc(
          "Names of two bodies, or \"all\": every two bodies that face each other and have no interface or "
          "contact of their own. Castings and risers that share nodes stay one.");
  s.quantity("distance", &I::distance, "m")
      .positive()
      .doc(
          "How far apart faces may be that face each other; without it a quarter of the mean edge length of "
          "the finer of the two surfaces.");
  s.quantity("touching", &I::touching, "m").at_least(0).doc("As of a [[contact]].");
  s.key("law", &I::law)
      .initially("")
      .doc(
          "The card in the library of interface laws (`interfaces/`); without it the one that fits the "
          "materials and roles best.");
  s.key("wet", &I::wet).initially(true).doc("As of a [[contact]].");
  s.section("heat", &I::heat, contact_heat_keys());
  s.section("friction", &I::friction, friction_keys());
  s.key("stages", &I::stages)
      .or_one()
      .initially(Value::list())
      .doc("The stages in which it holds; empty: in all.");
  s.place(&I::where);
  return s;
}

namespace {

/// Declares how pressure follows from penetration.
void pressure_keys(Section<ContactSpec>& s) {
  using C = ContactSpec;
  using Normal = C::Normal;
  s.choice(
       "normal", &C::normal,
       {{"automatic", Normal::automatic,
         "penalty; with [dynamics] energy_conserving; in a case in which nothing melts, unless it gives a "
         "penalty, augmented_lagrangian until an augmentation changes pressures by less than 1 % of the "
         "largest, with "
         "friction or large sliding by less than 5 %"},
        {"penalty", Normal::penalty, "pressure = penalty x penetration (3.43)"},
        {"augmented_lagrangian", Normal::augmented_lagrangian,
         "the same with Lagrange multipliers, which are updated until the penetration is within its "
         "tolerance"},
        {"energy_conserving", Normal::energy_conserving,
         "mean over the step by the difference quotient of the energy (5.19)"}})
      .initially("automatic")
      .doc("How pressure follows penetration.");
  s.key("penetration_tolerance", &C::penetration_tolerance)
      .initially(1e-6)
      .range(1e-12, 0.1)
      .when("normal", {"augmented_lagrangian"})
      .doc(
          "Penetration that the augmented Lagrangian leaves, as a share of the mean size of the slave's "
          "faces.");
  s.quantity("penalty", &C::penalty, "N/m3")
      .positive()
      .doc("Pressure per penetration; without it from `penalty_factor`.");
  s.key("penalty_factor", &C::penalty_factor)
      .positive()
      .doc(
          "Penalty = factor x Young's modulus / height of the elements, of the stiffer of the two surfaces. "
          "Without it and `penalty` the factor is 10, with integration = \"mortar\" 100; next to a melt the "
          "penalty is then at most that with which the `atmosphere` moves a liquid surface by 0.1 % of the "
          "free contraction of ten moduli (volume over cooling surface) of the body. With normal = "
          "\"penalty\" it rises as the surface of the casting gets solid, to the factor times the stiffness "
          "of the softer surface, if both bodies have a Young's modulus.");
  s.key("stabilisation", &C::stabilisation)
      .initially(1e-8)
      .range(0, 1)
      .doc(
          "Fraction of the penalty that is always in the matrix, but not in the forces: for bodies that lose "
          "their support.");
}

/// Declares where contact is integrated.
void integration_keys(Section<ContactSpec>& s) {
  using C = ContactSpec;
  using contact::IntegrationRule;
  s.choice("integration", &C::integration,
           {{"automatic", IntegrationRule::automatic, "segments with small sliding, Gauss points with large"},
            {"segments", IntegrationRule::segments,
             "slave faces cut where master faces end: exact on non-matching meshes; with large sliding cut "
             "again in every configuration, with means over halves of lines and quarters of faces (on a "
             "rigid surface: Gauss points)"},
            {"mortar", IntegrationRule::mortar,
             "means over segments around the slave's nodes: no oscillating pressures with stiff penalties, "
             "small sliding only"},
            {"nodal", IntegrationRule::nodal, "at the slave's nodes"},
            {"gauss", IntegrationRule::gauss, "at Gauss points of the slave's faces"}})
      .initially("automatic")
      .doc("Where contact is integrated.");
  s.key("gauss_degree", &C::gauss_degree)
      .initially(4)
      .range(1, 5)
      .doc("Polynomial degree that integration = \"gauss\" integrates exactly.");
}

/// Declares how far partners are looked for, which gaps there are at the start, and melt on its wall.
void first_gap_keys(Section<ContactSpec>& s) {
  using C = ContactSpec;
  s.quantity("search_distance", &C::search_distance, "m")
      .positive()
      .doc(
          "Largest distance at which opposite points are searched; without it a tenth of the slave's "
          "extent.");
  s.quantity("touching", &C::touching, "m")
      .at_least(0)
      .doc(
          "Initial gaps and penetrations up to this size count as touching, larger ones stay as in the mesh. "
          "Without it the initial gap is that between the curved surfaces that the facets approximate, and a "
          "rest of it, up to a quarter of the height of the facets, counts as touching.");
  s.key("wet", &C::wet)
      .initially(true)
      .doc(
          "Liquid metal is held on the wall by the atmosphere until its solid fraction reaches the "
          "coherency_fraction of its material, and conducts heat as closed contact until then. Without it a "
          "gap opens as soon as the metal would pull. It has no effect on bodies that never melt.");
  s.quantity("atmosphere", &C::atmosphere, "Pa")
      .initially("101325 Pa")
      .positive()
      .doc(
          "The pressure with which liquid metal is held on the wall, where `wet`: less than the atmosphere's "
          "where gas can pass the wall.");
}

}  // namespace

/// Keys of [[contact]]: both surfaces, how partners are found, how pressure follows from penetration, where
/// it is integrated, gaps at the start, melt on its wall, and the sections of heat, friction and wear.
Section<ContactSpec> contact_keys() {
  using C = ContactSpec;
  Section<C> s("contact", "Two surfaces that may touch, slide and part: unilateral contact.");
  s.key("name", &C::name).doc("A name of your choice.");
  s.key("slave", &C::slave)
      .initially("")
      .doc("Surface group that is integrated over: the finer or softer one.");
  s.key("master", &C::master)
      .initially("")
      .doc("Surface group onto which the slave is projected, or a [[rigid_surface]].");
  s.key("surfaces", &C::surfaces)
      .initially(Value::list())
      .doc(
          "Both groups instead of `slave` and `master`: the one with the smaller faces becomes the slave, of "
          "two alike the softer one.");
  using contact::Formulation;
  s.choice(
       "formulation", &C::formulation,
       {{"small_sliding", Formulation::small_sliding,
         "once, in the initial configuration: for surfaces that move little along each other"},
        {"large_sliding", Formulation::large_sliding, "as the closest point in the current configuration"}})
      .initially("small_sliding")
      .doc("How the point opposite to a contact point is found.");
  s.key("smoothing", &C::smoothing)
      .initially(false)
      .when("formulation", {"large_sliding"})
      .doc("Averaged normals of the master, so that the force does not jump from face to face.");
  pressure_keys(s);
  integration_keys(s);
  first_gap_keys(s);
  s.section("heat", &C::heat, contact_heat_keys());
  s.section("friction", &C::friction, friction_keys());
  s.section("wear", &C::wear, wear_keys());
  s.section("interface", &C::interface, interface_keys());
  s.key("stages", &C::stages)
      .or_one()
      .initially(Value::list())
      .doc(
          "The stages in which it holds; empty: in all. In the others neither force nor heat passes between "
          "the surfaces.");
  s.place(&C::where);
  return s;
}

}  // namespace solidus::cases
