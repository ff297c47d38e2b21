#include "heat/heat_system.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "mesh/block_geometry.hpp"
#include "parallel/parallel.hpp"
#include "system/common_failure.hpp"
#include "system/errors.hpp"

namespace solidus::heat {

namespace {

constexpr double k_rounding = 1e-7;  ///< of temperatures [K]

}  // namespace

HeatSystem::HeatSystem(const mesh::Mesh& mesh, AnalysisKind kind,
                       const std::vector<material::Material>& materials, const Conditions& conditions,
                       bool closed, std::vector<linear::Contribution*> contributions,
                       linear::BlockMatrix::Storage storage)
    : mesh_(mesh), kind_(kind), closed_(closed), contributions_(std::move(contributions)), active_(mesh) {
  contributions_heat_ = std::any_of(contributions_.begin(), contributions_.end(),
                                    [](const linear::Contribution* c) { return !c->stores(); });
  for (const material::Material& m : materials) at_nodes_.push_back(closed || m.changes_isothermally());
  add_conduction(materials);
  if (!conditions.absent_bodies.empty()) throw std::invalid_argument("every body is there when a run begins");
  add_conditions(conditions);

  nodal_ = std::make_unique<NodalPotential>(mesh, potentials_, active_);
  matrix_ = std::make_unique<linear::BlockMatrix>(mesh, 1, graph(), storage);
  matrix_->set_fixed(fixed_);
  bind();
  local_.resize(mesh.x.size());
  supplied_.resize(mesh.x.size());
  contributed_.resize(static_cast<std::size_t>(mesh.n_owned_nodes));
  contribution_power_.resize(contributions_.size());
}

HeatSystem::~HeatSystem() = default;

linear::NodeGraph HeatSystem::graph() const {
  linear::NodeGraph graph(mesh_);
  for (const mesh::Block& block : mesh_.blocks)
    if (active_.body(block.body)) graph.add_cliques(block.nodes, mesh::node_count(block.shape));
  for (const linear::Contribution* contribution : contributions_) contribution->add_to_graph(graph);
  return graph;
}

void HeatSystem::bind() {
  kept_conduction_.clear();
  for (const auto& block : conduction_)
    if (block) block->bind(*matrix_);
  for (SurfaceHeat& surface : surfaces_) surface.bind(*matrix_);
  for (linear::Contribution* contribution : contributions_) contribution->bind(*matrix_);
}

bool HeatSystem::follow_graph() {
  if (!linear::graph_outdated(contributions_)) return false;
  matrix_->set_graph(graph());
  bind();
  return true;
}

// While the bodies are the same the graph need not change: the nodes of a face are nodes of one element.
bool HeatSystem::set_conditions(const Conditions& conditions) {
  const linear::ActiveSet active(mesh_, conditions.absent_bodies);
  const bool others = active != active_;
  if (others) change_bodies(active);
  surfaces_.clear();
  sources_.clear();
  ignition_.clear();
  prescribed_.clear();
  add_conditions(conditions);
  if (others) matrix_->set_graph(graph());
  matrix_->set_fixed(fixed_);
  if (others)
    bind();
  else
    for (SurfaceHeat& surface : surfaces_) surface.bind(*matrix_);
  return others;
}

/// Conduction of a body that comes back is computed anew when it is asked for.
void HeatSystem::change_bodies(const linear::ActiveSet& active) {
  for (std::size_t b = 0; b < conduction_.size(); ++b)
    if (!active.body(mesh_.blocks[b].body)) conduction_[b].reset();
  for (std::size_t body = 0; body < fields_.size(); ++body) {
    fields_[body].nodes.clear();
    if (active.body(static_cast<int>(body))) find_field_nodes(body);
  }
  active_ = active;
  nodal_ = std::make_unique<NodalPotential>(mesh_, potentials_, active_);
}

void HeatSystem::add_conduction(const std::vector<material::Material>& materials) {
  for (const material::Material& m : materials) potentials_.emplace_back(m.conductivity);
  fields_.resize(materials.size());
  conduction_.resize(mesh_.blocks.size());
  for (std::size_t body = 0; body < fields_.size(); ++body) find_field_nodes(body);
}

void HeatSystem::find_field_nodes(std::size_t body) {
  if (potentials_[body].constant()) return;
  std::vector<char> of_body(mesh_.x.size(), 0);
  for (const mesh::Block& block : mesh_.blocks)
    if (static_cast<std::size_t>(block.body) == body)
      for (const Index node : block.nodes) of_body[static_cast<std::size_t>(node)] = 1;
  Field& u = fields_[body];
  u.nodes.reserve(static_cast<std::size_t>(std::count(of_body.begin(), of_body.end(), 1)));
  for (std::size_t i = 0; i < of_body.size(); ++i)
    if (of_body[i] != 0) u.nodes.push_back(static_cast<Index>(i));
  if (!u.nodes.empty()) u.value.resize(mesh_.x.size());
}

void HeatSystem::set_time(double time) {
  if (placed_)
    run_collectively([&] { evaluate(time); });
  else
    evaluate(time);
}

void HeatSystem::evaluate(double time) {
  for (SurfaceHeat& surface : surfaces_) surface.set_time(time);
  for (Volume& source : sources_)
    if (!source.burning) source.set_time(time);
  for (Prescribed& p : prescribed_) p.value.values(p.x, time, p.now);
}

void HeatSystem::set_burning(const BurningState& state, double begin, double end) {
  for (Volume& source : sources_)
    if (source.burning) source.burn(state, begin, end);
}

void HeatSystem::prescribe(std::span<double> temperature) const {
  for (const Prescribed& p : prescribed_)
    for (std::size_t k = 0; k < p.nodes.size(); ++k)
      temperature[static_cast<std::size_t>(p.nodes[k])] = p.now[k];
}

void HeatSystem::limit(bool on) {
  on = on && closed_;
  if (on == (limiter_ != nullptr)) return;
  limiter_.reset();
  kept_conduction_.clear();
  if (!on) return;
  limiter_ = std::make_unique<ConductionLimiter>(mesh_, potentials_);
}

bool HeatSystem::find_limits(std::span<const double> temperature, double negligible) {
  if (!limiter_ || !exchange_) return false;
  if (kept_conduction_.empty()) keep_conduction();
  if (!limiter_->needed()) return false;
  std::vector<LimitedFlow*> flows;
  std::vector<double> gain(contributed_.size()), loss(contributed_.size());
  conduct(temperature);
  for (std::size_t i = 0; i < gain.size(); ++i) (local_[i] > 0 ? gain : loss)[i] += std::abs(local_[i]);
  for (SurfaceHeat& surface : surfaces_) {
    surface.add_supply(temperature, gain, loss);
    surface.update_flows(temperature);
    for (LimitedFlow& flow : surface.flows()) flows.push_back(&flow);
  }
  for (const Volume& source : sources_)
    for (std::size_t i = 0; i < source.heat.size(); ++i)
      (source.heat[i] > 0 ? gain : loss)[i] += std::abs(source.heat[i]);
  contributions_heat_ = false;  // all are looked at
  for (linear::Contribution* contribution : contributions_) {
    if (contribution->stores()) continue;
    std::fill(contributed_.begin(), contributed_.end(), 0.0);
    contribution->add_residual(temperature, contributed_);
    double net = 0, magnitude = 0;
    for (std::size_t i = 0; i < gain.size(); ++i) {
      (contributed_[i] < 0 ? gain : loss)[i] += std::abs(contributed_[i]);
      net += contributed_[i];
      magnitude += std::abs(contributed_[i]);
    }
    constexpr double k_passed_on = 1e-9;  // net heat over the heat exchanged
    if (std::abs(parallel::global_sum(net)) > k_passed_on * parallel::global_sum(magnitude))
      contributions_heat_ = true;
  }
  return limiter_->find_shares(temperature, gain, loss, fixed_, negligible, flows);
}

void HeatSystem::clear_limits() {
  if (limiter_) limiter_->clear_shares();
  for (SurfaceHeat& surface : surfaces_)
    for (LimitedFlow& flow : surface.flows()) flow.left = 0;
}

ConductionLimiter::Held HeatSystem::hold_nodes(std::span<const double> temperature,
                                               const TemperatureRange& range) {
  if (!limiter_ || !exchange_) return ConductionLimiter::Held::none;
  return limiter_->hold(temperature, range.lowest - k_rounding, range.highest + k_rounding);
}

void HeatSystem::release_nodes() {
  if (limiter_) limiter_->release();
}

TemperatureRange HeatSystem::surroundings() const {
  TemperatureRange range;
  const auto include = [&range](const TemperatureRange& other) {
    range.lowest = std::min(range.lowest, other.lowest);
    range.highest = std::max(range.highest, other.highest);
  };
  for (const SurfaceHeat& surface : surfaces_)
    if (const std::optional<TemperatureRange> ambient = surface.ambient()) include(*ambient);
  for (const Prescribed& p : prescribed_)
    for (const double temperature : p.now) include({temperature, temperature});
  return {parallel::global_min(range.lowest), parallel::global_max(range.highest)};
}

TemperatureRange HeatSystem::ambient_range(bool with_contributions) const {
  double cooling = 0, heating = 0;
  for (const SurfaceHeat& surface : surfaces_) {
    if (surface.ambient()) continue;
    const auto [least, greatest] = surface.flux_range();
    cooling = std::min(cooling, least);
    heating = std::max(heating, greatest);
  }
  for (const Volume& source : sources_)
    for (const double heat : source.heat) {
      cooling = std::min(cooling, heat);
      heating = std::max(heating, heat);
    }
  TemperatureRange range = surroundings();
  const bool contributed = with_contributions && contributions_heat_;
  if (parallel::global_min(cooling) < 0 || contributed) range.lowest = -HUGE_VAL;
  if (parallel::global_max(heating) > 0 || contributed) range.highest = HUGE_VAL;
  return range;
}

TemperatureRange HeatSystem::range_of_contributions(std::span<const double> temperature) {
  TemperatureRange range;
  for (linear::Contribution* contribution : contributions_) {
    if (contribution->stores()) continue;
    std::fill(contributed_.begin(), contributed_.end(), 0.0);
    contribution->add_residual(temperature, contributed_);
    for (std::size_t i = 0; i < contributed_.size(); ++i) {
      if (contributed_[i] == 0) continue;
      range.lowest = std::min(range.lowest, temperature[i]);
      range.highest = std::max(range.highest, temperature[i]);
    }
  }
  return {parallel::global_min(range.lowest), parallel::global_max(range.highest)};
}

double HeatSystem::residual(std::span<const double> temperature, std::span<double> r) {
  double moved = 0;
  for (auto* heat : {&local_, &supplied_}) std::fill(heat->begin(), heat->end(), 0.0);
  std::fill(surface_power_.begin(), surface_power_.end(), 0.0);
  std::fill(source_power_.begin(), source_power_.end(), 0.0);
  if (exchange_) moved += add_flows(temperature);
  std::copy_n(local_.begin(), r.size(), r.begin());
  if (limiter_ && exchange_) limiter_->add_heat(temperature, r);
  storing_.clear();
  for (std::size_t c = 0; c < contributions_.size(); ++c) {
    contribution_power_[c] = 0;
    if (!exchange_ && !contributions_[c]->stores()) continue;
    std::fill(contributed_.begin(), contributed_.end(), 0.0);
    contributions_[c]->add_residual(temperature, contributed_);
    if (contributions_[c]->stores()) {
      storing_.resize(r.size(), 0.0);
      for (std::size_t i = 0; i < r.size(); ++i) storing_[i] += contributed_[i];
    }
    for (std::size_t i = 0; i < r.size(); ++i) {
      r[i] += contributed_[i];
      contribution_power_[c] -= contributed_[i];
      moved += std::abs(contributed_[i]);
    }
  }
  return moved;
}

ConductionBlock& HeatSystem::conduction(std::size_t block) {
  if (!conduction_[block]) {
    conduction_[block] = make_conduction_block(mesh_, mesh_.blocks[block], kind_, closed_);
    conduction_[block]->bind(*matrix_);
  }
  return *conduction_[block];
}

/// Conduction without its limits, in local_:  Σ_j K_ij (u_j − u_i), since Σ_j K_ij = 0. A uniform temperature
/// gives no flow to the last bit, and what one node of a pair gives the other one gets.
void HeatSystem::conduct(std::span<const double> temperature) {
  if (kept_conduction_.empty()) keep_conduction();
  std::vector<const double*> potential(fields_.size(), temperature.data());
  std::vector<double> factor(fields_.size(), 1.0);
  for (std::size_t b = 0; b < fields_.size(); ++b) {
    if (potentials_[b].constant()) continue;
    for (const Index node : fields_[b].nodes) {
      const auto i = static_cast<std::size_t>(node);
      fields_[b].value[i] = potentials_[b].value(temperature[i]);
    }
    potential[b] = fields_[b].value.data();
    factor[b] = 1.0 / potentials_[b].reference();
  }
  std::fill(local_.begin(), local_.end(), 0.0);
  const bool half = matrix_->storage() == linear::BlockMatrix::Storage::upper;
  const std::span<const std::int64_t> start = matrix_->row_start();
  const std::span<const Index> columns = matrix_->columns();
  // The diagonal adds nothing. Rows of ghosts are scrap.
  for (std::size_t i = 0; i + 1 < start.size(); ++i) {
    const int own = node_body_.empty() ? 0 : node_body_[i];
    double sum = 0;
    for (std::int64_t s = start[i]; s < start[i + 1]; ++s) {
      const auto j = static_cast<std::size_t>(columns[static_cast<std::size_t>(s)]);
      const int body = own >= 0 ? own : node_body_[j];
      if (body < 0) continue;
      const auto b = static_cast<std::size_t>(body);
      const double flow =
          kept_conduction_[static_cast<std::size_t>(s)] * (factor[b] * (potential[b][j] - potential[b][i]));
      sum += flow;
      if (half) local_[j] -= flow;
    }
    local_[i] += sum;
  }
  for (const SharedPair& pair : shared_) {
    const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j),
               b = static_cast<std::size_t>(pair.body);
    const double k = pair.k * potentials_[b].reference();
    const double flow = k * (factor[b] * (potential[b][j] - potential[b][i]));
    local_[i] += flow;
    if (half) local_[j] -= flow;
  }
}

/// Conduction, surfaces and sources, in local_. Returns the magnitudes of the last two.
double HeatSystem::add_flows(std::span<const double> temperature) {
  conduct(temperature);
  double moved = 0;
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    surface_power_[s] = surfaces_[s].add_residual(temperature, supplied_, moved);
  }
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    const Volume& source = sources_[s];
    for (std::size_t i = 0; i < source.heat.size(); ++i) {
      supplied_[i] -= source.heat[i];
      source_power_[s] += source.heat[i];
      moved += std::abs(source.heat[i]);
    }
  }
  for (std::size_t i = 0; i < local_.size(); ++i) local_[i] += supplied_[i];
  return moved;
}

double HeatSystem::entropy_power(std::span<const double> temperature) const {
  double sum = 0;
  for (std::size_t i = 0; i < contributed_.size(); ++i) sum -= supplied_[i] / temperature[i];
  return sum;
}

void HeatSystem::assemble(std::span<const double> temperature) {
  assert((nodal_->identity() || matrix_->storage() == linear::BlockMatrix::Storage::whole) &&
         "it is not symmetric");
  matrix_->set_zero();
  for (linear::Contribution* contribution : contributions_)
    if (exchange_ || contribution->stores()) contribution->add_tangent(temperature, *matrix_);
  if (!exchange_) return;
  for (std::size_t b = 0; b < fields_.size(); ++b)
    for (const Index node : fields_[b].nodes) {
      const auto i = static_cast<std::size_t>(node);
      fields_[b].value[i] = potentials_[b].conductivity(temperature[i]);
    }
  for (std::size_t b = 0; b < conduction_.size(); ++b) {
    const auto body = static_cast<std::size_t>(mesh_.blocks[b].body);
    if (!active_.body(static_cast<int>(body))) continue;
    if (potentials_[body].constant())
      conduction(b).add_tangent(potentials_[body].reference(), {}, *matrix_);
    else
      conduction(b).add_tangent(1.0, fields_[body].value, *matrix_);
  }
  for (const SurfaceHeat& surface : surfaces_) surface.add_tangent(temperature, *matrix_);
  if (limiter_) limiter_->add_tangent(temperature, *matrix_);
}

/// Assembles the part that does not change while the pattern stays. Without contributions the pattern changes
/// only where a body leaves: then the geometry of the elements, 137 bytes a node of tetrahedra, is not kept.
void HeatSystem::keep_conduction() {
  const auto n = static_cast<std::size_t>(matrix_->row_start().back());
  find_node_bodies();
  shared_.clear();
  kept_conduction_.assign(n, 0.0);
  if (limiter_) limiter_->clear();
  const std::span<const std::int64_t> start = matrix_->row_start();
  const std::span<const Index> columns = matrix_->columns();
  for (std::size_t body = 0; body < potentials_.size(); ++body) {
    matrix_->set_zero();
    for (std::size_t b = 0; b < conduction_.size(); ++b) {
      if (mesh_.blocks[b].body != static_cast<int>(body) || !active_.body(static_cast<int>(body))) continue;
      conduction(b).add_tangent_once(1.0, *matrix_);
      if (contributions_.empty()) conduction_[b].reset();
    }
    if (limiter_) limiter_->add_body(static_cast<int>(body), *matrix_);
    const double* values = matrix_->block(0);
    for (std::size_t s = 0; s < n; ++s) kept_conduction_[s] += potentials_[body].reference() * values[s];
    if (node_body_.empty()) continue;
    for (std::size_t i = 0; i + 1 < start.size(); ++i) {
      if (node_body_[i] >= 0) continue;
      for (std::int64_t s = start[i]; s < start[i + 1]; ++s) {
        const Index j = columns[static_cast<std::size_t>(s)];
        if (values[s] != 0 && j != static_cast<Index>(i) && node_body_[static_cast<std::size_t>(j)] < 0)
          shared_.push_back({static_cast<Index>(i), j, static_cast<int>(body), values[s]});
      }
    }
  }
  if (limiter_) limiter_->finish(*matrix_);
}

void HeatSystem::find_node_bodies() {
  node_body_.clear();
  if (mesh_.bodies.size() == 1) return;
  constexpr int k_none = -2;
  node_body_.assign(mesh_.x.size(), k_none);
  for (const mesh::Block& block : mesh_.blocks) {
    if (!active_.body(block.body)) continue;
    for (const Index node : block.nodes) {
      int& body = node_body_[static_cast<std::size_t>(node)];
      if (body == k_none) body = block.body;
      if (body != block.body) body = -1;
    }
  }
}

void HeatSystem::assemble_symmetric(std::span<const double> temperature, std::span<const double> slopes,
                                    const std::function<void(linear::BlockMatrix&)>& further) {
  if (exchange_ && kept_conduction_.empty()) keep_conduction();
  matrix_->set_zero();
  for (linear::Contribution* contribution : contributions_)
    if (exchange_ || contribution->stores()) contribution->add_tangent(temperature, *matrix_);
  if (exchange_)
    for (const SurfaceHeat& surface : surfaces_) surface.add_tangent(temperature, *matrix_);
  if (further) further(*matrix_);
  const std::span<const std::int64_t> start = matrix_->row_start();
  const std::span<const Index> columns = matrix_->columns();
  double* values = matrix_->block(0);
  if (!nodal_->identity()) {
    roots_.resize(slopes.size());
    for (std::size_t i = 0; i < slopes.size(); ++i) roots_[i] = 1.0 / std::sqrt(slopes[i]);
    for (std::size_t row = 0; row + 1 < start.size(); ++row)
      for (std::int64_t s = start[row]; s < start[row + 1]; ++s)
        if (values[s] != 0)
          values[s] *= roots_[row] * roots_[static_cast<std::size_t>(columns[static_cast<std::size_t>(s)])];
  }
  if (exchange_)
    for (std::size_t s = 0; s < kept_conduction_.size(); ++s) values[s] += kept_conduction_[s];
  if (limiter_ && exchange_) limiter_->add_symmetric_tangent(*matrix_);
}

}  // namespace solidus::heat
