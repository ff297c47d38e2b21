/// The way of a path is cut into pieces whose elements are counted; what holds an element is found by walking
/// from what is there to what is born, in the order of time.
#include "setup/deposition_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/log.hpp"
#include "system/processes.hpp"

namespace solidus::setup {

namespace {

constexpr double k_most_pieces = 1e5;
constexpr std::size_t k_empty_pieces = 2;  ///< in a row; one may lie between the centres of two elements

double distance(const Position& a, const Position& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// An element that is born during the run.
struct Newborn {
  double birth;
  std::size_t block;
  Index element;
};

std::vector<Newborn> by_time(const std::vector<linear::GrowingMesh::Births>& births) {
  std::vector<Newborn> all;
  for (std::size_t b = 0; b < births.size(); ++b)
    for (std::size_t e = 0; e < births[b].size(); ++e)
      if (births[b][e] > 0 && births[b][e] < HUGE_VAL) all.push_back({births[b][e], b, as_index(e)});
  std::ranges::sort(all, {}, [](const Newborn& n) { return std::tuple(n.birth, n.block, n.element); });
  return all;
}

std::span<const Index> nodes_of(const mesh::Mesh& mesh, const Newborn& n) {
  const mesh::ElementBlock& block = mesh.blocks[n.block];
  return {block.element(n.element), as_size(mesh::node_count(block.shape))};
}

/// The times from which nodes belong to something that is held, or that others hold by contact, [local node];
/// infinite: never. Collective.
std::vector<double> held_from(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                              const std::vector<linear::GrowingMesh::Births>& births,
                              const std::vector<Newborn>& newborn) {
  std::vector<double> held(mesh.x.size(), HUGE_VAL);
  // Surfaces in contact pass forces and heat.
  for (const cases::ContactSpec& c : spec.contacts)
    for (const std::string& side : c.sides())
      if (const auto surface = mesh.surfaces.find(side); surface != mesh.surfaces.end())
        for (const Index node : surface->second.nodes) held[as_size(node)] = -HUGE_VAL;
  // What is there at the start is held.
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
    for (Index e = 0; e < mesh.blocks[b].size(); ++e)
      if (births[b].empty() || births[b][as_size(e)] <= 0)
        for (const Index node : nodes_of(mesh, {0, b, e})) held[as_size(node)] = -HUGE_VAL;
  // Where nothing is, what is born first is what others come to lie on.
  const bool bare = std::ranges::none_of(held, [](double from) { return from < 0; });
  if (!parallel::any_process(!bare)) {
    const double first = parallel::global_min(newborn.empty() ? HUGE_VAL : newborn.front().birth);
    for (const Newborn& n : newborn)
      if (n.birth == first)
        for (const Index node : nodes_of(mesh, n)) held[as_size(node)] = first;
  }
  const parallel::GhostExchange ghosts(mesh);
  // An element that touches something held is held itself, and hands on to those that are born with it or
  // later. A process sees every element at the nodes it owns.
  for (bool changed = true; parallel::any_process(changed);) {
    ghosts.update(held, 1);
    changed = false;
    for (const Newborn& n : newborn) {
      const std::span<const Index> nodes = nodes_of(mesh, n);
      const auto at = [&](Index node) -> double& { return held[as_size(node)]; };
      if (std::ranges::none_of(nodes, [&](Index node) { return at(node) <= n.birth; })) continue;
      for (const Index node : nodes) {
        if (at(node) <= n.birth) continue;
        at(node) = n.birth;
        changed = true;
      }
    }
  }
  return held;
}

/// The deposition of a block's body.
const cases::DepositionSpec& deposition_of(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                                           std::size_t block) {
  const std::string& body = mesh.bodies[as_size(mesh.blocks[block].body)].name;
  return *std::ranges::find(spec.depositions, body, &cases::DepositionSpec::body);
}

void warn_of_late_births(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                         const std::vector<Newborn>& newborn) {
  if (!spec.time.end) return;
  for (const cases::DepositionSpec& d : spec.depositions) {
    double late = 0, last = 0;
    for (const Newborn& n : newborn) {
      if (n.birth <= *spec.time.end || &deposition_of(spec, mesh, n.block) != &d) continue;
      late += n.element < mesh.blocks[n.block].n_counted ? 1 : 0;
      last = std::max(last, n.birth);
    }
    late = parallel::global_sum(late);
    last = parallel::global_max(last);
    if (late > 0)
      logging::warn(
          "{}: {:.0f} elements of '{}' are born after the run has ended at {:g} s, the last at {:g} s",
          d.where.text(), late, d.body, *spec.time.end, last);
  }
}

}  // namespace

LaidDown::LaidDown(const cases::DepositionSpec& deposition, const TravelPath& path, double piece)
    : deposition_(deposition), path_(path), way_(path.points().size(), 0.0) {
  const std::vector<TravelPoint>& points = path.points();
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    way_[i + 1] = way_[i] + (points[i].on > 0 ? distance(points[i].x, points[i + 1].x) : 0.0);
  piece_ = std::max(piece, way_.back() / k_most_pieces);
  count_.assign(static_cast<std::size_t>(way_.back() / piece_) + 1, 0.0);
}

void LaidDown::count(std::size_t move, double along) {
  const double way = std::clamp(way_[move] + along, 0.0, way_.back());
  count_[std::min(static_cast<std::size_t>(way / piece_), count_.size() - 1)] += 1;
}

void LaidDown::warn() const {
  std::vector<double> all = count_;
  processes::sum(std::span(all));
  // The longest row of empty pieces; the last piece of the way is shorter than the others, and does not
  // count.
  std::size_t longest = 0, from = 0;
  for (std::size_t k = 0, empty = 0; k + 1 < all.size(); ++k) {
    empty = all[k] > 0 ? 0 : empty + 1;
    if (empty > longest) longest = empty, from = k + 1 - empty;
  }
  if (longest < k_empty_pieces) return;
  // Its begin as a point of the path.
  const double way = static_cast<double>(from) * piece_;
  const auto behind = std::upper_bound(way_.begin(), way_.end(), way);
  const auto move = as_size(std::max<std::ptrdiff_t>(behind - way_.begin() - 1, 0));
  const TravelPoint& p = path_.points()[move];
  const TravelPoint& next = path_.points()[std::min(move + 1, path_.points().size() - 1)];
  const double length = distance(p.x, next.x), share = length > 0 ? (way - way_[move]) / length : 0.0;
  const double time = p.time + share * (next.time - p.time);
  const Position x = path_.at(time);
  logging::warn(
      "{}: the path of the deposition '{}' lays nothing down from t = {:g} s and ({:.6g}, {:.6g}, {:.6g}) m "
      "on, "
      "over {:.3g} m: it runs outside of '{}', or where all has been laid down before",
      deposition_.where.text(), deposition_.name, time, x[0], x[1], x[2],
      static_cast<double>(longest) * piece_, deposition_.body);
}

void check_births(const cases::CaseSpec& spec, const mesh::Mesh& mesh,
                  const std::vector<linear::GrowingMesh::Births>& births) {
  const std::vector<Newborn> newborn = by_time(births);
  warn_of_late_births(spec, mesh, newborn);
  const std::vector<double> held = held_from(spec, mesh, births, newborn);
  for (const cases::DepositionSpec& d : spec.depositions) {
    double count = 0, first = HUGE_VAL;
    for (const Newborn& n : newborn) {
      if (&deposition_of(spec, mesh, n.block) != &d || n.element >= mesh.blocks[n.block].n_counted) continue;
      const std::span<const Index> nodes = nodes_of(mesh, n);
      if (std::ranges::any_of(nodes, [&](Index i) { return held[as_size(i)] <= n.birth; })) continue;
      count += 1;
      first = std::min(first, n.birth);
    }
    count = parallel::global_sum(count);
    first = parallel::global_min(first);
    if (count > 0)
      logging::warn(
          "{}: {:.0f} elements of '{}' touch nothing that is there when they are born, the first at "
          "{:g} s: heat does not reach them",
          d.where.text(), count, d.body, first);
  }
}

}  // namespace solidus::setup
