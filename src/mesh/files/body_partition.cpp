/// Groups are compared by their elements. The names that a person would have given are taken first, and a
/// group that overlaps what is taken is left out with its reason.
#include "mesh/files/body_partition.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <unordered_map>
#include <utility>

#include "mesh/surfaces/vertex_sets.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

using Members = std::vector<Index>;  // numbers of elements, rising

struct Candidate {
  std::string name;
  int preference = 0;
  Members members;
};

/// Groups and the elements that they hold, numbered over all of them.
struct Candidates {
  std::vector<Candidate> all;
  Index n_elements = 0;
  std::size_t n_entries = 0;  ///< of all groups together; an element counts once in a group
  std::size_t n_sets = 0;     ///< elements of all groups together, as they are there
};

Candidates candidates_of(const RawMesh& mesh, const NamePreference& preference) {
  // Groups of elements of the full dimension may be bodies; their elements are compared by their
  // vertices, since the same element may be in several groups under different numbers.
  Candidates result;
  std::vector<VertexSet> sets;
  for (const auto& [name, group] : mesh.groups) {
    if (group.dimension != mesh.dimension) continue;
    Candidate& candidate = result.all.emplace_back(Candidate{name, preference(name), {}});
    append_element_vertex_sets(group, sets);
    candidate.members.resize(sets.size() - result.n_sets);
    result.n_sets = sets.size();
  }
  // Elements are numbered as they come; one that is in several groups has one number.
  const std::vector<Index> first = first_equal_set(sets);
  std::vector<Index> number(sets.size());
  std::size_t set = 0;
  for (Candidate& candidate : result.all) {
    for (Index& member : candidate.members) {
      const auto original = as_size(first[set]);
      number[set] = original == set ? result.n_elements++ : number[original];
      member = number[set++];
    }
    // Sorted members make unions and intersections cheap.
    Members& m = candidate.members;
    std::ranges::sort(m);
    m.erase(std::unique(m.begin(), m.end()), m.end());
    result.n_entries += m.size();
  }
  return result;
}

class Choice {
 public:
  Choice(const std::vector<Candidate>& all, Index n_elements) : all_(all), taken_(as_size(n_elements), -1) {}

  /// Takes groups by the preference of their names, and among equals the largest first.
  /// @param classes  whether names of preference 0 and 1 come after each other, or together
  /// Returns whether all elements are in one.
  bool choose(bool classes) {
    std::ranges::fill(taken_, -1);
    chosen_.clear();
    std::vector<std::size_t> order(all_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto rank = [&](std::size_t i) {
      return classes ? all_[i].preference : std::max(all_[i].preference, 1);
    };
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
      if (rank(a) != rank(b)) return rank(a) > rank(b);
      if (all_[a].members.size() != all_[b].members.size())
        return all_[a].members.size() > all_[b].members.size();
      return all_[a].preference > all_[b].preference;  // of equal sets the better name
    });
    for (const std::size_t i : order)
      if (!is_union_of_others(i, rank)) take(i);
    return std::ranges::find(taken_, -1) == taken_.end();
  }

  BodyPartition partition() const {
    BodyPartition result;
    for (std::size_t i = 0; i < all_.size(); ++i)
      (std::ranges::find(chosen_, i) != chosen_.end() ? result.bodies : result.left_out)
          .push_back(all_[i].name);
    for (std::size_t i = 0; i < all_.size(); ++i)
      if (std::ranges::find(chosen_, i) == chosen_.end()) result.notes.push_back(why_left_out(i));
    return result;
  }

  /// A group that could not be taken although it holds an element that no other one has.
  std::string conflict() const {
    for (const Candidate& c : all_) {
      std::size_t free = 0;
      Index other = -1;
      for (const Index e : c.members)
        if (const Index t = taken_[as_size(e)]; t < 0)
          ++free;
        else
          other = t;
      if (free > 0 && other >= 0)
        return fmt::format(
            "the sets '{}' and '{}' have elements in common, and {} elements of '{}' are in no other set",
            c.name, all_[as_size(other)].name, free, c.name);
    }
    return "sets of elements overlap";
  }

 private:
  static bool inside(const Members& small, const Members& large) {
    return small.size() <= large.size() &&
           std::includes(large.begin(), large.end(), small.begin(), small.end());
  }

  /// Whether smaller groups with names that are at least as good fill it exactly.
  template <class Rank>
  bool is_union_of_others(std::size_t i, const Rank& rank) const {
    std::vector<char> filled(taken_.size(), 0);
    std::size_t n = 0;
    for (std::size_t k = 0; k < all_.size(); ++k) {
      if (k == i || rank(k) < rank(i) || all_[k].members.size() >= all_[i].members.size()) continue;
      if (!inside(all_[k].members, all_[i].members)) continue;
      for (const Index e : all_[k].members) n += std::exchange(filled[as_size(e)], 1) == 0 ? 1 : 0;
    }
    return n == all_[i].members.size();
  }

  void take(std::size_t i) {
    for (const Index e : all_[i].members)
      if (taken_[as_size(e)] >= 0) return;
    for (const Index e : all_[i].members) taken_[as_size(e)] = as_index(i);
    chosen_.push_back(i);
  }

  std::string why_left_out(std::size_t i) const {
    // The bodies that hold some of its elements are named in the reason.
    std::vector<std::string> holders;
    for (const std::size_t k : chosen_) {
      const bool any =
          std::ranges::any_of(all_[i].members, [&](Index e) { return taken_[as_size(e)] == as_index(k); });
      if (any) holders.push_back("'" + all_[k].name + "'");
    }
    std::ranges::sort(holders);
    // A set that is the union of chosen bodies is no body; any other one overlaps some of them.
    std::size_t whole = 0;
    for (const std::size_t k : chosen_)
      if (inside(all_[k].members, all_[i].members)) whole += all_[k].members.size();
    // Three cases, each with a message of its own: the same, a union, or an overlap.
    if (whole == all_[i].members.size() && holders.size() == 1)
      return fmt::format("the set '{}' holds the same elements as {} and is no body of its own", all_[i].name,
                         holders[0]);
    if (whole == all_[i].members.size())
      return fmt::format("the set '{}' holds all of {} and is no body of its own", all_[i].name,
                         fmt::join(holders, ", "));
    return fmt::format("the set '{}', {} elements, lies in {} and is no body of its own", all_[i].name,
                       all_[i].members.size(), fmt::join(holders, ", "));
  }

  const std::vector<Candidate>& all_;
  std::vector<Index> taken_;  ///< [element] the group that has it; -1: none
  std::vector<std::size_t> chosen_;
};

}  // namespace

int plain_preference(const std::string& name) {
  std::string begin = name;
  while (!begin.empty() && (std::isdigit(static_cast<unsigned char>(begin.back())) != 0 ||
                            begin.back() == '_' || begin.back() == '-'))
    begin.pop_back();
  std::ranges::transform(begin, begin.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array k_of_programs{"",         "all",      "eall",         "evolumes",   "efaces",
                                     "volume",   "surface",  "body",         "group",      "set",
                                     "elset",    "solid",    "elements",     "e",          "group_3d",
                                     "group_2d", "property", "all_elements", "allelements"};
  return std::ranges::any_of(k_of_programs, [&](const char* each) { return begin == each; }) ? 0 : 1;
}

BodyPartition partition_of(const RawMesh& mesh, const std::string& path, const NamePreference& preference) {
  const Candidates candidates = candidates_of(mesh, preference);
  Choice choice(candidates.all, candidates.n_elements);
  if (candidates.n_entries == as_size(candidates.n_elements)) {
    BodyPartition all;
    for (const Candidate& c : candidates.all) all.bodies.push_back(c.name);
    return all;
  }
  if (!choice.choose(true) && !choice.choose(false))
    throw InputError({path}, choice.conflict(), "sets of which no two hold the same element");
  return choice.partition();
}

}  // namespace solidus::mesh
