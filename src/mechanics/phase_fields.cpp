#include "mechanics/phase_fields.hpp"

#include <algorithm>

namespace solidus::mechanics {

namespace {

/// e^pc at a node (2.75).
double straining(const material::Material& material, double temperature, double plateau_share) {
  double sum = 0;
  for (const material::PhaseChange& change : material.phase_changes)
    if (change.volume_change != 0)
      sum += change.volume_change * change.fraction.value(temperature, plateau_share);
  return sum;
}

constexpr double k_molten = 1;  // of an isothermal change, where nothing else is known

}  // namespace

NodalPhases::NodalPhases(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
                         std::span<const double> initial_temperature)
    : blocks_(mesh.blocks.size()) {
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const material::Material& material = materials[static_cast<std::size_t>(mesh.blocks[b].body)];
    OfBlock& block = blocks_[b];
    block.strains = std::any_of(material.phase_changes.begin(), material.phase_changes.end(),
                                [](const material::PhaseChange& c) { return c.volume_change != 0; });
    if (material.solidification() == nullptr && !block.strains) continue;
    block.material = &material;
    block.nodes = mesh.blocks[b].nodes;
    std::sort(block.nodes.begin(), block.nodes.end());
    block.nodes.erase(std::unique(block.nodes.begin(), block.nodes.end()), block.nodes.end());
    block.nodes.shrink_to_fit();
    solid_fraction_.resize(mesh.x.size(), 1.0);
    if (!block.strains) continue;
    straining_.resize(mesh.x.size(), 0.0);
    for (const Index node : block.nodes)
      block.initial_straining.push_back(
          straining(material, initial_temperature[static_cast<std::size_t>(node)], k_molten));
  }
}

PhaseFields NodalPhases::evaluate(std::size_t block, std::span<const double> temperature,
                                  std::span<const double> plateau_share) {
  const OfBlock& of = blocks_[block];
  if (of.material == nullptr) return {};
  const material::PhaseChange* const freezing = of.material->solidification();
  for (std::size_t n = 0; n < of.nodes.size(); ++n) {
    const auto i = static_cast<std::size_t>(of.nodes[n]);
    const double share = plateau_share.empty() ? k_molten : plateau_share[i];
    if (freezing != nullptr) solid_fraction_[i] = freezing->fraction.value(temperature[i], share);
    if (of.strains) straining_[i] = straining(*of.material, temperature[i], share) - of.initial_straining[n];
  }
  PhaseFields fields;
  if (freezing != nullptr) fields.solid_fraction = solid_fraction_;
  if (of.strains) fields.straining = straining_;
  return fields;
}

std::size_t NodalPhases::bytes() const {
  std::size_t total = (solid_fraction_.capacity() + straining_.capacity()) * sizeof(double);
  for (const OfBlock& block : blocks_)
    total += block.nodes.capacity() * sizeof(Index) + block.initial_straining.capacity() * sizeof(double);
  return total;
}

}  // namespace solidus::mechanics
