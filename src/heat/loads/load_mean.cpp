/// The window is cut where a function of time bends; between two cuts Gauss's rule in time is exact for
/// smooth loads.
#include "heat/loads/load_mean.hpp"

#include <algorithm>
#include <cmath>

#include "numbers/index_casts.hpp"

namespace solidus::heat {

namespace {

/// Gauss' rules of two and of four points in [0, 1].
constexpr std::array<TimePoint, 2> k_gauss_2 = {{{0.21132486540518712, 0.5}, {0.78867513459481288, 0.5}}};
constexpr std::array<TimePoint, 4> k_gauss = {{{0.06943184420297371, 0.17392742256872693},
                                               {0.33000947820757187, 0.32607257743127307},
                                               {0.66999052179242813, 0.32607257743127307},
                                               {0.93056815579702629, 0.17392742256872693}}};

/// The ends of the pieces of one part of a window in which no table bends.
std::vector<double> pieces(const LoadWindow::Part& part, std::span<const PlaceFunction* const> functions,
                           int parts) {
  std::vector<double> ends{part.begin};
  for (int i = 1; i < parts; ++i)
    ends.push_back(part.begin + (part.end - part.begin) * (static_cast<double>(i) / parts));
  for (const PlaceFunction* f : functions) f->add_bends(part.begin, part.end, ends);
  ends.push_back(part.end);
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

bool all_steady(std::span<const PlaceFunction* const> functions) {
  return std::ranges::all_of(functions, [](const PlaceFunction* f) { return f->steady(); });
}

class Bisection {
 public:
  explicit Bisection(const LoadLaw& law) : law_(law) {}

  LoadValues mean(double begin, double end) {
    LoadValues sum{};
    for (const TimePoint& point : k_gauss) {
      const LoadValues v = law_.values_at(begin + point.time * (end - begin));
      for (std::size_t k = 0; k < v.size(); ++k) {
        sum[k] += point.weight * v[k];
        largest_[k] = std::max(largest_[k], std::abs(v[k]));
      }
    }
    return sum;
  }
  /// @param whole  mean(begin, end)
  LoadValues refined(double begin, double end, const LoadValues& whole, int depth) {
    const double middle = begin + 0.5 * (end - begin);
    LoadValues first = mean(begin, middle), second = mean(middle, end);
    bool same = true;
    for (std::size_t k = 0; k < whole.size(); ++k)
      same = same && std::abs(0.5 * (first[k] + second[k]) - whole[k]) <= k_same * largest_[k];
    if (!same && depth < k_deepest) {
      first = refined(begin, middle, first, depth + 1);
      second = refined(middle, end, second, depth + 1);
    }
    for (std::size_t k = 0; k < whole.size(); ++k) first[k] = 0.5 * (first[k] + second[k]);
    return first;
  }

 private:
  static constexpr double k_same = 1e-5;
  static constexpr int k_deepest = 16;
  const LoadLaw& law_;
  LoadValues largest_{};
};

}  // namespace

LoadValues LoadLaw::values(std::span<const double> of_functions) const {
  double product = 1;
  for (const double f : of_functions.first(of_functions.size() - 1)) product *= f;
  const double driver = of_functions.back();
  // Supply and loss apart for a power; coefficient and its product with the driving temperature for films and
  // radiation.
  switch (kind) {
    case Kind::power: {
      const double power = product * driver;
      return {std::max(power, 0.0), std::max(-power, 0.0)};
    }
    case Kind::film:
      return {product, product * driver};
    case Kind::radiation:
      return {product, product * driver * driver * driver * driver};
  }
  return {};
}

LoadValues LoadLaw::values_at(double time) const {
  std::array<double, 3> of_functions{};
  for (std::size_t i = 0; i < functions.size(); ++i) of_functions[i] = functions[i].value(time);
  return values(std::span(of_functions).first(functions.size()));
}

bool LoadLaw::uniform() const {
  return std::ranges::all_of(functions, [](const PlaceFunction& f) { return f.uniform(); });
}

bool LoadLaw::steady() const {
  return std::ranges::all_of(functions, [](const PlaceFunction& f) { return f.steady(); });
}

std::vector<const PlaceFunction*> LoadLaw::pointers() const {
  std::vector<const PlaceFunction*> all;
  for (const PlaceFunction& f : functions) all.push_back(&f);
  return all;
}

double LoadLaw::ambient(const LoadValues& mean, double otherwise) const {
  const double ratio = mean[0] != 0 ? mean[1] / mean[0] : -1;
  if (!(ratio >= 0)) return otherwise;
  return kind == Kind::film ? ratio : std::sqrt(std::sqrt(ratio));
}

std::vector<TimePoint> time_points(const LoadWindow& window, std::span<const PlaceFunction* const> functions,
                                   int n, int parts) {
  // A load that does not change has no mean to take: one point, without rounding.
  if (window.n_parts == 0 || all_steady(functions)) return {{window.time, 1}};
  const std::span<const TimePoint> rule =
      n == 2 ? std::span<const TimePoint>(k_gauss_2) : std::span<const TimePoint>(k_gauss);
  std::vector<TimePoint> points;
  // Gauss points between the breaks of the functions in time, weighted by the length of the pieces.
  for (int p = 0; p < window.n_parts; ++p) {
    const LoadWindow::Part& part = window.parts[as_size(p)];
    const std::vector<double> ends = pieces(part, functions, parts);
    for (std::size_t i = 1; i < ends.size(); ++i)
      for (const TimePoint& point : rule)
        points.push_back({ends[i - 1] + point.time * (ends[i] - ends[i - 1]),
                          part.weight * point.weight * (ends[i] - ends[i - 1]) / (part.end - part.begin)});
  }
  return points;
}

LoadValues mean_load(const LoadWindow& window, const LoadLaw& law) {
  // Loads that do not depend on time are evaluated once.
  if (window.n_parts == 0 || law.steady()) return law.values_at(window.time);
  const std::vector<const PlaceFunction*> functions = law.pointers();
  const bool smooth = std::ranges::all_of(functions, [](const PlaceFunction* f) { return f->tabulated(); });
  LoadValues sum{};
  const auto add = [&](double share, const LoadValues& v) {
    for (std::size_t k = 0; k < v.size(); ++k) sum[k] += share * v[k];
  };
  // Tables are smooth between their points, so that Gauss points between these are exact enough.
  if (smooth) {
    constexpr int k_points = 4;
    for (const TimePoint& point : time_points(window, functions, k_points))
      add(point.weight, law.values_at(point.time));
    return sum;
  }
  // Formulas may jump anywhere: each part of the window is cut into pieces, whose means are refined by
  // bisection where halves differ.
  constexpr int k_parts = 8;
  Bisection bisection(law);
  for (int p = 0; p < window.n_parts; ++p) {
    const LoadWindow::Part& part = window.parts[as_size(p)];
    const std::vector<double> ends = pieces(part, functions, k_parts);
    std::vector<LoadValues> whole;
    for (std::size_t i = 1; i < ends.size(); ++i) whole.push_back(bisection.mean(ends[i - 1], ends[i]));
    for (std::size_t i = 1; i < ends.size(); ++i)
      add(part.weight * (ends[i] - ends[i - 1]) / (part.end - part.begin),
          bisection.refined(ends[i - 1], ends[i], whole[i - 1], 0));
  }
  return sum;
}

}  // namespace solidus::heat
