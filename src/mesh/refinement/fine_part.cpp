/// Children that touch a node of this process are kept; nodes are numbered anew, processes one behind the
/// other.
#include "mesh/refinement/fine_part.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "mesh/parts/partition.hpp"
#include "mesh/refinement/placing.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::mesh {

namespace {

/// Children of a block before they are sorted, with nodes of the level.
using Kept = RawBlock;

class Maker {
 public:
  Maker(const Level& level, const Sharing& sharing)
      : level_(level), old_(level.part.mesh), sharing_(sharing), local_(as_size(level.n_nodes()), -1) {}

  Part make() {
    Part part;
    part.mesh.dimension = old_.dimension;
    part.mesh.bodies = old_.bodies;
    // What stays comes first: it decides which nodes do.
    for (const Cut& cut : level_.volumes) volumes_.push_back(children(cut, false));
    for (const auto& [name, cuts] : level_.faces)
      for (const Cut& cut : cuts) faces_[name].push_back(children(cut, old_.surfaces.at(name).replicated));
    number_nodes_of(part.mesh);
    // Then elements get the new numbers of their nodes.
    for (std::size_t b = 0; b < volumes_.size(); ++b) {
      part.mesh.blocks.push_back(sorted(std::move(volumes_[b]), old_.blocks[b].body, part.mesh));
    }
    for (const auto& [name, surface] : old_.surfaces) make_surface(name, surface, part.mesh);
    for (const Cut& cut : level_.skin) part.skin.push_back(local_block(children(cut, false)));
    for (const auto& [name, cuts] : level_.others)
      for (const Cut& cut : cuts) part.others[name].push_back(local_block(children(cut, true)));
    make_node_sets(part.mesh);
    return part;
  }

 private:
  bool is_mine(Index node) const { return node >= 0 && level_.is_mine(node); }

  /// The children of the elements of a block that touch a node of this process, or all of them.
  Kept children(const Cut& cut, bool all) const {
    const Lattice& lattice = lattice_of(cut.block->shape);
    Kept kept{cut.block->shape, {}, {}};
    std::vector<Index> nodes(as_size(node_count(kept.shape)));
    for (Index e = 0; e < cut.block->size(); ++e) {
      const Index* of_lattice = cut.element(e);
      const bool known =
          std::find(of_lattice, of_lattice + lattice.points.size(), -1) == of_lattice + lattice.points.size();
      const Children& choice = lattice.choices[known ? choice_of(lattice, of_lattice, level_.x) : 0];
      for (std::size_t c = 0; c < choice.size(); ++c) {
        for (std::size_t a = 0; a < nodes.size(); ++a) nodes[a] = of_lattice[choice[c][a]];
        if (!all && std::none_of(nodes.begin(), nodes.end(), [&](Index node) { return is_mine(node); }))
          continue;
        kept.nodes.insert(kept.nodes.end(), nodes.begin(), nodes.end());
        // Numbers of children follow one another, those of the first parent from one on.
        kept.input_element.push_back((cut.block->input_element[as_size(e)] - 1) *
                                         static_cast<GlobalIndex>(choice.size()) +
                                     static_cast<GlobalIndex>(c) + 1);
      }
    }
    return kept;
  }

  /// Finds the nodes that stay, own ones in an order that keeps neighbours close, and numbers them over all
  /// processes.
  void number_nodes_of(Mesh& mesh) {
    // The graph has compact numbers in the order in which elements name the nodes.
    std::vector<Index> here;
    const auto meet = [&](const Kept& kept) {
      for (const Index node : kept.nodes)
        if (local_[as_size(node)] < 0) {
          local_[as_size(node)] = as_index(here.size());
          here.push_back(node);
        }
    };
    for (const Kept& kept : volumes_) meet(kept);
    order_mine(here, mesh);
    for (const auto& [name, blocks] : faces_)
      for (const Kept& kept : blocks) meet(kept);
    // Own nodes are numbered consecutively, process after process, and keep their numbers in the input. The
    // owner sends both numbers to the processes that hold copies.
    std::int64_t mine = mesh.n_owned_nodes, all = mine;
    processes::sum(std::span<std::int64_t>(&all, 1));
    mesh.n_global_nodes = all;
    mesh.first_owned = processes::sum_before(mine);
    std::vector<GlobalIndex> global(as_size(level_.n_nodes()), -1), input = input_numbers();
    for (Index i = 0; i < mesh.n_owned_nodes; ++i) global[as_size(order_[as_size(i)])] = mesh.first_owned + i;
    sharing_.update(global);
    sharing_.update(input);
    // Copies follow in the order of their numbers.
    std::vector<Index> ghosts;
    std::ranges::copy_if(here, std::back_inserter(ghosts), [&](Index node) { return !is_mine(node); });
    std::ranges::sort(ghosts, {}, [&](Index node) { return global[as_size(node)]; });
    order_.insert(order_.end(), ghosts.begin(), ghosts.end());
    std::ranges::fill(local_, -1);
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const std::size_t node = as_size(order_[i]);
      local_[node] = as_index(i);
      mesh.x.push_back(level_.x[node]);
      mesh.global_node.push_back(global[node]);
      mesh.input_node.push_back(input[node]);
    }
  }

  /// @param here  nodes of the kept elements; local_ has their places in it
  void order_mine(const std::vector<Index>& here, Mesh& mesh) {
    std::vector<RawBlock> compact = volumes_;
    std::vector<const RawBlock*> pointers;
    for (RawBlock& block : compact) {
      for (Index& node : block.nodes) node = local_[as_size(node)];
      pointers.push_back(&block);
    }
    // As two processes: what is owned comes before what is not.
    std::vector<int> owner;
    for (const Index node : here) owner.push_back(is_mine(node) ? 0 : 1);
    mesh.n_owned_nodes = as_index(std::ranges::count(owner, 0));
    const std::vector<GlobalIndex> number =
        number_nodes(neighbours(as_index(here.size()), pointers), owner, 2);
    order_.assign(as_size(mesh.n_owned_nodes), -1);
    for (std::size_t i = 0; i < here.size(); ++i)
      if (owner[i] == 0) order_[as_size(number[i])] = here[i];
  }

  /// Old nodes keep their numbers; of a new one it follows from the element that places it.
  std::vector<GlobalIndex> input_numbers() const {
    std::int64_t last = 0, places = 0;
    std::vector<GlobalIndex> input;
    input.reserve(as_size(level_.n_nodes()));
    for (const GlobalIndex number : old_.input_node) {
      last = std::max(last, number);
      input.push_back(number);
    }
    for (const Cut& cut : level_.volumes)
      places = std::max(places, static_cast<std::int64_t>(lattice_of(cut.block->shape).points.size()) -
                                    node_count(cut.block->shape));
    // The least of the negative is the largest.
    std::int64_t least[2] = {-last, -places};
    processes::least(std::span<std::int64_t>(least));
    last = -least[0];
    places = -least[1];
    for (const Source& s : level_.source) {
      if (s.block < 0) {
        input.push_back(-1);  // its owner tells
        continue;
      }
      const ElementBlock& block = old_.blocks[as_size(s.block)];
      input.push_back(last + 1 + (block.input_element[as_size(s.element)] - 1) * places + s.point -
                      node_count(block.shape));
    }
    return input;
  }

  /// Elements in the order of their lowest nodes, first those that this process counts: whose lowest node is
  /// its own.
  ElementBlock sorted(Kept kept, int body, const Mesh& mesh) const {
    const auto nn = as_size(node_count(kept.shape));
    const std::size_t n = kept.nodes.size() / nn;
    for (Index& node : kept.nodes) node = local_[as_size(node)];
    std::vector<std::pair<GlobalIndex, std::size_t>> order(n);
    const GlobalIndex end = mesh.first_owned + mesh.n_owned_nodes;
    Index n_counted = 0;
    for (std::size_t e = 0; e < n; ++e) {
      GlobalIndex lowest = mesh.global_node[as_size(kept.nodes[e * nn])];
      for (std::size_t a = 1; a < nn; ++a)
        lowest = std::min(lowest, mesh.global_node[as_size(kept.nodes[e * nn + a])]);
      const bool counts = lowest >= mesh.first_owned && lowest < end;
      n_counted += counts ? 1 : 0;
      // Others go behind those that count.
      order[e] = {counts ? lowest : lowest + mesh.n_global_nodes, e};
    }
    std::ranges::sort(order);
    ElementBlock block{kept.shape, body, {}, {}, n_counted};
    block.nodes.reserve(kept.nodes.size());
    block.input_element.reserve(n);
    for (const auto& [lowest, e] : order) {
      const Index* nodes = kept.nodes.data() + e * nn;
      block.nodes.insert(block.nodes.end(), nodes, nodes + nn);
      block.input_element.push_back(kept.input_element[e]);
    }
    return block;
  }

  ElementBlock local_block(Kept kept) const {
    for (Index& node : kept.nodes) node = node < 0 ? -1 : local_[as_size(node)];
    return {kept.shape, -1, std::move(kept.nodes), std::move(kept.input_element), 0};
  }

  void make_surface(const std::string& name, const Surface& old, Mesh& mesh) {
    Surface& surface = mesh.surfaces[name];
    surface.replicated = old.replicated;
    const auto kept = faces_.find(name);
    for (std::size_t b = 0; b < old.faces.size(); ++b)
      surface.faces.push_back(sorted(std::move(kept->second[b]), old.faces[b].body, mesh));
    for (const ElementBlock& b : surface.faces)
      surface.nodes.insert(surface.nodes.end(), b.nodes.begin(), b.nodes.end());
    std::ranges::sort(surface.nodes);
    surface.nodes.erase(std::unique(surface.nodes.begin(), surface.nodes.end()), surface.nodes.end());
  }

  /// Nodes of a named set: old ones, and those of the elements of the group that the set is of. Own nodes are
  /// judged here, where all elements around them are; copies as their owners say.
  std::vector<char> members(const std::string& name, const std::vector<Index>& old) const {
    std::vector<char> is_in(as_size(level_.n_nodes()), 0);
    for (const Index node : old) is_in[as_size(node)] = 1;
    const auto add = [&](const Cut& cut) {
      for (const Index node : cut.nodes)
        if (node >= 0) is_in[as_size(node)] = 1;
    };
    for (const Cut& cut : level_.volumes)
      if (old_.bodies[as_size(cut.block->body)].name == name) add(cut);
    for (const auto* groups : {&level_.faces, &level_.others})
      if (const auto cuts = groups->find(name); cuts != groups->end())
        for (const Cut& cut : cuts->second) add(cut);
    return is_in;
  }

  void make_node_sets(Mesh& mesh) const {
    for (const auto& [name, old] : old_.node_sets) {
      std::vector<char> is_in = members(name, old);
      sharing_.update(is_in);
      std::vector<Index>& set = mesh.node_sets[name];
      for (std::size_t i = 0; i < order_.size(); ++i)
        if (is_in[as_size(order_[i])] != 0) set.push_back(as_index(i));
    }
  }

  const Level& level_;
  const Mesh& old_;
  const Sharing& sharing_;
  std::vector<Kept> volumes_;
  std::map<std::string, std::vector<Kept>> faces_;
  std::vector<Index> order_;  ///< nodes of the level that stay, in their new local order
  std::vector<Index> local_;  ///< of each node of the level; −1: it does not stay
};

}  // namespace

Part fine_part(const Level& level, const Sharing& sharing) {
  return Maker(level, sharing).make();
}

}  // namespace solidus::mesh
