#include <mpi.h>
#include <petscsys.h>

#include <algorithm>
#include <set>

#include "base/errors.hpp"
#include "mesh/faces.hpp"
#include "mesh/message.hpp"
#include "mesh/partition.hpp"

namespace solidus::mesh {

namespace {

// The mesh of the chosen bodies with its new numbering, on rank 0.
struct Whole {
  std::vector<const RawBlock*> blocks;
  std::vector<int> body;            // of each block
  std::vector<int> owner;           // of each raw node; −1: unused
  std::vector<GlobalIndex> number;  // new number of each raw node
  std::vector<GlobalIndex> first;   // first number of each process
  struct NamedFaces {
    std::string name;
    bool replicated;
    std::vector<RawBlock> blocks;  // faces of the chosen bodies, outward
    std::vector<int> body;         // of each block
  };
  std::vector<NamedFaces> surfaces;
  std::vector<std::pair<std::string, std::vector<Index>>> node_sets;  // raw nodes
};

std::string names_of(const RawMesh& raw, int dimension) {
  std::string text;
  for (const auto& [name, group] : raw.groups)
    if (group.dimension == dimension) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

void choose_bodies(const RawMesh& raw, const std::vector<std::string>& bodies, Whole& whole) {
  for (int b = 0; b < static_cast<int>(bodies.size()); ++b) {
    const std::string& name = bodies[static_cast<std::size_t>(b)];
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
void number_used_nodes(const RawMesh& raw, int n_processes, Whole& whole) {
  std::vector<Index> compact(raw.x.size(), -1);
  Index n_used = 0;
  for (const RawBlock* block : whole.blocks)
    for (const Index i : block->nodes)
      if (compact[static_cast<std::size_t>(i)] < 0) compact[static_cast<std::size_t>(i)] = n_used++;
  std::vector<RawBlock> renumbered;
  for (const RawBlock* block : whole.blocks) {
    renumbered.push_back({block->shape, block->nodes, {}});
    for (Index& i : renumbered.back().nodes) i = compact[static_cast<std::size_t>(i)];
  }
  std::vector<const RawBlock*> pointers;
  pointers.reserve(renumbered.size());
  for (const RawBlock& block : renumbered) pointers.push_back(&block);
  const NodeNeighbours graph = neighbours(n_used, pointers);
  const std::vector<int> owner = assign_owners(graph, n_processes);
  const std::vector<GlobalIndex> number = number_nodes(graph, owner, n_processes);

  whole.owner.assign(raw.x.size(), -1);
  whole.number.assign(raw.x.size(), -1);
  whole.first.assign(static_cast<std::size_t>(n_processes) + 1, 0);
  for (std::size_t i = 0; i < raw.x.size(); ++i) {
    if (compact[i] < 0) continue;
    const auto c = static_cast<std::size_t>(compact[i]);
    whole.owner[i] = owner[c];
    whole.number[i] = number[c];
    ++whole.first[static_cast<std::size_t>(owner[c]) + 1];
  }
  for (std::size_t p = 1; p < whole.first.size(); ++p) whole.first[p] += whole.first[p - 1];
}

void collect_surfaces(const RawMesh& raw, const std::vector<std::string>& bodies,
                      const std::vector<std::string>& replicated, Whole& whole) {
  FaceOwners owners;
  for (const auto& [name, group] : raw.groups) {
    if (group.dimension != raw.dimension - 1) continue;
    for (const RawBlock& block : group.blocks) {
      const int nn = node_count(block.shape), nv = vertex_count(block.shape);
      for (std::size_t f = 0; f < block.nodes.size(); f += static_cast<std::size_t>(nn))
        owners.emplace(face_key(block.nodes.data() + f, nv), FaceOwner{});
    }
  }
  find_face_owners(raw, bodies, owners);

  for (const auto& [name, group] : raw.groups) {
    if (group.dimension != raw.dimension - 1) continue;
    Whole::NamedFaces surface{
        name, std::find(replicated.begin(), replicated.end(), name) != replicated.end(), {}, {}};
    for (const RawBlock& block : group.blocks) {
      const int nn = node_count(block.shape), nv = vertex_count(block.shape);
      for (std::size_t f = 0; f * static_cast<std::size_t>(nn) < block.nodes.size(); ++f) {
        const Index* face = block.nodes.data() + f * static_cast<std::size_t>(nn);
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
        const RawBlock& parent = raw.groups.at(bodies[static_cast<std::size_t>(owner.body)])
                                     .blocks[static_cast<std::size_t>(owner.block)];
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

void collect_node_sets(const RawMesh& raw, Whole& whole) {
  for (const auto& [name, group] : raw.groups) {
    std::vector<Index> nodes;
    for (const RawBlock& block : group.blocks)
      for (const Index i : block.nodes)
        if (whole.owner[static_cast<std::size_t>(i)] >= 0) nodes.push_back(i);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    if (!nodes.empty()) whole.node_sets.emplace_back(name, std::move(nodes));
  }
}

// Who counts an element: the owner of its lowest global node.
int counting_process(const Whole& whole, const Index* element, int n) {
  const Index lowest = *std::min_element(element, element + n, [&](Index a, Index b) {
    return whole.number[static_cast<std::size_t>(a)] < whole.number[static_cast<std::size_t>(b)];
  });
  return whole.owner[static_cast<std::size_t>(lowest)];
}

struct Part {
  std::vector<Index> nodes;  // raw numbers in local order
  std::vector<Index> local;  // of raw nodes, −1 elsewhere
};

struct PartBlock {
  std::vector<Index> nodes;  // raw numbers
  std::vector<GlobalIndex> input_element;
  Index n_counted = 0;
};

PartBlock take_elements(const Whole& whole, const RawBlock& block, int process, bool all) {
  const int nn = node_count(block.shape);
  PartBlock counted, others;
  for (std::size_t e = 0; e * static_cast<std::size_t>(nn) < block.nodes.size(); ++e) {
    const Index* element = block.nodes.data() + e * static_cast<std::size_t>(nn);
    const bool touches = all || std::any_of(element, element + nn, [&](Index i) {
                           return whole.owner[static_cast<std::size_t>(i)] == process;
                         });
    if (!touches) continue;
    PartBlock& to = counting_process(whole, element, nn) == process ? counted : others;
    to.nodes.insert(to.nodes.end(), element, element + nn);
    to.input_element.push_back(block.input_element.empty() ? 0 : block.input_element[e]);
  }
  counted.n_counted = static_cast<Index>(counted.input_element.size());
  counted.nodes.insert(counted.nodes.end(), others.nodes.begin(), others.nodes.end());
  counted.input_element.insert(counted.input_element.end(), others.input_element.begin(),
                               others.input_element.end());
  return counted;
}

struct BlockHeader {
  Shape shape;
  int body;
  Index n_counted;
};

// Elements in the order of their nodes' numbers, so that neighbours in memory are neighbours in space.
void sort_block(const Whole& whole, int nn, PartBlock& block) {
  const auto sort_range = [&](std::size_t from, std::size_t to) {
    std::vector<std::size_t> order(to - from);
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = from + i;
    const auto lowest = [&](std::size_t e) {
      GlobalIndex low = -1;
      for (int a = 0; a < nn; ++a) {
        const auto n = whole.number[static_cast<std::size_t>(
            block.nodes[e * static_cast<std::size_t>(nn) + static_cast<std::size_t>(a)])];
        if (low < 0 || n < low) low = n;
      }
      return low;
    };
    std::vector<GlobalIndex> key(order.size());
    for (std::size_t i = 0; i < key.size(); ++i) key[i] = lowest(from + i);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return key[a - from] < key[b - from]; });
    const PartBlock old = block;
    for (std::size_t i = 0; i < order.size(); ++i) {
      block.input_element[from + i] = old.input_element[order[i]];
      std::copy_n(old.nodes.begin() + static_cast<std::ptrdiff_t>(order[i]) * nn, nn,
                  block.nodes.begin() + static_cast<std::ptrdiff_t>(from + i) * nn);
    }
  };
  sort_range(0, static_cast<std::size_t>(block.n_counted));
  sort_range(static_cast<std::size_t>(block.n_counted), block.input_element.size());
}

std::vector<char> pack_part(const RawMesh& raw, const Whole& whole, const std::vector<std::string>& bodies,
                            int process) {
  std::vector<PartBlock> blocks;
  std::vector<std::vector<PartBlock>> faces;
  for (const RawBlock* block : whole.blocks) {
    blocks.push_back(take_elements(whole, *block, process, false));
    sort_block(whole, node_count(block->shape), blocks.back());
  }
  for (const auto& surface : whole.surfaces) {
    auto& list = faces.emplace_back();
    for (const RawBlock& block : surface.blocks)
      list.push_back(take_elements(whole, block, process, surface.replicated));
  }

  // Owned nodes first, in the order of their numbers; then the ghosts.
  std::set<std::pair<GlobalIndex, Index>> owned, ghosts;
  const auto visit = [&](const std::vector<Index>& nodes) {
    for (const Index i : nodes) {
      auto& set = whole.owner[static_cast<std::size_t>(i)] == process ? owned : ghosts;
      set.emplace(whole.number[static_cast<std::size_t>(i)], i);
    }
  };
  for (const PartBlock& b : blocks) visit(b.nodes);
  for (const auto& list : faces)
    for (const PartBlock& b : list) visit(b.nodes);

  std::vector<Index> local(raw.x.size(), -1);
  std::vector<Point> x;
  std::vector<GlobalIndex> number, input;
  for (const auto* set : {&owned, &ghosts})
    for (const auto& [n, i] : *set) {
      local[static_cast<std::size_t>(i)] = static_cast<Index>(x.size());
      x.push_back(raw.x[static_cast<std::size_t>(i)]);
      number.push_back(n);
      input.push_back(raw.input_node[static_cast<std::size_t>(i)]);
    }
  const auto localise = [&](std::vector<Index> nodes) {
    for (Index& i : nodes) i = local[static_cast<std::size_t>(i)];
    return nodes;
  };

  Packer p;
  p.put(std::vector<GlobalIndex>{raw.dimension, static_cast<GlobalIndex>(owned.size()), whole.first.back(),
                                 whole.first[static_cast<std::size_t>(process)]});
  p.put(x);
  p.put(number);
  p.put(input);
  p.put_size(bodies.size());
  for (const std::string& name : bodies) p.put(name);
  const auto put_block = [&](Shape shape, int body, const PartBlock& b) {
    p.put(std::vector<BlockHeader>{{shape, body, b.n_counted}});
    p.put(localise(b.nodes));
    p.put(b.input_element);
  };
  p.put_size(blocks.size());
  for (std::size_t k = 0; k < blocks.size(); ++k) put_block(whole.blocks[k]->shape, whole.body[k], blocks[k]);
  p.put_size(whole.surfaces.size());
  for (std::size_t s = 0; s < whole.surfaces.size(); ++s) {
    p.put(whole.surfaces[s].name);
    p.put_size(whole.surfaces[s].replicated ? 1 : 0);
    p.put_size(faces[s].size());
    for (std::size_t k = 0; k < faces[s].size(); ++k)
      put_block(whole.surfaces[s].blocks[k].shape, whole.surfaces[s].body[k], faces[s][k]);
  }
  p.put_size(whole.node_sets.size());
  for (const auto& [name, nodes] : whole.node_sets) {
    p.put(name);
    std::vector<Index> here;
    for (const Index i : nodes)
      if (local[static_cast<std::size_t>(i)] >= 0) here.push_back(local[static_cast<std::size_t>(i)]);
    std::sort(here.begin(), here.end());
    p.put(here);
  }
  return p.buffer();
}

Mesh unpack_part(const std::vector<char>& buffer) {
  Unpacker u(buffer);
  Mesh mesh;
  const auto numbers = u.vector<GlobalIndex>();
  mesh.dimension = static_cast<int>(numbers[0]);
  mesh.n_owned_nodes = static_cast<Index>(numbers[1]);
  mesh.n_global_nodes = numbers[2];
  mesh.first_owned = numbers[3];
  mesh.x = u.vector<Point>();
  mesh.global_node = u.vector<GlobalIndex>();
  mesh.input_node = u.vector<GlobalIndex>();
  for (std::size_t n = u.size(); n > 0; --n) mesh.bodies.push_back({u.string()});
  const auto take_block = [&u] {
    const BlockHeader header = u.vector<BlockHeader>().front();
    Block block;
    block.shape = header.shape;
    block.body = header.body;
    block.n_counted = header.n_counted;
    block.nodes = u.vector<Index>();
    block.input_element = u.vector<GlobalIndex>();
    return block;
  };
  for (std::size_t n = u.size(); n > 0; --n) mesh.blocks.push_back(take_block());
  for (std::size_t n = u.size(); n > 0; --n) {
    Surface& surface = mesh.surfaces[u.string()];
    surface.replicated = u.size() == 1;
    for (std::size_t k = u.size(); k > 0; --k) surface.faces.push_back(take_block());
    for (const Block& b : surface.faces)
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

// MPI counts are ints: large buffers travel in pieces.
constexpr std::size_t k_piece = std::size_t{1} << 30;

void send(const std::vector<char>& buffer, int to) {
  unsigned long long size = buffer.size();
  MPI_Send(&size, 1, MPI_UNSIGNED_LONG_LONG, to, 0, PETSC_COMM_WORLD);
  for (std::size_t at = 0; at < buffer.size(); at += k_piece)
    MPI_Send(buffer.data() + at, static_cast<int>(std::min(k_piece, buffer.size() - at)), MPI_CHAR, to, 1,
             PETSC_COMM_WORLD);
}

std::vector<char> receive() {
  unsigned long long size = 0;
  MPI_Recv(&size, 1, MPI_UNSIGNED_LONG_LONG, 0, 0, PETSC_COMM_WORLD, MPI_STATUS_IGNORE);
  std::vector<char> buffer(size);
  for (std::size_t at = 0; at < buffer.size(); at += k_piece)
    MPI_Recv(buffer.data() + at, static_cast<int>(std::min(k_piece, buffer.size() - at)), MPI_CHAR, 0, 1,
             PETSC_COMM_WORLD, MPI_STATUS_IGNORE);
  return buffer;
}

// Rank 0's verdict reaches everybody, so that all throw the same.
std::string agree(std::string complaint) {
  int n = static_cast<int>(complaint.size());
  MPI_Bcast(&n, 1, MPI_INT, 0, PETSC_COMM_WORLD);
  complaint.resize(static_cast<std::size_t>(n));
  MPI_Bcast(complaint.data(), n, MPI_CHAR, 0, PETSC_COMM_WORLD);
  return complaint;
}

}  // namespace

Mesh distribute(const RawMesh& raw, const std::vector<std::string>& bodies,
                const std::vector<std::string>& replicated) {
  int rank = 0, n_processes = 1;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &n_processes);

  Whole whole;
  std::string complaint;
  if (rank == 0) {
    try {
      choose_bodies(raw, bodies, whole);
      number_used_nodes(raw, n_processes, whole);
      collect_surfaces(raw, bodies, replicated, whole);
      collect_node_sets(raw, whole);
    } catch (const std::exception& e) {
      complaint = e.what();
    }
  }
  complaint = agree(std::move(complaint));
  if (!complaint.empty()) throw InputError({}, complaint);

  if (rank != 0) return unpack_part(receive());
  for (int p = 1; p < n_processes; ++p) send(pack_part(raw, whole, bodies, p), p);
  return unpack_part(pack_part(raw, whole, bodies, 0));
}

}  // namespace solidus::mesh
