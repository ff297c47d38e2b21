#include "heat/channels/channel_line.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "heat/channels/line_excess.hpp"
#include "mesh/element_search.hpp"
#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::heat {

namespace {

constexpr double k_pi = std::numbers::pi;
constexpr int k_least_points = 12, k_most_points = 48;  ///< of a station, around the channel
constexpr double k_most_stations = 4000;
constexpr double k_reach = 6;       ///< elements and diameters by which the way goes on
constexpr double k_touches = 1e-6;  ///< a point this near counts as inside, as a share of the diameter

double dot(const Position& a, const Position& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Position difference(const Position& a, const Position& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double length(const Position& a) {
  return std::sqrt(dot(a, a));
}

double distance_to_segment(const Position& x, const Position& a, const Position& b) {
  const Position along = difference(b, a), to = difference(x, a);
  const double s = std::clamp(dot(to, along) / dot(along, along), 0.0, 1.0);
  Position off = to;
  for (std::size_t k = 0; k < 3; ++k) off[k] -= s * along[k];
  return length(off);
}

/// The way and a straight piece before and behind it.
std::vector<Position> extended(const std::vector<Position>& path, double by) {
  const auto beyond = [by](const Position& end, const Position& before) {
    const Position along = difference(end, before);
    const double size = length(along);
    Position x = end;
    for (std::size_t k = 0; k < 3; ++k) x[k] += by / size * along[k];
    return x;
  };
  std::vector<Position> longer{beyond(path[0], path[1])};
  longer.insert(longer.end(), path.begin(), path.end());
  longer.push_back(beyond(path.back(), path[path.size() - 2]));
  return longer;
}

/// Two directions of length one across another.
std::array<Position, 2> across(const Position& along) {
  // The axis that is farthest from the direction makes the first one.
  std::size_t least = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::abs(along[k]) < std::abs(along[least])) least = k;
  Position first{};
  first[least] = 1;
  const double part = dot(first, along);
  for (std::size_t k = 0; k < 3; ++k) first[k] -= part * along[k];
  const double size = length(first);
  for (double& c : first) c /= size;
  return {first,
          Position{along[1] * first[2] - along[2] * first[1], along[2] * first[0] - along[0] * first[2],
                   along[0] * first[1] - along[1] * first[0]}};
}

}  // namespace

ChannelLine::ChannelLine(const mesh::Mesh& mesh, AnalysisKind kind, int body,
                         const std::vector<Position>& path, double diameter, bool closed) {
  // Stations are half a diameter long; where elements are smaller than that, half an element.
  place_stations(kind, path, 0.5 * diameter);
  find_shares(mesh, body, path, diameter);
  const bool small = element_size_ > 0 && element_size_ < diameter;
  const double spacing = small ? 0.5 * element_size_ : 0.5 * diameter;
  if (kind != AnalysisKind::solid) {
    if (small) find_shares(mesh, body, path, diameter);
    find_excess(mesh, kind, body, path, diameter, closed);
    return;
  }
  // In space the field is that of a way which goes on behind its ends.
  const std::vector<Position> longer = extended(path, k_reach * (element_size_ + diameter));
  place_stations(kind, longer, spacing);
  find_shares(mesh, body, longer, diameter);
  find_excess(mesh, kind, body, longer, diameter, closed);
  drop_ends(longer.size() - 1);
}

/// The discrete field of all stations of a way together; bores and rings of two dimensions are apart from
/// each other.
void ChannelLine::find_excess(const mesh::Mesh& mesh, AnalysisKind kind, int body,
                              const std::vector<Position>& path, double diameter, bool closed) {
  const bool apart = kind != AnalysisKind::solid;
  const std::size_t n_fields = apart ? stations_.size() : 1;
  for (std::size_t field = 0; field < n_fields; ++field) {
    std::vector<double> taken(as_size(mesh.n_owned_nodes), 0.0);
    for (const Share& share : shares_)
      if (!apart || share.station == field)
        taken[as_size(share.node)] += share.weight * stations_[share.station].length;
    const auto far = [&](const mesh::Point& x) {
      double distance = HUGE_VAL;
      if (apart)
        distance = length(difference(x, stations_[field].x));
      else
        for (std::size_t i = 0; i + 1 < path.size(); ++i)
          distance = std::min(distance, distance_to_segment(x, path[i], path[i + 1]));
      return std::log(std::max(distance / (0.5 * diameter), 1.0)) / (2 * k_pi);
    };
    const std::vector<double> u = line_excess(mesh, kind, body, closed, taken, far);
    for (Share& share : shares_)
      if (!apart || share.station == field) share.excess = u[as_size(share.node)];
  }
}

/// Leaves out the stations of the first and the last segment, by which the way was extended.
void ChannelLine::drop_ends(std::size_t n_segments) {
  const auto beyond = [&](std::size_t segment) { return segment == 0 || segment + 1 == n_segments; };
  std::size_t first = 0;
  while (beyond(segments_[first])) ++first;
  std::erase_if(shares_, [&](const Share& share) { return beyond(segments_[share.station]); });
  for (Share& share : shares_) share.station -= first;
  std::vector<Station> kept;
  for (std::size_t s = 0; s < stations_.size(); ++s)
    if (!beyond(segments_[s])) kept.push_back(stations_[s]);
  stations_ = std::move(kept);
  segments_.clear();
}

void ChannelLine::place_stations(AnalysisKind kind, const std::vector<Position>& path, double spacing) {
  stations_.clear();
  segments_.clear();
  if (kind != AnalysisKind::solid) {
    for (const Position& x : path) {
      stations_.push_back({x, kind == AnalysisKind::axisymmetric ? 2 * k_pi * x[0] : 1.0});
      segments_.push_back(0);
    }
    return;
  }
  // Equal stations along each straight part.
  double whole = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) whole += length(difference(path[i + 1], path[i]));
  spacing = std::max(spacing, whole / k_most_stations);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Position along = difference(path[i + 1], path[i]);
    const double way = length(along);
    const int n = std::max(1, static_cast<int>(std::ceil(way / spacing)));
    for (int k = 0; k < n; ++k) {
      Station station{path[i], way / n};
      for (std::size_t c = 0; c < 3; ++c) station.x[c] += (k + 0.5) / n * along[c];
      stations_.push_back(station);
      segments_.push_back(i);
    }
  }
}

void ChannelLine::find_shares(const mesh::Mesh& mesh, int body, const std::vector<Position>& path,
                              double diameter) {
  shares_.clear();
  const mesh::ElementSearch search(mesh, body);
  const double around = k_pi * diameter / (0.5 * (element_size_ > 0 ? element_size_ : diameter));
  const int n = std::clamp(static_cast<int>(std::ceil(around)), k_least_points, k_most_points);
  // Sums over all processes: the share of each wall that is inside, and the sizes of elements.
  std::vector<double> sums(stations_.size() + 2, 0.0);
  for (std::size_t s = 0; s < stations_.size() && !search.empty(); ++s) {
    std::array<Position, 2> axes{Position{1, 0, 0}, Position{0, 1, 0}};
    if (mesh.dimension == 3) {
      Position along = difference(path[segments_[s] + 1], path[segments_[s]]);
      const double way = length(along);
      for (double& c : along) c /= way;
      axes = across(along);
    }
    // Each point of the wall counts at the nodes of its element that this process owns: a node's owner has
    // every element around it, so that each share is counted once.
    std::map<Index, double> weight;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * k_pi * (i + 0.5) / n;
      Position x = stations_[s].x;
      for (std::size_t k = 0; k < 3; ++k)
        x[k] += 0.5 * diameter * (std::cos(angle) * axes[0][k] + std::sin(angle) * axes[1][k]);
      const mesh::ElementSearch::Found found = search.find(x);
      if (found.distance > k_touches * diameter) continue;
      // Quadratic shape functions have negative values, and no node may be heated by what cools.
      double positive = 0;
      for (const double w : found.weights) positive += std::max(w, 0.0);
      for (std::size_t a = 0; a < found.nodes.size(); ++a) {
        if (found.nodes[a] >= mesh.n_owned_nodes || !(found.weights[a] > 0)) continue;
        weight[found.nodes[a]] += found.weights[a] / positive / n;
        sums[stations_.size()] += found.size;
        sums[stations_.size() + 1] += 1;
      }
    }
    for (const auto& [node, w] : weight) {
      shares_.push_back({node, s, w, 0});
      sums[s] += w;
    }
  }
  processes::sum(sums);
  for (std::size_t s = 0; s < stations_.size(); ++s) stations_[s].inside = sums[s];
  const double counted = sums[stations_.size() + 1];
  element_size_ = counted > 0 ? sums[stations_.size()] / counted : 0;
}

}  // namespace solidus::heat
