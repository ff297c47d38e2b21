/// Large sliding: points fixed on the slave, partners found again in every configuration x = X + u.
///
/// A point's partner ȳ = y(ξ̄) is the closest point of the master (3.4), or, with smoothing, the point on the
/// line along the averaged normals, x_s = y(ξ̄) − g_N ν(ξ̄). Both are the root of
///
///   r(ξ, g) = x_s − y(ξ) + g ν(ξ) = 0
///
/// whose derivatives give ∂ξ̄^α/∂x_b and ∂g_N/∂x_b exactly; for the closest point they are those of Laursen
/// and Simo (1993) with A_αβ = m_αβ + g_N k_αβ. Derivation: docs/theory/contact.md.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "contact/points/contact_kinematics.hpp"
#include "contact/points/sliding_points.hpp"
#include "contact/surfaces/facet_heights.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

class SlidingKinematics : public ContactKinematics {
 public:
  /// Places the points at zero displacement and time zero.
  SlidingKinematics(const mesh::Mesh& mesh, AnalysisKind kind, const ContactSurface& slave,
                    std::unique_ptr<Master> master, const SlidingOptions& options);

  /// The points with their partners.
  SlidingPoints& points() { return points_; }
  const SlidingPoints& points() const { return points_; }

  Index n_points() const override { return as_index(points_.table().weight.size()); }
  Particle particle(Index point) const override { return points_.particle(point); }
  FacetGap facets(Index point) const override;
  double coverage() const override { return points_.coverage(); }
  bool symmetric() const override { return points_.master().symmetric(); }
  void set_time(double time) override { points_.set_time(time); }
  using ContactKinematics::place;
  void place(std::span<const double> displacement, Points points) override {
    points_.place(displacement, points);
  }
  bool concerns(Index point) const override {
    return points_.table().concern[as_size(point)] != SlidingPoints::none;
  }
  PointMotion motion(Index point, const ContactPointState& old, Asked asked) const override;
  void add_geometric_tangent(Index point, double pressure, const Point& traction,
                             std::span<Tensor> k) const override;
  void add_share_rates(Index point, std::span<Point> rates) const override;
  Point master_way(Index point, double from, double to) const override {
    return points_.master().way(points_.table().partner[as_size(point)], from, to);
  }
  bool graph_outdated() const override { return points_.graph_outdated(); }
  void add_to_graph(CliqueSink& sink) override { points_.add_to_graph(sink); }

  /// Ȳ of the last motion().
  const Point& reference_place() const { return last_.frame.reference_y; }
  /// ∂Ȳ/∂x_b and ∂ν^ref/∂x_b, [node] of the last motion(), which was asked for rates; valid until the next
  /// call.
  struct ReferenceRates {
    std::span<const Tensor> place, normal;
  };
  ReferenceRates reference_rates(Index point) const;

 private:
  void list_nodes(std::size_t point) const;
  void find_rates(const Partner& partner) const;
  /// ∂w/∂x_b from the rates of ξ̄; empty where the weight is constant.
  std::span<const Point> find_weight_rates(std::size_t point) const;
  void find_face_rates(const Partner& partner) const;
  void find_wedge_rates(const Partner& partner) const;
  void find_slip(const Partner& partner, const ContactPointState& old, Asked asked,
                 PointMotion& motion) const;

  /// Work arrays of the last motion(), [node], which avoid allocations.
  struct LastMotion {
    MasterFrame frame;
    std::size_t n_slave = 0, n_nodes = 0;
    std::vector<Index> nodes;
    std::vector<double> share;
    std::vector<Point> penetration_rate, weight_rate;
    std::vector<std::array<Point, 2>> xi_rate;
    std::vector<Tensor> normal_rate;  ///< ∂ν/∂x_b
    std::vector<Tensor> slip_rate, carried_rate, place_rate, turn_rate;
  };

  SlidingPoints points_;
  std::size_t components_;
  FacetHeights heights_;  ///< of the slave
  mutable LastMotion last_;
};

}  // namespace solidus::contact
