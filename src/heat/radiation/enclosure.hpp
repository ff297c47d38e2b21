/// Radiation between grey, diffuse surfaces that see each other, and to what they see through an opening.
///
///   G_i A_i = Σ_j S_ij J_j + E_i σ Θ_∞⁴        J_i = M_i + (1 − ε_i) G_i        q = ε (G − σ Θ⁴)
///
/// of clusters i of faces (view_factors.hpp): G [W/m²] what falls on them, J what leaves them, M_i A_i = ∫ ε
/// σ Θ⁴ dA, ε_i A_i = ∫ ε dA over their faces, each node with its own temperature and emissivity. A node
/// takes ε G of the clusters of its faces by its share of them, so that what the surfaces and the opening
/// exchange adds up to zero whatever the clusters are. (J. R. Howell, M. P. Mengüç, K. Daun, R. Siegel,
/// Thermal Radiation Heat Transfer, chapter 5.) Views are those of the mesh, which deformation does not move.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "heat/radiation/view_factors.hpp"
#include "mesh/mesh.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

struct EnclosureOptions {
  std::size_t most_clusters = 2000;
  std::size_t rays_in_all = 4000000;                ///< spread over the clusters
  std::size_t most_rays = 16384, least_rays = 512;  ///< of a cluster
};

/// A surface at the time set.
struct EnclosureSurface {
  std::function<double(double temperature)> emissivity;  ///< 0 to 1
  double environment = 0;                                ///< Θ_∞⁴ [K⁴]
};

class Enclosure {
 public:
  /// Casts the rays. Collective. Throws InputError where the view factors do not close.
  /// @param surfaces  faces of this process, of linear or quadratic shapes
  Enclosure(const mesh::Mesh& mesh, AnalysisKind kind, std::span<const mesh::Surface> surfaces,
            const EnclosureOptions& options = {});

  /// G/σ on the clusters at these temperatures, the same on every process [K⁴]. Collective. Throws
  /// StepRejected where the linear system of G is not solved.
  /// @param temperature  [local node] [K]
  std::vector<double> irradiation(std::span<const double> temperature,
                                  std::span<const EnclosureSurface> surfaces);
  /// The same at the nodes of each surface, [surface][local node] [K⁴]; zero at others. Collective.
  std::vector<std::vector<double>> at_nodes(const std::vector<double>& on_clusters) const;
  /// Heat that went out through the opening at the last irradiation() [W].
  double to_environment() const { return to_environment_; }
  const ViewFactors& view_factors() const { return factors_; }
  std::size_t n_faces() const { return n_faces_; }
  double seconds() const { return seconds_; }  ///< that the rays have taken
  std::size_t bytes() const;

 private:
  /// What a cluster has of an owned node.
  struct Share {
    Index node;
    std::size_t cluster;
    double weight;  ///< ∫ N dA [m²]
  };
  std::vector<Share> shares_of(const mesh::Surface& surface, AnalysisKind kind, const RadiatingFaces& faces,
                               const std::vector<std::size_t>& numbers) const;
  std::vector<double> reflected(const std::vector<double>& root, std::vector<double> r) const;
  std::vector<double> solve(const std::vector<double>& emitted, const std::vector<double>& emissivity,
                            const std::vector<double>& from_outside);

  const mesh::Mesh& mesh_;
  parallel::GhostExchange ghosts_;
  std::vector<std::vector<Share>> shares_;  ///< of each surface
  std::vector<int> surface_of_;             ///< of each cluster
  std::size_t n_faces_ = 0;
  double seconds_ = 0, to_environment_ = 0;
  ViewFactors factors_;
};

}  // namespace solidus::heat
