/// The box of each body against the places of its melt.
#include "run/melt_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/log.hpp"

namespace solidus::run {

namespace {

/// A melt that is outside of its body's box by this share of the body's size has left its mould.
constexpr double k_out = 0.5;

}  // namespace

MeltWatch::MeltWatch(const cases::CaseSpec& spec, const setup::Assembly& a)
    : spec_(spec), a_(a), body_(as_size(a.mesh.n_owned_nodes), -1) {
  constexpr double k_unbounded = std::numeric_limits<double>::infinity();
  boxes_.resize(spec.bodies.size(),
                {{k_unbounded, k_unbounded, k_unbounded}, {-k_unbounded, -k_unbounded, -k_unbounded}});
  // The box around each body as it starts, and of each own node the body.
  for (const mesh::ElementBlock& block : a.mesh.blocks) {
    const auto body = as_size(block.body);
    for (const Index node : block.nodes) {
      for (std::size_t d = 0; d < 3; ++d) {
        boxes_[body].low[d] = std::min(boxes_[body].low[d], a.mesh.x[as_size(node)][d]);
        boxes_[body].high[d] = std::max(boxes_[body].high[d], a.mesh.x[as_size(node)][d]);
      }
      if (node < a.mesh.n_owned_nodes && body_[as_size(node)] < 0) body_[as_size(node)] = block.body;
    }
  }
  // Over all processes, so that a body in two parts has one box.
  for (Box& box : boxes_)
    for (std::size_t d = 0; d < 3; ++d) {
      box.low[d] = parallel::global_min(box.low[d]);
      box.high[d] = parallel::global_max(box.high[d]);
    }
}

double MeltWatch::Box::diagonal() const {
  return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

double MeltWatch::Box::distance_outside(const mesh::Point& place) const {
  mesh::Point out{};
  for (std::size_t d = 0; d < 3; ++d) out[d] = std::max({low[d] - place[d], place[d] - high[d], 0.0});
  return std::hypot(out[0], out[1], out[2]);
}

void MeltWatch::step(const coupling::StepRecord&, const coupling::State& state) {
  const std::vector<double>& u = state.mechanics.displacement;
  if (!ran_out_.empty() || !parallel::any_process(!u.empty())) return;
  const std::vector<double> coherency = coupling::coherency_of(a_.phases, state.heat);
  const std::size_t n = u.size() / std::max<std::size_t>(a_.mesh.x.size(), 1);
  std::vector<double> farthest(boxes_.size(), 0.0);
  // How far melt below coherency lies outside the box of its body.
  for (std::size_t i = 0; i < body_.size(); ++i) {
    if (body_[i] < 0 || coherency[i] >= 1) continue;
    mesh::Point place = a_.mesh.x[i];
    for (std::size_t d = 0; d < n; ++d) place[d] += u[i * n + d];
    const auto body = as_size(body_[i]);
    farthest[body] = std::max(farthest[body], boxes_[body].distance_outside(place));
  }
  // Once is enough: what has run out does not come back.
  for (std::size_t b = 0; b < farthest.size(); ++b) {
    const double way = parallel::global_max(farthest[b]), size = boxes_[b].diagonal();
    if (!(way > k_out * size) || !ran_out_.empty()) continue;
    ran_out_ = fmt::format(
        "the melt of '{}' has run out: by t = {:g} s it is {:.3g} mm outside of the box of its body, which "
        "measures {:.3g} mm from corner to corner",
        spec_.bodies[b].name, state.time, 1e3 * way, 1e3 * size);
    logging::warn("{}; {}", ran_out_, k_melt_remedy);
  }
}

}  // namespace solidus::run
