/// The heat of a source that travels along a path, per volume or area and per watt of its power.
///
/// At the point c of the path let d be the direction of the beam, t that of travel across it and s = d × t;
/// ξ, η, ζ are the distances from c along t, s and d. With the share f of the heat in front:
///
///   double ellipsoid  6 √3 f_k/(a b c_k π √π) exp(−3 (ξ²/c_k² + η²/a² + ζ²/b²)),  k = front, ξ ≥ 0, or rear,
///                     f_front = 2 f, f_rear = 2 − 2 f                      [1/m³]
///                     (Goldak, Chakravarti, Bibby, Metall. Trans. B 15 (1984) 299–305, eqs. 10 and 13)
///   gaussian          3/(π r²) exp(−3 (ξ² + η²)/r²), on a surface           [1/m²]
///   cylinder          1/(π r² b)          for ξ² + η² ≤ r², 0 ≤ ζ ≤ b       [1/m³]
///   line              3/(π r² b) exp(−3 (ξ² + η²)/r²)  for 0 ≤ ζ ≤ b        [1/m³]
///
/// a the half width, b the depth, c_k the lengths in front and behind, r the radius. The integral of each
/// over the half space below the point (over its plane for the gaussian) is one; where metal is thinner or
/// the point lies next to it less is delivered. On a plane face that the beam meets at a slant the gaussian
/// delivers more by 1/cos of its angle.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "input/travel_path.hpp"
#include "numbers/place_function.hpp"
#include "numbers/table.hpp"

namespace solidus::heat {

/// The shape of a source that travels.
struct TravellingShape {
  enum class Kind { double_ellipsoid, gaussian, cylinder, line };
  Kind kind = Kind::gaussian;
  double radius = 0;             ///< of gaussian, cylinder, line [m]
  double width = 0, depth = 0;   ///< half width a, depth b [m]
  double front = 0, rear = 0;    ///< c_k [m]
  double front_share = 0.5;      ///< f
  Position direction{0, 0, -1};  ///< d, of length one
};

class TravellingHeat : public PlaceLaw {
 public:
  /// @param efficiency  of the time [1]
  /// @param step_share  longest step, as a share of the time in which it moves by its own length
  TravellingHeat(std::shared_ptr<const TravelPath> path, const TravellingShape& shape, Table efficiency,
                 double step_share);

  void values(std::span<const Position> x, double time, std::span<double> values) const override;
  void add_spots(double time, std::vector<PlaceSpot>& spots) const override;
  void add_bends(double from, double to, std::vector<double>& times) const override;
  std::optional<Crossing> crossing(double from, double to) const override;
  /// Its length along its way [m].
  double length() const;

 private:
  struct Frame {
    Position centre{}, along{}, across{};
  };
  Frame frame(double time) const;
  /// The distribution at the distances from the centre.
  double density(double xi, double eta, double zeta) const;

  std::shared_ptr<const TravelPath> path_;
  TravellingShape shape_;
  Table efficiency_;
  double step_share_;
  double reach_ = 0;  ///< nothing is delivered farther away [m]
};

}  // namespace solidus::heat
