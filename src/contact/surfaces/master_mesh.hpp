/// A surface of a mesh as the master: closest point (3.4), averaged normals, wedges at edges and vertices.
///
/// Where two faces meet at an angle, the normals of both leave a wedge of places open, on the outside of a
/// ridge or behind a groove. The closest point of all of them is on the edge: there the normal is the
/// direction of the distance (Partner::Region::edge, vertex), which turns from one face's normal to the
/// other's, so that neither the penetration nor the normal force jumps.
/// Beyond the surface's free boundary there is no partner, but for a small tolerance within which the last
/// face is continued.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "contact/surfaces/master.hpp"
#include "contact/surfaces/master_normals.hpp"
#include "contact/surfaces/master_topology.hpp"
#include "contact/surfaces/sliding_search.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::contact {

/// A face is continued by this much beyond the free boundary as if there were none, in its reference
/// coordinates: discrete edges of curved surfaces never coincide.
inline constexpr double k_rim = 0.02;
/// Where points stand for parts of the slave that no segments cut at the boundary: an eighth of a face. A
/// point that lost its partner at once would have a force that jumps, and Newton's iteration goes round
/// between both.
inline constexpr double k_fading_rim = 0.25;

struct MeshMasterOptions {
  double search_distance = 0;  ///< partners are looked for this far, on both sides [m]
  bool smoothing = false;      ///< projection along averaged normals
  double feature_angle = 0.6;  ///< edges sharper than this in the reference stay sharp [rad]
  /// How far beyond its free boundary a face still holds a point, in its reference coordinates: all of it up
  /// to k_rim, then less and less.
  double rim = k_rim;
};

class MeshMaster : public Master {
 public:
  MeshMaster(int components, const ContactSurface& surface, const MeshMasterOptions& options);
  void place(std::span<const double> displacement, double time) override;
  Partner find(const Point& x, const Point& slave_normal, Index hint) const override;
  void watch(std::vector<char> faces) override { search_.watch(std::move(faces), faces_); }
  bool may_meet_watched(const Point& x, const Point& slave_normal, Index hint) const override {
    return search_.may_meet_watched(x, options_.search_distance, slave_normal, hint);
  }
  Index n_faces() const override { return surface_.n_faces(); }
  void frame(const Partner& partner, bool rates, MasterFrame& frame) const override;
  const FacetHeights* heights() const override { return &heights_; }
  std::size_t max_nodes() const override { return max_nodes_; }
  bool reference_turns() const override;
  bool symmetric() const override { return !normals_; }
  std::span<const Index> nodes(Index face) const override;
  std::span<const Index> around(Index face) const override { return topology_.around(face); }
  /// Number of times that the tree was built.
  int n_builds() const { return search_.n_builds(); }

 private:
  const Face& face(Index f) const { return faces_[as_size(f)]; }
  Partner on_face(Index f, const Point& xi, const Point& x) const;
  Partner in_wedge(const Feature& feature, const SurfacePoint& closest, const Point& x) const;
  Partner continued(const SurfacePoint& closest, const Feature& feature, const Point& x,
                    double tolerance) const;
  /// Sets the share of a point's part of the slave that the master still faces, where the point lies
  /// `outside` its free boundary.
  void cover(Partner& partner, double outside) const;
  Partner beyond_rim(const SurfacePoint& closest, const Feature& feature, const Point& x) const;
  Partner along_edge(const Feature& vertex, const Point& x) const;
  Partner flat(const SurfacePoint& closest, const Point& x) const;
  Partner smooth(const SurfacePoint& closest, const Point& x) const;
  Partner smooth_on(Index f, const Point& start, const Point& x, double tolerance) const;

  ContactSurface surface_;
  int components_;
  MeshMasterOptions options_;
  std::vector<Face> reference_, faces_;
  MasterTopology topology_;
  FacetHeights heights_;
  std::optional<AveragedNormals> normals_, reference_normals_;
  SlidingSearch search_;
  std::size_t max_nodes_ = 0;
  bool turns_ = false;
};

}  // namespace solidus::contact
