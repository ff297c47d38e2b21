/// The contact points of a slave surface that slide over a master: their positions, their partners, and the
/// pairs of faces for which the matrix has entries (the graph).
#pragma once

#include <memory>
#include <vector>

#include "contact/points/contact_kinematics.hpp"
#include "contact/points/integration.hpp"
#include "contact/surfaces/master.hpp"

namespace solidus::contact {

struct SlidingOptions {
  IntegrationRule rule = IntegrationRule::gauss;  ///< gauss or nodal, for the initial points
  int gauss_degree = 4;
  /// Rings of faces around the partner's face that are included in the graph in advance.
  int graph_rings = 2;
  /// Points with larger gaps do not require a new graph [m].
  double graph_distance = 1e300;
  /// The graph includes the pairs of nodes of all master faces opposite one slave face: forces at a point may
  /// depend on the motion of other points.
  bool meets_several = false;
};

/// An integration point on the slave.
struct SlavePlace {
  Index face = 0;
  Point xi{};
  double weight = 0;  ///< area in the reference configuration, with 2πr [m²]
  Index hint = -1;    ///< number of a master face that may be near
};

class SlidingPoints {
 public:
  /// Relation of a point to this process: the rings around its partner's face contain a node owned by the
  /// process (reached), or would contain one with twice as many rings (near), so that the graph includes it
  /// in advance.
  enum Concern : char { none, near, reached };
  /// The points, sorted by face.
  struct Table {
    std::vector<Index> face;
    std::vector<Index> number;  ///< of the point on its face
    std::vector<Point> xi, position, x;
    std::vector<double> weight;
    std::vector<std::array<double, k_max_face_nodes>> shape;
    std::vector<Partner> partner;
    std::vector<Index> hint;       ///< the last master face
    std::vector<char> behind;      ///< Master::behind, in the reference configuration
    std::vector<Concern> concern;  ///< at the last place()
  };

  /// Places the points at zero displacement and time zero.
  SlidingPoints(const mesh::Mesh& mesh, AnalysisKind kind, const ContactSurface& slave,
                std::unique_ptr<Master> master, const SlidingOptions& options);

  /// Replaces the points, sorted by face; they have no partners until the next place().
  void set_places(std::span<const SlavePlace> places);
  /// As in ContactKinematics.
  void set_time(double time) { time_ = time; }
  void place(std::span<const double> displacement, ContactKinematics::Points points);
  double coverage() const { return coverage_; }
  ContactKinematics::Particle particle(Index point) const;
  bool graph_outdated() const;
  void add_to_graph(ContactKinematics::CliqueSink& sink);

  const Table& table() const { return table_; }
  const ContactSurface& slave() const { return slave_; }
  Master& master() const { return *master_; }
  /// The area of a point that is covered by the master; its whole area if it has no partner [m²].
  double weight_of(std::size_t point) const { return table_.weight[point] * table_.partner[point].covered; }

 private:
  /// Pairs of faces in the graph: master faces of every slave face, sorted.
  struct AllowedFaces {
    std::vector<std::size_t> first;  ///< [slave face], one more at the end
    std::vector<Index> faces;
  };

  void add_points(AnalysisKind kind, const SlidingOptions& options);
  void add_point(const SlavePlace& place, Index number, const Face& face);
  void start_points();
  void find_faces_that_concern();
  bool own_slave(std::size_t point) const;
  Point place_of(std::size_t point, const Face& face) const;
  std::span<const Index> allowed(Index slave_face) const;

  const mesh::Mesh& mesh_;
  std::size_t components_;
  ContactSurface slave_;
  std::unique_ptr<Master> master_;
  SlidingOptions options_;
  double time_ = 0, coverage_ = 0;
  Table table_;
  bool all_own_ = false;               ///< this process owns the whole slave
  std::vector<Concern> face_concern_;  ///< [master face]; none for surfaces without nodes
  AllowedFaces allowed_;
};

}  // namespace solidus::contact
