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
#include <vector>

#include "contact/points/contact_kinematics.hpp"
#include "contact/points/integration.hpp"
#include "contact/surfaces/master.hpp"

namespace solidus::contact {

struct SlidingOptions {
  IntegrationRule rule = IntegrationRule::gauss;  ///< gauss or nodal, of the points at the start
  int gauss_degree = 4;
  /// Faces around a partner that the graph of the matrix keeps ready, in rings.
  int graph_rings = 2;
  /// Points with larger openings do not ask for a new graph [m].
  double graph_distance = 1e300;
  /// The graph holds the pairs of nodes of all faces that one slave face meets: forces at a point may depend
  /// on the motion of others.
  bool meets_several = false;
};

/// A place on the slave that stands for a part of it.
struct SlavePlace {
  Index face = 0;
  Point xi{};
  double weight = 0;  ///< area in the reference configuration, with 2πr [m²]
  Index hint = -1;    ///< a face of the master that may be near
};

class SlidingKinematics : public ContactKinematics {
 public:
  /// Places the points at zero displacement and time zero.
  SlidingKinematics(const mesh::Mesh& mesh, AnalysisKind kind, const ContactSurface& slave,
                    std::unique_ptr<Master> master, const SlidingOptions& options);

  /// Other points in place of those there are, sorted by face: without partners until the next place().
  void set_places(std::span<const SlavePlace> places);

  Index n_points() const override { return static_cast<Index>(points_.weight.size()); }
  Particle particle(Index point) const override;
  FacetGap facets(Index point) const override;
  double coverage() const override { return coverage_; }
  bool symmetric() const override { return master_->symmetric(); }
  void set_time(double time) override { time_ = time; }
  using ContactKinematics::place;
  void place(std::span<const double> displacement, Points points) override;
  bool concerns(Index point) const override {
    return points_.concern[static_cast<std::size_t>(point)] != none;
  }
  PointMotion motion(Index point, const ContactPointState& old, Asked asked) const override;
  void add_geometric_tangent(Index point, double pressure, const Point& traction,
                             std::span<Tensor> k) const override;
  void add_share_rates(Index point, std::span<Point> rates) const override;
  Point master_way(Index point, double from, double to) const override {
    return master_->way(partner(point), from, to);
  }
  bool graph_outdated() const override;
  void add_to_graph(CliqueSink& sink) override;

  const Partner& partner(Index point) const { return points_.partner[static_cast<std::size_t>(point)]; }
  Index slave_face(Index point) const { return points_.face[static_cast<std::size_t>(point)]; }
  const Point& slave_xi(Index point) const { return points_.xi[static_cast<std::size_t>(point)]; }
  /// Ȳ of the last motion().
  const Point& reference_place() const { return last_.frame.reference_y; }
  /// ∂Ȳ/∂x_b and ∂ν^ref/∂x_b, [node] of the last motion(), which was asked for rates; valid until the next
  /// call.
  struct ReferenceRates {
    std::span<const Tensor> place, normal;
  };
  ReferenceRates reference_rates(Index point) const;

 private:
  void add_points(AnalysisKind kind, const SlidingOptions& options);
  void add_point(const SlavePlace& place, Index number, const Face& face);
  void start_points();
  void find_faces_that_concern();
  bool own_slave(std::size_t point) const;
  Point place_of(std::size_t point, const Face& face) const;
  void list_nodes(std::size_t point) const;
  /// The area that a point stands for where it is; all of its own where it has no partner [m²].
  double weight_of(std::size_t point) const { return points_.weight[point] * points_.partner[point].covered; }
  void find_rates(const Partner& partner) const;
  /// ∂w/∂x_b from the rates of ξ̄; empty where the weight is constant.
  std::span<const Point> find_weight_rates(std::size_t point) const;
  void find_face_rates(const Partner& partner) const;
  void find_wedge_rates(const Partner& partner) const;
  void find_slip(const Partner& partner, const ContactPointState& old, Asked asked,
                 PointMotion& motion) const;
  std::span<const Index> allowed(Index slave_face) const;

  /// Relation of a point to this process: from a face that it meets, the graph's rings reach a node of its
  /// own (reached), or would from one that many faces on (near), so that the graph holds it before it comes.
  enum Concern : char { none, near, reached };
  /// The points, sorted by face.
  struct PointTable {
    std::vector<Index> face;
    std::vector<Index> number;  ///< of the point on its face
    std::vector<Point> xi, position, x;
    std::vector<double> weight;
    std::vector<std::array<double, k_max_face_nodes>> shape;
    std::vector<Partner> partner;
    std::vector<Index> hint;       ///< the face met last
    std::vector<char> behind;      ///< Master::behind, in the reference configuration
    std::vector<Concern> concern;  ///< at the last place()
  };
  /// Pairs of faces that the graph holds: master faces of every slave face, sorted.
  struct AllowedFaces {
    std::vector<std::size_t> first;  ///< [slave face], one more at the end
    std::vector<Index> faces;
  };
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

  const mesh::Mesh& mesh_;
  std::size_t components_;
  ContactSurface slave_;
  std::unique_ptr<Master> master_;
  FacetHeights heights_;  ///< of the slave
  SlidingOptions options_;
  double time_ = 0, coverage_ = 0;

  PointTable points_;
  bool all_own_ = false;               ///< this process owns the whole slave
  std::vector<Concern> face_concern_;  ///< [master face]; none for surfaces without nodes
  AllowedFaces allowed_;
  mutable LastMotion last_;
};

}  // namespace solidus::contact
