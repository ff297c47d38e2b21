/// Findings of sources that travel: those next to the metal, those that are still on when a run ends, and
/// steps in which they move too far.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "check/finding_family.hpp"
#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/source_input.hpp"

namespace solidus::check {

namespace {

constexpr double k_beside = 2;      ///< of the largest size of the source: farther from the nodes it heats
constexpr double k_many = 3;        ///< lengths of the source in a fixed step
constexpr int k_most_points = 200;  ///< of a path that are looked at

/// The box of the nodes that a source may heat, over all processes.
struct Box {
  Position low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  /// The distance of a point from it.
  double distance(const Position& x) const {
    double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double out = std::max({low[k] - x[k], x[k] - high[k], 0.0});
      square += out * out;
    }
    return std::sqrt(square);
  }
};

Box heated_box(const cases::SourceSpec& source, const mesh::Mesh& mesh) {
  Box box;
  for (const std::string& group : source.groups)
    if (const auto nodes = mesh.node_sets.find(group); nodes != mesh.node_sets.end())
      for (const Index node : nodes->second)
        for (std::size_t k = 0; k < 3; ++k) {
          const double x = mesh.x[as_size(node)][k];
          box.low[k] = std::min(box.low[k], x);
          box.high[k] = std::max(box.high[k], x);
        }
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] = parallel::global_min(box.low[k]);
    box.high[k] = parallel::global_max(box.high[k]);
  }
  return box;
}

double size_of(const heat::TravellingShape& s) {
  return std::max({s.radius, s.width, s.depth, s.front, s.rear});
}

/// Places of a path at which the source is on and far from all that it could heat.
void misses(const cases::SourceSpec& s, const TravelPath& path, const Box& box, double size,
            Findings& findings) {
  const std::size_t stride = std::max<std::size_t>(1, path.points().size() / k_most_points);
  for (std::size_t i = 0; i + 1 < path.points().size(); i += stride) {
    const TravelPoint& p = path.points()[i];
    const double away = box.distance(p.x);
    if (p.on == 0 || away <= k_beside * size) continue;
    findings.push_back(
        {false, s.where,
         fmt::format("the source '{}' is on at t = {:g} s in ({:.6g}, {:.6g}, {:.6g}) m, {:.3g} m "
                     "from the box of what it heats: it misses",
                     s.name, p.time, p.x[0], p.x[1], p.x[2], away),
         "a path on the metal, in its unit of length, or `on` = 0 next to it"});
    return;
  }
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures&, Findings& findings) {
  for (const cases::SourceSpec& s : spec.sources) {
    const TravelPath path = setup::travel_path(s.path, spec.dimension(), s.where);
    const heat::TravellingShape shape = setup::travelling_shape(s, spec.dimension());
    const double size = size_of(shape), end = spec.time.end.value_or(path.end());
    misses(s, path, heated_box(s, a.mesh), size, findings);
    if (path.end() > end)
      findings.push_back({false, s.where,
                          fmt::format("the path of the source '{}' ends at {:g} s, the run at {:g} s", s.name,
                                      path.end(), end),
                          "a run that is as long as the path"});
    if (path.begin() >= end) continue;
    // A fixed step in which it moves far heats a streak at once.
    const double length =
        heat::TravellingHeat(std::make_shared<TravelPath>(path), shape, Table(1.0), 1).length();
    const double moved = path.fastest(path.begin(), end) * spec.time.step.value_or(0) / length;
    if (!spec.time.adaptive && spec.stages.empty() && moved > k_many)
      findings.push_back(
          {false, s.where,
           fmt::format("the source '{}' moves by {:.3g} of its lengths in a step: a streak is heated at once",
                       s.name, moved),
           fmt::format("steps of {:.2g} s, or adaptive = true", 0.5 * *spec.time.step / moved)});
  }
}

}  // namespace

FindingFamily findings_sources() {
  return {.name = "sources that travel",
          .place = 285,
          .find = &find,
          .rows = {{Topic::conditions, "a source that misses",
                    fmt::format("it is on while farther than {} times its size from the bounding box of the "
                                "bodies that it heats",
                                number(k_beside))},
                   {Topic::conditions, "a source that is on when the run ends"},
                   {Topic::conditions, "a source that moves far in a step",
                    fmt::format("by more than {} times its length, in fixed steps", number(k_many))}}};
}

}  // namespace solidus::check
