// Sets and surfaces of a deck as groups of a mesh (mesh/files/abaqus_scope.hpp).
#include <algorithm>
#include <optional>
#include <set>
#include <span>

#include "mesh/files/abaqus_deck.hpp"
#include "mesh/files/abaqus_elements.hpp"
#include "mesh/files/abaqus_scope.hpp"
#include "mesh/files/split_cells.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mesh {

namespace {

void add(RawGroup& group, Shape shape, const std::vector<Index>& nodes, GlobalIndex number) {
  auto block = std::find_if(group.blocks.begin(), group.blocks.end(),
                            [&](const RawBlock& b) { return b.shape == shape; });
  if (block == group.blocks.end()) block = group.blocks.insert(group.blocks.end(), RawBlock{shape, {}, {}});
  block->nodes.insert(block->nodes.end(), nodes.begin(), nodes.end());
  block->input_element.push_back(number);
}

/// A member of a scope, and how many of the numbers of a set there are none of.
struct Found {
  std::vector<std::pair<std::size_t, Index>> members;  ///< scope and place in it; rising, each once
  GlobalIndex n_missing = 0;
  std::optional<GlobalIndex> missing;  ///< one of them
};

class Groups {
 public:
  Groups(const std::string& path, const std::vector<AbaqusScope>& scopes, std::vector<std::string> notes)
      : path_(path), scopes_(scopes) {
    mesh_.notes = std::move(notes);
  }

  RawMesh make() {
    add_nodes();
    for (const AbaqusScope& scope : scopes_) named_.emplace_back(scope.elements.size(), char{0});
    for (std::size_t s = 0; s < scopes_.size(); ++s)
      for (const auto& [key, set] : scopes_[s].element_sets) add_element_set(s, key, set);
    add_rest();
    for (std::size_t s = 0; s < scopes_.size(); ++s)
      for (const auto& [key, surface] : scopes_[s].surfaces) add_surface(s, key, surface);
    for (std::size_t s = 0; s < scopes_.size(); ++s)
      for (const auto& [key, set] : scopes_[s].node_sets) add_node_set(s, key, set);
    return std::move(mesh_);
  }

 private:
  void add_nodes();
  Found find(std::size_t scope, const std::vector<NumberRange>& ranges, bool nodes) const;
  const AbaqusElement& element(const std::pair<std::size_t, Index>& at) const {
    return scopes_[at.first].elements[as_size(at.second)];
  }
  std::vector<Index> nodes_of(std::size_t scope, const std::vector<Index>& local) const {
    std::vector<Index> nodes;
    for (const Index n : local) nodes.push_back(first_node_[scope] + n);
    return nodes;
  }
  void add_group(const std::string& name, RawGroup group) {
    if (group.blocks.empty()) return;
    // The same name for elements, nodes and faces is usual in these files.
    std::string free = name;
    if (mesh_.groups.contains(free)) free += "_" + std::to_string(group.dimension) + "d";
    for (int k = 2; mesh_.groups.contains(free); ++k) free = name + "_" + std::to_string(k);
    mesh_.groups.emplace(free, std::move(group));
  }
  /// The name of a set: with that of its instance before it where several scopes have such a set.
  template <class Has>
  std::string name_in_mesh(std::size_t scope, const std::string& name, Has has) const {
    if (scope == 0) return name;
    std::size_t n = 0;
    for (const AbaqusScope& each : scopes_) n += has(each) ? 1 : 0;
    return n > 1 ? scopes_[scope].name + "." + name : name;
  }
  void say_missing(const AbaqusSet& set, const Found& found) {
    if (found.n_missing == 0) return;
    mesh_.notes.push_back(set.at.text() + ": the set '" + set.name + "' names " +
                          std::to_string(found.n_missing) +
                          (found.n_missing == 1 ? " element that is" : " elements that are") +
                          " not in the file, such as " + std::to_string(*found.missing) +
                          "; an export of all elements, and not of those of the highest dimension, has them");
  }
  void add_element_set(std::size_t scope, const std::string& key, const AbaqusSet& set);
  void add_rest();
  void add_surface(std::size_t scope, const std::string& key, const AbaqusSurface& surface);
  void add_node_set(std::size_t scope, const std::string& key, const AbaqusSet& set);

  const std::string& path_;
  const std::vector<AbaqusScope>& scopes_;
  RawMesh mesh_;
  std::vector<Index> first_node_;         ///< of each scope, in the mesh
  std::vector<GlobalIndex> rise_;         ///< of the numbers of each scope in the mesh
  std::vector<std::vector<char>> named_;  ///< of each scope: whether an element is in a set
};

// Instances that use the same numbers get others, so that a number tells one node. The numbers of the first
// scope that has any stay as they are.
void Groups::add_nodes() {
  mesh_.dimension = 0;
  GlobalIndex last = 0;
  std::set<GlobalIndex> taken;
  const bool several = scopes_.size() > 2 || (scopes_.size() > 1 && !scopes_[0].x.empty());
  for (const AbaqusScope& scope : scopes_) {
    first_node_.push_back(as_index(mesh_.x.size()));
    GlobalIndex rise = 0;
    // Numbers are raised by a power of ten, so that a user recognises the old one in the new one.
    if (several) {
      const auto again = [&](GlobalIndex n) { return taken.contains(n); };
      if (std::ranges::any_of(scope.node_number, again))
        for (rise = 1; rise <= last; rise *= 10) {
        }
      for (const GlobalIndex n : scope.node_number) {
        taken.insert(n + rise);
        last = std::max(last, n + rise);
      }
      for (const AbaqusElement& e : scope.elements) last = std::max(last, e.number + rise);
    }
    // The rise is kept: references to nodes of this instance need it too.
    rise_.push_back(rise);
    if (rise > 0)
      mesh_.notes.push_back("the numbers of nodes and elements of the instance '" + scope.name +
                            "' are raised by " + std::to_string(rise) + ", as others have the same");
    mesh_.x.insert(mesh_.x.end(), scope.x.begin(), scope.x.end());
    for (const GlobalIndex n : scope.node_number) mesh_.input_node.push_back(n + rise);
    for (const AbaqusElement& e : scope.elements)
      mesh_.dimension = std::max(mesh_.dimension, mesh::dimension(e.shape));
  }
  if (mesh_.dimension < 2)
    throw InputError({path_},
                     "the mesh has no triangles, quads, tetrahedra or hexahedra: empty, cut off or "
                     "not a mesh",
                     "an Abaqus or CalculiX input file with *NODE and *ELEMENT");
}

Found Groups::find(std::size_t scope, const std::vector<NumberRange>& ranges, bool nodes) const {
  Found found;
  for (const NumberRange& r : ranges) {
    // A range belongs to the scope that it was written in, or to the instance that it names.
    const std::size_t of = r.scope == 0 ? scope : as_size(r.scope);
    const auto& at = nodes ? scopes_[of].node_at : scopes_[of].element_at;
    const std::size_t before = found.members.size();
    const auto n_all = static_cast<GlobalIndex>(at.size());
    // Short ranges are looked up number by number, which also tells which one is missing.
    if (r.count() <= 4 * n_all + 16) {
      for (GlobalIndex n = r.first; n <= r.last; n += r.step)
        if (const auto member = at.find(n); member != at.end())
          found.members.emplace_back(of, member->second);
        else if (!found.missing)
          found.missing = n;
    } else {  // a range far beyond what there is: what there is is looked through
      for (const auto& [n, member] : at)
        if (n >= r.first && n <= r.last && (n - r.first) % r.step == 0)
          found.members.emplace_back(of, member);
      if (!found.missing) found.missing = r.last;
    }
    found.n_missing += r.count() - static_cast<GlobalIndex>(found.members.size() - before);
  }
  // A member that two ranges name counts once.
  std::ranges::sort(found.members);
  found.members.erase(std::unique(found.members.begin(), found.members.end()), found.members.end());
  return found;
}

void Groups::add_element_set(std::size_t scope, const std::string& key, const AbaqusSet& set) {
  // Members by number, with a note on those that the deck does not have.
  const Found found = find(scope, set.ranges, false);
  say_missing(set, found);
  if (set.internal) return;
  // The highest dimension in the set decides what the group is.
  RawGroup group{0, {}};
  for (const auto& at : found.members) {
    group.dimension = std::max(group.dimension, mesh::dimension(element(at).shape));
    named_[at.first][as_size(at.second)] = 1;
  }
  // A set of everything means the elements of highest dimension in it.
  for (const auto& at : found.members) {
    const AbaqusElement& e = element(at);
    if (mesh::dimension(e.shape) == group.dimension)
      add(group, e.shape, nodes_of(at.first, e.nodes), e.number + rise_[at.first]);
  }
  add_group(name_in_mesh(scope, set.name,
                         [&](const AbaqusScope& s) {
                           const auto other = s.element_sets.find(key);
                           return other != s.element_sets.end() && !other->second.internal;
                         }),
            std::move(group));
}

// Elements of no set: one body of the deck, and one of each instance.
void Groups::add_rest() {
  // What no set has named is a body, one for the deck and one for each instance.
  for (std::size_t s = 0; s < scopes_.size(); ++s) {
    RawGroup rest{mesh_.dimension, {}};
    std::size_t thin = 0;
    for (std::size_t i = 0; i < scopes_[s].elements.size(); ++i) {
      const AbaqusElement& e = scopes_[s].elements[i];
      if (named_[s][i] != 0) continue;
      if (mesh::dimension(e.shape) == mesh_.dimension)
        add(rest, e.shape, nodes_of(s, e.nodes), e.number + rise_[s]);
      else if (mesh::dimension(e.shape) == 2)
        ++thin;
    }
    if (thin > 0)
      mesh_.notes.push_back(std::to_string(thin) +
                            " shells of no set lie next to the solids of the file and are left out");
    add_group(s == 0 || scopes_[s].name.empty() ? "body_1" : scopes_[s].name, std::move(rest));
  }
}

void Groups::add_surface(std::size_t scope, const std::string& key, const AbaqusSurface& surface) {
  // A surface of a deck names faces of elements: by a label S1, S2, … of a solid, or SPOS and SNEG, which
  // take a shell whole.
  RawGroup group{mesh_.dimension - 1, {}};
  for (const AbaqusFaces& faces : surface.faces) {
    const Found found = find(scope, faces.elements, false);
    if (found.n_missing > 0)
      throw InputError(faces.at, "there is no element " + std::to_string(*found.missing));
    const bool whole = faces.label == "SPOS" || faces.label == "SNEG";
    for (const auto& at : found.members) {
      // For each element of the set the label is translated into one of our faces; another dimension than
      // that of the surface is passed over.
      const AbaqusElement& e = element(at);
      const auto face = faces.label.size() == 2 && faces.label[0] == 'S'
                            ? face_of_abaqus_label(e.shape, faces.label[1] - '0')
                            : std::optional<int>{};
      if (!whole && !face)
        throw InputError(faces.at, "a " + std::string(name(e.shape)) + " has no face '" + faces.label + "'",
                         "S1 to S" + std::to_string(n_abaqus_faces(e.shape)));
      if (mesh::dimension(e.shape) - (whole ? 0 : 1) != group.dimension) continue;
      // Cells that are split when they are read (wedges, pyramids) know which of their parts has the face.
      if (whole) {
        add(group, e.shape, nodes_of(at.first, e.nodes), e.number + rise_[at.first]);
        continue;
      }
      const std::span<const int> of_split = face_of_split_cell(e.shape, *face);
      std::vector<Index> nodes;
      for (const int a : of_split.empty() ? face_nodes(e.shape, *face) : of_split)
        nodes.push_back(first_node_[at.first] + e.nodes[as_size(a)]);
      Shape shape = face_shape(e.shape);
      if (!of_split.empty()) shape = of_split.size() == 3 ? Shape::tri3 : Shape::quad4;
      add(group, shape, nodes, e.number + rise_[at.first]);
    }
  }
  add_group(name_in_mesh(scope, surface.name, [&](const AbaqusScope& s) { return s.surfaces.contains(key); }),
            std::move(group));
}

void Groups::add_node_set(std::size_t scope, const std::string& key, const AbaqusSet& set) {
  const Found found = find(scope, set.ranges, true);
  if (found.n_missing > 0)
    throw InputError(set.at, "the set '" + set.name + "' names node " + std::to_string(*found.missing) +
                                 ", which is not in the file");
  if (set.internal) return;
  RawGroup group{0, {}};
  for (const auto& [of, n] : found.members)
    add(group, Shape::point1, {first_node_[of] + n}, scopes_[of].node_number[as_size(n)]);
  add_group(name_in_mesh(scope, set.name,
                         [&](const AbaqusScope& s) {
                           const auto other = s.node_sets.find(key);
                           return other != s.node_sets.end() && !other->second.internal;
                         }),
            std::move(group));
}

}  // namespace

RawMesh mesh_of_scopes(const std::string& path, const std::vector<AbaqusScope>& scopes,
                       std::vector<std::string> notes) {
  return Groups(path, scopes, std::move(notes)).make();
}

}  // namespace solidus::mesh
