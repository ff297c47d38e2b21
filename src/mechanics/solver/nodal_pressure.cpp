/// The kernels of mixed elements write into the arrays of this class, which adds the projection of the
/// stabilisation and finds the unit of the pressure.
#include "mechanics/solver/nodal_pressure.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "numbers/index_casts.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"

namespace solidus::mechanics {

namespace {

/// Solutions of a step after each of which further elements may be full of pores.
constexpr int k_most_pore_iterations = 20;

std::vector<const mesh::ElementBlock*> blocks_with_pressure(
    const mesh::Mesh& mesh, std::span<const std::unique_ptr<BlockKernel>> blocks) {
  const std::vector<char> mixed = mixed_blocks(blocks);
  std::vector<const mesh::ElementBlock*> result;
  for (std::size_t b = 0; b < mixed.size(); ++b)
    if (mixed[b]) result.push_back(&mesh.blocks[b]);
  return result;
}

}  // namespace

std::vector<char> mixed_blocks(std::span<const std::unique_ptr<BlockKernel>> blocks) {
  std::vector<char> mixed;
  for (const auto& block : blocks) mixed.push_back(dynamic_cast<MixedKernel*>(block.get()) != nullptr);
  return mixed;
}

NodalPressure::NodalPressure(const mesh::Mesh& mesh, BodyFields fields_of_bodies,
                             std::span<const std::unique_ptr<BlockKernel>> blocks, bool orthogonal)
    : mesh_(mesh),
      ghosts_(mesh),
      fields_(std::move(fields_of_bodies)),
      blocks_(blocks_with_pressure(mesh, blocks)) {
  // A pressure for each node and field; a field is a body, or several that share no nodes.
  const auto n = mesh.x.size() * as_size(fields_.n_fields);
  pressure_.assign(n, 0.0);
  volume_residual_.assign(n, 0.0);
  volume_change_.assign(n, 0.0);
  std::vector<double> absent(n, 1.0);
  // Blocks of mixed elements write into these arrays; nodes without such an element have no pressure.
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    auto* kernel = dynamic_cast<MixedKernel*>(blocks[b].get());
    if (kernel == nullptr) continue;
    const auto body = as_size(mesh.blocks[b].body);
    const int field = fields_.of_body[body];
    kernel->use_pressure({pressure_, volume_residual_, volume_change_, fields_.n_fields, field});
    kernels_.push_back(kernel);
    for (const Index node : mesh.blocks[b].nodes) absent[as_size(node * fields_.n_fields + field)] = 0;
  }
  // A ghost may have its only such element on its owner.
  ghosts_.update(absent, fields_.n_fields);
  absent_.resize(n);
  // Only a node with an element of mixed form, here or on its owner, has a pressure.
  for (std::size_t i = 0; i < n; ++i) absent_[i] = absent[i] != 0;
  const auto owned = static_cast<std::ptrdiff_t>(mesh.n_owned_nodes * fields_.n_fields);
  // The mean square of residuals is taken over the nodes that have one.
  n_nodes_ = std::max(1.0, parallel::global_sum(static_cast<double>(
                               std::count(absent_.begin(), absent_.begin() + owned, char{0}))));
  if (orthogonal)
    projection_ = std::make_unique<PressureProjection>(mesh, ghosts_, kernels_, fields_.n_fields);
}

void NodalPressure::begin() {
  find_unit();
  if (projection_) projection_->begin();
}

/// Writes pressures in pascals for the kernels, and clears what they are about to sum.
void NodalPressure::set(std::span<const double> unknowns) {
  for (std::size_t i = 0; i < pressure_.size(); ++i) pressure_[i] = unit_ * unknowns[i];
  std::fill(volume_residual_.begin(), volume_residual_.end(), 0.0);
  std::fill(volume_change_.begin(), volume_change_.end(), 0.0);
}

/// The residual of the volume equation in the unit of the pressure: sums of the kernels, and the projection
/// of the stabilisation.
void NodalPressure::residual(std::span<double> r, BodyBalance& balance) {
  if (projection_) projection_->add(pressure_, 1.0, volume_residual_);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = absent_[i] ? 0.0 : -unit_ * volume_residual_[i];
  balance.add_volume_residual(r, fields_.n_fields);
  for (double& change : volume_change_) change *= unit_;
  balance.add_volume_change(std::span<const double>(volume_change_).first(r.size()), fields_.n_fields);
}

/// The unit is the mean of 2Ĝ over the length of an element, the root of the mean volume of a node: with it
/// both diagonal blocks of the saddle point are of one size.
void NodalPressure::find_unit() {
  std::array<double, 2> sums{0, 0};
  for (const MixedKernel* kernel : kernels_) {
    const auto part = kernel->mean_stiffness();
    for (std::size_t i = 0; i < 2; ++i) sums[i] += part[i];
  }
  processes::sum(sums);
  const double length = std::pow(sums[0] / n_nodes_, 1.0 / mesh_.dimension);
  unit_ = sums[1] / (sums[0] * length);
}

std::size_t NodalPressure::bytes() const {
  std::size_t total = projection_ ? projection_->bytes() : 0;
  for (const std::vector<double>* v : {&pressure_, &volume_residual_, &volume_change_})
    total += v->capacity() * sizeof(double);
  return total;
}

PressureProjection::PressureProjection(const mesh::Mesh& mesh, const parallel::GhostExchange& ghosts,
                                       const std::vector<MixedKernel*>& kernels, int fields)
    : mesh_(mesh),
      ghosts_(ghosts),
      kernels_(kernels),
      fields_(fields),
      weight_(mesh.x.size() * as_size(fields)) {}

/// The weights of the nodal mean of gradients, whose difference from the gradient is penalised.
void PressureProjection::begin() {
  std::fill(weight_.begin(), weight_.end(), 0.0);
  for (const MixedKernel* kernel : kernels_) kernel->add_projection_weight(weight_);
  for (double& weight : weight_) weight = weight > 0 ? 1 / weight : 0.0;
}

void PressureProjection::add(std::span<const double> p, double factor, std::span<double> out) {
  const auto dim = as_size(mesh_.dimension);
  gradient_.assign(p.size() * dim, 0.0);
  for (const MixedKernel* kernel : kernels_) kernel->add_gradient(p, gradient_);
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t d = 0; d < dim; ++d) gradient_[i * dim + d] *= factor * weight_[i];
  ghosts_.update(gradient_, fields_ * mesh_.dimension);
  for (const MixedKernel* kernel : kernels_) kernel->add_projected(gradient_, out);
}

/// The same as an operator on unknowns of owned nodes, for the product with the matrix.
void PressureProjection::add_owned(std::span<const double> x, double factor, const std::vector<char>& absent,
                                   std::span<double> y) {
  local_.resize(weight_.size());
  std::copy(x.begin(), x.end(), local_.begin());
  // Nodes without a pressure take no part.
  for (std::size_t i = 0; i < x.size(); ++i)
    if (absent[i]) local_[i] = 0;
  ghosts_.update(local_, fields_);
  projected_.assign(weight_.size(), 0.0);
  add(local_, factor, projected_);
  for (std::size_t i = 0; i < y.size(); ++i)
    if (!absent[i]) y[i] += projected_[i];
}

std::size_t PressureProjection::bytes() const {
  std::size_t total = 0;
  for (const std::vector<double>* v : {&weight_, &gradient_, &projected_, &local_})
    total += v->capacity() * sizeof(double);
  return total;
}

/// Pressures in pascals become unknowns in the unit of the matrix.
void to_unknowns(const NodalPressure& of, std::span<const double> pressure, std::span<double> unknowns) {
  std::fill(unknowns.begin(), unknowns.end(), 0.0);
  assert(pressure.empty() || pressure.size() == of.absent().size());
  for (std::size_t i = 0; i < pressure.size(); ++i)
    unknowns[i] = of.absent()[i] ? 0.0 : pressure[i] / of.unit();
}

void release_pores(NodalPressure& pressure) {
  for (MixedKernel* kernel : pressure.kernels()) kernel->release_pores();
}

bool fill_pores(NodalPressure& pressure, std::span<const double> unknowns, int iteration) {
  pressure.set(unknowns);
  bool filled = false;
  for (MixedKernel* kernel : pressure.kernels()) filled |= kernel->fill_pores();
  if (!parallel::any_process(filled)) return false;
  if (iteration > k_most_pore_iterations)
    throw StepRejected("mechanics: one element after another fills with pores",
                       "a step in which much more shrinks than can be fed", Failure::equilibrium);
  return true;
}

void add_projection(const NodalPressure& pressure, std::span<const double> x, double factor,
                    std::span<double> y) {
  if (PressureProjection* const projection = pressure.projection())
    projection->add_owned(x, factor * pressure.unit() * pressure.unit(), pressure.absent(), y);
}

linear::NodeGraph pressure_graph(const mesh::Mesh& mesh, const NodalPressure& pressure) {
  linear::NodeGraph graph(mesh);
  for (const mesh::ElementBlock* block : pressure.blocks())
    graph.add_cliques(block->nodes, mesh::node_count(block->shape));
  return graph;
}

}  // namespace solidus::mechanics
