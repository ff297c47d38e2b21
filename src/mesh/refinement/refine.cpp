/// Level by level: new nodes, who holds them, arcs, and the part of the next level.
#include "mesh/refinement/refine.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "mesh/message.hpp"
#include "mesh/refinement/curved_skin.hpp"
#include "mesh/refinement/fine_part.hpp"
#include "mesh/refinement/placing.hpp"
#include "mesh/refinement/skin_faces.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"

namespace solidus::mesh {

namespace {

/// Tells all processes the other groups; each keeps the elements of which it has a node.
std::map<std::string, std::vector<ElementBlock>> others_of(const Mesh& mesh,
                                                           const std::vector<OtherGroup>& groups) {
  Packer packer;
  packer.put_size(groups.size());
  for (const OtherGroup& group : groups) {
    packer.put(group.name);
    packer.put_size(static_cast<std::size_t>(group.shape));
    packer.put(group.nodes);
  }
  std::vector<char> bytes = std::move(packer).buffer();
  processes::broadcast(bytes);
  Unpacker unpacker(bytes);
  std::map<std::string, std::vector<ElementBlock>> others;
  std::unordered_map<GlobalIndex, Index> local;
  for (std::size_t n = unpacker.size(); n > 0; --n) {
    const std::string name = unpacker.string();
    ElementBlock block{static_cast<Shape>(unpacker.size()), -1, {}, {}, 0};
    // Numbers of the input lead to local nodes; the table is made where there is a group at all.
    if (local.empty())
      for (Index i = 0; i < mesh.n_nodes(); ++i) local.emplace(mesh.input_node[as_size(i)], i);
    const auto nodes = unpacker.vector<GlobalIndex>();
    const auto nn = as_size(node_count(block.shape));
    for (std::size_t e = 0; e + nn <= nodes.size(); e += nn) {
      std::vector<Index> here;
      for (std::size_t a = 0; a < nn; ++a) {
        const auto found = local.find(nodes[e + a]);
        here.push_back(found == local.end() ? -1 : found->second);
      }
      if (std::ranges::all_of(here, [](Index i) { return i < 0; })) continue;
      block.nodes.insert(block.nodes.end(), here.begin(), here.end());
      block.input_element.push_back(1);  // no one asks for it
    }
    others[name].push_back(std::move(block));
  }
  return others;
}

/// Whether all elements are of first order: those of second order have their shape already.
bool is_linear(const Mesh& mesh) {
  return std::ranges::all_of(mesh.blocks, [](const ElementBlock& b) { return order(b.shape) == 1; });
}

}  // namespace

std::vector<OtherGroup> prepare_refinement(RawMesh& raw, const std::vector<std::string>& bodies) {
  // Elements are numbered over all bodies, in the order of the case's.
  GlobalIndex next = 1;
  std::vector<char> used(raw.x.size(), 0);
  for (const std::string& body : bodies)
    for (RawBlock& block : raw.groups.at(body).blocks) {
      block.input_element.clear();
      const std::size_t n = block.nodes.size() / as_size(node_count(block.shape));
      for (std::size_t e = 0; e < n; ++e) block.input_element.push_back(next++);
      for (const Index node : block.nodes) used[as_size(node)] = 1;
    }
  // Nodes keep their numbers unless two have the same one, or one has none above zero.
  std::unordered_set<GlobalIndex> seen;
  bool unique = raw.input_node.size() == raw.x.size();
  for (const GlobalIndex number : raw.input_node) unique = unique && number > 0 && seen.insert(number).second;
  if (!unique) {
    raw.input_node.resize(raw.x.size());
    for (std::size_t i = 0; i < raw.x.size(); ++i) raw.input_node[i] = static_cast<GlobalIndex>(i) + 1;
  }
  // Groups that are neither bodies nor their surfaces, such as edges, are kept by the numbers of their nodes.
  std::vector<OtherGroup> others;
  for (const auto& [name, group] : raw.groups) {
    const bool is_body = std::ranges::find(bodies, name) != bodies.end();
    if (group.dimension == 0 || group.dimension == raw.dimension - 1 || is_body) continue;
    for (const RawBlock& block : group.blocks) {
      // Elements that lie on no body take no part.
      OtherGroup other{name, block.shape, {}};
      const auto nn = as_size(node_count(block.shape));
      for (std::size_t e = 0; e < block.nodes.size(); e += nn) {
        const auto nodes = std::span(block.nodes).subspan(e, nn);
        if (std::ranges::any_of(nodes, [&](Index node) { return used[as_size(node)] == 0; })) continue;
        for (const Index node : nodes) other.nodes.push_back(raw.input_node[as_size(node)]);
      }
      if (!other.nodes.empty()) others.push_back(std::move(other));
    }
  }
  return others;
}

void check_refined_size(const Mesh& mesh, int times) {
  // A refined element takes about so many bytes for each of its nodes while the mesh is made.
  constexpr double k_bytes = 25;
  double largest[2] = {0, 0};  // elements and bytes of a process
  double all = 0;
  for (const ElementBlock& block : mesh.blocks) {
    largest[0] += block.size();
    largest[1] += k_bytes * node_count(block.shape) * static_cast<double>(block.size());
    all += block.n_counted;
  }
  processes::largest(std::span<double>(largest));
  processes::sum(std::span(&all, 1));
  const double children = std::pow(mesh.dimension == 3 ? 8.0 : 4.0, times);
  const double memory =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  const std::string what = fmt::format("the refined mesh would have {:.2g} elements", all * children);
  if (largest[0] * children > std::numeric_limits<Index>::max())
    throw InputError({}, what, "fewer refinements, or more processes: 2e9 elements on each at most");
  if (largest[1] * children > memory)
    throw InputError({},
                     fmt::format("{}, {:.2g} GB on a process, and this machine has {:.2g} GB of memory", what,
                                 1e-9 * largest[1] * children, 1e-9 * memory),
                     "fewer refinements, or more processes on more machines");
}

Mesh refine(Mesh mesh, const Refinement& refinement, const std::vector<OtherGroup>& others,
            RefinementReport& report) {
  report = {};
  Part part;
  part.others = others_of(mesh, others);
  // Elements of second order have their shape; linear ones of the plane and of space get arcs on request.
  const bool curved = refinement.curved && is_linear(mesh);
  if (curved) part.skin = skin_faces(mesh);
  part.mesh = std::move(mesh);
  // Each level halves all edges. New nodes lie on arcs through their neighbours where the surface is curved,
  // as far as no element is turned over by it.
  for (int i = 0; i < refinement.times; ++i) {
    Level level(part);
    const Sharing sharing(level);
    if (curved) {
      const Arcs arcs = place_on_arcs(arc_offsets(level, sharing), sharing, level);
      report.on_arcs += arcs.kept;
      report.straightened += arcs.straightened;
    } else {
      sharing.update(level.x);
    }
    part = fine_part(level, sharing);
  }
  return std::move(part.mesh);
}

}  // namespace solidus::mesh
