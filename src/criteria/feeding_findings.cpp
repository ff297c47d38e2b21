// What Feeding tells at the end of a run: holes with their places, and the volumes of the balance.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "criteria/feeding.hpp"
#include "criteria/feeding_step.hpp"
#include "criteria/gas_pores.hpp"
#include "criteria/gather.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::criteria {

namespace {

constexpr std::size_t k_told = 3;        ///< holes of each kind
constexpr double k_least_hole = 1e-6;    ///< of the room of the castings
constexpr double k_part_of_hole = 0.02;  ///< of its room that a node must have lost to connect a hole

/// What one process knows of a hole, as a row of numbers.
struct Part {
  double label = 0, volume = 0;
  mesh::Point moment{};  ///< volume times place [m⁴]
  /// By what a place of it stands out: of a pipe how low it is, as minus the height of its bottom [m], else
  /// how much it has lost [m³].
  double rank = std::numeric_limits<double>::lowest();
  mesh::Point place{};  ///< that stands out most
  double body = -1;     ///< that has this place
  double top = std::numeric_limits<double>::lowest();
  static constexpr std::size_t k_width = 11;
};

void add(std::map<double, Part>& parts, const Part& other) {
  Part& part = parts.try_emplace(other.label, Part{.label = other.label}).first->second;
  part.volume += other.volume;
  for (std::size_t d = 0; d < 3; ++d) part.moment[d] += other.moment[d];
  part.top = std::max(part.top, other.top);
  if (other.rank <= part.rank) return;
  part.rank = other.rank;
  part.place = other.place;
  part.body = other.body;
}

std::map<double, Part> of_all_processes(const std::map<double, Part>& own) {
  // Parts as rows of numbers, joined by their label over all processes.
  std::vector<double> rows;
  for (const auto& [label, p] : own)
    rows.insert(rows.end(), {label, p.volume, p.moment[0], p.moment[1], p.moment[2], p.rank, p.place[0],
                             p.place[1], p.place[2], p.body, p.top});
  const std::vector<double> all = gathered(std::span<const double>(rows));
  std::map<double, Part> parts;
  for (std::size_t i = 0; i + Part::k_width <= all.size(); i += Part::k_width) {
    const double* r = all.data() + i;
    add(parts, {r[0], r[1], {r[2], r[3], r[4]}, r[5], {r[6], r[7], r[8]}, r[9], r[10]});
  }
  return parts;
}

}  // namespace

std::vector<FeedingHole> Feeding::holes(const CriterionRecord& record) const {
  // Rows of a record are read by the same view that writes them, which needs a copy to look at.
  CriterionRecord copy{record.name, record.columns, {}};
  const FeedingRows rows(copy.columns[0].values);
  const double room = totals(record).room;
  // The three kinds of holes are found one after the other: pipes, cavities and sinks. A hole is a connected
  // set of nodes that have lost more than a given share of their room.
  std::vector<FeedingHole> found;
  using Kind = FeedingHole::Kind;
  for (const auto& [kind, number] :
       {std::pair{Kind::pipe, k_pipe}, std::pair{Kind::cavity, k_cavity}, std::pair{Kind::sink, k_sink}}) {
    const auto lost = [&rows, lost_by = number](std::size_t i) { return rows(i, lost_by); };
    std::vector<char> inside(mesh_.x.size());
    for (std::size_t i = 0; i < inside.size(); ++i) inside[i] = lost(i) > k_part_of_hole;
    const ConnectedParts parts = connectivity_.parts(inside);
    // Each process sums the volume and the moment of its part of a hole; the representative place is that
    // with the largest rank.
    std::map<double, Part> own;
    for (std::size_t i = 0; i < as_size(mesh_.n_owned_nodes); ++i) {
      if (inside[i] == 0) continue;
      Part part{.label = parts.label[i], .volume = rows(i, k_room) * lost(i)};
      for (std::size_t d = 0; d < 3; ++d) part.moment[d] = part.volume * mesh_.x[i][d];
      part.rank = part.volume;
      part.place = mesh_.x[i];
      part.top = graph_.high(i);
      part.body = body_[i];
      // A pipe is told by its deepest place: its bottom is where the level lies within the node's height,
      // and the place is moved to it along the vertical.
      if (kind == Kind::pipe) {
        const double drained = std::clamp(rows(i, k_drained), 0.0, 1.0);
        const double bottom = graph_.high(i) - drained * (graph_.high(i) - graph_.low(i));
        const double height = up_.height(mesh_.x[i]);
        const std::array<double, 3> direction = up_.direction(mesh_.x[i]);
        for (std::size_t d = 0; d < 3; ++d) part.place[d] += (bottom - height) * direction[d];
        part.rank = -bottom;
      }
      add(own, part);
    }
    // Parts of all processes with one label are one hole. Holes too small against the casting are left out.
    for (const auto& [label, part] : of_all_processes(own)) {
      if (!(part.volume > k_least_hole * room)) continue;
      FeedingHole hole{.kind = kind, .volume = part.volume, .body = static_cast<int>(part.body)};
      for (std::size_t d = 0; d < 3; ++d) hole.where[d] = part.moment[d] / part.volume;
      // The depth of a pipe is measured from its highest place, and `left` from its bottom down to the lowest
      // place of the body.
      if (kind == Kind::pipe) {
        hole.where = part.place;
        hole.depth = part.top + part.rank;
        hole.left = -part.rank - lowest_of(hole.body);
      }
      found.push_back(hole);
    }
  }
  // They are listed by kind, the largest of a kind first.
  std::ranges::stable_sort(found, [](const FeedingHole& a, const FeedingHole& b) {
    return a.kind != b.kind ? a.kind < b.kind : a.volume > b.volume;
  });
  return found;
}

double Feeding::lowest_of(int body) const {
  double low = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < as_size(mesh_.n_owned_nodes); ++i)
    if (body_[i] == body) low = std::min(low, up_.height(mesh_.x[i]));
  return parallel::global_min(low);
}

std::vector<CriterionResult> Feeding::findings(const CriterionRecord& record) const {
  // First the totals: what the pipe, sinks, cavities and pores have taken, and the room of the metal.
  const FeedingTotals t = totals(record);
  std::vector<CriterionResult> found{
      {"feeding_pipe", "m3", t.pipe, false, {}},     {"feeding_sink", "m3", t.sink, false, {}},
      {"feeding_cavity", "m3", t.cavity, false, {}}, {"feeding_pores", "m3", t.pores, false, {}},
      {"feeding_room", "m3", t.room, false, {}},     {"feeding_defect", "1", t.defect(), false, {}}};
  if (t.wall != 0) found.push_back({"feeding_wall", "m3", t.wall, false, {}});
  // Gas has findings of its own, made of the porosity of each node and its room.
  if (has_gas()) {
    CriterionRecord copy{record.name, record.columns, {}};
    const FeedingRows rows(copy.columns[0].values);
    std::vector<double> pores, rooms;
    for (std::size_t i = 0; i < as_size(mesh_.n_owned_nodes); ++i) {
      pores.push_back(rows(i, k_gas));
      rooms.push_back(rows(i, k_room));
    }
    std::ranges::move(gas_findings(mesh_, pores, rooms), std::back_inserter(found));
  }
  // Then the largest holes of each kind with volume, body and place; pipes also with their depth and what is
  // left below them.
  constexpr std::array<const char*, 3> k_names{"pipe_", "cavity_", "sink_"};  // in the order of the kinds
  std::array<std::size_t, 3> told{};
  for (const FeedingHole& hole : holes(record)) {
    const auto kind = static_cast<std::size_t>(hole.kind);
    if (++told[kind] > k_told) continue;
    const std::string name = k_names[kind] + std::to_string(told[kind]);
    found.push_back({name + "_volume", "m3", hole.volume, true, hole.where});
    found.push_back({name + "_body", "1", static_cast<double>(hole.body), false, {}});
    if (hole.kind != FeedingHole::Kind::pipe) continue;
    found.push_back({name + "_depth", "m", hole.depth, true, hole.where});
    found.push_back({name + "_left", "m", hole.left, true, hole.where});
  }
  if (t.pores > k_least_hole * t.room) found.push_back(densest_pores(record));
  return found;
}

CriterionResult Feeding::densest_pores(const CriterionRecord& record) const {
  CriterionRecord copy{record.name, record.columns, {}};
  const FeedingRows rows(copy.columns[0].values);
  // Share and place travel together, so that the winner's place comes along.
  std::vector<double> own;
  // The densest own node, then the densest of all.
  for (std::size_t i = 0; i < as_size(mesh_.n_owned_nodes); ++i)
    if (rows(i, k_room) > 0 && (own.empty() || rows(i, k_pores) > own[0]))
      own = {rows(i, k_pores), mesh_.x[i][0], mesh_.x[i][1], mesh_.x[i][2]};
  const std::vector<double> all = gathered(std::span<const double>(own));
  CriterionResult densest{"feeding_densest_pores", "1", 0, true, {}};
  for (std::size_t k = 0; k + 4 <= all.size(); k += 4) {
    if (all[k] <= densest.value) continue;
    densest.value = all[k];
    densest.where = {all[k + 1], all[k + 2], all[k + 3]};
  }
  return densest;
}

}  // namespace solidus::criteria
