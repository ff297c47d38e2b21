/// A line through metal, gap and mould is cooled step by step; Chvorinov's rule carries its time to the
/// casting.
#include "check/freezing_estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "numbers/index_casts.hpp"

namespace solidus::check {

namespace {

constexpr int k_metal_cells = 16, k_mould_cells = 24;
constexpr double k_mould_growth = 1.2;  // of its cells outward
/// A bar: the thick place of a casting of several thicknesses, next to whose walls no mould cools it; a ball.
constexpr double k_bar = 2, k_ball = 3;

/// A cell of the line: joined to `parent` alone, which comes later in the list. The last is the metal's skin.
struct Cell {
  const material::EnthalpyCurve* curve = nullptr;
  const Table* conductivity = nullptr;
  double volume = 0;                     ///< per area of the cooled skin [m]
  int parent = -1;                       ///< −1: the skin
  double area = 0;                       ///< of the face to the parent, over that of the cooled skin
  double own_half = 0, parent_half = 0;  ///< distances from the face to the two centres [m]
  int mould = -1;       ///< number of the mould whose skin this is, which meets the metal; else −1
  int outside = -1;     ///< number of the mould whose outer side this is; else −1
  int neighbour = -1;   ///< number of the poured neighbour that this is a part of; else −1
  double enthalpy = 0;  ///< [J/m³]
};

/// The metal, its moulds and poured neighbours on a line, by finite volumes and backward Euler.
class Line {
 public:
  explicit Line(const FreezingProblem& problem) : problem_(problem), metal_(problem.metal->enthalpy()) {
    // Between a plate and a ball by how round the casting is; cells from its skin inwards and into each mould
    // and neighbour.
    exponent_ =
        std::clamp(problem.depth / problem.modulus, 1.0, std::clamp(problem.roundness, k_bar, k_ball));
    radius_ = std::max(problem.depth, problem.modulus);
    for (const MouldSide& mould : problem.moulds) curves_.push_back(mould.material->enthalpy());
    for (const PouredNeighbour& other : problem.neighbours) curves_.push_back(other.metal->enthalpy());
    for (std::size_t m = 0; m < problem.moulds.size(); ++m) add_mould(m);
    for (std::size_t o = 0; o < problem.neighbours.size(); ++o) add_neighbour(o);
    add_metal();
    for (Cell& cell : cells_)
      if (cell.parent < 0 && &cell != &cells_.back()) {
        cell.parent = static_cast<int>(cells_.size()) - 1;
        cell.parent_half = skin_half_;
      }
    old_.resize(cells_.size());
  }

  double radius() const { return radius_; }
  double skin() const { return temperature(cells_.size() - 1); }
  double centre() const { return temperature(centre_); }
  double mould_skin(std::size_t mould) const { return temperature(mould_skin_[mould]); }
  /// Whether a poured neighbour is solid where it meets the metal.
  bool neighbour_frozen(std::size_t neighbour) const {
    const material::PhaseChange* freezing = problem_.neighbours[neighbour].metal->solidification();
    return temperature(neighbour_foot_[neighbour]) <= freezing->fraction.solidus() * (1 + 1e-9);
  }
  /// The gap that shrinkage of the skin opens [m].
  double gap() const {
    const material::PhaseChange* freezing = problem_.metal->solidification();
    const double cooled = freezing->fraction.solidus() - skin();
    return cooled > 0 && problem_.metal->mechanical()
               ? radius_ * problem_.metal->expansion.value(skin()) * cooled
               : 0.0;
  }
  /// The hottest cell of the metal.
  double hottest() const {
    double hottest = 0;
    for (std::size_t i = centre_; i < cells_.size(); ++i) hottest = std::max(hottest, temperature(i));
    return hottest;
  }
  bool frozen() const {
    const double solidus = problem_.metal->solidification()->fraction.solidus();
    const double solid = metal_.lower(solidus) * (1 + 1e-9);
    return std::all_of(cells_.begin() + static_cast<std::ptrdiff_t>(centre_), cells_.end(),
                       [&](const Cell& cell) { return cell.enthalpy <= solid; });
  }
  bool step(double time, double dt) {
    for (std::size_t i = 0; i < cells_.size(); ++i) old_[i] = cells_[i].enthalpy;
    constexpr int k_most = 40;
    for (int iteration = 0; iteration < k_most; ++iteration)
      if (newton(time, dt)) return true;
    for (std::size_t i = 0; i < cells_.size(); ++i) cells_[i].enthalpy = old_[i];
    return false;
  }

 private:
  double temperature(std::size_t i) const { return cells_[i].curve->temperature(cells_[i].enthalpy); }
  /// Volume inside of a radius, over the area of the cooled skin.
  double volume(double r) const { return radius_ / exponent_ * std::pow(r / radius_, exponent_); }
  double area(double r) const { return std::pow(r / radius_, exponent_ - 1); }

  void add_mould(std::size_t number) {
    const MouldSide& mould = problem_.moulds[number];
    const std::size_t outermost = cells_.size();
    add_shell(
        {&curves_[number], &mould.material->conductivity, mould.share, mould.volume_ratio, mould.start});
    cells_[outermost].outside = cells_.back().mould = static_cast<int>(number);
    mould_skin_.push_back(cells_.size() - 1);
  }

  void add_neighbour(std::size_t number) {
    const PouredNeighbour& other = problem_.neighbours[number];
    const std::size_t outermost = cells_.size();
    add_shell({&curves_[problem_.moulds.size() + number], &other.metal->conductivity, other.share,
               other.volume_ratio, other.start});
    for (std::size_t i = outermost; i < cells_.size(); ++i) cells_[i].neighbour = static_cast<int>(number);
    neighbour_foot_.push_back(cells_.size() - 1);
  }

  struct Shell {
    const material::EnthalpyCurve* curve;
    const Table* conductivity;
    double share;         ///< of the cooled skin
    double volume_ratio;  ///< its volume over that of the metal
    double start;         ///< [K]
  };

  /// Adds a shell of the right volume on a share of the metal's skin, in cells that grow outward, the
  /// outermost first.
  void add_shell(const Shell& shell) {
    const double outer = radius_ * std::pow(1 + shell.volume_ratio / shell.share, 1 / exponent_);
    const double thickness = outer - radius_;
    double cell = thickness * (k_mould_growth - 1) / (std::pow(k_mould_growth, k_mould_cells) - 1);
    std::array<double, k_mould_cells + 1> r{};
    r[0] = radius_;
    for (std::size_t i = 0; i < k_mould_cells; ++i, cell *= k_mould_growth) r[i + 1] = r[i] + cell;
    for (std::size_t i = k_mould_cells; i-- > 0;) {
      Cell c;
      c.curve = shell.curve;
      c.conductivity = shell.conductivity;
      c.volume = shell.share * (volume(r[i + 1]) - volume(r[i]));
      c.area = shell.share * area(r[i]);
      c.own_half = (r[i + 1] - r[i]) / 2;
      c.parent_half = i > 0 ? (r[i] - r[i - 1]) / 2 : 0;
      c.parent = i > 0 ? static_cast<int>(cells_.size()) + 1 : -1;
      c.enthalpy = c.curve->upper(shell.start);
      cells_.push_back(c);
    }
  }

  void add_metal() {
    // The place is as thick as its radius, cut into cells from the centre outwards.
    centre_ = cells_.size();
    const double width = radius_ / k_metal_cells;
    skin_half_ = width / 2;
    // Shells of equal width from the centre to the skin; each is tied to the next one outwards.
    for (int i = 0; i < k_metal_cells; ++i) {
      const double inner = i * width, outer = (i + 1) * width;
      Cell c;
      c.curve = &metal_;
      c.conductivity = &problem_.metal->conductivity;
      c.volume = volume(outer) - volume(inner);
      c.own_half = c.parent_half = width / 2;
      c.area = area(outer);
      c.parent = i + 1 < k_metal_cells ? static_cast<int>(cells_.size()) + 1 : -1;
      c.enthalpy = metal_.upper(problem_.start);
      cells_.push_back(c);
    }
  }

  double conductance(const Cell& cell, const Cell& parent, double own, double other) const {
    double resistance =
        cell.own_half / cell.conductivity->value(own) + cell.parent_half / parent.conductivity->value(other);
    if (cell.mould >= 0) {
      const MouldSide& mould = problem_.moulds[as_size(cell.mould)];
      double h = mould.conductance(0, other, own);
      // Half of a skin rests on its mould, by weight or because it shrinks onto a core.
      if (mould.may_open) h = (h + mould.conductance(gap(), other, own)) / 2;
      resistance += 1 / std::max(h, 1e-9);
    }
    return cell.area / resistance;
  }

  /// One iteration; true where it has converged.
  bool newton(double time, double dt) {
    const std::size_t n = cells_.size();
    // Enthalpies are the unknowns; temperatures and their slopes follow from the curve of each
    // cell.
    std::vector<double> t(n), d(n), diagonal(n), residual(n), up(n, 0.0), down(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      t[i] = temperature(i);
      d[i] = cells_[i].curve->inverse_slope(cells_[i].enthalpy);
      diagonal[i] = cells_[i].volume / dt;
      residual[i] = cells_[i].volume / dt * (cells_[i].enthalpy - old_[i]);
    }
    // Heat from outside is linear in the temperature over a tenth of a kelvin, and enters the
    // matrix only where it damps.
    const auto load = [&](std::size_t i, const auto& heat, double factor = 1) {
      constexpr double k_difference = 0.1;  // [K]
      const double q = heat(t[i], time + dt);
      residual[i] -= factor * q;
      diagonal[i] -= factor * std::min(0.0, (heat(t[i] + k_difference, time + dt) - q) / k_difference) * d[i];
    };
    for (const OpenSide& side : problem_.open) load(n - 1, side.heat);
    // Each cell has up to three exchanges: the air behind a mould, a neighbouring metal, and its
    // parent.
    for (std::size_t i = 0; i < n; ++i) {
      const Cell& cell = cells_[i];
      if (cell.outside >= 0)
        if (const auto& heat = problem_.moulds[as_size(cell.outside)].outer_heat) load(i, heat);
      if (cell.neighbour >= 0) load(i, problem_.neighbours[as_size(cell.neighbour)].heat, cell.volume);
      if (cell.parent < 0) continue;
      const auto p = as_size(cell.parent);
      // What one cell loses its parent gets, so that the sum is conserved exactly.
      const double g = conductance(cell, cells_[p], t[i], t[p]), q = g * (t[i] - t[p]);
      residual[i] += q;
      residual[p] -= q;
      diagonal[i] += g * d[i];
      diagonal[p] += g * d[p];
      up[i] = -g * d[p];    // row of the cell, column of its parent
      down[i] = -g * d[i];  // row of the parent
    }
    // Children come before their parents: one sweep eliminates, one solves.
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const auto p = as_size(cells_[i].parent);
      diagonal[p] -= down[i] * up[i] / diagonal[i];
      residual[p] -= down[i] * residual[i] / diagonal[i];
    }
    // Back substitution from the root down, with the largest change as the measure of convergence.
    double change = 0;
    std::vector<double> step(n);
    for (std::size_t i = n; i-- > 0;) {
      const double from_parent = i + 1 < n ? up[i] * step[as_size(cells_[i].parent)] : 0.0;
      step[i] = (-residual[i] - from_parent) / diagonal[i];
      cells_[i].enthalpy += step[i];
      change = std::max(change, std::abs(step[i]));
    }
    constexpr double k_tolerance = 1e3;  // [J/m³], a thousandth of a kelvin
    return change < k_tolerance;
  }

  const FreezingProblem& problem_;
  material::EnthalpyCurve metal_;
  std::vector<material::EnthalpyCurve> curves_;
  double radius_ = 0, exponent_ = 1, skin_half_ = 0;
  std::vector<Cell> cells_;
  std::vector<double> old_;
  std::vector<std::size_t> mould_skin_, neighbour_foot_;
  std::size_t centre_ = 0;
};

/// Drops of temperature on the way out: within the metal, at the interface, in the mould [K].
struct Drops {
  double metal = 0, interface = 0, mould = 0;
};

Drops drops(const Line& line, const FreezingProblem& problem) {
  // The drops of temperature in the metal, across the interface and in the mould that takes the most heat.
  Drops d;
  d.metal = line.centre() - line.skin();
  if (problem.moulds.empty()) {
    d.interface = 1e9;
    return d;
  }
  const auto main =
      std::max_element(problem.moulds.begin(), problem.moulds.end(),
                       [](const MouldSide& a, const MouldSide& b) { return a.share < b.share; });
  const double skin = line.mould_skin(as_size(main - problem.moulds.begin()));
  d.interface = line.skin() - skin;
  d.mould = skin - main->start;
  return d;
}

std::string largest(const Drops& d, bool has_mould) {
  if (d.metal > d.interface && d.metal > d.mould) return "the metal";
  if (!has_mould) return "the surroundings";
  return d.interface > d.mould ? "the interface" : "the mould";
}

double reach(const FreezingProblem& problem, double time) {
  if (problem.moulds.empty()) return 0;
  const auto main =
      std::max_element(problem.moulds.begin(), problem.moulds.end(),
                       [](const MouldSide& a, const MouldSide& b) { return a.share < b.share; });
  const material::Material& m = *main->material;
  const double hot = (main->start + problem.metal->solidification()->fraction.solidus()) / 2;
  return std::sqrt(m.conductivity.value(hot) / (m.density * m.specific_heat.value(hot)) * time);
}

}  // namespace

FreezingEstimate estimate_freezing(const FreezingProblem& problem) {
  constexpr double k_growth = 1.05, k_longest = 3e9;  // a century [s]
  // Hundreds are usual. Where contact under pressure conducts otherwise than a gap of zero, the skin may go
  // to and fro between both without end.
  constexpr int k_most_steps = 5000;
  FreezingEstimate estimate;
  Line line(problem);
  const material::Material& metal = *problem.metal;
  const double solidus = metal.solidification()->fraction.solidus();
  const double diffusivity =
      metal.conductivity.value(solidus) / (metal.density * metal.specific_heat.value(solidus));
  // The first step is a thousandth of the time that heat takes through the metal.
  double time = 0, dt = 1e-3 * line.radius() * line.radius() / diffusivity;
  Drops sum;
  // Neighbours that never freeze keep the largest number.
  constexpr double k_never = std::numeric_limits<double>::max();
  estimate.neighbours.assign(problem.neighbours.size(), k_never);
  for (int n = 0; !line.frozen(); ++n) {
    if (n == k_most_steps) {
      estimate.gave_up = true;
      return estimate;
    }
    // Time without end or steps without length: it comes to rest above its solidus.
    if (time > k_longest || !(dt > 1e-12)) {
      estimate.rest = line.hottest();
      return estimate;
    }
    // A step that does not converge is tried again a quarter as long.
    if (!line.step(time, dt)) {
      dt /= 4;
      continue;
    }
    time += dt;
    for (std::size_t o = 0; o < estimate.neighbours.size(); ++o)
      if (line.neighbour_frozen(o)) estimate.neighbours[o] = std::min(estimate.neighbours[o], time);
    // Temperature drops over metal, interface and mould, weighted by time, tell which of them
    // governs.
    const Drops now = drops(line, problem);
    sum.metal += dt * now.metal;
    sum.interface += dt * now.interface;
    sum.mould += dt * now.mould;
    dt *= k_growth;
  }
  estimate.time = time;
  for (double& neighbour : estimate.neighbours) neighbour = std::min(neighbour, time);
  // What takes the largest drop is what limits the freezing.
  estimate.governed_by = largest(sum, !problem.moulds.empty());
  estimate.mould_reach = reach(problem, time);
  return estimate;
}

}  // namespace solidus::check
