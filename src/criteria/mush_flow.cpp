/// A linear complementarity problem: pressures where melt flows, pores where it would have to be drawn
/// below the critical pressure. An active set of nodes is found, with conjugate gradients inside.
#include "criteria/mush_flow.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "material/permeability.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::criteria {

namespace {

// Mush that is thinner than an edge is passed over no less than this share of it; and no solid is left out of
// account beyond this fraction, from which on nothing flows.
constexpr double k_least_share = 1e-3, k_most_solid = 1 - 1e-6;

/// ∫_0^f max(f, 1/4)²/(1 − f)³ df.
double resistance_up_to(double f) {
  constexpr double k = material::k_least_solid;
  const auto below = [](double x) { return k * k * (1 / (2 * (1 - x) * (1 - x)) - 0.5); };
  const auto beyond = [](double x) {
    const double u = 1 - x;
    return 1 / (2 * u * u) - 2 / u - std::log(u);
  };
  return f <= k ? below(f) : below(k) + beyond(f) - beyond(k);
}

/// Its mean between two solid fractions.
double mean_resistance(double a, double b) {
  constexpr double k_equal = 1e-4;
  a = std::min(a, k_most_solid);
  b = std::min(b, k_most_solid);
  if (std::abs(a - b) > k_equal * (1 - std::max(a, b)))
    return (resistance_up_to(a) - resistance_up_to(b)) / (a - b);
  const double f = (a + b) / 2, solid = std::max(f, material::k_least_solid), liquid = 1 - f;
  return solid * solid / (liquid * liquid * liquid);
}

/// The equations of the nodes in mush, and their solution.
class Equations {
 public:
  Equations(const FeedingGraph& graph, const parallel::GhostExchange& ghosts, std::span<const MushLaw> laws,
            const MushInput& input, std::span<double> pressure)
      : ghosts_(ghosts), laws_(laws), input_(input), pressure_(pressure) {
    // A row for each own node in mush: the flows to its neighbours by permeability over viscosity,
    // and gas that gives way with pressure.
    start_.push_back(0);
    for (std::size_t i = 0; i < input.flow.size(); ++i) {
      if (input.place[i] != MushPlace::mush) continue;
      rows_.push_back(i);
      double diagonal = 0;
      for (const FeedingGraph::Neighbour& n : graph.around(as_index(i))) {
        const auto j = as_size(n.node);
        if (input.place[j] == MushPlace::none || !(n.factor > 0)) continue;
        const double conductance =
            static_cast<double>(n.factor) * laws[as_size(input.body[i])].mobility(end(i), end(j));
        edges_.push_back({j, conductance});
        diagonal += conductance;
      }
      if (!input.gives.empty()) diagonal += input.gives[i];
      start_.push_back(edges_.size());
      diagonal_.push_back(diagonal);
    }
    // Pools are at the pressure of the melt above, which counts as zero.
    for (std::size_t i = 0; i < pressure_.size(); ++i)
      if (input.place[i] != MushPlace::mush) pressure_[i] = 0;
    held_.assign(rows_.size(), 0);
  }

  MushResult solve() {
    constexpr int k_most_rounds = 400;
    // Nodes that cannot be fed, or were at their least pressure already, start as held.
    for (std::size_t k = 0; k < rows_.size(); ++k)
      if (!(diagonal_[k] > 0) || pressure_[rows_[k]] <= -critical(k)) hold(k);
    for (int round = 0; round < k_most_rounds; ++round) {
      balance();
      bool changed = false;
      // An active set: too low a pressure is held and opens pores; a held node that would close
      // them again is let go.
      for (std::size_t k = 0; k < rows_.size(); ++k) {
        const bool low =
            held_[k] == 0 && pressure_[rows_[k]] < -critical(k) - k_slack * std::abs(critical(k));
        // Let go of only while few rounds have gone by: then the set can but grow, and ends.
        const bool fed = held_[k] != 0 && diagonal_[k] > 0 && round < k_most_rounds / 2 && pores(k) < 0;
        if (low) hold(k);
        if (fed) held_[k] = 0;
        changed = changed || low || fed;
      }
      // The set is right when no process has changed it.
      if (!parallel::any_process(changed)) break;
      ghosts_.update(pressure_, 1);
    }
    return result();
  }

 private:
  static constexpr double k_slack = 1e-6;
  struct Edge {
    std::size_t node;
    double conductance;
  };

  MushLaw::End end(std::size_t node) const { return {input_.solid[node], input_.temperature[node]}; }
  double critical(std::size_t k) const {
    if (!input_.drop.empty()) return input_.drop[rows_[k]];
    return laws_[as_size(input_.body[rows_[k]])].critical_drop();
  }
  void hold(std::size_t k) {
    held_[k] = 1;
    pressure_[rows_[k]] = -critical(k);
  }
  /// Σ_j c_ij (x_i − x_j) of a row.
  double outflow(std::size_t k, std::span<const double> x) const {
    double sum = diagonal_[k] * x[rows_[k]];
    for (std::size_t e = start_[k]; e < start_[k + 1]; ++e) sum -= edges_[e].conductance * x[edges_[e].node];
    return sum;
  }
  /// R of a row: what its neighbours do not bring.
  double pores(std::size_t k) const { return input_.flow[rows_[k]] + outflow(k, pressure_); }

  /// Conjugate gradients with the diagonal for the rows that are not held.
  void balance() {
    constexpr double k_tolerance = 1e-7;
    constexpr int k_most_iterations = 2000;
    // The residual and the first direction, with what the tolerance relates to: the size of all flows.
    ghosts_.update(pressure_, 1);
    std::vector<double> residual(rows_.size(), 0.0), image(rows_.size()), direction(pressure_.size(), 0.0);
    double size = 0, product = 0;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      if (held_[k] != 0) continue;
      const double flow = input_.flow[rows_[k]];
      residual[k] = -pores(k);
      size += flow * flow / diagonal_[k];
      direction[rows_[k]] = residual[k] / diagonal_[k];
      product += residual[k] * direction[rows_[k]];
    }
    std::array<double, 2> sums{size, product};
    processes::sum(sums);
    size = sums[0];
    product = sums[1];
    // Until the residual in the norm of the diagonal is small against the flows.
    for (int i = 0; i < k_most_iterations && product > k_tolerance * k_tolerance * size; ++i) {
      ghosts_.update(direction, 1);
      double curvature = 0;
      for (std::size_t k = 0; k < rows_.size(); ++k) {
        if (held_[k] != 0) continue;
        image[k] = outflow(k, direction);
        curvature += image[k] * direction[rows_[k]];
      }
      // The step along the direction and the next direction, as in any conjugate gradients.
      curvature = parallel::global_sum(curvature);
      if (!(curvature > 0)) break;
      const double step = product / curvature;
      double next = 0;
      for (std::size_t k = 0; k < rows_.size(); ++k) {
        if (held_[k] != 0) continue;
        pressure_[rows_[k]] += step * direction[rows_[k]];
        residual[k] -= step * image[k];
        next += residual[k] * residual[k] / diagonal_[k];
      }
      next = parallel::global_sum(next);
      const double share = next / product;
      for (std::size_t k = 0; k < rows_.size(); ++k)
        if (held_[k] == 0) direction[rows_[k]] = residual[k] / diagonal_[k] + share * direction[rows_[k]];
      product = next;
    }
    ghosts_.update(pressure_, 1);
  }

  MushResult result() const {
    MushResult result;
    result.pores.assign(input_.flow.size(), 0.0);
    result.from_pool.assign(input_.n_pools, 0.0);
    // Rows whose pressure is held at its least open pores; flow from pools is what they give to the mush.
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const std::size_t i = rows_[k];
      if (held_[k] != 0) result.pores[i] = std::max(0.0, pores(k));
      for (std::size_t e = start_[k]; e < start_[k + 1]; ++e)
        if (const std::size_t j = edges_[e].node; input_.place[j] == MushPlace::pool)
          result.from_pool[as_size(input_.pool[j])] -= edges_[e].conductance * pressure_[i];
    }
    processes::sum(result.from_pool);
    return result;
  }

  const parallel::GhostExchange& ghosts_;
  std::span<const MushLaw> laws_;
  const MushInput& input_;
  std::span<double> pressure_;
  std::vector<std::size_t> rows_, start_;  ///< owned nodes in mush, and their edges
  std::vector<Edge> edges_;
  std::vector<double> diagonal_;
  std::vector<char> held_;  ///< at the critical drop
};

}  // namespace

MushLaw::MushLaw(const material::Material& material)
    : factor_(material::Permeability(material.casting).mobility(material::k_least_solid) *
              material::k_least_solid * material::k_least_solid / std::pow(1 - material::k_least_solid, 3)),
      liquidus_(material.solidification() != nullptr ? material.solidification()->fraction.liquidus() : 0),
      critical_drop_(material.casting.critical_pressure_drop) {}

double MushLaw::mobility(const End& a, const End& b) const {
  const double cold = std::min(a.temperature, b.temperature), hot = std::max(a.temperature, b.temperature);
  double share = 1;
  if (hot > liquidus_ && hot > cold)
    share = std::clamp((liquidus_ - cold) / (hot - cold), k_least_share, 1.0);
  return factor_ / (share * share * mean_resistance(a.solid, b.solid));
}

MushResult flow_through_mush(const FeedingGraph& graph, const parallel::GhostExchange& ghosts,
                             std::span<const MushLaw> laws, const MushInput& input,
                             std::span<double> pressure) {
  return Equations(graph, ghosts, laws, input, pressure).solve();
}

}  // namespace solidus::criteria
