/// Contact kinematics of surfaces whose faces come and go with the elements behind them: those of all faces,
/// of which points take part as long as the faces on both of their sides are there.
#pragma once

#include <memory>
#include <vector>

#include "contact/points/contact_kinematics.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

/// Which faces of the two surfaces of a pair are there, [face]; empty: all of them.
struct FacesThere {
  std::vector<char> slave, master;
};

class GrowingKinematics final : public ContactKinematics {
 public:
  /// All faces are there at first.
  /// @param all          of all faces
  /// @param master_face  [point]; empty where the master does not grow
  GrowingKinematics(std::unique_ptr<ContactKinematics> all, std::vector<Index> master_face);

  /// From here on points without their faces have no partner.
  void set_there(const FacesThere& faces);

  bool there(Index point) const override { return there_[as_size(point)] != 0; }
  PointMotion motion(Index point, const ContactPointState& old, Asked asked) const override;

  Index n_points() const override { return all_->n_points(); }
  Particle particle(Index point) const override { return all_->particle(point); }
  FacetGap facets(Index point) const override { return all_->facets(point); }
  double coverage() const override { return all_->coverage(); }
  bool symmetric() const override { return all_->symmetric(); }
  bool partners_change() const override { return all_->partners_change(); }
  void set_time(double time) override { all_->set_time(time); }
  using ContactKinematics::place;
  void place(std::span<const double> displacement, Points points) override {
    all_->place(displacement, points);
  }
  bool concerns(Index point) const override { return all_->concerns(point); }
  void add_geometric_tangent(Index point, double pressure, const Point& traction,
                             std::span<Tensor> k) const override {
    all_->add_geometric_tangent(point, pressure, traction, k);
  }
  void add_share_rates(Index point, std::span<Point> rates) const override {
    all_->add_share_rates(point, rates);
  }
  Point master_way(Index point, double from, double to) const override {
    return there(point) ? all_->master_way(point, from, to) : Point{};
  }
  bool graph_outdated() const override { return all_->graph_outdated(); }
  void add_to_graph(CliqueSink& sink) override { all_->add_to_graph(sink); }

 private:
  std::unique_ptr<ContactKinematics> all_;
  std::vector<Index> master_face_;
  std::vector<char> there_;  ///< [point]
};

}  // namespace solidus::contact
