/// Pieces between all bends of capacity and fractions, each quadratic in temperature; jumps of isothermal
/// changes lie between two pieces.
#include "material/enthalpy.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "numbers/index_casts.hpp"

namespace solidus::material {
namespace {

/// C with the continuation that the class comment states, as points; beyond them C is constant.
Table continued(const Table& c) {
  if (c.constant() || c.extrapolation() != Extrapolation::linear) return c;
  std::vector<double> x(c.x().begin(), c.x().end()), y(c.y().begin(), c.y().end());
  const double width = x.back() - x.front();
  // The reach of a line that leaves a point with value y and slope m outwards: at most the width, until y has
  // halved.
  const auto reach = [&](double value, double m) {
    return m < 0 ? std::min(width, 0.5 * value / -m) : width;
  };
  const double hot_slope = c.derivative(x.back()), cold_slope = c.derivative(x.front());
  const double hot = reach(y.back(), hot_slope);
  const double cold = std::min(reach(y.front(), -cold_slope), 0.5 * x.front());  // stays above absolute zero
  x.push_back(x.back() + hot);
  y.push_back(y.back() + hot_slope * hot);
  if (cold > 0) {
    x.insert(x.begin(), x.front() - cold);
    y.insert(y.begin(), y.front() - cold_slope * cold);
  }
  return {x, y};
}

std::size_t last_not_above(const std::vector<double>& starts, double x) {
  const auto next = std::upper_bound(starts.begin(), starts.end(), x);
  return next == starts.begin() ? 0 : as_size(next - starts.begin()) - 1;
}

}  // namespace

EnthalpyCurve::EnthalpyCurve(double density, const Table& specific_heat,
                             std::span<const PhaseChange> changes) {
  // Data are checked before anything is built of them.
  const Table c = continued(specific_heat);
  if (!(density > 0 && std::isfinite(density))) throw std::invalid_argument("the density is not positive");
  if (!(c.min_value() > 0)) throw std::invalid_argument("the specific heat is not positive");

  // Between two breaks the specific heat and all fractions are straight lines, so the enthalpy is a parabola:
  // a piece. One more break on either side gives the first and the last jump a piece to lie on.
  std::vector<double> breaks;  // where C or an f bends or jumps
  if (!c.constant()) breaks.assign(c.x().begin(), c.x().end());
  for (const PhaseChange& change : changes) {
    if (!(change.latent_heat >= 0 && std::isfinite(change.latent_heat)))
      throw std::invalid_argument("the latent heat of '" + change.name + "' is negative");
    for (const auto& [temperature, fraction] : change.fraction.points()) breaks.push_back(temperature);
  }
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  if (breaks.empty()) breaks.push_back(0.0);
  const double first = breaks.front();
  if (first > 0)
    breaks.insert(breaks.begin(), first - std::min(1.0, 0.5 * first));  // a jump may lie at the first break
  breaks.push_back(breaks.back() + 1.0);                                // ... and at the last

  // The enthalpy is summed from the coldest break. Jumps of a fraction (changes at one temperature) are kept
  // at the start of a piece.
  double sensible = 0;  // ∫ρC from the first break
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double t0 = breaks[i], t1 = breaks[i + 1];
    double latent = 0, jump = 0, slope = 0;
    for (const PhaseChange& change : changes) {
      const double heat = density * change.latent_heat, from = change.fraction.above(t0);
      latent += heat * (1.0 - from);
      jump += heat * (change.fraction.below(t0) - from);
      slope += heat * (from - change.fraction.below(t1)) / (t1 - t0);
    }
    const double c0 = density * c.value(t0), c1 = density * (c.value(t1) - c.value(t0)) / (t1 - t0);
    pieces_.push_back({t0, t1, sensible + latent, c0 + slope, c1});
    start_temperature_.push_back(t0);
    start_enthalpy_.push_back(sensible + latent);
    jump_.push_back(jump);
    if (jump > 0) jumps_.push_back({t0, jump});
    sensible += (t1 - t0) * (c0 + 0.5 * c1 * (t1 - t0));
  }
  // The entropy ∫ dh/Θ of each piece gets the constant that makes it continuous, but for latent heat over
  // temperature at the jumps.
  entropy_.assign(pieces_.size(), 0.0);
  for (std::size_t i = 1; i < pieces_.size(); ++i) {  // continuous but for the jumps
    const double at = pieces_[i].t0;
    entropy_[i] = entropy(i - 1, at) + jump_[i] / at - entropy(i, at);
  }
}

std::size_t EnthalpyCurve::piece_of_temperature(double temperature) const {
  return last_not_above(start_temperature_, temperature);
}
std::size_t EnthalpyCurve::piece_of_enthalpy(double enthalpy) const {
  return last_not_above(start_enthalpy_, enthalpy);
}

double EnthalpyCurve::value(const Piece& piece, double temperature) const {
  const double t = temperature - piece.t0;
  if (t < 0) return piece.h0 + piece.c0 * t;
  const double inside = std::min(t, piece.t1 - piece.t0), outside = t - inside;
  return piece.h0 + inside * (piece.c0 + 0.5 * piece.c1 * inside) + outside * (piece.c0 + piece.c1 * inside);
}

double EnthalpyCurve::upper(double temperature) const {
  return value(pieces_[piece_of_temperature(temperature)], temperature);
}

double EnthalpyCurve::lower(double temperature) const {
  const std::size_t i = piece_of_temperature(temperature);
  const double h = value(pieces_[i], temperature);
  return temperature == pieces_[i].t0 ? h - jump_[i] : h;
}

double EnthalpyCurve::entropy(std::size_t piece, double temperature) const {
  const Piece& p = pieces_[piece];
  return entropy_[piece] + (p.c0 - p.c1 * p.t0) * std::log(temperature) + p.c1 * temperature;
}

double EnthalpyCurve::upper_entropy(double temperature) const {
  return entropy(piece_of_temperature(temperature), temperature);
}

double EnthalpyCurve::lower_entropy(double temperature) const {
  const std::size_t i = piece_of_temperature(temperature);
  const double s = entropy(i, temperature);
  return temperature == pieces_[i].t0 && jump_[i] > 0 ? s - jump_[i] / temperature : s;
}

double EnthalpyCurve::capacity(double temperature) const {
  const Piece& piece = pieces_[piece_of_temperature(temperature)];
  return piece.c0 + piece.c1 * std::clamp(temperature - piece.t0, 0.0, piece.t1 - piece.t0);
}

double EnthalpyCurve::temperature(double enthalpy) const {
  // The piece in which the enthalpy lies, and how far into it.
  const std::size_t i = piece_of_enthalpy(enthalpy);
  const Piece& piece = pieces_[i];
  const double h = enthalpy - piece.h0, width = piece.t1 - piece.t0;
  // Below the first piece capacity is constant.
  if (h <= 0) return piece.t0 + h / piece.c0;
  const double in_piece = width * (piece.c0 + 0.5 * piece.c1 * width);
  if (h >= in_piece) {
    const bool last = i + 1 == pieces_.size();
    return last ? piece.t1 + (h - in_piece) / (piece.c0 + piece.c1 * width)
                : piece.t1;  // beyond the range, or in a jump
  }
  // c0 x + c1/2 x² = h, in the form that does not cancel for small c1
  const double x = 2 * h / (piece.c0 + std::sqrt(piece.c0 * piece.c0 + 2 * piece.c1 * h));
  return std::min(piece.t0 + x, piece.t1);
}

double EnthalpyCurve::inverse_slope(double enthalpy) const {
  const std::size_t i = piece_of_enthalpy(enthalpy);
  if (i + 1 < pieces_.size() && jump_[i + 1] > 0 && enthalpy > pieces_[i + 1].h0 - jump_[i + 1]) return 0.0;
  return 1.0 / capacity(temperature(enthalpy));
}

}  // namespace solidus::material
