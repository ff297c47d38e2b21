/// Pieces between all bends of both tables, searched by heat or by potential; on a piece each quantity is a
/// quadratic that is solved in closed form.
#include "heat/storage/storage_curve.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace solidus::heat {

namespace {

/// The root t of a t + b/2 t² = y that is zero with y, in the form that does not cancel for small b.
double root(double a, double b, double y) {
  return 2.0 * y / (a + std::sqrt(std::max(0.0, a * a + 2.0 * b * y)));
}

/// v and dv/dΘ.
struct Potential {
  const KirchhoffPotential& u;
  double value(double t) const { return u.constant() ? t : u.value(t) / u.reference(); }
  double slope(double t) const { return u.constant() ? 1.0 : u.conductivity(t) / u.reference(); }
};

}  // namespace

StorageCurve::StorageCurve(const material::EnthalpyCurve& enthalpy, const KirchhoffPotential& potential)
    : pieces_(pieces_of(enthalpy, potential)),
      by_heat_(search_of(pieces_, &Piece::h0)),
      by_potential_(search_of(pieces_, &Piece::v0)) {
  const Potential v{potential};
  const double first = pieces_.front().t0, c = enthalpy.capacity(first - 1.0), k = v.slope(first);
  below_ = {first, 0, enthalpy.lower(first), c, 0, v.value(first), k, k - v.slope(first - 1.0), 0, 0};
}

std::vector<StorageCurve::Piece> StorageCurve::pieces_of(const material::EnthalpyCurve& enthalpy,
                                                         const KirchhoffPotential& potential) {
  // Pieces end where the enthalpy or the potential bends: within one both are quadratic.
  std::vector<double> breaks;
  for (const material::EnthalpyCurve::Piece& piece : enthalpy.pieces()) breaks.push_back(piece.t0);
  breaks.push_back(enthalpy.pieces().back().t1);
  if (!potential.constant())
    breaks.insert(breaks.end(), potential.points().begin(), potential.points().end());
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());

  const Potential v{potential};
  std::vector<Piece> pieces;
  // Each piece has value, slope and curvature of heat and potential at its start. The last one goes on
  // without end.
  for (std::size_t i = 0; i < breaks.size(); ++i) {
    const double t0 = breaks[i], h0 = enthalpy.upper(t0), c0 = enthalpy.capacity(t0), k0 = v.slope(t0);
    const double jump = h0 - enthalpy.lower(t0);
    if (i + 1 == breaks.size()) {
      pieces.push_back({t0, HUGE_VAL, h0, c0, 0, v.value(t0), k0, v.slope(t0 + 1.0) - k0, HUGE_VAL, jump});
      break;
    }
    const double width = breaks[i + 1] - t0, c1 = 2.0 * (enthalpy.capacity(t0 + 0.5 * width) - c0) / width,
                 k1 = (v.slope(breaks[i + 1]) - k0) / width;
    pieces.push_back({t0, width, h0, c0, c1, v.value(t0), k0, k1, width * (c0 + 0.5 * c1 * width), jump});
  }
  return pieces;
}

IntervalSearch StorageCurve::search_of(const std::vector<Piece>& pieces, double Piece::*start) {
  std::vector<double> starts;
  for (const Piece& piece : pieces) starts.push_back(piece.*start);
  return IntervalSearch(std::move(starts));
}

StorageCurve::AtHeat StorageCurve::at_heat(double h) const {
  const std::size_t i = by_heat_(h);
  const Piece* piece = &pieces_[i];
  // Heat counts from the start of the piece in which it lies.
  double x = h - piece->h0;
  if (x < 0) {
    if (h >= below_.h0) return {piece->t0, piece->v0, 0.0};  // in a jump at the first temperature
    piece = &below_;
    x = h - piece->h0;
  }
  if (x >= piece->height) {
    const Piece& next = pieces_[i + 1];
    // In a jump, or at the end of the piece but for rounding.
    constexpr double k_rounding = 1e-9;
    const bool jumps = next.jump > k_rounding * (next.h0 - piece->h0) && x > piece->height;
    const double c = piece->c0 + piece->c1 * piece->width;
    return {next.t0, next.v0, jumps ? 0.0 : (piece->k0 + piece->k1 * piece->width) / c};
  }
  // c² = c0² + 2 c1 x: the capacity at that heat, of a piece whose capacity is linear in
  // temperature.
  const double c = std::sqrt(std::max(0.0, piece->c0 * piece->c0 + 2.0 * piece->c1 * x));
  // The root in the form without cancellation for small c1.
  double t = 2.0 * x / (piece->c0 + c);
  if (piece != &below_) t = std::min(t, piece->width);
  const double k = piece->k0 + piece->k1 * t;
  return {piece->t0 + t, piece->v0 + 0.5 * t * (piece->k0 + k), k / c};
}

StorageCurve::AtPotential StorageCurve::at_potential(double v) const {
  // The piece by its potential, then the temperature in it from a quadratic equation. Within rounding of a
  // jump the slope is zero, as it is in the jump.
  const Piece* piece = &pieces_[by_potential_(v)];
  if (v < piece->v0) piece = &below_;
  double t = root(piece->k0, piece->k1, v - piece->v0);
  if (piece != &below_) t = std::min(t, piece->width);
  const double h = piece->h0 + t * (piece->c0 + 0.5 * piece->c1 * t);
  constexpr double k_near = 1e-6;  // of the piece, from a jump
  const bool at_start = piece->jump > 0 && t <= k_near * std::min(piece->width, 1.0);
  const bool at_end = piece != &below_ && std::isfinite(piece->width) && piece[1].jump > 0 &&
                      piece->width - t <= k_near * piece->width;
  const double slope = at_start || at_end ? 0.0 : (piece->k0 + piece->k1 * t) / (piece->c0 + piece->c1 * t);
  return {piece->t0 + t, t == 0 ? h - piece->jump : h, h, slope};
}

}  // namespace solidus::heat
