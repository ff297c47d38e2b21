/// The parts are made in the order in which they need each other: the law with its penalty, then the
/// multipliers, then the term of the mechanical phase, which refers to both.
#include "contact/forces/forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contact/points/penalty.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::contact {

namespace {

PointLaw law_of(const ContactParameters& spec, double penalty) {
  PointLaw law;
  law.normal = {spec.normal, penalty};
  // Solid bodies may have a stiffer penalty than melt; friction has a tangential penalty of its own or a
  // share of the normal one.
  if (spec.normal == NormalKind::penalty) law.stiffening = std::max(spec.solid_penalty / penalty, 1.0);
  if (!spec.friction) return law;
  const FrictionParameters& friction = *spec.friction;
  law.friction.emplace(friction,
                       friction.tangential_penalty.value_or(friction.tangential_penalty_factor * penalty),
                       spec.interface_heat_capacity);
  law.friction_stiffens = !friction.tangential_penalty;
  law.wear = spec.wear;
  return law;
}

}  // namespace

ContactForces::ContactForces(const ContactGeometry& geometry, const ContactParameters& spec,
                             const PairSurfaces& surfaces, std::span<const double> body_modulus,
                             const ContactStep& step)
    : step_(step),
      law_(law_of(spec, penalty_of(geometry.mesh(), spec, surfaces, body_modulus))),
      symmetric_(spec.friction ? spec.friction->symmetric : geometry.kinematics().symmetric()),
      multipliers_(geometry, law_.normal, spec.penetration_tolerance * geometry.face_size(),
                   geometry.face_size(), spec.pressure_tolerance,
                   stiffness_of(geometry.mesh(), surfaces, body_modulus)),
      term_(spec.name, geometry, law_, step, active_, spec.stabilisation,
            spec.friction && spec.friction->symmetric) {
  term_.follow_weights(!symmetric_);
}

void ContactForces::activate(bool on) {
  active_ = on;
}

void ContactForces::begin(bool isentropic, double share, bool goes_on) {
  multipliers_.begin(goes_on);
  term_.stabilisation().hold(1);
  law_.isentropic = isentropic;
  law_.share = share;
}

PointForces ContactForces::at(const PointMotion& motion, Index point) const {
  if (!active_) return {};
  return law_.forces(motion, step_.from[as_size(point)], step_.coupled.around(motion),
                     step_.iterate_of(point));
}

GlobalIndex changes(const MechanicsTerm& term) {
  return std::llround(parallel::global_sum(static_cast<double>(term.outcome().changes)));
}

std::string failure_text(const MechanicsTerm& term, const std::string& name) {
  const FrictionStatus failure = term.outcome().failure;
  if (parallel::any_process(failure != FrictionStatus::converged)) {
    const double worst = parallel::global_max(static_cast<double>(failure));
    return fmt::format("contact '{}': {}", name, reason(static_cast<FrictionStatus>(std::lround(worst))));
  }
  const GlobalIndex n = changes(term);
  if (n == 0) return {};
  return fmt::format("contact '{}': {} points still change between open, sticking and slipping", name, n);
}

}  // namespace solidus::contact
