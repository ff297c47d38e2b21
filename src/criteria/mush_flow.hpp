/// Melt that flows through mush to where it shrinks, and pores where it does not get there.
///
///   Σ_j c_ij (P_j − P_i) = Q_i + K_i P_i − R_i,   P_i ≥ −ΔP_cr,   R_i ≥ 0,   R_i (P_i + ΔP_cr) = 0
///
/// P [Pa] the pressure of the melt, its weight left out, zero in pools; Q [m³/s] what the metal around a node
/// needs, K [m³/(Pa s)] not below zero by how much less it needs as gas in it expands; R [m³/s] the pores
/// that open, from the critical drop ΔP_cr of the material on (material/casting.hpp). c_ij = g_ij K̃_ij/μ with
/// g of the graph (feeding_graph.hpp) and the law of Darcy, Blake and Kozeny (material/permeability.hpp),
/// whose resistance is integrated along the edge:
///
///   μ/K̃ = s² (180 μ/λ₂²) ∫ max(f, 1/4)²/(1 − f)³ df/(f_j − f_i)
///
/// with f linear between the nodes. s is the share of the edge over which metal freezes, that from the colder
/// temperature to the liquidus: where mush is thinner than the edge, it is passed over the length s of it,
/// and a node that freezes all at once asks for 1/s times the flow of the front that really goes by.
#pragma once

#include <span>
#include <vector>

#include "criteria/feeding_graph.hpp"
#include "material/material.hpp"
#include "parallel/parallel.hpp"

namespace solidus::criteria {

/// Resistance of mush to flow of melt, by the material.
class MushLaw {
 public:
  explicit MushLaw(const material::Material& material);
  /// A node at the end of an edge: solid fraction and temperature [K].
  struct End {
    double solid, temperature;
  };
  /// K̃/μ [m²/(Pa s)].
  double mobility(const End& a, const End& b) const;
  double critical_drop() const { return critical_drop_; }  ///< ΔP_cr [Pa]

 private:
  double factor_, liquidus_, critical_drop_;
};

/// The place of a node in a flow.
enum class MushPlace : char { none, mush, pool };

struct MushInput {
  std::span<const MushPlace> place;     ///< [local node]
  std::span<const int> pool;            ///< [local node]: the pool of a node in a pool
  std::span<const int> body;            ///< [local node]: whose law holds
  std::span<const double> solid;        ///< mean solid fraction of the step, [local node]
  std::span<const double> temperature;  ///< [K], [local node]
  std::span<const double> flow;         ///< Q [m³/s] where P = 0, [owned node]
  std::span<const double> gives = {};   ///< K [m³/(Pa s)], [owned node]; empty: zero
  std::span<const double> drop = {};    ///< ΔP_cr [Pa], [owned node]; empty: those of the materials
  std::size_t n_pools = 0;
};

struct MushResult {
  std::vector<double> pores;      ///< R [m³/s], [owned node]
  std::vector<double> from_pool;  ///< [m³/s], the same on every process
};

/// Solves by conjugate gradients within an active set of the nodes at the critical drop. Collective.
/// @param laws      [body]
/// @param pressure  P, [local node]: start and solution; −ΔP_cr where pores open
MushResult flow_through_mush(const FeedingGraph& graph, const parallel::GhostExchange& ghosts,
                             std::span<const MushLaw> laws, const MushInput& input,
                             std::span<double> pressure);

}  // namespace solidus::criteria
