/// Times are rounded to those of groups, by which blocks are then divided.
#include "linear/birth_groups.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::linear {

namespace {

using Births = GrowingMesh::Births;
constexpr int k_most_times = GrowingMesh::k_most_times;

void append(mesh::ElementBlock& to, const mesh::ElementBlock& from, Index element) {
  const Index* nodes = from.element(element);
  to.nodes.insert(to.nodes.end(), nodes, nodes + mesh::node_count(from.shape));
  to.input_element.push_back(from.input_element[as_size(element)]);
  if (element < from.n_counted) ++to.n_counted;
}

}  // namespace

std::vector<double> group_times(std::vector<Births>& births, double interval) {
  // The different times are found one after the other, since no process knows all of them.
  std::vector<double> own, times;
  for (const Births& of_block : births)
    for (const double t : of_block)
      if (std::isfinite(t)) own.push_back(t);
  std::sort(own.begin(), own.end());
  const double first = parallel::global_min(own.empty() ? HUGE_VAL : own.front()),
               last = parallel::global_max(own.empty() ? -HUGE_VAL : own.back());
  if (!(last >= first)) return times;
  const double same = 1e-9 * std::max(last - first, 1e-9);
  const auto collect = [&] {
    times.clear();
    for (double time = -HUGE_VAL; std::ssize(times) <= k_most_times;) {
      const auto next = std::upper_bound(own.begin(), own.end(), time + same);
      time = parallel::global_min(next == own.end() ? HUGE_VAL : *next);
      if (!std::isfinite(time)) break;
      times.push_back(time);
    }
  };
  if (interval <= 0) collect();
  if (std::ssize(times) > k_most_times) interval = (last - first) / k_most_times;
  // Each birth moves to the time at which its group is born.
  const auto rounded = [&](double t) {
    return interval > 0 ? first + interval * std::ceil((t - first) / interval - 1e-9)
                        : *(std::upper_bound(times.begin(), times.end(), t + same) - 1);
  };
  for (Births& of_block : births)
    for (double& t : of_block)
      if (std::isfinite(t)) t = rounded(t);
  if (interval <= 0) return times;
  for (double& t : own) t = rounded(t);
  collect();
  return times;
}

void divide_by_birth(mesh::Mesh& mesh, std::vector<Births>& births, double interval) {
  const std::vector<double> times = group_times(births, interval);
  // Each element gets the number of its group: zero from the start, then the times, last those never born.
  const std::size_t never = times.size() + 1;
  const auto group = [&](double birth) {
    if (birth <= 0) return std::size_t{0};
    return std::isfinite(birth) ? as_size(std::ranges::lower_bound(times, birth) - times.begin()) + 1 : never;
  };
  std::vector<mesh::ElementBlock> blocks;
  std::vector<Births> of_blocks;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    mesh::ElementBlock& from = mesh.blocks[b];
    // Another process may have the elements of a group, or all elements of a block that grows.
    std::vector<int> used(never + 1, 0);
    for (const double birth : births[b]) used[group(birth)] = 1;
    processes::largest(std::span(used));
    if (std::ranges::count(used, 1) == 0) {
      blocks.push_back(std::move(from));
      of_blocks.emplace_back();
      continue;
    }
    for (std::size_t g = 0; g < used.size(); ++g) {
      if (used[g] == 0) continue;
      mesh::ElementBlock& to = blocks.emplace_back();
      to.shape = from.shape;
      to.body = from.body;
      for (Index e = 0; e < from.size(); ++e)
        if (group(births[b][as_size(e)]) == g) append(to, from, e);
      const double born = g == 0 ? -HUGE_VAL : g == never ? HUGE_VAL : times[g - 1];
      of_blocks.emplace_back(as_size(to.size()), born);
    }
  }
  mesh.blocks = std::move(blocks);
  births = std::move(of_blocks);
}

}  // namespace solidus::linear
