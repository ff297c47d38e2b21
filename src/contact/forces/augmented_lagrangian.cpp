/// The multipliers rise in one of two ways: by means around nodes with lengthened steps (Aitken), which
/// keeps pressures smooth along a face, and by single points with secants, where means alternate between
/// two patterns of contact.
#include "contact/forces/augmented_lagrangian.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/points/point_law.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::contact {

namespace {}  // namespace

void AugmentedLagrangian::accelerate(const std::vector<double>& penetration) {
  constexpr double k_longest = 30;
  // At the first augmentation of a step nothing is known of how penetrations fall: every node takes
  // the plain step.
  if (last_penetration_.size() != penetration.size()) {
    step_factor_.assign(penetration.size(), 1.0);
  } else {
    // Aitken's factor by the ratio in which penetrations fall, not below the plain step and not far above it.
    for (std::size_t i = 0; i < penetration.size(); ++i) {
      const double last = last_penetration_[i], fallen = last - penetration[i];
      const double ratio = fallen != 0 ? last / fallen : 1.0;
      step_factor_[i] = ratio > 0 ? std::clamp(step_factor_[i] * ratio, 1.0, k_longest) : 1.0;
    }
  }
  last_penetration_ = penetration;
}

std::vector<double> AugmentedLagrangian::step_of_points(const ContactState& now, const ContactStep& step) {
  // The plain step of each point adds penalty times penetration to its multiplier (Uzawa's rule), which never
  // falls below what suction allows. Its convergence is linear; the secants of the steps before shorten the
  // way.
  constexpr double k_longest = 1e3;  // times the largest plain step
  // Scalar products count each point once, on the process that counts it, and are sums over all processes.
  const ContactKinematics& kinematics = geometry_.kinematics();
  const Secants::Dot dot = [&](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t p = 0; p < a.size(); ++p)
      if (kinematics.particle(as_index(p)).counted) sum += a[p] * b[p];
    return parallel::global_sum(sum);
  };
  const auto largest_of = [](const std::vector<double>& values) {
    double most = 0;
    for (const double value : values) most = std::max(most, std::abs(value));
    return parallel::global_max(most);
  };
  std::vector<double> plain;
  // An open point keeps the least multiplier: its penetration says nothing of its pressure.
  for (std::size_t p = 0; p < step.from.size(); ++p) {
    const double least = least_multiplier(step.from[p]), multiplier = step.from[p].multiplier;
    const bool open = now.points[p].status == PointStatus::open;
    plain.push_back((open ? least : std::max(least, multiplier + law_.penalty * now.points[p].penetration)) -
                    multiplier);
  }
  // The step by secants is shortened where it would go far beyond the largest plain step, and open points
  // take the plain one.
  secants_.look(plain, dot);
  std::vector<double> by_secants = secants_.step(dot);
  const double most = k_longest * largest_of(plain), length = largest_of(by_secants);
  for (std::size_t p = 0; p < by_secants.size(); ++p) {
    if (length > most) by_secants[p] *= most / length;
    if (now.points[p].status == PointStatus::open) by_secants[p] = plain[p];
  }
  return by_secants;
}

void AugmentedLagrangian::augment(const ContactState& now, ContactStep& step, AugmentedBy by) {
  if (!acts() || ended_) return;
  // The state before is kept for take_back(), by which the last augmentation ends without effect.
  if (may_end_) {
    left_ = largest(now).penetration;
    before_.clear();
    for (const ContactPointState& from : step.from) before_.push_back({from.multiplier, from.traction});
  }
  const bool by_means = by == AugmentedBy::means;
  // Where steps of points are chosen by means around nodes, a point takes what its nodes say, so
  // that pressures stay smooth along a face; by points each one follows its own penetration.
  std::vector<double> penetration;
  if (by_means) {
    penetration = nodal_penetration(geometry_, now);
    accelerate(penetration);
  }
  std::vector<double> step_of_point;
  if (!by_means) step_of_point = step_of_points(now, step);
  const ContactKinematics& kinematics = geometry_.kinematics();
  // Sticking keeps the compliance of its penalty where no one asked for multipliers, and where augmentations
  // by means have not settled: points that are more than a face can follow would drive their tangential
  // tractions to and fro from one augmentation to the next.
  const bool tangential = !pressure_tolerance_ && by_means;
  if (tangential && step.start_traction.empty())
    for (const ContactPointState& from : step.from) step.start_traction.push_back(from.traction);
  if (!by_means && !step.start_traction.empty())
    for (std::size_t p = 0; p < step.from.size(); ++p) step.from[p].traction = step.start_traction[p];
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    ContactPointState& from = step.from[as_size(p)];
    if (!by_means) {
      const double before = from.multiplier;
      from.multiplier = std::max(least_multiplier(from), before + step_of_point[as_size(p)]);
      step_of_point[as_size(p)] = from.multiplier - before;
      continue;
    }
    // The mean penetration at the point is interpolated from its nodes, each with the factor of its
    // own sequence.
    double grown = 0;
    const ContactKinematics::Particle particle = kinematics.particle(p);
    for (std::size_t b = 0; b < particle.nodes.size(); ++b)
      grown += particle.share[b] * step_factor_[as_size(particle.nodes[b])] *
               penetration[as_size(particle.nodes[b])];
    // An open point keeps no pressure: it would hold the surfaces together when they touch again.
    if (now.points[as_size(p)].status == PointStatus::open)
      from.multiplier = least_multiplier(from);
    else
      from.multiplier = std::max(least_multiplier(from), from.multiplier + law_.penalty * grown);
    if (tangential) from.traction = now.points[as_size(p)].traction;
  }
  if (by_means) return;
  // The first augmentation by points takes friction back to its start as well, which no secant tells.
  if (std::exchange(by_points_, true))
    secants_.took(std::move(step_of_point));
  else
    secants_.clear();
}

void AugmentedLagrangian::take_back(ContactStep& step) {
  if (!acts()) return;
  for (std::size_t p = 0; p < before_.size(); ++p) {
    step.from[p].multiplier = before_[p].multiplier;
    step.from[p].traction = before_[p].traction;
  }
  ended_ = true;
}

double AugmentedLagrangian::excess(const ContactState& now) const {
  if (!acts()) return 0;
  const Penetration found = largest(now);
  if (!pressure_tolerance_) return found.penetration / allowed_;
  const double allowed = *pressure_tolerance_ * found.pressure / law_.penalty;
  return allowed > 0 ? found.penetration / allowed : 0;
}

double AugmentedLagrangian::pressure_error(const ContactState& now) const {
  if (!acts()) return 0;
  double force = 0, area = 0;
  const ContactKinematics& kinematics = geometry_.kinematics();
  // Mean force and area of what presses; the largest penetration times the stiffness is what the pressure may
  // be wrong by.
  for (Index p = 0; p < kinematics.n_points(); ++p) {
    const ContactKinematics::Particle particle = kinematics.particle(p);
    const double pressure = now.points[as_size(p)].pressure;
    if (!particle.counted || !(pressure > 0)) continue;
    force += particle.weight * pressure;
    area += particle.weight;
  }
  force = parallel::global_sum(force);
  area = parallel::global_sum(area);
  return force > 0 ? largest(now).penetration * stiffness_ * area / force : 0;
}

}  // namespace solidus::contact
