#include "heat/iteration/heat_system.hpp"

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

HeatSystem::HeatSystem(const mesh::Mesh& mesh, AnalysisKind kind,
                       const std::vector<material::Material>& materials, const ThermalConditions& conditions,
                       bool closed, std::vector<linear::Contribution*> contributions,
                       linear::BlockMatrix::Storage storage, bool correct_edges)
    : mesh_(mesh), kind_(kind), closed_(closed), contributions_(std::move(contributions)), active_(mesh) {
  // Contributions that bring heat of their own make bounds of temperature impossible; those that only store
  // do not.
  contributions_heat_ = std::any_of(contributions_.begin(), contributions_.end(),
                                    [](const linear::Contribution* c) { return !c->stores(); });
  for (const material::Material& m : materials) at_nodes_.push_back(closed || m.changes_isothermally());
  // Conduction comes before the conditions, since conditions on nodes ask where heat is stored.
  if (correct_edges) edges_ = EdgeConduction(mesh);
  add_conduction(materials);
  if (!conditions.absent_bodies.empty()) throw std::invalid_argument("every body is there when a run begins");
  add_conditions(conditions);

  // The matrix has room for all that adds to it, contact included.
  nodal_ = std::make_unique<NodalPotential>(mesh, potentials_, active_);
  matrix_ = std::make_unique<linear::BlockMatrix>(mesh, 1, graph(), storage);
  matrix_->set_fixed(fixed_);
  bind();
  supplied_.resize(mesh.x.size());
  if (!contributions_.empty()) contributed_.resize(static_cast<std::size_t>(mesh.n_owned_nodes));
  contribution_power_.resize(contributions_.size());
}

HeatSystem::~HeatSystem() = default;

linear::NodeGraph HeatSystem::graph() const {
  linear::NodeGraph graph(mesh_);
  for (const mesh::ElementBlock& block : mesh_.blocks)
    if (active_.body(block.body)) graph.add_cliques(block.nodes, mesh::node_count(block.shape));
  for (const linear::Contribution* contribution : contributions_) contribution->add_to_graph(graph);
  return graph;
}

void HeatSystem::bind() {
  forget_conduction();
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
bool HeatSystem::set_conditions(const ThermalConditions& conditions) {
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

/// Conduction of a body that comes back is computed again when it is asked for.
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
  for (const mesh::ElementBlock& block : mesh_.blocks)
    if (static_cast<std::size_t>(block.body) == body)
      for (const Index node : block.nodes) of_body[static_cast<std::size_t>(node)] = 1;
  Field& u = fields_[body];
  u.nodes.reserve(static_cast<std::size_t>(std::count(of_body.begin(), of_body.end(), 1)));
  for (std::size_t i = 0; i < of_body.size(); ++i)
    if (of_body[i] != 0) u.nodes.push_back(static_cast<Index>(i));
}

void HeatSystem::set_window(const LoadWindow& window) {
  for (SurfaceHeat& surface : surfaces_) surface.set_window(window);
  for (Volume& source : sources_)
    if (!source.burning) source.set_window(window);
  const auto prescribe = [&] {
    for (Prescribed& p : prescribed_) p.value.values(p.x, window.time, p.now);
  };
  if (placed_)
    run_collectively(prescribe);
  else
    prescribe();
}

double HeatSystem::lasting(double from, double to) const {
  double longest = HUGE_VAL;
  for (const SurfaceHeat& surface : surfaces_) longest = std::min(longest, surface.lasting(from, to));
  for (const Volume& source : sources_)
    if (source.load) longest = std::min(longest, source.load->lasting(from, to));
  return longest;
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

void HeatSystem::release_work() {
  std::vector<double>().swap(local_);
  for (Field& u : fields_) std::vector<double>().swap(u.value);
}

double HeatSystem::residual(std::span<const double> temperature, std::span<double> r) {
  // The residual is the sum of flows out of the nodes: conduction, surfaces and sources, less what limits
  // hold back.
  double moved = 0;
  std::fill(supplied_.begin(), supplied_.end(), 0.0);
  std::fill(surface_power_.begin(), surface_power_.end(), 0.0);
  std::fill(source_power_.begin(), source_power_.end(), 0.0);
  if (exchange_)
    moved += add_flows(temperature);
  else
    local_.assign(mesh_.x.size(), 0.0);
  std::copy_n(local_.begin(), r.size(), r.begin());
  if (limiter_ && exchange_) limiter_->add_heat(temperature, r);
  storing_.clear();
  // Contributions add theirs; the ones that store are summed apart, because the balance of a step treats them
  // as storage.
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
    conduction_[block] = make_conduction_block(mesh_, mesh_.blocks[block], kind_, closed_, edges_);
    conduction_[block]->bind(*matrix_);
  }
  return *conduction_[block];
}

/// Conduction without its limits, in local_:  Σ_j K_ij (u_j − u_i), since Σ_j K_ij = 0. A uniform temperature
/// gives no flow to the last bit, and what one node of a pair gives the other one gets.
void HeatSystem::conduct(std::span<const double> temperature) {
  if (!keeps_conduction()) keep_conduction();
  std::vector<const double*> potential(fields_.size(), temperature.data());
  std::vector<double> factor(fields_.size(), 1.0);
  for (std::size_t b = 0; b < fields_.size(); ++b) {
    if (potentials_[b].constant()) continue;
    if (!fields_[b].nodes.empty()) fields_[b].value.resize(mesh_.x.size());
    for (const Index node : fields_[b].nodes) {
      const auto i = static_cast<std::size_t>(node);
      fields_[b].value[i] = potentials_[b].value(temperature[i]);
    }
    potential[b] = fields_[b].value.data();
    factor[b] = 1.0 / potentials_[b].reference();
  }
  local_.assign(mesh_.x.size(), 0.0);
  const bool half = matrix_->storage() == linear::BlockMatrix::Storage::upper;
  const std::span<const std::int64_t> start = matrix_->row_start();
  const std::span<const Index> columns = matrix_->columns();
  const double* const entries = kept_conduction_.empty() ? matrix_->block(0) : kept_conduction_.data();
  // The diagonal adds nothing. Rows of ghosts are scrap.
  for (std::size_t i = 0; i + 1 < start.size(); ++i) {
    const int own = node_body_.empty() ? 0 : node_body_[i];
    double sum = 0;
    for (std::int64_t s = start[i]; s < start[i + 1]; ++s) {
      const auto j = static_cast<std::size_t>(columns[static_cast<std::size_t>(s)]);
      const int body = own >= 0 ? own : node_body_[j];
      if (body < 0) continue;
      const auto b = static_cast<std::size_t>(body);
      const double flow = entries[s] * (factor[b] * (potential[b][j] - potential[b][i]));
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
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh_.n_owned_nodes); ++i)
    sum -= supplied_[i] / temperature[i];
  return sum;
}

}  // namespace solidus::heat
