/// Phases of the heat of a pair follow each other: a mechanical pass has handed over its points, a thermal
/// phase conducts with them, and what it finds is committed to the state.
#include "contact/pair_heat.hpp"

#include <utility>

#include "contact/heat/heat_measures.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

namespace {}  // namespace

PairHeat::PairHeat(std::unique_ptr<ContactHeat> heat, const ContactGeometry& geometry, ContactForces& forces,
                   ContactStep& step, ContactEnd& end)
    : heat_(std::move(heat)), geometry_(geometry), forces_(forces), step_(step), end_(end) {
  if (heat_) coupling_ = std::make_unique<HeatCoupling>(geometry.mesh(), heat_->points(), heat_->term());
}

void PairHeat::begin(double dt, bool adiabatic) {
  if (has_temperature()) heat_->points().stages().begin({dt, adiabatic});
}

void PairHeat::predict() {
  if (heat_) heat_->predict();
}

InterfaceSums PairHeat::commit(std::span<const double> temperature) {
  return heat_ ? heat_->commit(temperature, step_, end_.state.points) : InterfaceSums{};
}

void PairHeat::hold_deformation() {
  if (!has_temperature()) return;
  step_.from = end_.state.points;
  step_.dt = 0;
  heat_->restore(step_, end_.state.points, true);
}

std::vector<double> PairHeat::conducted_temperatures(std::span<const double> temperature) const {
  return has_temperature() ? interface_temperatures(heat_->points(), temperature) : std::vector<double>{};
}

std::vector<double> PairHeat::nodal(std::span<const double> temperature) const {
  std::vector<double> heat(as_size(geometry_.mesh().n_owned_nodes), 0.0);
  if (heat_) heat_->term().add_residual(temperature, heat);
  return heat;
}

void PairHeat::add_coupling(std::span<const double> temperature, linear::CoupledMatrix& matrix) const {
  if (!heat_ || !forces_.active()) return;
  const ContactKinematics& kinematics = geometry_.at(end_.time, end_.displacement);
  const PointLaw& law = forces_.law();
  // Both are scratch of one point that the rates returned refer to until the next call.
  std::vector<Point> trial, share;
  const auto rates_of = [&](Index p) -> HeatRates {
    const ContactPointState& from = step_.from[as_size(p)];
    // How the pairing changes with displacements: shares, penetration, weight and, where it rubs, the trial
    // traction, whose size grows with slip and with the traction carried along.
    const PointMotion motion = kinematics.motion(p, from, ContactKinematics::Asked::rates);
    if (!motion.partnered) return {};  // of no node of this process
    const std::size_t n = motion.nodes.size();
    share.assign(n * n, Point{});
    kinematics.add_share_rates(p, share);
    trial.clear();
    if (law.friction && end_.state.points[as_size(p)].status != PointStatus::open) {
      // The trial traction is T_n carried along plus ε_T times the slip; its size changes along its
      // own direction.
      const double spring = law.tangential_penalty(from);
      const Point whole = add_scaled(motion.carried, spring, motion.slip);
      const double size = norm(whole);
      for (std::size_t b = 0; b < n && size > 0; ++b) {
        trial.push_back(scale(spring / size, transposed_times(motion.slip_rate[b], whole)));
        if (!motion.carried_rate.empty())
          trial.back() = add_scaled(trial.back(), 1 / size, transposed_times(motion.carried_rate[b], whole));
      }
    }
    return {motion.penetration_rate, trial, share, motion.weight_rate};
  };
  coupling_->add(rates_of, temperature, matrix);
  forces_.term().add_temperature_tangent(matrix);
}

}  // namespace solidus::contact
