#include "coupling/coherency.hpp"

#include "heat/thermal_phase.hpp"
#include "parallel/parallel.hpp"

namespace solidus::coupling {

Coherency::Coherency(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
                     const linear::ActiveSet& active)
    : mesh_(mesh), material_(static_cast<std::size_t>(mesh.n_owned_nodes), nullptr) {
  for (const mesh::ElementBlock& block : mesh.blocks) {
    const material::Material& material = materials[static_cast<std::size_t>(block.body)];
    if (!active.body(block.body) || material.solidification() == nullptr) continue;
    melts_ = true;  // every process has every block
    for (const Index node : block.nodes)
      if (node < mesh.n_owned_nodes && material_[static_cast<std::size_t>(node)] == nullptr)
        material_[static_cast<std::size_t>(node)] = &material;
  }
  of_solid_.assign(mesh.x.size(), 1.0);
  for (std::size_t i = 0; i < material_.size(); ++i)
    if (material_[i] != nullptr) of_solid_[i] = 1 / material_[i]->casting.coherency_fraction;
  parallel::GhostExchange(mesh_).update(of_solid_, 1);
}

std::vector<double> Coherency::at(const heat::ThermalPhase* heat, const heat::ThermalState& state,
                                  const std::vector<double>& temperature) const {
  if (!melts_) return {};
  std::vector<double> coherency(mesh_.x.size(), 1.0), solid;
  if (heat != nullptr) solid = heat->solid_fraction(state);
  for (std::size_t i = 0; i < material_.size(); ++i) {
    if (material_[i] == nullptr) continue;
    const double fraction = heat != nullptr ? solid[i] : material_[i]->solid_fraction(temperature[i]);
    coherency[i] = fraction / material_[i]->casting.coherency_fraction;
  }
  parallel::GhostExchange(mesh_).update(coherency, 1);
  return coherency;
}

}  // namespace solidus::coupling
