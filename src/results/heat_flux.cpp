#include "results/heat_flux.hpp"

#include "mesh/block_geometry.hpp"

namespace solidus::results {

std::vector<double> element_heat_flux(const mesh::Mesh& mesh, AnalysisKind kind,
                                      const std::function<const material::Material&(int)>& material_of,
                                      std::span<const double> temperature) {
  std::vector<double> flux;
  for (const mesh::Block& block : mesh.blocks) {
    const mesh::BlockGeometry g(mesh, block, kind, mesh::stiffness_rule(block.shape));
    const auto n_nodes = static_cast<std::size_t>(g.n_nodes), dim = static_cast<std::size_t>(g.dim);
    const Table& conductivity = material_of(block.body).conductivity;
    for (Index e = 0; e < g.n_elements; ++e) {
      const Index batch = e / k_lanes;
      const int lane = static_cast<int>(e % k_lanes);
      std::vector<double> sum(dim, 0.0);
      double volume = 0;
      for (int q = 0; q < g.n_points; ++q) {
        const Lane* const gradients = g.gradients_at(batch, q);
        const double w = g.weight_at(batch, q)[lane];
        double theta = 0;
        std::vector<double> gradient(dim, 0.0);
        for (std::size_t a = 0; a < n_nodes; ++a) {
          const double value = temperature[static_cast<std::size_t>(block.element(e)[a])];
          theta += g.values[static_cast<std::size_t>(q) * n_nodes + a] * value;
          for (std::size_t i = 0; i < dim; ++i) gradient[i] += gradients[a * dim + i][lane] * value;
        }
        for (std::size_t i = 0; i < dim; ++i) sum[i] -= w * conductivity.value(theta) * gradient[i];
        volume += w;
      }
      for (const double value : sum) flux.push_back(value / volume);
    }
  }
  return flux;
}

}  // namespace solidus::results
