/// Contact kinematics of small sliding: partners found once, in the reference configuration
/// (integration.hpp).
///
/// The relative displacement d = Σ B_b u_b of a point and its partner says everything, in a frame that stays:
/// g_N = g_N⁰ + d·n, and the partner's way is the tangential part, Ȳ = (1 − n⊗n) d. No geometric terms.
#pragma once

#include <vector>

#include "contact/points/contact_kinematics.hpp"
#include "contact/points/integration.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

class FixedKinematics final : public ContactKinematics {
 public:
  /// @param components of the displacement
  FixedKinematics(ContactPoints points, int components);

  const ContactPoints& points() const { return points_; }

  Index n_points() const override { return points_.n_points(); }
  Particle particle(Index point) const override;
  FacetGap facets(Index point) const override { return points_.facets[as_size(point)]; }
  double coverage() const override { return points_.paired_measure / points_.slave_measure; }
  bool partners_change() const override { return false; }
  using ContactKinematics::place;
  void place(std::span<const double> displacement, Points points) override;
  PointMotion motion(Index point, const ContactPointState& old, Asked asked) const override;
  void add_geometric_tangent(Index, double, const Point&, std::span<Tensor>) const override {}
  bool graph_outdated() const override { return false; }
  void add_to_graph(CliqueSink& sink) override;

 private:
  ContactPoints points_;
  int components_;
  std::vector<Index> pairing_;   ///< of each point
  std::vector<Point> relative_;  ///< d at the last place() [m]
  mutable std::vector<Point> penetration_rate_;
  mutable std::vector<Tensor> slip_rate_;
};

}  // namespace solidus::contact
