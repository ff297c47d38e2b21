#include "mechanics/pressure_equation.hpp"

#include <mpi.h>

#include <algorithm>
#include <cmath>

namespace solidus::mechanics {

namespace {

/// ‖r_p‖ over the size of its terms: rounding leaves 1e-16 of each.
constexpr double k_tolerance = 1e-13;
/// A volumetric strain that is nothing: a body at rest has a defect of rounding alone.
constexpr double k_no_strain = 1e-20;
/// Of one linear solve, so that the next defect is below the tolerance where the law is linear.
constexpr double k_share = 0.3;
constexpr int k_max_corrections = 25;
/// And what of the defect a linear solve takes away at most: refinement, instead of iterations that rounding
/// has stopped.
constexpr double k_refinement = 1e-6;
/// A correction that leaves more of the defect than this has met rounding.
constexpr double k_stagnates = 0.5;
/// Defects this much above the tolerance are accepted where rounding stops the iteration.
constexpr double k_rounding = 1e3;

/// Sums of squares of both over all processes.
std::array<double, 2> squares(std::span<const double> a, std::span<const double> b) {
  std::array<double, 2> sums{0, 0};
  for (const double value : a) sums[0] += value * value;
  for (const double value : b) sums[1] += value * value;
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return sums;
}

std::vector<char> mixed_blocks(std::span<const std::unique_ptr<BlockKernel>> blocks) {
  std::vector<char> mixed;
  for (const auto& block : blocks) mixed.push_back(dynamic_cast<MixedKernel*>(block.get()) != nullptr);
  return mixed;
}

std::vector<const mesh::Block*> blocks_with_pressure(const mesh::Mesh& mesh,
                                                     std::span<const std::unique_ptr<BlockKernel>> blocks) {
  const std::vector<char> mixed = mixed_blocks(blocks);
  std::vector<const mesh::Block*> result;
  for (std::size_t b = 0; b < mixed.size(); ++b)
    if (mixed[b]) result.push_back(&mesh.blocks[b]);
  return result;
}

/// Pressures couple within the elements that have them.
algebra::NodeGraph graph_of(const mesh::Mesh& mesh, std::span<const mesh::Block* const> blocks) {
  algebra::NodeGraph graph(mesh);
  for (const mesh::Block* block : blocks) graph.add_cliques(block->nodes, mesh::node_count(block->shape));
  return graph;
}

}  // namespace

PressureFields pressure_fields(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
                               std::span<const char> mixed_block) {
  const std::size_t n = mesh.bodies.size();
  std::vector<char> at_node(mesh.x.size() * n, 0);
  std::vector<int> touching(n * n, 0);
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    if (!mixed_block[b]) continue;
    for (const Index node : mesh.blocks[b].nodes)
      at_node[static_cast<std::size_t>(node) * n + static_cast<std::size_t>(mesh.blocks[b].body)] = 1;
  }
  for (std::size_t node = 0; node < mesh.x.size(); ++node)
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; at_node[node * n + a] && b < n; ++b)
        if (at_node[node * n + b] && materials[a].name != materials[b].name) touching[a * n + b] = 1;
  MPI_Allreduce(MPI_IN_PLACE, touching.data(), static_cast<int>(touching.size()), MPI_INT, MPI_MAX,
                PETSC_COMM_WORLD);
  PressureFields fields{1, std::vector<int>(n, 0)};
  for (std::size_t a = 0; a < n; ++a) {
    const auto taken = [&](int field) {
      for (std::size_t b = 0; b < a; ++b)
        if (touching[a * n + b] && fields.of_body[b] == field) return true;
      return false;
    };
    while (taken(fields.of_body[a])) ++fields.of_body[a];
    fields.n_fields = std::max(fields.n_fields, fields.of_body[a] + 1);
  }
  return fields;
}

PressureEquation::PressureEquation(const mesh::Mesh& mesh, int components,
                                   const std::vector<material::Material>& materials,
                                   std::span<const std::unique_ptr<BlockKernel>> blocks,
                                   std::vector<std::array<double, 3>> body_force, bool direct)
    : mesh_(mesh),
      components_(components),
      orthogonal_(body_force.empty()),
      ghosts_(mesh),
      fields_of_body_(pressure_fields(mesh, materials, mixed_blocks(blocks))),
      blocks_(blocks_with_pressure(mesh, blocks)),
      matrix_(mesh, fields_of_body_.n_fields, graph_of(mesh, blocks_)),
      operator_([this](std::span<const double> x, std::span<double> y) { add_projection_to(x, -1.0, y); }),
      solver_({.prefix = "mechanics_pressure_",
               .preconditioner =
                   direct ? algebra::Preconditioner::factorisation : algebra::Preconditioner::multigrid}) {
  const auto n = mesh.x.size() * static_cast<std::size_t>(fields());
  pressure_.assign(n, 0.0);
  fixed_.assign(n, 1);
  std::vector<double> volume(mesh.x.size(), 0.0);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    auto* kernel = dynamic_cast<MixedKernel*>(blocks[b].get());
    if (kernel == nullptr) continue;
    const auto body = static_cast<std::size_t>(mesh.blocks[b].body);
    const int field = fields_of_body_.of_body[body];
    kernel->use_pressure(pressure_, {fields(), field});
    kernel->bind_pressure(matrix_);
    if (!body_force.empty()) kernel->set_body_force(body_force[body]);
    kernels_.push_back(kernel);
    blocks[b]->add_nodal_volume(1.0, volume);
    for (const Index node : mesh.blocks[b].nodes)
      fixed_[static_cast<std::size_t>(node * fields() + field)] = 0;
  }
  // A ghost may have its only such element on its owner.
  std::vector<double> shared(fixed_.begin(), fixed_.end());
  ghosts_.update(shared, fields());
  for (std::size_t i = 0; i < n; ++i) fixed_[i] = shared[i] != 0;
  matrix_.set_fixed(fixed_);
  const auto owned = static_cast<std::size_t>(mesh.n_owned_nodes * fields());
  n_nodes_ =
      std::max(1.0, algebra::global_sum(static_cast<double>(std::count(
                        fixed_.begin(), fixed_.begin() + static_cast<std::ptrdiff_t>(owned), char{0}))));
  volume_ = std::sqrt(squares(std::span(volume).first(static_cast<std::size_t>(mesh.n_owned_nodes)), {})[0]);
  right_.resize(owned);
  correction_.resize(owned);
  weight_.assign(n, 0.0);
}

PressureEquation::~PressureEquation() = default;

std::unique_ptr<algebra::BlockMatrix> PressureEquation::make_matrix() const {
  auto matrix = std::make_unique<algebra::BlockMatrix>(mesh_, fields(), graph_of(mesh_, blocks_));
  matrix->set_fixed(fixed_);
  return matrix;
}

void PressureEquation::begin(std::span<const double> start) {
  direction_ = {};
  last_u_.clear();
  if (start.empty())
    std::fill(pressure_.begin(), pressure_.end(), 0.0);
  else
    std::copy(start.begin(), start.end(), pressure_.begin());
  find_unit();
  if (orthogonal_) {
    std::fill(weight_.begin(), weight_.end(), 0.0);
    for (const MixedKernel* kernel : kernels_) kernel->add_projection_weight(weight_);
    for (double& weight : weight_) weight = weight > 0 ? 1 / weight : 0.0;
  }
  matrix_.set_zero();
  for (const MixedKernel* kernel : kernels_) kernel->add_compliance(unit_ * unit_, matrix_);
  Mat assembled = matrix_.matrix();
  solver_.set(operator_.with(assembled), assembled);
}

void PressureEquation::find_unit() {
  std::array<double, 2> sums{0, 0};
  for (const MixedKernel* kernel : kernels_) {
    const auto part = kernel->mean_stiffness();
    for (std::size_t i = 0; i < 2; ++i) sums[i] += part[i];
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  const double length = std::pow(sums[0] / n_nodes_, 1.0 / mesh_.dimension);
  unit_ = sums[1] / (sums[0] * length);
}

/// out += factor × Gᵀ D⁻¹ G p on local nodes; ghost rows are scrap.
void PressureEquation::add_projection(std::span<const double> p, double factor, std::span<double> out) {
  const auto dim = static_cast<std::size_t>(mesh_.dimension);
  gradient_.assign(p.size() * dim, 0.0);
  for (const MixedKernel* kernel : kernels_) kernel->add_gradient(p, gradient_);
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t d = 0; d < dim; ++d) gradient_[i * dim + d] *= factor * weight_[i];
  ghosts_.update(gradient_, fields() * mesh_.dimension);
  for (const MixedKernel* kernel : kernels_) kernel->add_projected(gradient_, out);
}

void PressureEquation::add_projection_to(std::span<const double> x, double factor, std::span<double> y) {
  if (!orthogonal_) return;
  local_.resize(pressure_.size());
  std::copy(x.begin(), x.end(), local_.begin());
  for (std::size_t i = 0; i < x.size(); ++i)
    if (fixed_[i]) local_[i] = 0;
  ghosts_.update(local_, fields());
  projected_.assign(pressure_.size(), 0.0);
  add_projection(local_, factor * unit_ * unit_, projected_);
  for (std::size_t i = 0; i < y.size(); ++i)
    if (!fixed_[i]) y[i] += projected_[i];
}

void PressureEquation::expect(std::span<const double> displacement, std::span<const double> pressure) {
  direction_.u.assign(displacement.begin(), displacement.end());
  direction_.p.assign(pressure.begin(), pressure.end());
  direction_.from_u = last_u_;
  direction_.from_p = pressure_;
  direction_.squared = squares(displacement, {})[0];
}

/// The pressure to begin with at u.
void PressureEquation::guess(std::span<const double> u) {
  if (direction_.squared <= 0) return;
  double along = 0;
  for (std::size_t i = 0; i < direction_.u.size(); ++i)
    along += direction_.u[i] * (u[i] - direction_.from_u[i]);
  const double share = algebra::global_sum(along) / direction_.squared;
  if (!std::isfinite(share)) return;
  std::copy(direction_.from_p.begin(), direction_.from_p.end(), pressure_.begin());
  for (std::size_t i = 0; i < direction_.p.size(); ++i) pressure_[i] += share * unit_ * direction_.p[i];
  ghosts_.update(pressure_, fields());
}

bool PressureEquation::solve(std::span<const double> u) {
  const std::size_t owned = right_.size();
  const std::vector<double> before = pressure_;
  guess(u);
  double last = HUGE_VAL;
  bool found = false;
  for (int k = 0; k < k_max_corrections && !found; ++k) {
    defect_.assign(pressure_.size(), 0.0);
    size_.assign(pressure_.size(), 0.0);
    for (MixedKernel* kernel : kernels_) kernel->add_volume_defect(u, defect_, size_);
    if (orthogonal_) add_projection(pressure_, 1.0, defect_);
    const auto sums = squares(std::span(defect_).first(owned), std::span(size_).first(owned));
    const double defect = std::sqrt(sums[0]),
                 goal = std::max(k_tolerance * std::sqrt(sums[1]), k_no_strain * volume_);
    if (!std::isfinite(defect)) break;
    found = defect <= goal || (defect > k_stagnates * last && defect <= k_rounding * goal);
    if (found) break;
    last = defect;
    for (std::size_t i = 0; i < owned; ++i) right_[i] = unit_ * defect_[i];
    const algebra::LinearReport report =
        solver_.solve(right_, correction_, k_refinement, k_share * unit_ * goal);
    iterations_ += report.iterations;
    for (std::size_t i = 0; i < owned; ++i)
      if (!fixed_[i]) pressure_[i] += unit_ * correction_[i];
    ghosts_.update(pressure_, fields());
  }
  if (found)
    last_u_.assign(u.begin(),
                   u.begin() + static_cast<std::ptrdiff_t>(owned / static_cast<std::size_t>(fields()) *
                                                           static_cast<std::size_t>(components_)));
  else
    std::copy(before.begin(), before.end(), pressure_.begin());
  return found;
}

std::size_t PressureEquation::bytes() const {
  std::size_t total = matrix_.bytes();
  for (const std::vector<double>* v :
       {&pressure_, &weight_, &defect_, &size_, &gradient_, &projected_, &local_, &right_, &correction_})
    total += v->capacity() * sizeof(double);
  return total;
}

}  // namespace solidus::mechanics
