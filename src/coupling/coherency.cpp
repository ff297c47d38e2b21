/// A node takes the material that can melt; elements of melt count by their mean, so that one solid node
/// does not make an element coherent.
#include "coupling/coherency.hpp"

#include <algorithm>

#include "heat/thermal_phase.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::coupling {

Coherency::Coherency(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
                     const linear::ActiveSet& active)
    : mesh_(mesh), materials_(materials), material_(mesh.x.size(), nullptr) {
  // The material of each node is that of the first body there that can melt.
  for (const mesh::ElementBlock& block : mesh.blocks) {
    const material::Material& material = materials[as_size(block.body)];
    if (!active.body(block.body) || material.solidification() == nullptr) continue;
    melts_ = true;  // every process has every block
    blocks_.push_back(&block);
    for (const Index node : block.nodes)
      if (material_[as_size(node)] == nullptr) material_[as_size(node)] = &material;
  }
  // Nodes of bodies that do not melt are coherent from the start.
  of_solid_.assign(mesh.x.size(), 1.0);
  if (!melts_) return;
  const std::size_t n_bodies = mesh.bodies.size();
  of_solid_ = of(std::vector<double>(mesh.x.size(), 1.0), {1, std::vector<int>(n_bodies, 0)});
}

void Coherency::set_shells(std::span<const std::string> surfaces, std::span<const double> length) {
  std::vector<char> melts;
  for (const mesh::ElementBlock& block : mesh_.blocks)
    melts.push_back(std::ranges::find(blocks_, &block) != blocks_.end());
  depth_.emplace(mesh_, surfaces, melts, length);
  if (!depth_->any()) depth_.reset();
}

std::vector<double> Coherency::of(std::span<const double> solid_fraction,
                                  const mechanics::BodyFields& fields) const {
  if (!melts_) return {};
  // The coherency of a node is the least of its elements: a wall lets go of elements, and an element is as
  // coherent as the mean of its vertices.
  constexpr double k_unknown = -1;
  std::vector<double> coherency(mesh_.x.size(), k_unknown), of_nodes(mesh_.x.size(), 1.0);
  for (const mesh::ElementBlock* block : blocks_) {
    const auto body = as_size(block->body);
    const double of_one = 1 / materials_[body].casting.coherency_fraction;
    const auto width = as_size(fields.n_fields), field = as_size(fields.of_body[body]);
    const auto vertices = as_size(mesh::vertex_count(block->shape));
    const std::size_t n = block->nodes.empty() ? 0 : block->nodes.size() / as_size(block->size());
    for (Index e = 0; e < block->size(); ++e) {
      const std::span<const Index> nodes(block->element(e), n);
      double sum = 0;
      for (std::size_t a = 0; a < vertices; ++a) sum += solid_fraction[as_size(nodes[a]) * width + field];
      const double of_element = of_one * (sum / static_cast<double>(vertices));
      for (const Index node : nodes) {
        of_nodes[as_size(node)] = of_one * solid_fraction[as_size(node) * width + field];
        double& least = coherency[as_size(node)];
        least = least == k_unknown ? of_element : std::min(least, of_element);
      }
    }
  }
  // Nodes of bodies that do not melt are coherent.
  std::ranges::replace(coherency, k_unknown, 1.0);
  if (depth_) depth_->limit(of_nodes, coherency);
  parallel::GhostExchange(mesh_).update(coherency, 1);
  return coherency;
}

std::vector<double> Coherency::at(const heat::ThermalPhase* heat, const heat::ThermalState& state,
                                  const std::vector<double>& temperature) const {
  if (!melts_) return {};
  std::vector<double> solid(mesh_.x.size(), 1.0);
  if (heat != nullptr) {
    solid = heat->states().solid_fraction(state);
    parallel::GhostExchange(mesh_).update(solid, 1);
  } else {
    for (std::size_t i = 0; i < material_.size(); ++i)
      if (material_[i] != nullptr) solid[i] = material_[i]->solid_fraction(temperature[i]);
  }
  return of(solid, {1, std::vector<int>(mesh_.bodies.size(), 0)});
}

}  // namespace solidus::coupling
