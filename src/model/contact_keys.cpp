#include "model/case_keys.hpp"

namespace solidus::model {

namespace {

Section<contact::HeatTransferSpec> contact_heat_keys() {
  using H = contact::HeatTransferSpec;
  Section<H> s("heat", "Heat through the interface; without this section it is insulated.");
  s.quantity("conductance", &H::conductance, "W/m2/K")
      .positive()
      .doc("h_co, from body to body: where the bodies touch, and where the gap law starts at a gap of zero.");
  s.key("exponent", &H::exponent)
      .initially(0.0)
      .range(0, 2)
      .doc(
          "Exponent of h = h_open(0) + h_co (p / hardness)^exponent where the bodies touch (3.49); zero: "
          "h_co.");
  s.quantity("hardness", &H::hardness, "Pa").positive().doc("Hardness H_e of 3.49; needed with an exponent.");
  s.choice("gap_law", &H::gap_law,
           {{"constant", H::GapLaw::constant, "the conductance whatever the gap"},
            {"table", H::GapLaw::table, "a table of the gap"},
            {"gas", H::GapLaw::gas, "conduction through gas, k / (gap + k / open_conductance) (3.50)"}})
      .doc("Heat across the open gap.");
  s.function("gap_conductance", &H::gap_table, "W/m2/K")
      .of({Argument::gap})
      .at_least(0)
      .when("gap_law", {"table"})
      .doc("Conductance as a table of the gap; without an exponent it starts at the conductance.");
  s.quantity("gas_conductivity", &H::gas_conductivity, "W/m/K")
      .positive()
      .when("gap_law", {"gas"})
      .doc("Conductivity of the gas in the gap.");
  s.quantity("open_conductance", &H::open_conductance, "W/m2/K")
      .positive()
      .when("gap_law", {"constant", "gas"})
      .doc("h_o, the conductance of the interface that has just opened; without it the conductance.");
  s.key("slave_emissivity", &H::slave_emissivity)
      .initially(0.0)
      .range(0, 1)
      .doc("Emissivity of the slave's surface; with both, grey bodies radiate across the interface.");
  s.key("master_emissivity", &H::master_emissivity)
      .initially(0.0)
      .range(0, 1)
      .doc("Emissivity of the master's surface.");
  s.place(&H::where);
  return s;
}

}  // namespace

Section<ContactSpec> contact_keys() {
  using C = ContactSpec;
  using contact::IntegrationRule;
  Section<C> s("contact",
               "Two surfaces that may touch and part: unilateral contact without friction, small sliding.");
  s.key("name", &C::name).doc("A name of your choice.");
  s.key("slave", &C::slave).doc("Surface group that is integrated over: the finer or softer one.");
  s.key("master", &C::master).doc("Surface group that it is projected on.");
  s.quantity("penalty", &C::penalty, "N/m3")
      .positive()
      .doc("Pressure per penetration; without it from `penalty_factor`.");
  s.key("penalty_factor", &C::penalty_factor)
      .initially(10.0)
      .positive()
      .doc(
          "Penalty = factor x Young's modulus / height of the elements, of the stiffer of the two surfaces.");
  s.key("stabilisation", &C::stabilisation)
      .initially(1e-10)
      .range(0, 1)
      .doc(
          "Share of the penalty that the matrix, not the forces, always holds: for bodies that lose their "
          "support.");
  s.choice("integration", &C::integration,
           {{"segments", IntegrationRule::segments,
             "slave faces cut where master faces end: exact on non-matching meshes"},
            {"nodal", IntegrationRule::nodal, "at the slave's nodes"},
            {"gauss", IntegrationRule::gauss, "at Gauss points of the slave's faces"}})
      .initially("segments")
      .doc("Where contact is integrated.");
  s.key("gauss_degree", &C::gauss_degree)
      .initially(4)
      .range(1, 5)
      .doc("Polynomial degree that integration = \"gauss\" integrates exactly.");
  s.quantity("search_distance", &C::search_distance, "m")
      .positive()
      .doc("How far partners are looked for; without it a tenth of the slave's extent.");
  s.quantity("touching", &C::touching, "m")
      .at_least(0)
      .doc("Initial gaps and penetrations up to this size count as touching; without it rounding only.");
  s.section("heat", &C::heat, contact_heat_keys());
  s.key("stages", &C::stages)
      .or_one()
      .initially(Value::list())
      .doc("The stages in which it holds; empty: in all. In the others nothing passes between the surfaces.");
  s.place(&C::where);
  return s;
}

}  // namespace solidus::model
