/// Residual and tangent point by point. Entries of successive points with the same nodes are summed in one
/// dense block (Run) before they go to the matrix, since most points of a face share their nodes.
#include "contact/forces/mechanics_term.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/log.hpp"

namespace solidus::contact {

namespace {

/// Newton's iteration has gone astray, or the stabilisation holds it back, after so many tangents.
constexpr int k_patient = 8;
/// The stabilisation then becomes a tenth with every tangent, down to this share of itself.
constexpr double k_least_stabilisation = 1e-4;

}  // namespace

/// Counts and maxima over the points of a residual, this process's part.
struct MechanicsTerm::Count {
  double points = 0, closed = 0, sticking = 0, penetration = 0, pressure = 0;

  void add(const ContactPointState& from, const PointMotion& motion, const PointForces& forces) {
    if (!from.counted) return;
    points += 1;
    if (forces.status == PointStatus::open) return;
    closed += 1;
    if (forces.status == PointStatus::sticks) sticking += 1;
    penetration = std::max(penetration, motion.penetration);
    pressure = std::max(pressure, forces.normal.pressure);
  }
};

/// Consecutive points that share their nodes, and the sum of their tangents.
struct MechanicsTerm::Run {
  Index first = -1;
  std::vector<Index> nodes;
  std::vector<double> k;          ///< [b][c][i][j]
  std::vector<Tensor> geometric;  ///< [b][c]; scratch of one point
};

MechanicsTerm::MechanicsTerm(std::string name, const ContactGeometry& geometry, const PointLaw& law,
                             const ContactStep& step, const bool& active, double stabilisation,
                             bool symmetric)
    : name_(std::move(name)),
      n_owned_(geometry.mesh().n_owned_nodes),
      geometry_(geometry),
      kinematics_(geometry.kinematics()),
      law_(law),
      step_(step),
      active_(active),
      stabilisation_(stabilisation),
      symmetric_(symmetric),
      status_(as_size(kinematics_.n_points()), PointStatus::open) {}

void MechanicsTerm::Stabilisation::next() {
  ++n_tangents_;
  left_ = std::clamp(std::pow(10.0, k_patient - n_tangents_), k_least_stabilisation, 1.0);
}

void MechanicsTerm::add_to_graph(linear::NodeGraph& graph) const {
  version_ = geometry_.graph().add_to(graph);
}

void MechanicsTerm::bind(const linear::BlockMatrix& matrix) {
  slots_.bind(matrix, n_owned_, kinematics_.n_points());
  coupled_.matrix = nullptr;  // the places of its slots are void too
}

void MechanicsTerm::add_residual(std::span<const double> x, std::span<double> r) {
  // The counts of changed points and failed laws are those of this residual.
  outcome_ = {};
  if (!active_) return;
  // Each point that concerns this process is placed at the displacement x, its law answers, and its force
  // goes to the owned nodes.
  geometry_.at(step_.time, x, ContactKinematics::Points::own);
  const auto n = as_size(geometry_.components());
  Count count;
  for (Index p = 0; p < kinematics_.n_points(); ++p) {
    if (!kinematics_.concerns(p)) continue;
    const ContactPointState& from = step_.from[as_size(p)];
    const PointMotion motion = kinematics_.motion(p, from, ContactKinematics::Asked::motion);
    const PointForces f = law_.forces(motion, from, step_.coupled.around(motion), step_.iterate_of(p));
    // Changes of status are counted for the messages of an iteration that does not converge.
    if (f.status != status_[as_size(p)] && from.counted) ++outcome_.changes;
    status_[as_size(p)] = f.status;
    count.add(from, motion, f);
    if (f.friction.status != FrictionStatus::converged && outcome_.failure == FrictionStatus::converged)
      outcome_.failure = f.friction.status;
    // A law of friction that has found no state makes the residual not a number, so that the step is
    // shortened.
    double pressure = f.normal.balance_pressure;
    if (f.friction.status != FrictionStatus::converged)
      pressure = std::numeric_limits<double>::quiet_NaN();
    else if (f.status == PointStatus::open && pressure == 0)
      continue;
    for (std::size_t b = 0; b < motion.nodes.size(); ++b) {
      if (motion.nodes[b] >= n_owned_) continue;
      double* rb = r.data() + as_size(motion.nodes[b]) * n;
      const Point force =
          // Without friction there is no tangential part to distribute.
          law_.friction ? motion.force_at(b, pressure, f.traction) : scale(pressure, motion.normal_at(b));
      for (std::size_t i = 0; i < n; ++i) rb[i] += motion.weight * force[i];
    }
  }
  if (logging::level() == logging::Level::debug) log(count);
}

void MechanicsTerm::log(const Count& count) const {
  logging::debug(
      "contact '{}': {:.0f} of {:.0f} points closed, {:.0f} stick, {:.0f} changed; penetration up to {:.3g} "
      "m, "
      "pressure up to {:.3g} Pa",
      name_, parallel::global_sum(count.closed), parallel::global_sum(count.points),
      parallel::global_sum(count.sticking), parallel::global_sum(static_cast<double>(outcome_.changes)),
      parallel::global_max(count.penetration), parallel::global_max(count.pressure));
}

template <int dim>
void MechanicsTerm::add_point(const PointMotion& motion, Index point, Run& run) {
  const ContactPointState& from = step_.from[as_size(point)];
  const PointForces f = law_.forces(motion, from, step_.coupled.around(motion), step_.iterate_of(point));
  if (!f.normal.closed && f.normal.balance_pressure == 0 && stabilisation_.none()) return;
  // An open point without stabilisation adds nothing; all others add w (B_b ⊗ dF) for every pair of
  // their nodes.
  const std::size_t n = motion.nodes.size();
  const double w = motion.weight;
  const bool frictional = law_.friction.has_value() && f.normal.closed;
  const double spring = frictional ? law_.tangential_penalty(from) : 0.0;
  // How the traction follows the penetration: by its friction limit and, where temperatures are solved along,
  // by the conductance that pressure and gap change.
  Point traction_by_penetration{};
  if (frictional && !symmetric_) {
    traction_by_penetration = scale(f.normal.tangent, f.traction_by_pressure);
    if (f.joint)
      traction_by_penetration =
          add_scaled(traction_by_penetration,
                     f.conductance.by_pressure * f.normal.tangent + f.conductance.by_penetration,
                     f.traction_by_conductance);
  }
  const double stabilisation = stabilisation_.of(w) * law_.normal.penalty;
  // Rates by each node: penetration and, with friction, the traction that slip and rotation change.
  for (std::size_t c = 0; c < n; ++c) {
    const Point& g = motion.penetration_rate[c];
    Tensor traction_rate{};
    if (frictional) {
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
          traction_rate[i][j] = spring * motion.slip_rate[c][i][j];
          if (!motion.carried_rate.empty()) traction_rate[i][j] += motion.carried_rate[c][i][j];
        }
      traction_rate = times(f.traction_by_trial, traction_rate);
      add_outer(traction_rate, 1, traction_by_penetration, g);
    }
    // B_b F of a point is one tensor but for B_b.
    const bool alike = motion.push_share.empty();
    const Tensor pushed = frictional && alike ? times(motion.push, traction_rate) : Tensor{};
    // Each node takes the force of normal, stabilisation and traction with its share.
    for (std::size_t b = 0; b < n; ++b) {
      double* block = run.k.data() + (b * n + c) * dim * dim;
      const Point normal = scale(w * f.normal.balance_tangent, motion.normal_at(b));
      for (std::size_t i = 0; i < dim; ++i)
        for (std::size_t j = 0; j < dim; ++j) block[i * dim + j] += normal[i] * g[j];
      for (std::size_t i = 0; i < dim; ++i)
        block[i * dim + i] += stabilisation * motion.share[b] * motion.share[c];
      if (!frictional) continue;
      const Tensor of_node = alike ? pushed : times(motion.push_share[b], traction_rate);
      const double share = alike ? w * motion.share[b] : w;
      for (std::size_t i = 0; i < dim; ++i)
        for (std::size_t j = 0; j < dim; ++j) block[i * dim + j] += share * of_node[i][j];
    }
  }
  // Weights change with the place where segments are cut again.
  if (follows_weights_ && !motion.weight_rate.empty()) {
    for (std::size_t b = 0; b < n; ++b) {
      const Point force = frictional ? motion.force_at(b, f.normal.balance_pressure, f.traction)
                                     : scale(f.normal.balance_pressure, motion.normal_at(b));
      for (std::size_t c = 0; c < n; ++c) {
        double* block = run.k.data() + (b * n + c) * dim * dim;
        for (std::size_t i = 0; i < dim; ++i)
          for (std::size_t j = 0; j < dim; ++j) block[i * dim + j] += force[i] * motion.weight_rate[c][j];
      }
    }
  }
  if (!kinematics_.partners_change() || (!f.normal.closed && f.normal.balance_pressure == 0)) return;
  run.geometric.assign(n * n, Tensor{});
  kinematics_.add_geometric_tangent(point, f.normal.balance_pressure, f.traction, run.geometric);
  for (std::size_t e = 0; e < n * n; ++e)
    for (std::size_t i = 0; i < dim; ++i)
      for (std::size_t j = 0; j < dim; ++j) run.k[(e * dim + i) * dim + j] += run.geometric[e][i][j];
}

template <int dim>
void MechanicsTerm::flush(Run& run, linear::BlockMatrix& matrix) {
  const std::size_t n = run.nodes.size();
  // Blocks lie [b][c][i][j], so that one (b, c) is contiguous and is added to the matrix as it is.
  const auto entry = [&](std::size_t b, std::size_t c, std::size_t i, std::size_t j) -> double& {
    return run.k[((b * n + c) * dim + i) * dim + j];
  };
  // For a symmetric solver the mean of the block and its transpose.
  if (symmetric_)
    for (std::size_t b = 0; b < n; ++b)
      for (std::size_t c = 0; c <= b; ++c)
        for (std::size_t i = 0; i < dim; ++i)
          for (std::size_t j = 0; j < dim; ++j) {
            const double mean = 0.5 * (entry(b, c, i, j) + entry(c, b, j, i));
            entry(b, c, i, j) = entry(c, b, j, i) = mean;
          }
  const std::span<const SlotCache::Slot> slots = slots_.slots(run.first, run.nodes);
  for (std::size_t e = 0; e < n * n; ++e) {
    double* target = matrix.block(slots[e]);
    const double* block = run.k.data() + e * dim * dim;
    for (std::size_t i = 0; i < dim * dim; ++i) target[i] += block[i];
  }
}

template <int dim>
void MechanicsTerm::add_tangents(linear::BlockMatrix& matrix) {
  Run run;
  for (Index p = 0; p < kinematics_.n_points(); ++p) {
    if (!kinematics_.concerns(p)) continue;
    const ContactPointState& from = step_.from[as_size(p)];
    // Points of which no node is owned here have rows on other processes only, which compute them
    // too.
    const PointMotion motion = kinematics_.motion(p, from, ContactKinematics::Asked::rates);
    if (!motion.partnered || std::none_of(motion.nodes.begin(), motion.nodes.end(),
                                          [this](Index node) { return node < n_owned_; }))
      continue;
    // Successive points of the same nodes are summed in one dense block before they go into the matrix.
    if (!std::equal(motion.nodes.begin(), motion.nodes.end(), run.nodes.begin(), run.nodes.end())) {
      if (run.first >= 0) flush<dim>(run, matrix);
      run.first = p;
      run.nodes.assign(motion.nodes.begin(), motion.nodes.end());
      run.k.assign(run.nodes.size() * run.nodes.size() * dim * dim, 0.0);
    }
    add_point<dim>(motion, p, run);
  }
  if (run.first >= 0) flush<dim>(run, matrix);
}

void MechanicsTerm::add_temperature_tangent(linear::CoupledMatrix& matrix) {
  if (!active_ || step_.coupled.law == nullptr) return;
  if (coupled_.matrix != &matrix.displacement()) {
    coupled_.matrix = &matrix.displacement();
    coupled_.slots.bind(*coupled_.matrix, n_owned_, kinematics_.n_points());
  }
  const auto components = as_size(geometry_.components());
  // At each point that slips the traction changes with the temperature of the interface, and this with the
  // nodal temperatures of both sides.
  for (Index p = 0; p < kinematics_.n_points(); ++p) {
    if (!kinematics_.concerns(p)) continue;
    const PointMotion motion =
        kinematics_.motion(p, step_.from[as_size(p)], ContactKinematics::Asked::motion);
    const std::optional<Surroundings> around = step_.coupled.around(motion);
    if (!around) continue;
    // Without a joint solution, or without traction, temperature changes no force: friction acts
    // along the traction.
    const PointForces f = law_.forces(motion, step_.from[as_size(p)], around);
    if (!f.joint || !(norm(f.traction) > 0)) continue;
    // Θ_c by the sides, at fixed h and through h at their mean.
    const double by_mean = f.joint->traction_by_conductance * f.conductance.by_temperature;
    std::array<double, 2> by_side = f.joint->traction_by_side;
    by_side[0] += around->master_takes_heat ? 0.5 * by_mean : by_mean;
    by_side[1] += 0.5 * by_mean;
    if (by_side[0] == 0 && by_side[1] == 0) continue;
    // The traction's size alone depends on temperature; its direction is that of the trial
    // traction.
    const Point along = scale(1 / norm(f.traction), f.traction);
    const std::size_t n = motion.nodes.size();
    const auto slots = coupled_.slots.slots(p, motion.nodes);
    for (std::size_t row = 0; row < n; ++row) {
      const Point direction = motion.pushed_at(row, along);
      for (std::size_t a = 0; a < n; ++a) {
        const bool slave = a < as_size(motion.n_slave);
        const double shape = slave ? motion.share[a] : -motion.share[a];
        const double slope = motion.weight * shape * by_side[slave ? 0 : 1];
        double* const to = matrix.force_by_temperature(slots[row * n + a]);
        for (std::size_t i = 0; i < components; ++i) to[i] += slope * direction[i];
      }
    }
  }
}

void MechanicsTerm::add_tangent(std::span<const double> x, linear::BlockMatrix& matrix) {
  if (!active_) return;
  stabilisation_.next();
  geometry_.at(step_.time, x, ContactKinematics::Points::own);
  if (geometry_.components() == 2)
    add_tangents<2>(matrix);
  else
    add_tangents<3>(matrix);
}

}  // namespace solidus::contact
