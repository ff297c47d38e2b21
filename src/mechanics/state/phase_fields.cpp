/// Fractions are found at the nodes, where heat is stored, and interpolated to the points of each block
/// within the range of its nodes.
#include "mechanics/state/phase_fields.hpp"

#include <algorithm>

#include "numbers/index_casts.hpp"

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

double share_at(const FractionPlace& at, std::size_t node) {
  return at.plateau_share.empty() ? k_molten : at.plateau_share[node];
}

std::vector<char> melting_blocks(const mesh::Mesh& mesh, const std::vector<material::Material>& materials) {
  std::vector<char> melts;
  for (const mesh::ElementBlock& block : mesh.blocks)
    melts.push_back(materials[as_size(block.body)].solidification() != nullptr);
  return melts;
}

}  // namespace

NodalPhases::NodalPhases(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
                         std::span<const double> initial_temperature)
    : n_nodes_(mesh.x.size()),
      fields_(body_fields(mesh, materials, melting_blocks(mesh, materials))),
      blocks_(mesh.blocks.size()) {
  bool melts = false;
  // A block needs nodal fractions if its material freezes or strains by a phase change. Whether any material
  // melts is known on every process, since each has every block.
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const auto body = as_size(mesh.blocks[b].body);
    const material::Material& material = materials[body];
    OfBlock& block = blocks_[b];
    block.strains = std::any_of(material.phase_changes.begin(), material.phase_changes.end(),
                                [](const material::PhaseChange& c) { return c.volume_change != 0; });
    melts = melts || material.solidification() != nullptr;  // every process has every block
    if (material.solidification() == nullptr && !block.strains) continue;
    block.material = &material;
    // The fields of a body are evaluated at its nodes; each block keeps the list of them without doubles.
    block.field = as_size(fields_.of_body[body]);
    block.nodes = mesh.blocks[b].nodes;
    std::sort(block.nodes.begin(), block.nodes.end());
    block.nodes.erase(std::unique(block.nodes.begin(), block.nodes.end()), block.nodes.end());
    block.nodes.shrink_to_fit();
    solid_fraction_.resize(n_nodes_, 1.0);
    freezing_.resize(n_nodes_, 0.0);
    contracting_.resize(n_nodes_, 1.0);
    // Straining of phase changes is counted from the initial state of the node, taken as molten within a
    // plateau.
    if (!block.strains) continue;
    straining_.resize(n_nodes_, 0.0);
    for (const Index node : block.nodes)
      block.initial_straining.push_back(straining(material, initial_temperature[as_size(node)], k_molten));
  }
  // The initial solid fraction is the reference of a run that starts with metal partly solid.
  if (!melts) return;
  initial_solid_fraction_.assign(n_nodes_ * as_size(fields_.n_fields), 1.0);
  initial_solid_fraction_ = solid_fraction({initial_temperature, {}});
}

std::vector<double> NodalPhases::solid_fraction(const FractionPlace& at) const {
  std::vector<double> fraction(initial_solid_fraction_.size(), 1.0);
  for (const OfBlock& of : blocks_) {
    const material::PhaseChange* const freezing =
        of.material != nullptr ? of.material->solidification() : nullptr;
    if (freezing == nullptr) continue;
    // At each node by the temperature and, within a jump, by the share of it that is done.
    for (const Index node : of.nodes) {
      const auto i = as_size(node);
      fraction[place(i, of)] = freezing->fraction.value(at.temperature[i], share_at(at, i));
    }
  }
  return fraction;
}

std::vector<double> NodalPhases::mean_solid_fraction(std::span<const double> before,
                                                     const FractionPlace& at) const {
  std::vector<double> fraction = solid_fraction(at);
  for (std::size_t i = 0; i < before.size(); ++i) fraction[i] = 0.5 * (fraction[i] + before[i]);
  return fraction;
}

PhaseFields NodalPhases::evaluate(std::size_t block, const FractionPlace& at,
                                  std::span<const double> before) {
  // The fractions of the block's material at its nodes, from temperature and share of a plateau. The law
  // works with the mean of the step where a fraction at its start is known.
  const OfBlock& of = blocks_[block];
  if (of.material == nullptr) return {};
  const material::PhaseChange* const freezing = of.material->solidification();
  for (std::size_t n = 0; n < of.nodes.size(); ++n) {
    const auto i = as_size(of.nodes[n]);
    const double share = share_at(at, i);
    if (freezing != nullptr) {
      const double now = freezing->fraction.value(at.temperature[i], share);
      const double old = before.empty() ? now : before[place(i, of)];
      solid_fraction_[i] = before.empty() ? now : 0.5 * (now + old);
      freezing_[i] = freezing->volume_change * (now - old);
      contracting_[i] = freezing->fraction.mean_over_temperature(old, now);
    }
    // Straining is counted from the initial state of the node.
    if (of.strains)
      straining_[i] = straining(*of.material, at.temperature[i], share) - of.initial_straining[n];
  }
  PhaseFields fields;
  if (freezing != nullptr) {
    fields.solid_fraction = solid_fraction_;
    fields.freezing = freezing_;
    fields.contracting = contracting_;
  }
  if (of.strains) fields.straining = straining_;
  return fields;
}

std::size_t NodalPhases::bytes() const {
  std::size_t total = (solid_fraction_.capacity() + straining_.capacity() + freezing_.capacity() +
                       contracting_.capacity() + initial_solid_fraction_.capacity()) *
                      sizeof(double);
  for (const OfBlock& block : blocks_)
    total += block.nodes.capacity() * sizeof(Index) + block.initial_straining.capacity() * sizeof(double);
  return total;
}

}  // namespace solidus::mechanics
