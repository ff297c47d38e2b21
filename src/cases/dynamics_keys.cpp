/// Keys of [dynamics].
#include "cases/case_keys.hpp"

namespace solidus::cases {

/// Keys of [dynamics]: mass matrix and integrator. Parameters belong to the method that they are keys of.
Section<DynamicsSpec> dynamics_keys() {
  using D = DynamicsSpec;
  Section<D> s("dynamics", "Inertia. Its presence switches it on; without it bodies are in equilibrium.");
  using mechanics::MassKind;
  s.choice("mass", &D::mass,
           {{"consistent", MassKind::consistent, "of the shape functions"},
            {"lumped", MassKind::lumped, "diagonal: row sums, in quadratic elements diagonal scaling"}})
      .initially("consistent")
      .doc("The mass matrix.");
  s.choice("method", &D::method,
           {{"backward_euler", D::Method::backward_euler,
             "first order, damps oscillations with a period of less than some tens of steps"},
            {"newmark", D::Method::newmark, "with gamma and beta; first order unless gamma = 0.5"},
            {"trapezoidal", D::Method::trapezoidal,
             "gamma = 0.5, beta = 0.25: second order, keeps the energy of linear elastic bodies"},
            {"generalised_alpha", D::Method::generalised_alpha,
             "second order, damps the highest frequencies to spectral_radius a step"}})
      .initially("generalised_alpha")
      .doc(
          "Time integration of displacement, velocity and acceleration; all methods are stable for every "
          "step in linear dynamics.");
  s.key("gamma", &D::gamma)
      .initially(0.6)
      .when("method", {"newmark"})
      .range(0.5, 1)
      .doc("Below 0.5 oscillations would grow; above, they are damped.");
  s.key("beta", &D::beta)
      .initially(0.3025)
      .when("method", {"newmark"})
      .positive()
      .doc("At least (gamma + 0.5)^2 / 4, for stability in every step.");
  s.key("spectral_radius", &D::spectral_radius)
      .initially(0.8)
      .when("method", {"generalised_alpha"})
      .range(0, 1)
      .doc(
          "Factor by which a step reduces the amplitude of the highest frequencies: 1 damps nothing, 0 "
          "removes them at once.");
  s.place(&D::where);
  return s;
}

}  // namespace solidus::cases
