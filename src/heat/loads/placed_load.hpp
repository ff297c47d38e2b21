/// A load that varies with position, on the elements of a body or the faces of a surface.
///
/// Values at points (the nodes, or the Gauss points of the open rule) put in the wrong total where the load
/// is not much larger than an element. Its integrals (cell_integrals.hpp) have the right one, but spread what
/// they find over all nodes of an element, which flattens a peak that the nodes resolve. So the values at
/// points hold where the total that they give is right, scaled to it, else the integrals; in between, from 1
/// to 5 % of the total, a mean of both:
///
///   f = α (I/S) f_points + (1 − α) f_integrals,   α = min(1, max(0, (0.05 − |S/I − 1|)/0.04))
///
/// S the total by points, I the integral. The sum over the mesh is I in either case, for what heats and for
/// what cools by itself. In time the load is its mean over the window, at Gauss points so close that it
/// overlaps with itself from one to the next.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "heat/loads/cell_integrals.hpp"
#include "heat/loads/load_mean.hpp"

namespace solidus::heat {

class PlacedLoad {
 public:
  /// A point at which values are taken. Where it is a node it has the mean around the node in place of its
  /// value, else that of its cell.
  struct Point {
    Position x{};
    Index node = -1, cell = -1;
    double weight = 0;  ///< in sums over all processes [m²], [m³]; zero: another process counts it
  };
  /// Volume or area of a point that counts for an owned node.
  struct Share {
    Index node, point;
    double weight;
  };

  /// @param name    for messages
  /// @param shares  of a power
  PlacedLoad(const mesh::Mesh& mesh, AnalysisKind kind, std::string name, LoadLaw law,
             std::vector<CellIntegrals::Cells> cells, std::vector<Point> points,
             std::vector<Share> shares = {});
  /// Collective. Throws InputError, on every process, where a function has no value that is allowed.
  void set(const LoadWindow& window);
  /// The heat of a power into the owned nodes over the window that is set [W].
  std::span<const double> heat() const { return heat_; }
  /// The means of an exchange (a film or radiation), one for each point.
  std::span<const LoadValues> means() const { return means_; }
  /// The longest time from `from` on, up to `to`, after which the load overlaps with three fifths of itself,
  /// whatever its power is by then; infinite where that is longer, and of loads that do not move. A normal
  /// distribution of the deviation σ moves by 1.05 σ in that time, a patch of the length L by 0.4 L. Of a
  /// load that knows its path the share of the time in which it moves by its own length that it allows.
  /// Collective.
  double lasting(double from, double to) const;
  std::size_t bytes() const;

 private:
  struct Total {
    LoadValues points{}, integrals{};
  };
  bool moves() const;
  /// The one of its functions that knows how it travels and needs the shortest steps.
  std::optional<Crossing> crossing(double from, double to) const;
  void average(const LoadLaw& law, std::span<const TimePoint> times, std::span<const Position> x, bool fixed,
               std::span<LoadValues> values) const;
  CellIntegrals::Breaks breaks(const LoadLaw& law, std::span<const TimePoint> times) const;
  CellIntegrals::Result integrate(const LoadLaw& law, std::span<const TimePoint> times,
                                  bool with_samples) const;
  void set_power(const CellIntegrals::Result& integrals, std::span<const LoadValues> at_points);
  void set_exchange(const CellIntegrals::Result& integrals, std::span<const LoadValues> at_points);
  void check(const CellIntegrals::Result& integrals, double by_points);

  /// Where values are taken, and what they count for.
  struct Samples {
    std::vector<Point> points;
    std::vector<Position> x;  ///< of points that are no nodes
    std::vector<Share> shares;
    std::vector<std::vector<double>> kept;  ///< values of steady functions at the fixed points
  };

  const mesh::Mesh& mesh_;
  std::string name_;
  LoadLaw law_;                   ///< without the functions of scale_
  std::optional<LoadLaw> scale_;  ///< of a power whose distribution is steady: what is the same everywhere
  CellIntegrals cells_;
  mutable Samples samples_;
  std::vector<double> heat_, steady_heat_;
  std::vector<LoadValues> means_;
  std::optional<LoadWindow> window_;  ///< that is set
  bool told_coarse_ = false, told_uncertain_ = false;
  std::array<double, 3> low_{}, high_{};  ///< the box of the cells
};

}  // namespace solidus::heat
