/// The adaptive division of one cell over which a load is integrated: a part of cell_integrals.cpp.
#pragma once

#include <algorithm>

#include "heat/loads/cell_shapes.hpp"
#include "mesh/quadrature.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/common_failure.hpp"

namespace solidus::heat {

/// A part of a cell: a box between two corners of the reference shape, or a simplex.
struct CellIntegrals::Part {
  Index cell = 0;
  std::array<Point, 4> corners{};
  double share = 1;  ///< of the reference shape, by the size of its rule
  int level = 0;
  int n_samples = 0;
  std::array<Sample, 8> samples{};
  LoadValues integral{};
  double measure = 0;
  bool breaks = false;  ///< the load is known to jump in it
  bool coarse = false;  ///< it is larger than a place in it at which the load is concentrated
};

/// The rounds of one integration.
class CellIntegrals::Division {
 public:
  Division(const CellIntegrals& cells, const Evaluate& evaluate, const Breaks& breaks, bool with_samples)
      : cells_(cells), evaluate_(evaluate), breaks_(breaks), with_samples_(with_samples) {
    const std::size_t n_cells = cells.measure_.size();
    result_.of_points.resize(cells.points_.size());
    result_.of_nodes.resize(cells.mesh_.x.size());
    result_.of_cells.resize(n_cells);
    largest_.resize(n_cells);
    for (const PlaceSpot& spot : breaks.spots)
      for (std::size_t i = 0; i < 3; ++i) {
        spots_low_[i] = std::min(spots_low_[i], spot.centre[i] - spot.radius);
        spots_high_[i] = std::max(spots_high_[i], spot.centre[i] + spot.radius);
      }
  }

  Result run() {
    run_collectively([&] { evaluate_(cells_.points_, true, result_.of_points); });
    see_whole_cells();
    std::vector<Part> open;
    run_collectively([&] { open = begin(); });
    for (int round = 0; parallel::any_process(!open.empty()); ++round) {
      std::vector<Part> next;
      run_collectively([&] { next = divide(open, round + 1 == k_rounds); });
      open = std::move(next);
      LoadValues seen = accepted_;
      for (const Part& part : open)
        if (cells_.counted(part.cell))
          for (std::size_t k = 0; k < k_values; ++k) seen[k] += std::abs(part.integral[k]);
      sum(seen);
    }
    for (std::size_t k = 0; k < k_values; ++k) {
      double total = 0;
      for (std::size_t c = 0; c < result_.of_cells.size(); ++c)
        if (cells_.counted(as_index(c))) total += result_.of_cells[c][k];
      result_.total[k] = parallel::global_sum(total);
      const double left = parallel::global_sum(left_[k]);
      if (scale_[k] > 0) result_.uncertain = std::max(result_.uncertain, left / scale_[k]);
    }
    return std::move(result_);
  }

 private:
  static constexpr int k_rounds = 40, k_deepest = 14;
  static constexpr double k_whole = 1e-4, k_part = 1e-5;
  static constexpr std::size_t k_most_parts = 1 << 15;  ///< open on a process

  void sum(const LoadValues& seen) {
    for (std::size_t k = 0; k < k_values; ++k) scale_[k] = parallel::global_sum(seen[k]);
  }
  /// Means of the values at nodes and centroid, and by how much they differ.
  std::pair<LoadValues, LoadValues> of_whole(Index cell) const {
    const Cells& block = cells_.blocks_[cells_.block_of(cell)];
    const int n = mesh::node_count(block.shape);
    const Index* nodes = cells_.nodes_of(cell);
    const LoadValues& centre = result_.of_points[cells_.used_nodes_.size() + as_size(cell)];
    LoadValues low = centre, high = centre, mean{};
    for (int a = 0; a < n; ++a) {
      const LoadValues& v = result_.of_points[as_size(cells_.point_of_node(nodes[a]))];
      for (std::size_t k = 0; k < k_values; ++k) {
        low[k] = std::min(low[k], v[k]);
        high[k] = std::max(high[k], v[k]);
        mean[k] += 0.5 * std::abs(v[k]) / n;
      }
    }
    for (std::size_t k = 0; k < k_values; ++k) {
      mean[k] += 0.5 * std::abs(centre[k]);
      high[k] -= low[k];
    }
    return {mean, high};
  }
  void see_whole_cells() {
    LoadValues seen{};
    for (std::size_t c = 0; c < cells_.measure_.size(); ++c) {
      if (!cells_.counted(as_index(c))) continue;
      const LoadValues mean = of_whole(as_index(c)).first;
      for (std::size_t k = 0; k < k_values; ++k) seen[k] += cells_.measure_[c] * mean[k];
    }
    sum(seen);
  }
  /// Cells that are divided; the others count by the values at their nodes.
  std::vector<Part> begin() {
    std::vector<Part> open;
    for (std::size_t c = 0; c < cells_.measure_.size(); ++c) {
      const auto cell = as_index(c);
      const LoadValues spread = of_whole(cell).second;
      Part part;
      part.cell = cell;
      begin_shape(part);
      find_breaks(part);
      part.coarse = is_coarse(part);
      bool matters = part.breaks || part.coarse;
      const LoadValues mean = of_whole(cell).first;
      for (std::size_t k = 0; k < k_values; ++k) largest_[c][k] = 2 * mean[k];
      for (std::size_t k = 0; k < k_values; ++k)
        matters = matters || cells_.measure_[c] * spread[k] > k_whole * scale_[k];
      if (matters)
        open.push_back(part);
      else
        add_whole(cell);
    }
    evaluate(open);
    return open;
  }
  void add_whole(Index cell) {
    const std::size_t b = cells_.block_of(cell);
    const Cells& block = cells_.blocks_[b];
    const auto n = as_size(mesh::node_count(block.shape));
    const Index* nodes = cells_.nodes_of(cell);
    const double* shares =
        cells_.shares_.data() + cells_.first_share_[b] + as_size(cell - cells_.first_[b]) * n;
    for (std::size_t a = 0; a < n; ++a) {
      const LoadValues& v = result_.of_points[as_size(cells_.point_of_node(nodes[a]))];
      add(cell, nodes[a], shares[a], v);
      if (with_samples_ && cells_.counted(cell) && matters(shares[a], v))
        result_.samples.push_back({cells_.mesh_.x[as_size(nodes[a])], {}, shares[a], v});
    }
    if (cells_.counted(cell))
      for (std::size_t k = 0; k < k_values; ++k) accepted_[k] += std::abs(result_.of_cells[as_size(cell)][k]);
  }
  /// Whether a point is part of the distribution: the tails of a normal one reach everywhere.
  bool matters(double weight, const LoadValues& v) const {
    constexpr double k_nothing = 1e-9;
    bool some = false;
    for (std::size_t k = 0; k < k_values; ++k) some = some || weight * std::abs(v[k]) > k_nothing * scale_[k];
    return some;
  }
  void add(Index cell, Index node, double weight, const LoadValues& v) {
    for (std::size_t k = 0; k < k_values; ++k) {
      result_.of_nodes[as_size(node)][k] += weight * v[k];
      result_.of_cells[as_size(cell)][k] += weight * v[k];
    }
  }
  void accept(const Part& part, const LoadValues& error) {
    const Cells& block = cells_.blocks_[cells_.block_of(part.cell)];
    const auto n = as_size(mesh::node_count(block.shape));
    const Index* nodes = cells_.nodes_of(part.cell);
    std::array<double, k_most_nodes> w{};
    const bool counts = cells_.counted(part.cell);
    for (int q = 0; q < part.n_samples; ++q) {
      const Sample& s = part.samples[as_size(q)];
      shares_at(block.shape, s.xi, std::span(w).first(n));
      for (std::size_t a = 0; a < n; ++a) add(part.cell, nodes[a], w[a] * s.weight, s.value);
      if (with_samples_ && counts && matters(s.weight, s.value)) result_.samples.push_back(s);
    }
    if (!counts) return;
    for (std::size_t k = 0; k < k_values; ++k) {
      accepted_[k] += std::abs(part.integral[k]);
      left_[k] += error[k];
    }
  }
  void begin_shape(Part& part) const {
    const Shape shape = cells_.blocks_[cells_.block_of(part.cell)].shape;
    if (is_box(shape))
      part.corners = {Point{-1, -1, -1}, Point{1, 1, 1}, {}, {}};
    else
      part.corners = {Point{0, 0, 0}, Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}};
  }
  /// The corners of a part in space.
  std::vector<Position> corners(const Part& part) const {
    const Shape shape = cells_.blocks_[cells_.block_of(part.cell)].shape;
    const int dim = mesh::dimension(shape);
    std::vector<Position> all;
    const auto place = [&](const Point& xi) {
      all.push_back(map(cells_.mesh_, cells_.kind_, shape, cells_.nodes_of(part.cell), xi).first);
    };
    if (!is_box(shape)) {
      for (int i = 0; i <= dim; ++i) place(part.corners[as_size(i)]);
      return all;
    }
    for (int i = 0; i < 1 << dim; ++i) {
      Point xi{};
      for (int j = 0; j < dim; ++j) xi[as_size(j)] = part.corners[(i >> j) & 1][as_size(j)];
      place(xi);
    }
    return all;
  }
  /// Finds out whether the load is known to jump in a part. Returns the axis along which it is to be halved
  /// so that no two jumps lie in it; −1: it need not be.
  int find_breaks(Part& part) const {
    part.breaks = false;
    int axis = -1;
    if (breaks_.at[0].empty() && breaks_.at[1].empty() && breaks_.at[2].empty()) return axis;
    const std::vector<Position> all = corners(part);
    for (std::size_t i = 0; i < 3; ++i) {
      double low = HUGE_VAL, high = -HUGE_VAL;
      for (const Position& x : all) low = std::min(low, x[i]), high = std::max(high, x[i]);
      const double margin = 1e-9 * (high - low);
      const auto& coordinates = breaks_.at[i];
      const auto first = std::upper_bound(coordinates.begin(), coordinates.end(), low + margin),
                 last = std::lower_bound(coordinates.begin(), coordinates.end(), high - margin);
      if (first >= last) continue;
      part.breaks = true;
      if (last - first > 1 && high - low > 0.5 * breaks_.apart[i]) axis = static_cast<int>(i);
    }
    return axis;
  }
  /// Whether a part is larger than the radius of a place near it at which the load is concentrated. Cells far
  /// from all of them are told by their nodes.
  bool is_coarse(const Part& part) const {
    if (breaks_.spots.empty()) return false;
    Position low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    const auto see = [&](const Position& x) {
      for (std::size_t i = 0; i < 3; ++i) low[i] = std::min(low[i], x[i]), high[i] = std::max(high[i], x[i]);
    };
    const auto apart = [&](const Position& from, const Position& to) {
      for (std::size_t i = 0; i < 3; ++i)
        if (high[i] < from[i] || low[i] > to[i]) return true;
      return false;
    };
    if (part.level == 0) {
      const int n = mesh::node_count(cells_.blocks_[cells_.block_of(part.cell)].shape);
      for (int a = 0; a < n; ++a) see(cells_.mesh_.x[as_size(cells_.nodes_of(part.cell)[a])]);
      if (apart(spots_low_, spots_high_)) return false;
    }
    // The box of its corners is compared with each place.
    low.fill(HUGE_VAL), high.fill(-HUGE_VAL);
    for (const Position& x : corners(part)) see(x);
    double size = 0;
    for (std::size_t i = 0; i < 3; ++i) size = std::max(size, high[i] - low[i]);
    return std::ranges::any_of(breaks_.spots, [&](const PlaceSpot& spot) {
      Position from = spot.centre, to = spot.centre;
      for (std::size_t i = 0; i < 3; ++i) from[i] -= spot.radius, to[i] += spot.radius;
      return size > spot.radius && !apart(from, to);
    });
  }
  /// Halves a part across the direction of its reference shape that leads farthest along an axis.
  std::vector<Part> halved(const Part& part, int axis) const {
    const Shape shape = cells_.blocks_[cells_.block_of(part.cell)].shape;
    const int dim = mesh::dimension(shape);
    const auto coordinate = [&](const Point& xi) {
      return map(cells_.mesh_, cells_.kind_, shape, cells_.nodes_of(part.cell), xi).first[as_size(axis)];
    };
    std::vector<Part> halves(2, part);
    for (Part& half : halves) half.share *= 0.5;
    double longest = -1;
    if (is_box(shape)) {
      std::size_t across = 0;
      const Point middle = half_way(part.corners[0], part.corners[1]);
      for (std::size_t j = 0; j < as_size(dim); ++j) {
        Point a = middle, b = middle;
        a[j] = part.corners[0][j], b[j] = part.corners[1][j];
        if (const double way = std::abs(coordinate(a) - coordinate(b)); way > longest)
          longest = way, across = j;
      }
      halves[0].corners[1][across] = halves[1].corners[0][across] = middle[across];
      return halves;
    }
    std::pair<std::size_t, std::size_t> edge{0, 1};
    for (std::size_t i = 0; i <= as_size(dim); ++i)
      for (std::size_t j = i + 1; j <= as_size(dim); ++j)
        if (const double way = std::abs(coordinate(part.corners[i]) - coordinate(part.corners[j]));
            way > longest)
          longest = way, edge = {i, j};
    const Point middle = half_way(part.corners[edge.first], part.corners[edge.second]);
    halves[0].corners[edge.first] = halves[1].corners[edge.second] = middle;
    return halves;
  }
  std::vector<Part> children(const Part& part) const {
    const Shape shape = cells_.blocks_[cells_.block_of(part.cell)].shape;
    const int dim = mesh::dimension(shape);
    std::vector<Part> all(std::size_t{1} << dim, part);
    for (Part& child : all) {
      child.share = part.share / static_cast<double>(all.size());
      child.level = part.level + 1;
    }
    const auto& c = part.corners;
    if (is_box(shape)) {
      const Point middle = half_way(c[0], c[1]);
      for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = 0; j < as_size(dim); ++j)
          all[i].corners[(i >> j & 1) != 0 ? 0 : 1][j] = middle[j];
      return all;
    }
    const auto m = [&](std::size_t i, std::size_t j) { return half_way(c[i], c[j]); };
    if (dim == 2) {
      all[0].corners = {c[0], m(0, 1), m(0, 2), {}};
      all[1].corners = {m(0, 1), c[1], m(1, 2), {}};
      all[2].corners = {m(0, 2), m(1, 2), c[2], {}};
      all[3].corners = {m(0, 1), m(1, 2), m(0, 2), {}};
      return all;
    }
    all[0].corners = {c[0], m(0, 1), m(0, 2), m(0, 3)};
    all[1].corners = {m(0, 1), c[1], m(1, 2), m(1, 3)};
    all[2].corners = {m(0, 2), m(1, 2), c[2], m(2, 3)};
    all[3].corners = {m(0, 3), m(1, 3), m(2, 3), c[3]};
    all[4].corners = {m(0, 1), m(2, 3), m(0, 2), m(0, 3)};
    all[5].corners = {m(0, 1), m(2, 3), m(0, 3), m(1, 3)};
    all[6].corners = {m(0, 1), m(2, 3), m(1, 3), m(1, 2)};
    all[7].corners = {m(0, 1), m(2, 3), m(1, 2), m(0, 2)};
    return all;
  }
  void evaluate(std::vector<Part>& parts) {
    std::vector<Position> x;
    for (Part& part : parts) {
      const Shape shape = cells_.blocks_[cells_.block_of(part.cell)].shape;
      const int dim = mesh::dimension(shape);
      const Shape simple = dim == 1   ? Shape::line2
                           : dim == 2 ? (is_box(shape) ? Shape::quad4 : Shape::tri3)
                                      : (is_box(shape) ? Shape::hex8 : Shape::tet4);
      const mesh::Rule& rule = rule_of(simple);
      part.n_samples = static_cast<int>(rule.size());
      for (std::size_t q = 0; q < rule.size(); ++q) {
        Sample& s = part.samples[q];
        const Point& eta = rule[q].xi;
        s.xi = {};
        for (std::size_t j = 0; j < as_size(dim); ++j) {
          if (is_box(shape)) {
            s.xi[j] = 0.5 * ((1 - eta[j]) * part.corners[0][j] + (1 + eta[j]) * part.corners[1][j]);
            continue;
          }
          s.xi[j] = part.corners[0][j];
          for (std::size_t i = 0; i < as_size(dim); ++i)
            s.xi[j] += eta[i] * (part.corners[i + 1][j] - part.corners[0][j]);
        }
        const auto [position, size] =
            map(cells_.mesh_, cells_.kind_, shape, cells_.nodes_of(part.cell), s.xi);
        s.x = position;
        s.weight = rule[q].weight * part.share * size;
        x.push_back(position);
      }
    }
    std::vector<LoadValues> values(x.size());
    evaluate_(x, false, values);
    std::size_t i = 0;
    for (Part& part : parts) {
      part.integral = {};
      part.measure = 0;
      LoadValues& largest = largest_[as_size(part.cell)];
      for (int q = 0; q < part.n_samples; ++q, ++i) {
        Sample& s = part.samples[as_size(q)];
        s.value = values[i];
        part.measure += s.weight;
        for (std::size_t k = 0; k < k_values; ++k) {
          part.integral[k] += s.weight * s.value[k];
          largest[k] = std::max(largest[k], std::abs(s.value[k]));
        }
      }
    }
  }
  static const mesh::Rule& rule_of(Shape shape) {
    static const mesh::Rule line = mesh::gauss_rule(Shape::line2, 3),
                            quad = mesh::gauss_rule(Shape::quad4, 3), hex = mesh::gauss_rule(Shape::hex8, 3),
                            triangle = mesh::gauss_rule(Shape::tri3, 2),
                            tetrahedron = mesh::gauss_rule(Shape::tet4, 2);
    if (shape == Shape::line2) return line;
    if (shape == Shape::quad4) return quad;
    if (shape == Shape::hex8) return hex;
    return shape == Shape::tri3 ? triangle : tetrahedron;
  }
  /// One round: every part is divided once more; those that agree with their parts are done.
  std::vector<Part> divide(std::vector<Part>& open, bool last) {
    std::vector<Part> all;
    std::vector<std::size_t> end;
    std::vector<char> only_halved;
    for (Part& part : open) {
      const int axis = find_breaks(part);
      const std::vector<Part> parts = axis >= 0 ? halved(part, axis) : children(part);
      all.insert(all.end(), parts.begin(), parts.end());
      end.push_back(all.size());
      only_halved.push_back(axis >= 0);
    }
    evaluate(all);
    std::vector<Part> next;
    const bool crowded = all.size() > k_most_parts;
    for (std::size_t p = 0, i = 0; p < open.size(); ++p) {
      const std::size_t begin = i;
      LoadValues sum{};
      for (; i < end[p]; ++i)
        for (std::size_t k = 0; k < k_values; ++k) sum[k] += all[i].integral[k];
      bool done = true;
      LoadValues error{};
      for (std::size_t k = 0; k < k_values; ++k) {
        error[k] = std::abs(sum[k] - open[p].integral[k]);
        done = done && error[k] <= k_part * scale_[k];
      }
      for (std::size_t j = begin; j < i; ++j) {
        Part& part = all[j];
        bool close = done && only_halved[p] == 0;
        LoadValues of_part{};
        for (std::size_t k = 0; k < k_values; ++k) of_part[k] = error[k] / static_cast<double>(i - begin);
        if (open[p].breaks) {
          const bool more = find_breaks(part) >= 0;
          if (part.breaks)
            for (std::size_t k = 0; k < k_values; ++k) {
              // Its points may all lie on the side where there is nothing.
              of_part[k] = std::max(of_part[k], 0.25 * part.measure * largest_[as_size(part.cell)][k]);
              close = close && of_part[k] <= k_part * scale_[k];
            }
          close = close && !more;
        }
        if (open[p].coarse) {
          part.coarse = is_coarse(part);
          close = close && !part.coarse;
        }
        if (close || last || crowded || part.level >= k_deepest)
          accept(part, of_part);
        else
          next.push_back(part);
      }
    }
    return next;
  }

  const CellIntegrals& cells_;
  const Evaluate& evaluate_;
  const Breaks& breaks_;
  bool with_samples_;
  Result result_;
  std::vector<LoadValues> largest_;  ///< magnitudes seen in each cell
  LoadValues scale_{}, accepted_{}, left_{};
  /// The box of all places at which the load is concentrated.
  Position spots_low_{HUGE_VAL, HUGE_VAL, HUGE_VAL}, spots_high_{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
};

}  // namespace solidus::heat
