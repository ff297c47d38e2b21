/// Bodies are chosen, used nodes numbered, surfaces and sets gathered, all on process 0.
#include "mesh/parts/global_mesh.hpp"

#include <algorithm>

#include "mesh/parts/partition.hpp"
#include "mesh/surfaces/faces.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

std::string names_of(const RawMesh& raw, int dimension) {
  std::string text;
  for (const auto& [name, group] : raw.groups)
    if (group.dimension == dimension) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

void choose_bodies(const RawMesh& raw, const std::vector<std::string>& bodies, GlobalMesh& whole) {
  for (int b = 0; b < static_cast<int>(bodies.size()); ++b) {
    const std::string& name = bodies[as_size(b)];
    const auto group = raw.groups.find(name);
    if (group == raw.groups.end() || group->second.dimension != raw.dimension)
      throw InputError({}, "the mesh has no body '" + name + "'",
                       "bodies of the mesh: " + names_of(raw, raw.dimension));
    for (const RawBlock& block : group->second.blocks) {
      whole.blocks.push_back(&block);
      whole.body.push_back(b);
    }
  }
}

// Numbers the nodes that the bodies use; the graph is built on those alone.
void number_used_nodes(const RawMesh& raw, const std::vector<BodyWork>& work, int n_processes,
                       GlobalMesh& whole) {
  // Bodies may use a part of the nodes only; they get numbers without holes, in the order of use.
  std::vector<Index> compact(raw.x.size(), -1);
  Index n_used = 0;
  std::vector<RawBlock> renumbered;
  for (const RawBlock* block : whole.blocks) {
    renumbered.push_back({block->shape, block->nodes, {}});
    for (Index& i : renumbered.back().nodes) {
      Index& c = compact[as_size(i)];
      if (c < 0) c = n_used++;
      i = c;
    }
  }
  std::vector<const RawBlock*> pointers;
  for (const RawBlock& block : renumbered) pointers.push_back(&block);
  const NodeNeighbours graph = neighbours(n_used, pointers);
  // Work of a node follows from what its body computes.
  std::vector<BodyWork> of_block;
  for (const int body : whole.body) of_block.push_back(work.empty() ? BodyWork::all : work[as_size(body)]);
  // Work of contact is that of nodes on surfaces that all processes have.
  std::vector<char> in_contact(as_size(n_used), 0);
  for (const NamedFaces& surface : whole.surfaces)
    for (const RawBlock& block : surface.blocks)
      for (const Index i : block.nodes)
        if (surface.replicated) in_contact[as_size(compact[as_size(i)])] = 1;
  // The partition balances the work of nodes; then each process numbers its own ones.
  const std::vector<int> owner =
      assign_owners(graph, node_work(graph, pointers, of_block, in_contact), n_processes);
  const std::vector<GlobalIndex> number = number_nodes(graph, owner, n_processes);

  // Owner and number go back to the nodes of the whole mesh; `first` counts them by processes.
  whole.owner.assign(raw.x.size(), -1);
  whole.number.assign(raw.x.size(), -1);
  whole.first.assign(as_size(n_processes) + 1, 0);
  for (std::size_t i = 0; i < raw.x.size(); ++i) {
    if (compact[i] < 0) continue;
    const auto c = as_size(compact[i]);
    whole.owner[i] = owner[c];
    whole.number[i] = number[c];
    ++whole.first[as_size(owner[c]) + 1];
  }
  for (std::size_t p = 1; p < whole.first.size(); ++p) whole.first[p] += whole.first[p - 1];
}

void collect_surfaces(const RawMesh& raw, const std::vector<std::string>& bodies,
                      const std::vector<std::string>& replicated, GlobalMesh& whole) {
  // First all faces of surfaces, then the elements of bodies that own them.
  FaceOwners owners;
  for (const auto& [name, group] : raw.groups) {
    if (group.dimension != raw.dimension - 1) continue;
    for (const RawBlock& block : group.blocks) {
      const int nn = node_count(block.shape), nv = vertex_count(block.shape);
      for (std::size_t f = 0; f < block.nodes.size(); f += as_size(nn))
        owners.emplace(face_key(block.nodes.data() + f, nv), FaceOwner{});
    }
  }
  find_face_owners(raw, bodies, owners);

  // Faces of one shape and body go into one block each.
  for (const auto& [name, group] : raw.groups) {
    if (group.dimension != raw.dimension - 1) continue;
    NamedFaces surface{
        name, std::find(replicated.begin(), replicated.end(), name) != replicated.end(), {}, {}};
    for (const RawBlock& block : group.blocks) {
      const int nn = node_count(block.shape), nv = vertex_count(block.shape);
      for (std::size_t f = 0; f * as_size(nn) < block.nodes.size(); ++f) {
        const Index* face = block.nodes.data() + f * as_size(nn);
        const FaceOwner owner = owners.at(face_key(face, nv));
        if (owner.body < 0) continue;  // bounds a body that does not take part
        std::size_t k = 0;
        while (k < surface.blocks.size() &&
               (surface.blocks[k].shape != block.shape || surface.body[k] != owner.body))
          ++k;
        if (k == surface.blocks.size()) {
          surface.blocks.push_back({block.shape, {}, {}});
          surface.body.push_back(owner.body);
        }
        // The element's own list of the face's nodes is outward.
        const RawBlock& parent = raw.groups.at(bodies[as_size(owner.body)]).blocks[as_size(owner.block)];
        const Index* element =
            parent.nodes.data() + static_cast<std::ptrdiff_t>(owner.element) * node_count(parent.shape);
        for (const int a : face_nodes(parent.shape, owner.face))
          surface.blocks[k].nodes.push_back(element[a]);
        surface.blocks[k].input_element.push_back(block.input_element.empty() ? 0 : block.input_element[f]);
      }
    }
    if (!surface.blocks.empty()) whole.surfaces.push_back(std::move(surface));
  }
  for (const std::string& name : replicated)
    if (std::none_of(whole.surfaces.begin(), whole.surfaces.end(),
                     [&](const auto& s) { return s.name == name; }))
      throw InputError({}, "the mesh has no surface '" + name + "'",
                       "surfaces of the mesh: " + names_of(raw, raw.dimension - 1));
}

void collect_node_sets(const RawMesh& raw, GlobalMesh& whole) {
  for (const auto& [name, group] : raw.groups) {
    std::vector<Index> nodes;
    for (const RawBlock& block : group.blocks)
      for (const Index i : block.nodes)
        if (whole.owner[as_size(i)] >= 0) nodes.push_back(i);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    if (!nodes.empty()) whole.node_sets.emplace_back(name, std::move(nodes));
  }
}

}  // namespace

GlobalMesh make_global_mesh(const RawMesh& raw, const std::vector<std::string>& bodies,
                            const std::vector<std::string>& replicated, const std::vector<BodyWork>& work,
                            int n_processes) {
  GlobalMesh whole;
  choose_bodies(raw, bodies, whole);
  collect_surfaces(raw, bodies, replicated, whole);
  number_used_nodes(raw, work, n_processes, whole);
  collect_node_sets(raw, whole);
  return whole;
}

}  // namespace solidus::mesh
