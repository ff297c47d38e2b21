/// Heat between the two surfaces as a term of the thermal phase; an internal part of ContactPair.
#pragma once

#include <span>

#include "contact/heat/heat_points.hpp"
#include "contact/points/graph.hpp"
#include "contact/points/slot_cache.hpp"
#include "linear/contribution.hpp"
#include "mesh/mesh.hpp"

namespace solidus::contact {

/// The heat that each node gives off. With the surfaces' temperatures Θ_s = Σ N_i Θ_i and Θ_m = Σ N_j Θ_j at
/// a point, h at their mean:
///
///   nodal form       r_i += w N_i [h (Θ_i − Θ_m) + e (Θ_i⁴ − Σ_j N_j Θ_j⁴)]    on the slave
///                    r_j −= w N_j [h (Θ_s − Θ_j) + e (Σ_i N_i Θ_i⁴ − Θ_j⁴)]    on the master
///   consistent form  r_a += w B_a [h Σ_b B_b Θ_b + e Σ_b B_b Θ_b⁴]              B: N of the slave, −N of the
///                                                                               master
///
/// e = σ_r F(a), a the master's area over the slave's across the gap: a_s of the slave's curvature and 1/a_m
/// of the master's, which are one of concentric faces, in geometric mean, so that the heat does not hang on
/// which side is the slave. Both are sums of exchanges between pairs of nodes, so heat is conserved to
/// rounding. In the nodal form the pairs are one of the slave and one of the master, with h N_i N_j >= 0 for
/// linear shapes: with it a matrix of non-negative type stays one (6.3.1). Quadratic shapes have functions
/// below zero, by which heat would pass from cold to hot: they take the consistent form, whose entropy
/// production h (Θ_s − Θ_m)²/(Θ_s Θ_m) is nowhere below zero. In a step that is short against the time in
/// which heat crosses an element it takes nodes beyond all temperatures around, as a matrix of capacities by
/// integration does: at faces with such nodes (limit_exchange) it is the nodal form with the functions of the
/// linear parts of the face (positive_shares.hpp).
///
/// Where friction acts, the heat is that of the balance of the interface (3.65, 5.33), Θ_c eliminated at the
/// point (interface_thermodynamics.hpp): Q_1 and Q_2 leave the bodies, and what they differ from conduction
/// alone goes to the nodes by their shape functions, in both forms:
///
///   r_i += w N_i [Q_1 − h (Θ_s − Θ_m)],   r_j += w N_j [Q_2 + h (Θ_s − Θ_m)]
///
/// Without storage in the interface that is D_c,mech alone, split as h_1 : h_2, which changes no matrix. With
/// C_co it is a capacity spread over the nodes of a face: the matrix stays of non-negative type where C_co/Δt
/// is small against the conductance k/l of an element.
///
/// A master without nodes (a rigid surface) has the temperature that it is given, the same everywhere, and
/// takes what comes; without one it takes no heat.
///
/// The tangent takes 2 e N_i N_j (Θ_i³ + Θ_j³) for radiation, the mean of the two derivatives: it keeps the
/// matrix symmetric and, being off by O(Θ_i − Θ_j), costs iterations, not accuracy. All else is exact; a law
/// that changes with the temperature makes it unsymmetric.
class HeatTerm : public linear::Contribution {
 public:
  /// Keeps references.
  HeatTerm(const mesh::Mesh& mesh, ContactGraph& graph, HeatPoints& points)
      : n_owned_(mesh.n_owned_nodes), graph_(graph), points_(points) {}

  bool graph_may_change() const override { return graph_.may_change(); }
  bool graph_outdated() const override {
    return points_.interface().active ? graph_.outdated(version_) : graph_.renewed(version_);
  }
  void add_to_graph(linear::NodeGraph& graph) const override { version_ = graph_.add_to(graph); }
  void bind(const linear::BlockMatrix& matrix) override;
  void add_residual(std::span<const double> x, std::span<double> r) override;
  void add_tangent(std::span<const double> x, linear::BlockMatrix& matrix) override;
  /// In an adiabatic phase heat of friction is taken up on the spot.
  bool stores() const override { return points_.stages().adiabatic(); }
  void begin_stage(const linear::RungeKuttaStage& stage, std::span<const double> before) override;
  void limit_exchange(std::span<const char> nodes) override { points_.limit_exchange(nodes); }
  /// How often the term has been bound: slots of other matrices for its points are void with each time.
  int bindings() const { return bindings_; }
  /// Memory besides that of the points.
  std::size_t bytes() const { return slots_.bytes(); }

 private:
  Index n_owned_;
  ContactGraph& graph_;
  HeatPoints& points_;
  mutable int version_ = 0;  ///< of the graph it has
  SlotCache slots_;
  int bindings_ = 0;
};

}  // namespace solidus::contact
