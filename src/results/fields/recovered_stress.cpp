/// Around each node a linear function is fitted to the elements of its body, by least squares that are
/// factorised once for a mesh.
#include "results/fields/recovered_stress.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/symmetric_eigen.hpp"

namespace solidus::results {

namespace {

constexpr std::size_t k_components = 6;
/// Centroids spread in a direction where their variance is this part of that of an element's nodes.
constexpr double k_spread = 0.1;
/// Per node: rank + 1 (zero: no fit), the centre, and value and gradient of each component.
constexpr std::size_t k_fit = 4 + 4 * k_components;

/// Element that a cell of the file corresponds to.
struct ElementOfCell {
  const mesh::ElementBlock* block;
  Index element;
};
std::vector<ElementOfCell> cells_of(const mesh::Mesh& mesh) {
  std::vector<ElementOfCell> cells;
  for (const mesh::ElementBlock& block : mesh.blocks)
    for (Index e = 0; e < block.size(); ++e) cells.push_back({&block, e});
  return cells;
}

/// A matrix of at most three rows, three numbers each.
using Small = std::array<double, 9>;

/// M = L Lᵀ, in place below the diagonal; false where M is not positive definite.
bool cholesky(Small& m, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = j; i < n; ++i) {
      double rest = m[3 * i + j];
      for (std::size_t k = 0; k < j; ++k) rest -= m[3 * i + k] * m[3 * j + k];
      if (i == j && !(rest > 0)) return false;
      m[3 * i + j] = i == j ? std::sqrt(rest) : rest / m[3 * j + j];
    }
  return true;
}
/// x = L⁻¹ x and x = L⁻ᵀ x, of numbers that are `step` apart.
void solve_lower(const Small& l, std::size_t n, double* x, std::size_t step) {
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) x[i * step] -= l[3 * i + k] * x[k * step];
    x[i * step] /= l[3 * i + i];
  }
}
void solve_upper(const Small& l, std::size_t n, double* x) {
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) x[i] -= l[3 * k + i] * x[k];
    x[i] /= l[3 * i + i];
  }
}

}  // namespace

/// Volume centroids, and how far the nodes lie from them.
void StressRecovery::measure_cells(AnalysisKind kind) {
  for (const mesh::ElementBlock& block : mesh_.blocks) {
    const mesh::BlockGeometry g(mesh_, block, kind, mesh::stiffness_rule(block.shape));
    const auto n_nodes = as_size(g.n_nodes);
    std::vector<double> weight(n_nodes);
    for (Index e = 0; e < g.n_elements; ++e) {
      std::fill(weight.begin(), weight.end(), 0.0);
      double volume = 0;
      // The weights of the nodes are ∫ N_a dV, which sum to the volume.
      for (int q = 0; q < g.n_points; ++q) {
        const double w = g.weight_at(e / k_lanes, q)[e % k_lanes];
        volume += w;
        for (std::size_t a = 0; a < n_nodes; ++a) weight[a] += w * g.values[as_size(q) * n_nodes + a];
      }
      const auto x = [&](std::size_t a) { return mesh_.x[as_size(block.element(e)[a])]; };
      mesh::Point centre{};
      for (std::size_t a = 0; a < n_nodes; ++a)
        for (std::size_t i = 0; i < 3; ++i) centre[i] += weight[a] / volume * x(a)[i];
      // Second moments of the nodes tell how far the element reaches in each direction.
      std::array<double, 9> moment{};
      for (std::size_t a = 0; a < n_nodes; ++a)
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j)
            moment[3 * i + j] += (x(a)[i] - centre[i]) * (x(a)[j] - centre[j]) / static_cast<double>(n_nodes);
      centroid_.push_back(centre);
      moment_.push_back(moment);
    }
  }
}

StressRecovery::StressRecovery(const mesh::Mesh& mesh, AnalysisKind kind) : mesh_(mesh), ghosts_(mesh) {
  measure_cells(kind);
  const std::vector<ElementOfCell> cells = cells_of(mesh);
  // Around each node of each body the cells that have it, and the directions in which their centroids spread.
  std::map<std::pair<int, Index>, std::vector<std::size_t>> around;  // of body and owned node
  // A node has one patch in each of its bodies, since stresses jump from body to body.
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (int a = 0; a < mesh::node_count(cells[c].block->shape); ++a) {
      const Index node = cells[c].block->element(cells[c].element)[a];
      if (node < mesh.n_owned_nodes) around[{cells[c].block->body, node}].push_back(c);
    }
  // Each patch knows in how many directions it can tell a slope.
  for (auto& [key, list] : around) {
    Patch patch;
    patch.body = key.first;
    patch.node = key.second;
    patch.cells = std::move(list);
    spread(patch);
    patches_.push_back(std::move(patch));
  }
}

/// The directions in which the centroids of a patch spread, measured by the extent of its elements in each,
/// and the inverse there.
void StressRecovery::spread(Patch& patch) const {
  // The middle of the centroids, around which the stress is fitted.
  const std::size_t dim = as_size(mesh_.dimension);
  const double n = static_cast<double>(patch.cells.size());
  for (const std::size_t c : patch.cells)
    for (std::size_t i = 0; i < 3; ++i) patch.centre[i] += centroid_[c][i] / n;
  // How the centroids spread against each other, and how far each element extends by itself.
  Small between{}, within{};
  for (const std::size_t c : patch.cells)
    for (std::size_t i = 0; i < dim; ++i)
      for (std::size_t j = 0; j < dim; ++j) {
        between[3 * i + j] += (centroid_[c][i] - patch.centre[i]) * (centroid_[c][j] - patch.centre[j]);
        within[3 * i + j] += moment_[c][3 * i + j];
      }
  // Directions are compared after scaling by the extent, so that long elements do not count as
  // spread.
  Small& scale = within;
  if (!cholesky(scale, dim)) return;
  for (std::size_t j = 0; j < dim; ++j) solve_lower(scale, dim, &between[j], 3);
  for (std::size_t i = 0; i < dim; ++i) solve_lower(scale, dim, &between[3 * i], 1);
  std::vector<double> scaled(dim * dim);
  for (std::size_t i = 0; i < dim; ++i)
    for (std::size_t j = 0; j < dim; ++j)
      scaled[i * dim + j] = 0.5 * (between[3 * i + j] + between[3 * j + i]);
  // Only directions in which the centroids spread enough are kept for a slope; in the others it is
  // constant.
  SymmetricEigen modes = symmetric_eigen(std::move(scaled), dim);
  for (std::size_t k = 0; k < dim; ++k) {
    if (!(modes.values[k] > k_spread)) continue;
    double* const v = &modes.vectors[k * dim];
    solve_upper(scale, dim, v);
    for (std::size_t i = 0; i < dim; ++i)
      for (std::size_t j = 0; j < dim; ++j) patch.inverse[3 * i + j] += v[i] * v[j] / modes.values[k];
    ++patch.rank;
  }
}

void StressRecovery::find_fit(const Patch& patch, std::span<const double> stress, double* fit) const {
  fit[0] = patch.rank + 1;
  std::copy(patch.centre.begin(), patch.centre.end(), fit + 1);
  const double count = static_cast<double>(patch.cells.size());
  for (std::size_t k = 0; k < k_components; ++k) {
    double* const of = fit + 4 + 4 * k;
    for (const std::size_t c : patch.cells) of[0] += stress[k_components * c + k] / count;
    std::array<double, 3> moment{};
    for (const std::size_t c : patch.cells)
      for (std::size_t i = 0; i < 3; ++i)
        moment[i] += (centroid_[c][i] - patch.centre[i]) * (stress[k_components * c + k] - of[0]);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) of[1 + i] += patch.inverse[3 * i + j] * moment[j];
  }
}

std::vector<double> StressRecovery::at_nodes(std::span<const double> stress, int asked) const {
  // Each node gets the value of a linear fit to the stresses of the elements around it (superconvergent patch
  // recovery), body by body, because stress jumps from body to body.
  const std::vector<ElementOfCell> cells = cells_of(mesh_);
  const std::size_t n = mesh_.x.size();
  std::vector<double> result(k_components * n, 0.0), bodies(n, 0.0);
  for (std::size_t body = 0; body < mesh_.bodies.size(); ++body) {
    if (asked >= 0 && body != as_size(asked)) continue;
    std::vector<double> fits(k_fit * n, 0.0);
    for (const Patch& patch : patches_) {
      if (as_size(patch.body) != body) continue;
      find_fit(patch, stress, fits.data() + k_fit * as_size(patch.node));
    }
    // Ghosts get the fits of their owners, since a node may need that of a neighbour.
    ghosts_.update(fits, static_cast<int>(k_fit));
    // A node whose own patch has a lower rank than one around it (at a corner, say) takes the mean of the
    // better fits, extended to its place.
    for (const Patch& patch : patches_) {
      if (as_size(patch.body) != body) continue;
      const auto node = as_size(patch.node);
      std::vector<Index> near;
      double best = 0;
      for (const std::size_t c : patch.cells)
        for (int a = 0; a < mesh::node_count(cells[c].block->shape); ++a) {
          near.push_back(cells[c].block->element(cells[c].element)[a]);
          best = std::max(best, fits[k_fit * as_size(near.back())]);
        }
      std::sort(near.begin(), near.end());
      near.erase(std::unique(near.begin(), near.end()), near.end());
      if (best <= fits[k_fit * node]) near = {patch.node};
      double used = 0;
      std::array<double, k_components> sum{};
      for (const Index other : near) {
        const double* const fit = fits.data() + k_fit * as_size(other);
        if (fit[0] < best) continue;
        used += 1;
        for (std::size_t k = 0; k < k_components; ++k) {
          sum[k] += fit[4 + 4 * k];
          for (std::size_t i = 0; i < 3; ++i) sum[k] += fit[5 + 4 * k + i] * (mesh_.x[node][i] - fit[1 + i]);
        }
      }
      for (std::size_t k = 0; k < k_components; ++k) result[k_components * node + k] += sum[k] / used;
      bodies[node] += 1;
    }
  }
  // A node of several bodies has the mean over them.
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < k_components && bodies[i] > 0; ++k) result[k_components * i + k] /= bodies[i];
  ghosts_.update(result, static_cast<int>(k_components));
  return result;
}

std::vector<double> principal_values(std::span<const double> tensors, int rank) {
  std::vector<double> values;
  values.reserve(tensors.size() / k_components);
  for (std::size_t i = 0; i + k_components <= tensors.size(); i += k_components) {
    const double* const t = tensors.data() + i;
    Small m{t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2]};
    std::array<double, 3> principal{};
    find_symmetric_eigen(m, principal, {});
    values.push_back(principal[as_size(2 - rank)]);
  }
  return values;
}

std::vector<double> von_mises_values(std::span<const double> tensors) {
  std::vector<double> values;
  values.reserve(tensors.size() / k_components);
  for (std::size_t i = 0; i + k_components <= tensors.size(); i += k_components) {
    const double* const t = tensors.data() + i;
    const double mean = (t[0] + t[1] + t[2]) / 3;
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) square += (t[k] - mean) * (t[k] - mean) + 2 * t[3 + k] * t[3 + k];
    values.push_back(std::sqrt(1.5 * square));
  }
  return values;
}

}  // namespace solidus::results
