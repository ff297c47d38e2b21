#include "model/case_keys.hpp"

namespace solidus::model {

namespace {

template <class S>
Key& solver_choice(Section<S>& s) {
  using algebra::SolverKind;
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

Section<heat::HeatOptions> heat_keys() {
  using heat::HeatOptions;
  using heat::Integration;
  Section<HeatOptions> s("heat", "Numerics of the thermal phase.");
  s.choice("integration", &HeatOptions::integration,
           {{"closed", Integration::closed, "heat content at the nodes: no over- or undershoot"},
            {"open", Integration::open, "heat content at Gauss points"}})
      .initially("closed")
      .doc("Where heat content is integrated (monograph 6.3).");
  s.key("open_degree", &HeatOptions::open_degree)
      .initially(0)
      .range(0, 10)
      .doc("Polynomial degree that the open rule integrates exactly; 0: by element.");
  s.key("tolerance", &HeatOptions::tolerance)
      .initially(1e-9)
      .positive()
      .doc("Newton stops when the residual falls below this share of the heat moved in the step.");
  s.key("max_iterations", &HeatOptions::max_iterations)
      .initially(50)
      .range(1, 1000)
      .doc("Newton iterations before a step is cut.");
  s.key("exact_conductivity", &HeatOptions::exact_conductivity)
      .initially(false)
      .doc("The slope of the conductivity enters the tangent: fewer iterations, an unsymmetric matrix.");
  solver_choice(s).doc("Linear solver; PETSc options with the prefix -heat_ change it further.");
  return s;
}

Section<MechanicsSpec> mechanics_keys() {
  Section<MechanicsSpec> s("mechanics", "Numerics of the mechanical phase.");
  s.key("tolerance", &MechanicsSpec::tolerance)
      .initially(1e-3)
      .positive()
      .doc("Newton stops when the residual falls below this share of the forces.");
  s.key("max_iterations", &MechanicsSpec::max_iterations)
      .initially(50)
      .range(1, 1000)
      .doc("Newton iterations before a step is cut.");
  s.key("line_search", &MechanicsSpec::line_search)
      .initially(true)
      .doc("Shorten Newton's steps where they do not help.");
  s.key("b_bar", &MechanicsSpec::b_bar)
      .initially(true)
      .doc("Mean volumetric strain per element in quads and hexahedra (Q1/P0, monograph 6.2): no locking.");
  using mechanics::TimeIntegration;
  s.choice(
       "integration", &MechanicsSpec::integration,
       {{"backward_euler", TimeIntegration::backward_euler, "first order, no oscillations"},
        {"bdf2", TimeIntegration::two_step,
         "two-step method of second order; the first step, and one more than 2.4 times as long as the one "
         "before, by backward Euler"}})
      .initially("backward_euler")
      .doc("How inelastic strains advance in time (monograph 4.64-4.73).");
  solver_choice(s).doc("Linear solver; PETSc options with the prefix -mechanics_ change it further.");
  return s;
}

Section<CouplingSpec> coupling_keys() {
  Section<CouplingSpec> s("coupling", "How the two phases take turns.");
  s.place(&CouplingSpec::where);
  s.choice("scheme", &CouplingSpec::scheme,
           {{"isothermal", CouplingSpec::Scheme::isothermal,
             "mechanical phase at fixed temperature, then thermal phase at fixed configuration"},
            {"isentropic", CouplingSpec::Scheme::isentropic,
             "mechanical phase at fixed entropy of every point, then the same: stable however strongly "
             "deformation and heat are coupled"}})
      .initially("isothermal")
      .doc("The operator split. With heat or mechanics alone there is nothing to split.");
  using Heating = CouplingSpec::StructuralHeating;
  s.choice("structural_heating", &CouplingSpec::structural_heating,
           {{"entropy", Heating::entropy,
             "temperature x difference of the structural entropy, less dissipation (4.48a)"},
            {"energy", Heating::energy,
             "difference of the structural energy, less the stress power: closes the first law"},
            {"none", Heating::none, "deformation neither takes up nor releases heat"}})
      .initially("entropy")
      .doc("How deformation and viscous dissipation enter the heat balance.");
  return s;
}

}  // namespace solidus::model
