#include "run/melt_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "parallel/parallel.hpp"
#include "system/log.hpp"

namespace solidus::model {

namespace {

/// A melt that has moved by this share of the size of its body has left its mould.
constexpr double k_out = 0.5;

constexpr const char* k_remedy =
    "does a mould, a support or a plane of symmetry hold it on all sides but the upper one?";

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

MeltWatch::MeltWatch(const CaseSpec& spec, const Assembly& a)
    : spec_(spec), a_(a), body_(at(a.mesh.n_owned_nodes), -1) {
  constexpr double k_far = std::numeric_limits<double>::infinity();
  std::vector<mesh::Point> low(spec.bodies.size(), {k_far, k_far, k_far}),
      high(spec.bodies.size(), {-k_far, -k_far, -k_far});
  for (const mesh::ElementBlock& block : a.mesh.blocks) {
    const auto body = static_cast<std::size_t>(block.body);
    for (const Index node : block.nodes) {
      for (std::size_t d = 0; d < 3; ++d) {
        low[body][d] = std::min(low[body][d], a.mesh.x[at(node)][d]);
        high[body][d] = std::max(high[body][d], a.mesh.x[at(node)][d]);
      }
      if (node < a.mesh.n_owned_nodes && body_[at(node)] < 0) body_[at(node)] = block.body;
    }
  }
  for (std::size_t b = 0; b < low.size(); ++b) {
    double square = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double length = parallel::global_max(high[b][d]) - parallel::global_min(low[b][d]);
      square += length * length;
    }
    size_.push_back(std::sqrt(square));
  }
}

void MeltWatch::step(const coupling::StepRecord&, const coupling::State& state) {
  const std::vector<double>& u = state.mechanics.displacement;
  if (!ran_out_.empty() || !parallel::any_process(!u.empty())) return;
  const std::vector<double> coherency = coupling::coherency_of(a_.phases, state.heat);
  const std::size_t n = u.size() / std::max<std::size_t>(a_.mesh.x.size(), 1);
  std::vector<double> farthest(size_.size(), 0.0);
  for (std::size_t i = 0; i < body_.size(); ++i) {
    if (body_[i] < 0 || coherency[i] >= 1) continue;
    double square = 0;
    for (std::size_t d = 0; d < n; ++d) square += u[i * n + d] * u[i * n + d];
    double& of_body = farthest[static_cast<std::size_t>(body_[i])];
    of_body = std::max(of_body, std::sqrt(square));
  }
  for (std::size_t b = 0; b < farthest.size(); ++b) {
    const double way = parallel::global_max(farthest[b]);
    if (!(way > k_out * size_[b]) || !ran_out_.empty()) continue;
    ran_out_ = fmt::format(
        "the melt of '{}' has run out: by t = {:g} s it has moved by {:.3g} mm, its body "
        "measures {:.3g} mm from corner to corner",
        spec_.bodies[b].name, state.time, 1e3 * way, 1e3 * size_[b]);
    logging::warn("{}; {}", ran_out_, k_remedy);
    ran_out_ += std::string("; ") + k_remedy;
  }
}

}  // namespace solidus::model
