/// Gradients at the points of an element, averaged by volume, times the conductivity.
#include "results/fields/heat_flux.hpp"

#include "mesh/block_geometry.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::results {

namespace {

/// Means over the elements of what `add` sums at each point from weight, conductivity, temperature and its
/// gradient, [cell][component].
template <class Add>
std::vector<double> element_means(const mesh::Mesh& mesh, AnalysisKind kind,
                                  const std::function<const material::Material&(int)>& material_of,
                                  std::span<const double> temperature, std::size_t n_components,
                                  const Add& add) {
  std::vector<double> means;
  for (const mesh::ElementBlock& block : mesh.blocks) {
    const mesh::BlockGeometry g(mesh, block, kind, mesh::stiffness_rule(block.shape));
    const auto n_nodes = as_size(g.n_nodes), dim = as_size(g.dim);
    const Table& conductivity = material_of(block.body).conductivity;
    for (Index e = 0; e < g.n_elements; ++e) {
      const Index batch = e / k_lanes;
      const int lane = static_cast<int>(e % k_lanes);
      std::vector<double> sum(n_components, 0.0);
      double volume = 0;
      // Temperature and its gradient at each point, from the nodal values.
      for (int q = 0; q < g.n_points; ++q) {
        const Lane* const gradients = g.gradients_at(batch, q);
        const double w = g.weight_at(batch, q)[lane];
        double theta = 0;
        std::vector<double> gradient(dim, 0.0);
        for (std::size_t a = 0; a < n_nodes; ++a) {
          const double value = temperature[as_size(block.element(e)[a])];
          theta += g.values[as_size(q) * n_nodes + a] * value;
          for (std::size_t i = 0; i < dim; ++i) gradient[i] += gradients[a * dim + i][lane] * value;
        }
        add(w, conductivity.value(theta), theta, gradient, sum);
        volume += w;
      }
      // The mean over the element, by volume.
      for (const double value : sum) means.push_back(value / volume);
    }
  }
  return means;
}

}  // namespace

std::vector<double> element_heat_flux(const mesh::Mesh& mesh, AnalysisKind kind,
                                      const std::function<const material::Material&(int)>& material_of,
                                      std::span<const double> temperature) {
  return element_means(
      mesh, kind, material_of, temperature, as_size(mesh.dimension),
      [](double w, double k, double, const std::vector<double>& gradient, std::vector<double>& sum) {
        for (std::size_t i = 0; i < sum.size(); ++i) sum[i] -= w * k * gradient[i];
      });
}

std::vector<double> element_conduction_dissipation(
    const mesh::Mesh& mesh, AnalysisKind kind,
    const std::function<const material::Material&(int)>& material_of, std::span<const double> temperature) {
  return element_means(
      mesh, kind, material_of, temperature, 1,
      [](double w, double k, double theta, const std::vector<double>& gradient, std::vector<double>& sum) {
        for (const double slope : gradient) sum[0] += w * k * slope * slope / theta;
      });
}

}  // namespace solidus::results
