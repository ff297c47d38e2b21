/// The unknown of the thermal phase's linear systems: Kirchhoff's potential of a node, over a conductivity.
///
///   v_i(Θ) = 1/n_i Σ_m u_m(Θ)/κ_m [K],   c_i = dv_i/dΘ
///
/// over the n_i materials around the node, with κ_m = KirchhoffPotential::reference(). Within one material
/// the flux is κ_m ∇v exactly, so conduction is linear in v, with a symmetric matrix that never changes,
/// Σ_m κ_m ∫∇N_a·∇N_b dV. Where materials of different k(Θ)/κ share nodes, that matrix is only close to the
/// derivative of the flux. Materials with constant conductivities have v = Θ.
#pragma once

#include <span>
#include <vector>

#include "heat/conduction/kirchhoff_potential.hpp"
#include "linear/active_set.hpp"
#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::heat {

class NodalPotential {
 public:
  /// @param potentials  one per body of the mesh; must outlive this object
  NodalPotential(const mesh::Mesh& mesh, std::span<const KirchhoffPotential> potentials,
                 const linear::ActiveSet& active);

  /// Whether v = Θ at every node.
  bool identity() const { return identity_; }
  /// Whether v is that of this body's material alone.
  bool is_of(Index node, int body) const {
    if (identity_) return true;
    const auto list = bodies(node);
    return list.size() == 1 && list.front() == body;
  }
  const KirchhoffPotential& of_body(int body) const { return potentials_[as_size(body)]; }
  double value(Index node, double temperature) const;  ///< v [K]
  double slope(Index node, double temperature) const;  ///< c
  /// Θ(v) [K].
  /// @param near  a temperature from which the search starts where several materials meet
  double temperature(Index node, double value, double near) const;
  std::size_t bytes() const;

 private:
  std::span<const int> bodies(Index node) const {
    if (start_.empty()) return bodies_;
    const auto i = as_size(node);
    return {bodies_.data() + start_[i], as_size(start_[i + 1] - start_[i])};
  }

  std::span<const KirchhoffPotential> potentials_;
  bool identity_ = true;
  /// Into bodies_, of each owned node; empty where v = Θ, and where all nodes are of the one body there.
  std::vector<Index> start_;
  std::vector<int> bodies_;
};

}  // namespace solidus::heat
