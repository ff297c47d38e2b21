/// Pressures are eliminated approximately by the softness of the volume at each node; what is left is a
/// displacement block for multigrid.
#include "mechanics/solver/saddle_preconditioner.hpp"

#include <algorithm>

#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

namespace {

/// Block rows of the coarsest level. In a mush, where one element melts and the next one is solid, cycles
/// over coarser levels are no match for a factorisation: 870 linear iterations of a step of the fine
/// crankshaft become 280.
constexpr GlobalIndex k_coarsest = 150;
/// γ, the stiffness against the divergence in parts of 2Ĝ: it makes Poisson's ratio 1/4 of A.
constexpr double k_augmentation = 1.0 / 3.0 + 0.5;

}  // namespace

bool SaddlePreconditioner::serves(const linear::BlockMatrix& displacement) {
  const int components = displacement.block_size();
  return displacement.constraints().empty() &&
         linear::BlockMultigrid::supports(components, linear::rigid_body_mode_count(components));
}

SaddlePreconditioner::SaddlePreconditioner(const mesh::Mesh& mesh, linear::SaddleMatrix& matrix,
                                           NodalPressure& pressure, const parallel::GhostExchange& ghosts,
                                           bool symmetric)
    : mesh_(mesh),
      matrix_(matrix),
      pressure_(pressure),
      ghosts_(ghosts),
      multigrid_(mesh, matrix.components(), linear::rigid_body_modes, symmetric, k_coarsest) {
  // Where melt flows the Schur complement is a Laplacian and needs multigrid; elsewhere it is a mass matrix
  // with incomplete factors.
  const auto fields = as_size(pressure.fields().n_fields);
  const auto& kernels = pressure.kernels();
  if (std::any_of(kernels.begin(), kernels.end(), [](const MixedKernel* kernel) { return kernel->flows(); }))
    for (std::size_t field = 0; field < fields; ++field)
      schur_cycles_.push_back(std::make_unique<linear::BlockMultigrid>(mesh, 1, linear::constants, true));
  else
    factors_.resize(fields);
  // Each pressure field has a Schur complement of its own, without rows where a node has no pressure of it.
  for (std::size_t field = 0; field < fields; ++field) {
    schur_.push_back(std::make_unique<linear::BlockMatrix>(mesh, 1, pressure_graph(mesh, pressure),
                                                           linear::BlockMatrix::Storage::upper));
    std::vector<char> absent(mesh.x.size());
    for (std::size_t node = 0; node < absent.size(); ++node)
      absent[node] = pressure.absent()[node * fields + field];
    schur_.back()->set_fixed(std::move(absent));
  }
  for (MixedKernel* kernel : pressure.kernels()) kernel->bind_pressure(*schur_[as_size(kernel->field())]);
}

void SaddlePreconditioner::set_up_schur() {
  const double scale = pressure_.unit() * pressure_.unit();
  for (const auto& matrix : schur_) matrix->set_zero();
  for (const MixedKernel* kernel : pressure_.kernels())
    kernel->add_schur(scale, *schur_[as_size(kernel->field())]);
  for (std::size_t field = 0; field < factors_.size(); ++field) factors_[field].set_up(*schur_[field]);
  for (std::size_t field = 0; field < schur_cycles_.size(); ++field)
    schur_cycles_[field]->set_up(*schur_[field]);
  find_softness();
}

void SaddlePreconditioner::find_softness() {
  const std::size_t fields = schur_.size(), n = mesh_.x.size() * fields;
  // Pressures are scaled by their unit so that both rows of the system have one size.
  const double scale = pressure_.unit() * pressure_.unit();
  std::vector<double> softness(n, 0.0), volume(n, 0.0);
  // Softness of the volume at each node; its inverse augments the displacement block.
  for (const MixedKernel* kernel : pressure_.kernels()) kernel->add_softness(softness, volume);
  inverse_softness_.assign(as_size(mesh_.n_owned_nodes) * fields, 0.0);
  stiffness_.assign(n, 0.0);
  for (std::size_t i = 0; i < inverse_softness_.size(); ++i) {
    // A node without volume of a mixed element has no pressure to augment.
    if (!(softness[i] > 0)) continue;
    inverse_softness_[i] = k_augmentation / (scale * softness[i]);
    stiffness_[i] = k_augmentation * volume[i] / softness[i];
  }
  ghosts_.update(stiffness_, pressure_.fields().n_fields);
}

void SaddlePreconditioner::set_up_displacement() {
  linear::BlockMatrix& a = matrix_.displacement();
  for (const MixedKernel* kernel : pressure_.kernels()) kernel->add_augmentation(1.0, stiffness_, a);
  multigrid_.set_up(a);
  for (const MixedKernel* kernel : pressure_.kernels()) kernel->add_augmentation(-1.0, stiffness_, a);
}

void SaddlePreconditioner::apply(std::span<const double> r, std::span<double> z) {
  // A block triangular preconditioner in transformed pressures: first the Schur complement of each pressure
  // field, by multigrid or by factors.
  const std::size_t fields = schur_.size();
  const auto n_p = as_size(mesh_.n_owned_nodes) * fields;
  const std::size_t n_u = r.size() - n_p;
  right_.resize(n_p / fields);
  result_.resize(n_p);
  for (std::size_t field = 0; field < fields; ++field) {
    for (std::size_t node = 0; node < right_.size(); ++node) right_[node] = -r[n_u + node * fields + field];
    const auto part = std::span(result_).first(right_.size());
    if (factors_.empty())
      schur_cycles_[field]->apply(right_, part);
    else
      factors_[field].apply(right_, part);
    for (std::size_t node = 0; node < right_.size(); ++node) z[n_u + node * fields + field] = result_[node];
  }
  // The gradient of the pressure found is moved to the right-hand side of the displacements, which are then
  // answered by multigrid. Ghosts are needed wherever a rectangle of the matrix is applied.
  local_.resize(mesh_.x.size() * fields);
  std::copy(z.begin() + static_cast<std::ptrdiff_t>(n_u), z.end(), local_.begin());
  ghosts_.update(local_, pressure_.fields().n_fields);
  part_.resize(n_u);
  matrix_.multiply_gradient(local_, part_);
  const std::vector<char>& prescribed = matrix_.displacement().fixed();
  for (std::size_t i = 0; i < n_u; ++i) part_[i] = prescribed[i] ? 0.0 : r[i] - part_[i];
  multigrid_.apply(part_, z.first(n_u));

  // The transformation p = p̂ + W⁻¹ Bᵀ u is undone at last, with the displacements found.
  local_u_.resize(mesh_.x.size() * as_size(matrix_.components()));
  std::copy_n(z.begin(), n_u, local_u_.begin());
  ghosts_.update(local_u_, matrix_.components());
  result_.resize(n_p);
  matrix_.multiply_divergence(local_u_, result_);
  for (std::size_t i = 0; i < n_p; ++i) z[n_u + i] += inverse_softness_[i] * result_[i];
}

std::size_t SaddlePreconditioner::bytes() const {
  std::size_t total =
      multigrid_.bytes() + (stiffness_.capacity() + inverse_softness_.capacity() + right_.capacity() +
                            part_.capacity() + result_.capacity() + local_.capacity() + local_u_.capacity()) *
                               sizeof(double);
  for (const auto& matrix : schur_) total += matrix->bytes();
  for (const auto& factors : factors_) total += factors.bytes();
  for (const auto& cycle : schur_cycles_) total += cycle->bytes();
  return total;
}

}  // namespace solidus::mechanics
