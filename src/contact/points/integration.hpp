/// Integration rule of a contact pair: points on the slave surface, each with its partner on the master.
///
///   ∫_Γs f dA  ≈  Σ_p w_p f_p
///
/// Small sliding: the partners are found once, in the reference configuration. A point's partner lies on the
/// line through it along n, the unit normal of the slave face at the point, which looks out of the slave
/// towards the master. With the gap vector along n, the forces on both sides balance in moment as well as in
/// sum.
///
/// Signs: `penetration` g_N = (x_s − x_m)·n is positive where the bodies overlap, as in the monograph (3.5,
/// whose ν, the outward normal of the master, is −n); `opening` = −g_N is what users see as the gap.
#pragma once

#include <vector>

#include "contact/surfaces/facet_heights.hpp"
#include "contact/surfaces/integration_rule.hpp"
#include "contact/surfaces/surface.hpp"
#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/types.hpp"

namespace solidus::contact {

/// More than a face ever holds.
inline constexpr GlobalIndex k_points_of_a_face = 1 << 20;

struct IntegrationOptions {
  IntegrationRule rule = IntegrationRule::segments;
  int gauss_degree = 4;        ///< rule `gauss`: polynomials of this degree are integrated exactly
  double search_distance = 0;  ///< partners are looked for this far along the normal, both ways [m]
};

/// Points of one slave face and one master face. All a pairing's points share its nodes.
struct Pairing {
  Index slave_face = 0, master_face = 0;
  int n_slave = 0, n_master = 0;  ///< nodes
  std::size_t first_node = 0;     ///< in ContactPoints::nodes: slave's nodes, then the master's
  Index first_point = 0, n_points = 0;
  std::size_t first_shape = 0;  ///< in ContactPoints::shape
  int n_shown = 0;              ///< nodes of the slave that show its values; zero: all
  bool counted = false;         ///< this process counts it in sums
  int n_nodes() const { return n_slave + n_master; }
};

/// Structure of arrays; a process holds the pairings that touch a node it owns. Over all processes each
/// pairing is counted exactly once, by the owner of the slave face's first node.
struct ContactPoints {
  std::vector<Pairing> pairings;
  std::vector<Index> nodes;     ///< local numbers
  std::vector<double> shape;    ///< [point][node]: N of the slave's nodes, −N of the master's
  std::vector<double> weight;   ///< area × (2π r | 1) [m²]; per metre of thickness in plane strain
  std::vector<Point> normal;    ///< n, from the slave to the master
  std::vector<Point> position;  ///< on the slave, reference configuration [m]
  std::vector<double> initial_penetration;  ///< g_N at u = 0 [m]
  std::vector<FacetGap> facets;             ///< what facets of curved surfaces do to g_N
  std::vector<GlobalIndex> number;  ///< of all processes alike: slave face × k_points_of_a_face + place

  double slave_measure = 0;   ///< whole slave surface, axisymmetric with 2πr [m²]; over all processes
  double paired_measure = 0;  ///< the part that found a partner [m²]; over all processes

  Index n_points() const { return as_index(weight.size()); }
  std::size_t bytes() const;
};

/// Finds all points of a pair of surfaces. Collective.
ContactPoints integrate(const mesh::Mesh& mesh, AnalysisKind kind, const ContactSurface& slave,
                        const ContactSurface& master, const IntegrationOptions& options);

}  // namespace solidus::contact
