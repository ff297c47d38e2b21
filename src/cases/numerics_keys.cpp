/// Keys of [heat], [mechanics] and [coupling]; schemes add their own.
#include "cases/case_keys.hpp"
#include "coupling/scheme_kind.hpp"
#include "input/kinds.hpp"

namespace solidus::cases {

namespace {

template <class S>
Key& solver_choice(Section<S>& s) {
  using linear::SolverKind;
  return s
      .choice("solver", &S::solver,
              {{"automatic", SolverKind::automatic, "by analysis kind and size"},
               {"direct", SolverKind::direct, "MUMPS"},
               {"multigrid", SolverKind::multigrid, "conjugate gradients with algebraic multigrid"},
               {"incomplete", SolverKind::incomplete, "conjugate gradients with incomplete Cholesky"},
               {"jacobi", SolverKind::jacobi, "conjugate gradients with Jacobi's preconditioner"}})
      .initially("automatic");
}

}  // namespace

/// Keys of [heat]: integration rule, forms of heat, stepping, bounds of temperature, tolerances and solver.
Section<heat::HeatOptions> heat_keys() {
  using heat::HeatIntegration;
  using heat::HeatOptions;
  Section<HeatOptions> s("heat", "Numerics of the thermal phase.");
  s.choice("integration", &HeatOptions::integration,
           {{"closed", HeatIntegration::closed, "at the nodes: no over- or undershoot"},
            {"open", HeatIntegration::open,
             "at Gauss points, but at the nodes of bodies whose material has an isothermal change"}})
      .initially("closed")
      .doc("Where in an element the heat content is integrated (monograph 6.3).");
  using heat::ThermalStepping;
  s.choice(
       "stepping", &HeatOptions::stepping,
       {{"automatic", std::nullopt,
         "sdirk2, but backward_euler with inertia, with forms of structural heat of first order and in "
         "schemes that have their own time integration"},
        {"sdirk2", ThermalStepping::sdirk2,
         "two implicit stages, second order, L-stable (Alexander 1977); a step that would overshoot is of "
         "first order"},
        {"backward_euler", ThermalStepping::backward_euler, "one stage, first order"}})
      .initially("automatic")
      .doc("Integration in time, with heat alone and in schemes whose thermal phase is solved by itself.");
  s.key("open_degree", &HeatOptions::open_degree)
      .initially(0)
      .range(0, 10)
      .doc("Polynomial degree that the open rule integrates exactly; 0: by element.");
  s.key("tolerance", &HeatOptions::tolerance)
      .initially(0.0)
      .range(0, 0.1)
      .doc(
          "Newton stops when the residual falls below this fraction of the heat moved in the step. 0: 1e-6 "
          "with the closed rule, where the nodes store the remaining residual as heat, so that energy is "
          "conserved with every tolerance; else 1e-9, because there the remaining residual is heat lost or "
          "gained.");
  s.key("max_iterations", &HeatOptions::max_iterations)
      .initially(50)
      .range(1, 1000)
      .doc("Newton iterations before a step is cut.");
  s.key("bounds", &HeatOptions::bounds)
      .initially(true)
      .doc(
          "Closed rule: limits conduction where obtuse, bent or quadratic elements would let temperatures "
          "leave the range of the initial and boundary ones (docs/theory/thermal.md); linear fields and "
          "smooth temperatures stay as they are.");
  s.key("edges", &HeatOptions::edges)
      .initially(true)
      .doc(
          "Corrects conduction in linear triangles and tetrahedra at re-entrant edges of a body, such as the "
          "sand along the rims of a casting, where these elements conduct too well "
          "(docs/theory/thermal.md).");
  solver_choice(s).doc("Linear solver; PETSc options with the prefix -heat_ change it further.");
  return s;
}

namespace {

/// Declares Newton's iteration and how far its linear systems are solved.
void equilibrium_keys(Section<MechanicsSpec>& s) {
  s.key("tolerance", &MechanicsSpec::tolerance)
      .initially(1e-5)
      .range(1e-14, 0.1)
      .doc(
          "Newton stops when the residual falls below this fraction of the forces on a body; the monograph "
          "uses 1e-3 (chapter 7).");
  s.key("displacement_tolerance", &MechanicsSpec::displacement_tolerance)
      .initially(1e-3)
      .range(0, 1)
      .doc(
          "Newton's second criterion: the next iteration would change the displacement by less than this "
          "fraction of the body's displacement in the time step. The residual alone says little about a "
          "casting that is hardly held. 0: the residual alone, the criterion of the monograph.");
  s.key("max_iterations", &MechanicsSpec::max_iterations)
      .initially(50)
      .range(1, 1000)
      .doc("Newton iterations before a step is cut.");
  s.key("line_search", &MechanicsSpec::line_search)
      .initially(true)
      .doc("Shorten Newton's steps where the full step does not reduce the residual or the energy enough.");
  s.key("inexact_newton", &MechanicsSpec::inexact)
      .initially(true)
      .doc(
          "Linear systems are solved only as accurately as the Newton iteration needs (Eisenstat and Walker "
          "1996); false: always to linear_tolerance. Newton's criterion is the same. It also holds for a "
          "scheme that solves both fields at once.");
  s.key("linear_tolerance", &MechanicsSpec::linear_tolerance)
      .initially(1e-8)
      .range(1e-15, 0.1)
      .doc(
          "Smallest relative residual to which an iterative solver solves a linear system. It also holds for "
          "a scheme that solves both fields at once.");
}

/// Declares the elements and their stabilisation.
void formulation_keys(Section<MechanicsSpec>& s) {
  s.key("b_bar", &MechanicsSpec::b_bar)
      .initially(true)
      .doc(
          "Averages the volumetric strain of quads and hexahedra: constant in an element of first order, "
          "linear in one of second order (Q1/P0 and Q2/P1, monograph 6.2), so that they do not lock.");
  using mechanics::Simplices;
  s.choice("simplices", &MechanicsSpec::simplices,
           {{"automatic", Simplices::automatic,
             "mixed where a body's material melts, flows plastically or has a Poisson's ratio above 0.45; "
             "else displacement"},
            {"mixed", Simplices::mixed, "displacement and continuous pressure, stabilised: no locking"},
            {"displacement", Simplices::displacement, "displacement alone, which locks in plastic flow"}})
      .initially("automatic")
      .doc("Formulation of linear triangles and tetrahedra; for other shapes see b_bar.");
  using mechanics::Stabilisation;
  s.choice("stabilisation", &MechanicsSpec::stabilisation,
           {{"automatic", Stabilisation::automatic, "algebraic in quasi-statics, orthogonal with inertia"},
            {"orthogonal", Stabilisation::orthogonal, "orthogonal sub-grid scales"},
            {"algebraic", Stabilisation::algebraic, "algebraic sub-grid scales, without inertia"}})
      .initially("automatic")
      .doc("Stabilisation of the pressure in mixed triangles and tetrahedra (Codina 2000).");
}

}  // namespace

/// Keys of [mechanics]: integration of the law, elements and their stabilisation, tolerances and solver.
Section<MechanicsSpec> mechanics_keys() {
  Section<MechanicsSpec> s("mechanics", "Numerics of the mechanical phase.");
  equilibrium_keys(s);
  formulation_keys(s);
  using mechanics::TimeIntegration;
  s.choice(
       "integration", &MechanicsSpec::integration,
       {{"backward_euler", TimeIntegration::backward_euler, "first order, no oscillations"},
        {"bdf2", TimeIntegration::two_step,
         "two-step method of second order; the first step, and one more than 2.4 times as long as the one "
         "before, by backward Euler"}})
      .initially("backward_euler")
      .doc("Time integration of inelastic strains (monograph 4.64-4.73).");
  solver_choice(s).doc("Linear solver; PETSc options with the prefix -mechanics_ change it further.");
  return s;
}

/// Keys of [coupling]: scheme, order of the phases, structural heat, and what of a step is solved again.
Section<CouplingSpec> coupling_keys() {
  Section<CouplingSpec> s("coupling", "How the two phases are solved together.");
  s.place(&CouplingSpec::where);
  s.kinds("scheme", &CouplingSpec::scheme, coupling::schemes())
      .initially(std::string(coupling::default_scheme()->name()))
      .doc("The coupling scheme; without effect with heat or mechanics alone.");
  using Heating = CouplingSpec::StructuralHeatForm;
  s.choice(
       "structural_heating", &CouplingSpec::structural_heating,
       {{"energy", Heating::energy,
         "difference of the structural energy, less the stress power: conserves energy"},
        {"entropy", Heating::entropy,
         "temperature x difference of the structural entropy, less dissipation (4.43a; isothermal: 4.48a "
         "with 4.50 collapsed)"},
        {"literal", Heating::literal,
         "after an isothermal mechanical phase only: the difference to the entropy after the mechanical "
         "phase, and structural "
         "heating H^ep (4.48a, 4.50)"},
        {"temperature", Heating::temperature,
         "after an isothermal mechanical phase only: heat capacity C and structural heating H^ep (4.53a)"},
        {"none", Heating::none, "deformation neither takes up nor releases heat"}})
      .initially("energy")
      .doc("How deformation and viscous dissipation enter the heat balance.");
  s.key("as_printed", &CouplingSpec::as_printed)
      .initially(false)
      .doc(
          "Sensible heat in the form of `structural_heating` too, as the monograph prints it: temperature x "
          "difference of entropy, or capacity x difference of temperature. Each step loses heat of second "
          "order in the step.");
  s.quantity("ambient_temperature", &CouplingSpec::ambient_temperature, "K")
      .positive()
      .doc(
          "Reference temperature of the stability functional 2.24; without it the common temperature of the "
          "surroundings, or the lowest initial temperature.");
  return s;
}

}  // namespace solidus::cases
