/// Groups of entries with one value have one leader; sums go to it, values come from it.
#include "linear/multi_point_constraints.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::linear {

MultiPointConstraints::MultiPointConstraints(const mesh::Mesh& mesh, int block_size,
                                             std::vector<std::vector<Index>> groups) {
  if (groups.empty()) return;
  // Members of a group are one unknown, that of their leader: the member with the lowest global number over
  // all processes.
  const auto global = [&](Index entry) {
    return mesh.global_node[as_size(entry / block_size)] * block_size + entry % block_size;
  };
  unknown_.resize(mesh.x.size() * as_size(block_size));
  for (std::size_t i = 0; i < unknown_.size(); ++i) unknown_[i] = global(as_index(i));

  // A process may hold a part of a group only, so the leader is found by a minimum over them.
  std::vector<GlobalIndex> leaders(groups.size(), std::numeric_limits<GlobalIndex>::max());
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const Index entry : groups[g]) leaders[g] = std::min(leaders[g], global(entry));
  static_assert(sizeof(GlobalIndex) == sizeof(std::int64_t));
  processes::least(leaders);

  // Owned members are kept, because sums over the group go through them; all but the leader are followers.
  const Index n_owned = mesh.n_owned_nodes * block_size;
  groups_.resize(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const Index entry : groups[g]) {
      assert(unknown_[as_size(entry)] == global(entry) && "a member of two groups");
      unknown_[as_size(entry)] = leaders[g];
      if (entry >= n_owned) continue;
      groups_[g].members.push_back(entry);
      if (global(entry) == leaders[g])
        groups_[g].leader = entry;
      else
        followers_.push_back(entry);
    }
}

void MultiPointConstraints::sum(std::span<double> r) const {
  if (empty()) return;
  std::vector<double> sums(groups_.size(), 0.0);
  // The forces of all members of a group act on one unknown; sums go over the processes.
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (const Index entry : groups_[g].members) {
      sums[g] += r[as_size(entry)];
      r[as_size(entry)] = 0;
    }
  processes::sum(sums);
  for (std::size_t g = 0; g < groups_.size(); ++g)
    if (groups_[g].leader >= 0) r[as_size(groups_[g].leader)] = sums[g];
}

void MultiPointConstraints::share(std::span<double> x) const {
  if (empty()) return;
  std::vector<double> values(groups_.size(), 0.0);  // one process owns the leader, the others add zero
  for (std::size_t g = 0; g < groups_.size(); ++g)
    if (groups_[g].leader >= 0) values[g] = x[as_size(groups_[g].leader)];
  processes::sum(values);
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (const Index entry : groups_[g].members) x[as_size(entry)] = values[g];
}

}  // namespace solidus::linear
