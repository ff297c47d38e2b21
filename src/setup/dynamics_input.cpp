/// Parameters of the integrator from the method's name and its damping, and checks of the velocities.
#include "setup/dynamics_input.hpp"

#include <fmt/format.h>

#include "numbers/index_casts.hpp"

namespace solidus::setup {

namespace {

using Method = cases::DynamicsSpec::Method;

mechanics::Motion motion(const cases::DynamicsSpec& dynamics) {
  using mechanics::Motion;
  switch (dynamics.method) {
    case Method::backward_euler:
      break;
    case Method::newmark:
      return Motion::newmark(dynamics.gamma, dynamics.beta);
    case Method::trapezoidal:
      return Motion::trapezoidal();
    case Method::generalised_alpha:
      return Motion::generalised_alpha(dynamics.spectral_radius);
  }
  return Motion::backward_euler();
}

void check_velocity(const cases::BodySpec& body, const cases::CaseSpec& spec) {
  if (body.initial_velocity.empty()) return;
  if (!spec.dynamics)
    throw InputError(body.where,
                     fmt::format("the body '{}' has an initial velocity, but no inertia", body.name),
                     "a section [dynamics], or no initial_velocity");
  const auto dimension = as_size(spec.dimension());
  if (body.initial_velocity.size() != dimension)
    throw InputError(body.where,
                     fmt::format("the initial velocity of the body '{}' has {} components", body.name,
                                 body.initial_velocity.size()),
                     fmt::format("{} in this analysis", dimension));
}

}  // namespace

std::string method_name(const cases::DynamicsSpec& dynamics) {
  switch (dynamics.method) {
    case Method::backward_euler:
      return "backward_euler";
    case Method::generalised_alpha:
      return "generalised_alpha";
    case Method::newmark:
    case Method::trapezoidal:
      break;
  }
  return "newmark";
}

std::optional<mechanics::DynamicsOptions> dynamics_options(const cases::CaseSpec& spec) {
  if (!spec.dynamics) return {};
  mechanics::DynamicsOptions options;
  options.mass = spec.dynamics->mass;
  options.motion = motion(*spec.dynamics);
  for (const cases::BodySpec& body : spec.bodies) {
    std::array<double, 3>& velocity = options.initial_velocity.emplace_back();
    for (std::size_t i = 0; i < body.initial_velocity.size(); ++i) velocity[i] = body.initial_velocity[i];
  }
  return options;
}

void check_dynamics(const cases::CaseSpec& spec) {
  for (const cases::BodySpec& body : spec.bodies) check_velocity(body, spec);
  // Without the section there is no inertia, and nothing to contradict.
  if (!spec.dynamics) return;
  const cases::DynamicsSpec& d = *spec.dynamics;
  if (!spec.has_mechanics())
    throw InputError(d.where, "there is no mechanics in this analysis that inertia could act in",
                     "physics = \"mechanics\" or \"thermomechanical\", or no [dynamics]");
  if (d.method != Method::newmark) return;
  constexpr double k_rounding = 1e-12;  // as mechanics::Motion allows
  // The least beta for which every step is stable follows from gamma.
  const double least = mechanics::Motion::least_beta(d.gamma);
  if (d.beta < least * (1 - k_rounding))
    throw InputError(
        d.where,
        fmt::format("Newmark's method with gamma = {} and beta = {} is not stable for every step", d.gamma,
                    d.beta),
        fmt::format("beta of {} or more", least));
}

}  // namespace solidus::setup
