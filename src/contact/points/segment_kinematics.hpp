/// Large sliding with segments: contact points that stand for cells of the slave's faces.
///
///   g_c = Σ_s α_s g_s,   α_s = w_s/Σ w_s
///
/// over the places s of cell c: Gauss points of the pieces into which the master's faces cut the cell where
/// the bodies are now. A place meets the master as a point of SlidingKinematics does; shape functions,
/// normals and slip are averaged likewise. The forces of a cell are those of an even traction on it,
///
///   r_b = Σ_s w_s B_b,s (t_N n_s + F_s T),   t_N = t_N(g_c),
///
/// on *both* sides, whatever the meshes: an even pressure passes. Cells stay on the slave, so that they keep
/// friction's history while pieces come and go. g is continuous from face to face of the master, hence
/// ∂g_c/∂x_b = Σ_s α_s ∂g_s/∂x_b, without the motion of the cuts, and normal forces have a potential.
///
/// A cell that the master covers in part stands for that part. Its way is counted from the slave,
/// Σ_s α_s (Ȳ_s − X_s), which does not change when another part is covered.
///
/// Validity: reference normals of the master that differ from face to face turn a cell's tangent plane when a
/// cut moves, and a cell at the master's end is covered the more or less; that is in the forces, not in the
/// tangent. Source: M. A. Puso, T. A. Laursen, Comput. Methods
/// Appl. Mech. Eng. 193 (2004) 601 (pieces); constant pressures per cell: N. El-Abbasi, K.-J. Bathe, Comput.
/// Struct. 79 (2001) 1473.
#pragma once

#include <memory>
#include <vector>

#include "contact/points/sliding_kinematics.hpp"
#include "contact/surfaces/search.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

class SegmentKinematics final : public ContactKinematics {
 public:
  /// Places the cells at zero displacement.
  /// @param met              the same master, for the places
  /// @param search_distance  up to which faces are cut with each other [m]
  SegmentKinematics(const mesh::Mesh& mesh, AnalysisKind kind, const ContactSurface& slave,
                    const ContactSurface& master, std::unique_ptr<Master> met, double search_distance);

  Index n_points() const override { return as_index(cells_.face.size()); }
  /// With the weight of the part that was covered when the cell was last placed, of a cell without a partner
  /// the whole.
  Particle particle(Index point) const override;
  FacetGap facets(Index point) const override;
  double coverage() const override { return coverage_; }
  bool symmetric() const override { return places_.symmetric(); }
  void set_time(double time) override { places_.set_time(time); }
  using ContactKinematics::place;
  void place(std::span<const double> displacement, Points points) override;
  bool concerns(Index point) const override;
  PointMotion motion(Index point, const ContactPointState& old, Asked asked) const override;
  void add_geometric_tangent(Index point, double pressure, const Point& traction,
                             std::span<Tensor> k) const override;
  void add_share_rates(Index point, std::span<Point> rates) const override;
  bool graph_outdated() const override { return places_.graph_outdated(); }
  void add_to_graph(CliqueSink& sink) override { places_.add_to_graph(sink); }

 private:
  void add_cells();
  int degree_of_pieces(const ContactSurface& master) const;
  void cut(Index slave_face, const Face& now, const FaceSearch& master);
  /// Finds the nodes of a place among those of the cell, in last_.where; new ones are added.
  void number_nodes(const PointMotion& place) const;
  void add_rates(Index place, double share, const PointMotion& at) const;
  void find_slip(const ContactPointState& old, const Point& way, Asked asked, PointMotion& motion) const;
  template <class Visit>
  void for_each_place(Index point, Asked asked, Visit visit) const;

  /// Sorted by face.
  struct Cells {
    std::vector<Index> face, number;
    std::vector<Point> position;  ///< mean of the reference configuration
    std::vector<double> whole, covered;
    std::vector<std::array<double, k_max_face_nodes>> shape;  ///< means of the slave's shape functions
    std::vector<Index> first_cell;                            ///< [slave face], one more at the end
    std::vector<Index> first_place;                           ///< [cell], one more at the end
  };
  /// Work arrays of the last motion(), [node].
  struct LastMotion {
    std::vector<Index> nodes;
    std::vector<std::size_t> where;  ///< [node of a place]
    std::vector<double> share;
    std::vector<Point> normal_share, penetration_rate;
    std::vector<Tensor> push_share, slip_rate, carried_rate, way_rate, turn_rate;
  };

  AnalysisKind kind_;
  std::size_t components_;
  ContactSurface slave_, master_;
  double reach_, coverage_ = 0;
  int degree_;
  SlidingKinematics places_;
  Index n_owned_;

  Cells cells_;
  std::vector<SlavePlace> found_;  ///< work array of place()
  mutable LastMotion last_;
};

}  // namespace solidus::contact
