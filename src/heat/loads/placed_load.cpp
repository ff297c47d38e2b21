/// Values at the points give the pattern, integrals over cells give the total: where both agree the points
/// suffice, else nodal heat is a mixture of both with the right total.
#include "heat/loads/placed_load.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/common_failure.hpp"
#include "system/log.hpp"

namespace solidus::heat {

namespace {

constexpr double k_resolved = 0.01, k_unresolved = 0.05;  ///< |S/I − 1|
constexpr double k_overlap = 0.6;
/// Gauss points of the mean over a step are taken for each such share of the time in which a load moves by
/// its own length: one standard deviation of a normal distribution.
constexpr double k_apart = 0.2;
constexpr double k_uncertain = 0.01;

/// α: the share of the values at points.
double share_of_points(double by_points, double integral) {
  if (integral == by_points) return 1;
  if (!(by_points > 0) || !(integral > 0)) return 0;
  const double off = std::abs(by_points / integral - 1);
  return std::clamp((k_unresolved - off) / (k_unresolved - k_resolved), 0.0, 1.0);
}

bool same(const LoadWindow& a, const LoadWindow& b) {
  const auto same_part = [](const LoadWindow::Part& p, const LoadWindow::Part& q) {
    return p.begin == q.begin && p.end == q.end && p.weight == q.weight;
  };
  return a.time == b.time && a.n_parts == b.n_parts && same_part(a.parts[0], b.parts[0]) &&
         same_part(a.parts[1], b.parts[1]);
}

/// A distribution that does not change in time is computed once.
bool splits(const LoadLaw& law) {
  if (law.kind != LoadLaw::Kind::power || law.steady()) return false;
  return std::ranges::all_of(law.functions, [](const PlaceFunction& f) { return f.uniform() || f.steady(); });
}

/// Whether nothing has been told of a load of this name yet: where a body grows, loads are made again and
/// again.
bool first_of_its_name(const std::string& name) {
  static std::set<std::string> told;
  return told.insert(name).second;
}

/// The time after which the overlap is k_overlap, infinite where it is more after the longest one: found by
/// halving until the overlap is large enough, and then between the last two times.
double time_of_overlap(double longest, const std::function<double(double)>& overlap) {
  constexpr int k_halvings = 16, k_between = 3;
  if (overlap(longest) >= k_overlap) return HUGE_VAL;
  for (int i = 0; i < k_halvings && overlap(longest) < k_overlap; ++i) longest *= 0.5;
  double low = longest, high = 2 * longest;
  for (int i = 0; i < k_between; ++i) {
    const double middle = 0.5 * (low + high);
    (overlap(middle) < k_overlap ? high : low) = middle;
  }
  return low;
}

}  // namespace

PlacedLoad::PlacedLoad(const mesh::Mesh& mesh, AnalysisKind kind, std::string name, LoadLaw law,
                       std::vector<CellIntegrals::Cells> cells, std::vector<Point> points,
                       std::vector<Share> shares)
    : mesh_(mesh),
      name_(std::move(name)),
      law_(std::move(law)),
      cells_(mesh, kind, std::move(cells)),
      samples_{.points = std::move(points), .x = {}, .shares = std::move(shares), .kept = {}} {
  // A power that is a product of a distribution and a factor without place is split, so that the distribution
  // is integrated once.
  if (splits(law_)) {
    scale_ = LoadLaw{LoadLaw::Kind::power, {}};
    std::erase_if(law_.functions, [&](const PlaceFunction& f) {
      if (f.uniform()) scale_->functions.push_back(f);
      return f.uniform();
    });
  }
  // Points that lie on no node are evaluated one by one.
  for (const Point& p : samples_.points)
    if (p.node < 0) samples_.x.push_back(p.x);
  heat_.resize(as_size(mesh.n_owned_nodes));
  samples_.kept.resize(law_.functions.size());
  // The extent of the load's cells is known to every process.
  for (std::size_t i = 0; i < 3; ++i) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const Position& x : cells_.points()) low = std::min(low, x[i]), high = std::max(high, x[i]);
    low_[i] = parallel::global_min(low);
    high_[i] = parallel::global_max(high);
  }
}

bool PlacedLoad::moves() const {
  return std::ranges::any_of(law_.functions,
                             [](const PlaceFunction& f) { return !f.uniform() && !f.steady(); });
}

void PlacedLoad::average(const LoadLaw& law, std::span<const TimePoint> times, std::span<const Position> x,
                         bool fixed, std::span<LoadValues> values) const {
  // Functions that do not depend on time are evaluated once. For points that do not move their values are
  // kept for all later steps.
  const std::size_t n = law.functions.size();
  std::vector<std::vector<double>> now(n);
  for (std::size_t f = 0; f < n; ++f) {
    const PlaceFunction& function = law.functions[f];
    if (!function.steady()) continue;
    std::vector<double>& kept = samples_.kept[f];
    if (fixed && !function.uniform() && !kept.empty()) {
      now[f] = kept;
      continue;
    }
    now[f].resize(x.size());
    function.values(x, times.front().time, now[f]);
    if (fixed && !function.uniform()) kept = now[f];
  }
  // The mean over the step is a weighted sum over the times of its quadrature. Functions of time are
  // evaluated at each of them, and the law makes heat, or film coefficient and surroundings, of their values.
  std::array<double, 3> of_functions{};
  std::fill(values.begin(), values.end(), LoadValues{});
  for (const TimePoint& time : times) {
    for (std::size_t f = 0; f < n; ++f) {
      if (law.functions[f].steady()) continue;
      now[f].resize(x.size());
      law.functions[f].values(x, time.time, now[f]);
    }
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (std::size_t f = 0; f < n; ++f) of_functions[f] = now[f][i];
      const LoadValues v = law.values(std::span(of_functions).first(n));
      for (std::size_t k = 0; k < v.size(); ++k) values[i][k] += time.weight * v[k];
    }
  }
}

CellIntegrals::Breaks PlacedLoad::breaks(const LoadLaw& law, std::span<const TimePoint> times) const {
  CellIntegrals::Breaks breaks;
  // Along each axis where functions break at any of these times, and the least distance between two such
  // places.
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<double> now;
    for (const TimePoint& time : times) {
      now.clear();
      for (const PlaceFunction& f : law.functions) f.add_breaks(i, low_[i], high_[i], time.time, now);
      std::sort(now.begin(), now.end());
      for (std::size_t k = 1; k < now.size(); ++k)
        if (now[k] > now[k - 1]) breaks.apart[i] = std::min(breaks.apart[i], now[k] - now[k - 1]);
      breaks.at[i].insert(breaks.at[i].end(), now.begin(), now.end());
    }
    std::sort(breaks.at[i].begin(), breaks.at[i].end());
    breaks.at[i].erase(std::unique(breaks.at[i].begin(), breaks.at[i].end()), breaks.at[i].end());
  }
  for (const TimePoint& time : times)
    for (const PlaceFunction& f : law.functions) f.add_spots(time.time, breaks.spots);
  return breaks;
}

CellIntegrals::Result PlacedLoad::integrate(const LoadLaw& law, std::span<const TimePoint> times,
                                            bool with_samples) const {
  return cells_.integrate([&](std::span<const Position> x, bool fixed,
                              std::span<LoadValues> values) { average(law, times, x, fixed, values); },
                          breaks(law, times), with_samples);
}

void PlacedLoad::set(const LoadWindow& window) {
  // The same window as before needs nothing. Otherwise the distribution is integrated unless it is steady.
  if (window_ && same(*window_, window)) return;
  if (!window_ || !(scale_ || law_.steady())) {
    // A load that moves is integrated in as many parts of the step as it takes to overlap with itself.
    constexpr int k_points = 2, k_most_parts = 64;
    int parts = 1;
    if (moves() && window.n_parts > 0) {
      const double begin = window.parts[0].begin, end = window.parts[as_size(window.n_parts - 1)].end;
      const std::optional<Crossing> known = crossing(begin, end);
      const double apart = known ? k_apart * known->time : lasting(begin, end);
      parts = static_cast<int>(std::min<double>(k_most_parts, std::ceil((end - begin) / apart)));
      parts = std::max(parts, 1);
    }
    // Cells give the integrals, points the values there; the kind of the load says how both become nodal
    // heat.
    const std::vector<TimePoint> times = time_points(window, law_.pointers(), k_points, parts);
    const CellIntegrals::Result integrals = integrate(law_, times, false);
    std::vector<LoadValues> apart(samples_.x.size()), at_points(samples_.points.size());
    if (parallel::any_process(!samples_.x.empty()))
      run_collectively([&] { average(law_, times, samples_.x, false, apart); });
    for (std::size_t p = 0, i = 0; p < samples_.points.size(); ++p)
      at_points[p] = samples_.points[p].node >= 0
                         ? integrals.of_points[as_size(cells_.point_of_node(samples_.points[p].node))]
                         : apart[i++];
    if (law_.kind == LoadLaw::Kind::power)
      set_power(integrals, at_points);
    else
      set_exchange(integrals, at_points);
    if (scale_) steady_heat_ = heat_;
  }
  window_ = window;
  // A factor of time multiplies the distribution by its mean over the step.
  if (!scale_) return;
  const LoadValues mean = mean_load(window, *scale_);
  for (std::size_t i = 0; i < heat_.size(); ++i) heat_[i] = (mean[0] - mean[1]) * steady_heat_[i];
}

void PlacedLoad::set_power(const CellIntegrals::Result& integrals, std::span<const LoadValues> at_points) {
  // Nodal heat is a mean of two forms, with the same total: values at the points, or integrals with the
  // nodes' weights where points would miss the total. Heating and cooling are treated apart.
  std::fill(heat_.begin(), heat_.end(), 0.0);
  double least = 1;
  for (std::size_t k = 0; k < 2; ++k) {
    const double sign = k == 0 ? 1 : -1;
    // The total by points against the integral over cells tells how far points can be trusted.
    double sum = 0;
    for (const Share& share : samples_.shares) sum += share.weight * at_points[as_size(share.point)][k];
    const double by_points = parallel::global_sum(sum), integral = integrals.total[k];
    const double alpha = share_of_points(by_points, integral);
    least = std::min(least, alpha);
    // Values at points, scaled so that their total is the integral.
    if (alpha > 0 && by_points != 0)
      for (const Share& share : samples_.shares)
        heat_[as_size(share.node)] +=
            sign * alpha * (integral / by_points) * share.weight * at_points[as_size(share.point)][k];
    // What is left goes by the integrals of the nodes.
    if (alpha < 1)
      for (std::size_t i = 0; i < heat_.size(); ++i)
        heat_[i] += sign * (1 - alpha) * integrals.of_nodes[i][k];
  }
  check(integrals, least);
}

void PlacedLoad::set_exchange(const CellIntegrals::Result& integrals, std::span<const LoadValues> at_points) {
  // The drive is counted from the coldest ambient temperature: in kelvin the rest would hide what varies.
  double coldest = HUGE_VAL;
  // Index 0 is the coefficient, index 1 the coefficient times the ambient temperature.
  LoadValues sum{};
  for (std::size_t p = 0; p < samples_.points.size(); ++p) {
    for (std::size_t k = 0; k < 2; ++k) sum[k] += samples_.points[p].weight * at_points[p][k];
    if (at_points[p][0] > 0) coldest = std::min(coldest, at_points[p][1] / at_points[p][0]);
  }
  // Means over processes, so that all of them take the same mixture.
  coldest = parallel::global_min(coldest);
  if (!std::isfinite(coldest)) coldest = 0;
  const LoadValues by_points{parallel::global_sum(sum[0]), parallel::global_sum(sum[1])};
  // An ambient temperature that is the same everywhere leaves rounding.
  constexpr double k_rounding = 1e-9;
  // The drive above the coldest temperature: integral and points are compared in it.
  const double excess = integrals.total[1] - coldest * integrals.total[0];
  const double alpha = std::min(share_of_points(by_points[0], integrals.total[0]),
                                excess > k_rounding * integrals.total[1]
                                    ? share_of_points(by_points[1] - coldest * by_points[0], excess)
                                    : 1.0);
  const double scale = by_points[0] > 0 ? integrals.total[0] / by_points[0] : 1;
  means_.assign(samples_.points.size(), {});
  std::vector<double> around;  // means around nodes, ghosts too
  if (alpha < 1) {
    around.resize(2 * mesh_.x.size());
    for (std::size_t i = 0; i < as_size(mesh_.n_owned_nodes); ++i)
      for (std::size_t k = 0; k < 2; ++k)
        if (cells_.of_nodes()[i] > 0) around[2 * i + k] = integrals.of_nodes[i][k] / cells_.of_nodes()[i];
    parallel::GhostExchange(mesh_).update(around, 2);
  }
  // At each point the mixture of its own value and the mean around its node or in its cell.
  for (std::size_t p = 0; p < samples_.points.size(); ++p)
    for (std::size_t k = 0; k < 2; ++k) {
      means_[p][k] = alpha * scale * at_points[p][k];
      if (alpha == 1) continue;
      const Point& point = samples_.points[p];
      means_[p][k] += (1 - alpha) * (point.node >= 0 ? around[2 * as_size(point.node) + k]
                                                     : integrals.of_cells[as_size(point.cell)][k] /
                                                           cells_.of_cell(point.cell));
    }
  check(integrals, alpha);
}

void PlacedLoad::check(const CellIntegrals::Result& integrals, double by_points) {
  if (by_points == 0 && !std::exchange(told_coarse_, true) && first_of_its_name(name_))
    logging::info(
        "'{}' is smaller than the elements that it acts on: its power is its integral, but temperatures "
        "around it "
        "are means over elements, which a finer mesh would resolve",
        name_);
  if (integrals.uncertain > k_uncertain && !std::exchange(told_uncertain_, true))
    logging::warn("the integral of '{}' over the elements may be wrong by {:.2g} %", name_,
                  100 * integrals.uncertain);
}

std::optional<Crossing> PlacedLoad::crossing(double from, double to) const {
  std::optional<Crossing> least;
  for (const PlaceFunction& f : law_.functions)
    if (const std::optional<Crossing> one = f.crossing(from, to))
      if (!least || one->share * one->time < least->share * least->time) least = one;
  return least;
}

double PlacedLoad::lasting(double from, double to) const {
  // The result is how long the load takes until it overlaps with itself only by k_overlap: how far it travels
  // over its own size. A load that does not move lasts for ever.
  if (!moves()) return HUGE_VAL;
  // One that knows its path says it itself.
  if (const std::optional<Crossing> known = crossing(from, to)) {
    const double longest = known->share * known->time;
    return longest < to - from ? longest : HUGE_VAL;
  }
  // Only the distribution counts, so a power that varies evenly is set to one. Of a flux the value itself is
  // compared, of a film its coefficient.
  LoadLaw law = law_;  // its distribution, whatever its power is
  for (PlaceFunction& f : law.functions)
    if (f.uniform() && law.kind == LoadLaw::Kind::power) f = 1.0;
  const std::size_t k = law.kind == LoadLaw::Kind::power ? 0 : 1;
  const auto size = [&](const LoadValues& v) { return k == 0 ? v[0] + v[1] : v[1]; };
  // The shape at the start of the step is the reference. A load that does not act yet is followed backward
  // from the end of the step.
  double start = from, direction = 1;
  const auto at_time = [&](double time) { return std::array{TimePoint{time, 1}}; };
  CellIntegrals::Result shape = integrate(law, at_time(from), true);
  if (!(size(shape.total) > 0)) {  // it comes later
    start = to, direction = -1;
    shape = integrate(law, at_time(to), true);
    if (!(size(shape.total) > 0)) return HUGE_VAL;
  }
  // Where the total changes with time, the shape then is scaled to the same total before it is compared.
  const bool same_power =
      std::ranges::all_of(law.functions, [](const PlaceFunction& f) { return f.steady() || f.only_moves(); });
  std::vector<Position> x;
  for (const CellIntegrals::Sample& s : shape.samples) x.push_back(s.x);
  std::vector<LoadValues> values(x.size());
  // The overlap is the integral of the smaller of both distributions over that of the reference, at the
  // points where the reference was integrated.
  const auto overlap = [&](double after) {
    const auto time = at_time(start + direction * after);
    double of_power = 1;
    if (!same_power) {
      const double then = size(integrate(law, time, false).total);
      if (!(then > 0)) return 0.0;
      of_power = size(shape.total) / then;
    }
    run_collectively([&] { average(law, time, x, false, values); });
    double common = 0, all = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const CellIntegrals::Sample& s = shape.samples[i];
      common += s.weight * std::min(size(s.value), of_power * size(values[i]));
      all += s.weight * size(s.value);
    }
    all = parallel::global_sum(all);
    return all > 0 ? parallel::global_sum(common) / all : 1.0;
  };
  return time_of_overlap(to - from, overlap);
}

std::size_t PlacedLoad::bytes() const {
  return cells_.bytes() + samples_.points.capacity() * sizeof(Point) +
         samples_.shares.capacity() * sizeof(Share);
}

}  // namespace solidus::heat
