#include "mesh/parts/subdomains.hpp"

#include <algorithm>
#include <utility>

#include "mesh/message.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

constexpr std::size_t k_for_names = 65536;  // bytes of names and headers, about

struct BlockHeader {
  Shape shape;
  int body;
  Index n_counted;
};

}  // namespace

Subdomains::Subdomains(const RawMesh& raw, const GlobalMesh& whole, const std::vector<std::string>& bodies)
    : raw_(raw), whole_(whole), bodies_(bodies), local_(raw.x.size(), -1) {
  for (const RawBlock* block : whole.blocks) volumes_.push_back(sort_out(*block, false));
  for (const NamedFaces& surface : whole.surfaces) {
    OfBlocks& blocks = faces_.emplace_back();
    for (const RawBlock& block : surface.blocks) blocks.push_back(sort_out(block, surface.replicated));
  }
  find_sets();
}

/// A process holds the elements and faces that touch a node it owns, and counts those whose lowest node
/// number is among its own.
/// Elements go in the order of these, so that neighbours in memory are neighbours in space.
std::vector<Subdomains::Elements> Subdomains::sort_out(const RawBlock& block, bool for_all) const {
  const int nn = node_count(block.shape), n_processes = whole_.n_processes();
  const auto n_elements = as_index(block.nodes.size() / as_size(nn));
  std::vector<std::pair<GlobalIndex, Index>> order(as_size(n_elements));
  for (Index e = 0; e < n_elements; ++e) {
    const Index* element = block.nodes.data() + as_size(e) * as_size(nn);
    GlobalIndex lowest = whole_.number[as_size(element[0])];
    for (int a = 1; a < nn; ++a) lowest = std::min(lowest, whole_.number[as_size(element[a])]);
    order[as_size(e)] = {lowest, e};
  }
  // Sorted by their lowest node, then by their number, so that any partition gives the same order.
  std::sort(order.begin(), order.end());

  std::vector<Elements> of_process(as_size(n_processes));
  std::vector<int> owners;
  for (const auto& [lowest, e] : order) {
    const Index* element = block.nodes.data() + as_size(e) * as_size(nn);
    owners.clear();
    int counting = -1;
    for (int a = 0; a < nn; ++a) {
      const int owner = whole_.owner[as_size(element[a])];
      if (whole_.number[as_size(element[a])] == lowest) counting = owner;
      if (std::find(owners.begin(), owners.end(), owner) == owners.end()) owners.push_back(owner);
    }
    // Surfaces of contact are held by every process.
    if (for_all) {
      owners.resize(as_size(n_processes));
      for (int p = 0; p < n_processes; ++p) owners[as_size(p)] = p;
    }
    for (const int p : owners)
      (p == counting ? of_process[as_size(p)].counted : of_process[as_size(p)].others).push_back(e);
  }
  return of_process;
}

/// The node sets of each node, as a compressed list: counts, then their sums, then the sets.
void Subdomains::find_sets() {
  first_set_.assign(raw_.x.size() + 1, 0);
  for (const auto& [name, nodes] : whole_.node_sets)
    for (const Index i : nodes) ++first_set_[as_size(i) + 1];
  for (std::size_t i = 1; i < first_set_.size(); ++i) first_set_[i] += first_set_[i - 1];
  sets_.resize(as_size(first_set_.back()));
  std::vector<Index> fill(first_set_.begin(), first_set_.end() - 1);
  for (std::size_t s = 0; s < whole_.node_sets.size(); ++s)
    for (const Index i : whole_.node_sets[s].second) sets_[as_size(fill[as_size(i)]++)] = static_cast<int>(s);
}

/// Raw nodes in local order: owned ones in the order of their numbers, then the ghosts likewise.
std::vector<Index> Subdomains::nodes_of(int process) const {
  std::vector<char> is_here(raw_.x.size(), 0);
  const auto visit = [&](const RawBlock& block, const std::vector<Elements>& of_process) {
    const int nn = node_count(block.shape);
    for (const auto* list : {&of_process[as_size(process)].counted, &of_process[as_size(process)].others})
      for (const Index e : *list) {
        const Index* element = block.nodes.data() + as_size(e) * as_size(nn);
        for (int a = 0; a < nn; ++a) is_here[as_size(element[a])] = 1;
      }
  };
  for (std::size_t b = 0; b < volumes_.size(); ++b) visit(*whole_.blocks[b], volumes_[b]);
  for (std::size_t s = 0; s < faces_.size(); ++s)
    for (std::size_t b = 0; b < faces_[s].size(); ++b) visit(whole_.surfaces[s].blocks[b], faces_[s][b]);
  std::vector<Index> nodes;
  nodes.reserve(as_size(std::count(is_here.begin(), is_here.end(), 1)));
  for (std::size_t i = 0; i < is_here.size(); ++i)
    if (is_here[i] != 0) nodes.push_back(as_index(i));
  std::sort(nodes.begin(), nodes.end(), [&](Index a, Index b) {
    const bool ghost_a = whole_.owner[as_size(a)] != process, ghost_b = whole_.owner[as_size(b)] != process;
    return ghost_a != ghost_b ? ghost_b : whole_.number[as_size(a)] < whole_.number[as_size(b)];
  });
  return nodes;
}

/// Returns the bytes that the elements and faces of a process take in the message.
std::size_t Subdomains::element_bytes(int process) const {
  std::size_t bytes = 0;
  const auto add = [&](const RawBlock& block, const std::vector<Elements>& of_process) {
    const Elements& elements = of_process[as_size(process)];
    bytes += (elements.counted.size() + elements.others.size()) *
             (as_size(node_count(block.shape)) * sizeof(Index) +
              (block.input_element.is_wide() ? sizeof(GlobalIndex) : sizeof(Index)));
  };
  for (std::size_t b = 0; b < volumes_.size(); ++b) add(*whole_.blocks[b], volumes_[b]);
  for (std::size_t s = 0; s < faces_.size(); ++s)
    for (std::size_t b = 0; b < faces_[s].size(); ++b) add(whole_.surfaces[s].blocks[b], faces_[s][b]);
  return bytes;
}

/// Writes the elements of a process, counted ones first, with local node numbers, and forgets its list of
/// them.
void Subdomains::put_block(const RawBlock& block, int body, Elements& elements, Packer& p) const {
  const std::size_t nn = as_size(node_count(block.shape));
  const std::size_t n_elements = elements.counted.size() + elements.others.size();
  p.put(std::vector<BlockHeader>{{block.shape, body, as_index(elements.counted.size())}});
  p.put_size(n_elements * nn);
  std::vector<Index> local(nn);
  for (const auto* list : {&elements.counted, &elements.others})
    for (const Index e : *list) {
      for (std::size_t a = 0; a < nn; ++a) local[a] = local_[as_size(block.nodes[as_size(e) * nn + a])];
      p.put_values(local.data(), nn);
    }
  InputNumbers numbers;
  numbers.reserve(n_elements);
  for (const auto* list : {&elements.counted, &elements.others})
    for (const Index e : *list)
      numbers.push_back(block.input_element.empty() ? 0 : block.input_element[as_size(e)]);
  numbers.pack(p);
  elements = {};
}

std::vector<char> Subdomains::pack(int process) {
  // The part of a process is written into one buffer, in the order in which unpack_part() reads it: nodes,
  // bodies, blocks, surfaces, node sets. Numbers in it are local to the process.
  const std::vector<Index> nodes = nodes_of(process);
  std::vector<std::vector<Index>> sets(whole_.node_sets.size());
  for (std::size_t here = 0; here < nodes.size(); ++here) {
    const std::size_t i = as_size(nodes[here]);
    local_[i] = as_index(here);
    for (Index k = first_set_[i]; k < first_set_[i + 1]; ++k)
      sets[as_size(sets_[as_size(k)])].push_back(as_index(here));
  }

  // The buffer is reserved at its size, because parts of large meshes are made one after the other and would
  // double it.
  Packer p;
  p.reserve(nodes.size() * (sizeof(Point) + 2 * sizeof(GlobalIndex)) + element_bytes(process) +
            sets_.size() * sizeof(Index) + k_for_names);
  const GlobalIndex first = whole_.first[as_size(process)],
                    n_owned = whole_.first[as_size(process) + 1] - first;
  p.put(std::vector<GlobalIndex>{raw_.dimension, n_owned, whole_.first.back(), first});
  const auto put_of_nodes = [&](const auto& values) {
    p.put_size(nodes.size());
    for (const Index i : nodes) p.put_values(&values[as_size(i)], 1);
  };
  // Nodes are written one by one from the whole mesh, without copies of whole lists.
  put_of_nodes(raw_.x);
  const auto put_numbers_of_nodes = [&](const std::vector<GlobalIndex>& numbers) {
    InputNumbers here;
    here.reserve(nodes.size());
    for (const Index i : nodes) here.push_back(numbers[as_size(i)]);
    here.pack(p);
  };
  put_numbers_of_nodes(whole_.number);
  put_numbers_of_nodes(raw_.input_node);
  p.put_size(bodies_.size());
  for (const std::string& name : bodies_) p.put(name);
  p.put_size(volumes_.size());
  for (std::size_t b = 0; b < volumes_.size(); ++b)
    put_block(*whole_.blocks[b], whole_.body[b], volumes_[b][as_size(process)], p);
  p.put_size(whole_.surfaces.size());
  for (std::size_t s = 0; s < whole_.surfaces.size(); ++s) {
    const NamedFaces& surface = whole_.surfaces[s];
    p.put(surface.name);
    p.put_size(surface.replicated ? 1 : 0);
    p.put_size(surface.blocks.size());
    for (std::size_t b = 0; b < surface.blocks.size(); ++b)
      put_block(surface.blocks[b], surface.body[b], faces_[s][b][as_size(process)], p);
  }
  p.put_size(whole_.node_sets.size());
  for (std::size_t s = 0; s < sets.size(); ++s) {
    p.put(whole_.node_sets[s].first);
    std::sort(sets[s].begin(), sets[s].end());
    p.put(sets[s]);
  }
  // The table of local numbers is cleared at these nodes alone, for the next process.
  for (const Index i : nodes) local_[as_size(i)] = -1;
  return std::move(p).buffer();
}

Mesh unpack_part(const std::vector<char>& buffer) {
  // The reverse of pack(): everything is read in the same order.
  Unpacker u(buffer);
  Mesh mesh;
  const auto numbers = u.vector<GlobalIndex>();
  mesh.dimension = static_cast<int>(numbers[0]);
  mesh.n_owned_nodes = as_index(numbers[1]);
  mesh.n_global_nodes = numbers[2];
  mesh.first_owned = numbers[3];
  mesh.x = u.vector<Point>();
  mesh.global_node = InputNumbers(u);
  mesh.input_node = InputNumbers(u);
  for (std::size_t n = u.size(); n > 0; --n) mesh.bodies.push_back({u.string()});
  const auto take_block = [&u] {
    const BlockHeader header = u.vector<BlockHeader>().front();
    ElementBlock block;
    block.shape = header.shape;
    block.body = header.body;
    block.n_counted = header.n_counted;
    block.nodes = u.vector<Index>();
    block.input_element = InputNumbers(u);
    return block;
  };
  for (std::size_t n = u.size(); n > 0; --n) mesh.blocks.push_back(take_block());
  // Nodes of a surface are those of its faces, each once.
  for (std::size_t n = u.size(); n > 0; --n) {
    Surface& surface = mesh.surfaces[u.string()];
    surface.replicated = u.size() == 1;
    for (std::size_t k = u.size(); k > 0; --k) surface.faces.push_back(take_block());
    for (const ElementBlock& b : surface.faces)
      surface.nodes.insert(surface.nodes.end(), b.nodes.begin(), b.nodes.end());
    std::sort(surface.nodes.begin(), surface.nodes.end());
    surface.nodes.erase(std::unique(surface.nodes.begin(), surface.nodes.end()), surface.nodes.end());
  }
  for (std::size_t n = u.size(); n > 0; --n) {
    const std::string name = u.string();
    mesh.node_sets[name] = u.vector<Index>();
  }
  return mesh;
}

}  // namespace solidus::mesh
