/// A face of a surface in contact is there as long as it bounds exactly one element that is born: then the
/// mesh of now has it in its surface.
#include "setup/growing_contacts.hpp"

#include <algorithm>
#include <span>
#include <unordered_set>
#include <utility>

#include "mesh/surfaces/faces.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::setup {

void set_growing_surfaces(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                          contact::ContactParameters& pair) {
  if (spec.depositions.empty()) return;
  std::vector<char> grows(mesh.x.size(), 0);
  for (const cases::DepositionSpec& d : spec.depositions)
    for (const mesh::ElementBlock& block : mesh.blocks)
      if (mesh.bodies[as_size(block.body)].name == d.body)
        for (const Index node : block.nodes) grows[as_size(node)] = 1;
  for (const std::string& side : {pair.slave, pair.master}) {
    const auto surface = mesh.surfaces.find(side);
    const bool any =
        surface != mesh.surfaces.end() &&
        std::ranges::any_of(surface->second.nodes, [&](Index node) { return grows[as_size(node)] != 0; });
    if (parallel::any_process(any)) pair.growing.push_back(side);
  }
}

GrowingContacts::GrowingContacts(const mesh::Mesh& whole, const Pairs& pairs) : whole_(whole), pairs_(pairs) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const contact::ContactParameters& spec = pairs[i]->parts().spec;
    if (spec.growing.empty()) continue;
    growing_.push_back({i, side(*pairs[i], spec.slave), side(*pairs[i], spec.master)});
  }
}

GrowingContacts::Side GrowingContacts::side(const contact::ContactPair& pair, const std::string& name) const {
  const std::vector<std::string>& growing = pair.parts().spec.growing;
  if (std::ranges::find(growing, name) == growing.end()) return {};
  return {name, std::make_unique<contact::ContactSurface>(whole_, name)};
}

std::vector<char> GrowingContacts::there(const Side& side, const mesh::Mesh& present) const {
  if (side.faces == nullptr) return {};
  std::unordered_set<mesh::FaceKey, mesh::FaceKeyHash> found;
  for (const mesh::ElementBlock& faces : present.surfaces.at(side.name).faces)
    for (Index f = 0; f < faces.size(); ++f)
      found.insert(mesh::face_key(faces.element(f), mesh::vertex_count(faces.shape)));
  // Every process has all faces, but only the one that owns the first node of a face is sure to hold the
  // elements on both of its sides.
  std::vector<int> there(as_size(side.faces->n_faces()), 0);
  for (Index f = 0; f < side.faces->n_faces(); ++f) {
    const std::span<const Index> nodes = side.faces->nodes(f);
    if (nodes[0] >= whole_.n_owned_nodes) continue;
    const mesh::FaceKey key = mesh::face_key(nodes.data(), mesh::vertex_count(side.faces->shape(f)));
    there[as_size(f)] = found.contains(key) ? 1 : 0;
  }
  processes::largest(std::span(there));
  return {there.begin(), there.end()};
}

void GrowingContacts::follow(const mesh::Mesh& present, double time, coupling::State* state) const {
  for (const Growing& pair : growing_) {
    contact::ContactPass now{.time = time};
    contact::ContactState* history = nullptr;
    if (state != nullptr) {
      now.displacement = state->mechanics.displacement;
      now.temperature = state->heat.temperature;
      if (!state->contacts.empty()) history = &state->contacts[pair.number];
    }
    pairs_[pair.number]->follow_elements({there(pair.slave, present), there(pair.master, present)}, now,
                                         history);
  }
}

}  // namespace solidus::setup
