/// Heat between the two surfaces as a term of the thermal phase; an internal part of ContactPair.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "contact/heat/heat_gap.hpp"
#include "contact/interface/heat_transfer.hpp"
#include "contact/interface/interface_thermodynamics.hpp"
#include "contact/points/graph.hpp"
#include "contact/points/partners.hpp"
#include "contact/points/point_law.hpp"
#include "contact/points/slot_cache.hpp"
#include "contact/surfaces/surface_curvature.hpp"
#include "linear/contribution.hpp"
#include "linear/coupled_matrix.hpp"
#include "mesh/mesh.hpp"

namespace solidus::contact {

/// Contact state of a point after the mechanical phase, as the thermal phase needs it.
struct HeatPoint {
  double penetration = 0;        ///< g_N [m]
  double pressure = 0;           ///< t_N [Pa]
  double pressure_slope = 0;     ///< ∂t_N/∂g_N [Pa/m]
  bool has_temperature = false;  ///< friction acts or the interface stores heat: Θ_c is balanced, from `step`
  InterfaceStep step;
  /// Where the thermal phase finds the slip again (5.40–5.51): the law and its input. `step` then has the
  /// dissipation and the entropy of the mechanical phase, which are not used.
  const FrictionLaw* friction = nullptr;
  FrictionInput slip{};
  std::optional<JointSlopes> joint;  ///< slip answers Θ_c: dissipation in `step` is that of its solution
};

/// Derivatives of the motion of a point with respect to the displacements of its nodes.
struct HeatRates {
  std::span<const Point> penetration;  ///< ∂g_N/∂x_b
  std::span<const Point> trial;        ///< ∂‖T^trial‖/∂x_b [Pa/m]; empty: zero
  std::span<const Point> share;        ///< ∂B_a/∂x_b, [a][b]
  std::span<const Point> weight;       ///< ∂w/∂x_b [m]; empty: zero
};

/// Time over which a thermal phase spreads the heat of a mechanical pass, if their time steps differ.
struct HeatSpan {
  double dt = 0;           ///< [s]
  bool adiabatic = false;  ///< nothing flows: the dissipation alone is a term
};

/// Heat into the bodies at a point, slave and master [W/m²]: in all, and the part of it by friction, that is
/// beyond conduction and radiation between the two surfaces as they are. What friction makes less what the
/// interface stores.
struct InterfaceHeatFlux {
  std::array<double, 2> total{}, by_friction{};
};

/// Heat dissipated and stored in the interface in a step, over the points that this process counts [J].
struct InterfaceHeat {
  double dissipated = 0;  ///< Σ w D_c,mech Δt
  double stored = 0;      ///< Σ w Θ_c (S^e_c − S^e_c,n)
};

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
  /// @param nodal  the nodal form; for linear faces only
  HeatTerm(const mesh::Mesh& mesh, const PartnerList& partners, ContactGraph& graph,
           const HeatTransferLaw& law, bool nodal);
  /// Curvatures of the slave at every point, [point], and of the master at its nodes, [local node]; empty:
  /// faces are plane. Before place().
  void set_curvature(std::vector<SurfaceCurvature> slave, std::vector<SurfaceCurvature> master) {
    curvature_ = std::move(slave);
    master_curvature_ = std::move(master);
  }
  /// Freezes the configuration, [point]; the partners are those of the list now.
  void place(std::vector<HeatPoint> points);
  const std::vector<HeatPoint>& points() const { return points_; }
  /// Sets the temperature of a master without nodes [K]; absent: it takes no heat.
  void set_tool_temperature(std::optional<double> temperature) { tool_temperature_ = temperature; }
  /// Off: no term at all.
  void activate(bool on) { active_ = on; }
  /// The thermal phase that follows: dissipation and entropy of the points are spread evenly over it, in one
  /// or two stages (begin_stage). Until end_phase() a point's balance is that of the stage.
  void begin_phase(const HeatSpan& span);
  void end_phase() { phase_.reset(); }
  /// Whether the tangent is symmetric.
  bool symmetric() const { return !law_.of_temperature(); }

  bool graph_may_change() const override { return graph_.may_change(); }
  bool graph_outdated() const override {
    return active_ ? graph_.outdated(version_) : graph_.renewed(version_);
  }
  void add_to_graph(linear::NodeGraph& graph) const override;
  void bind(const linear::BlockMatrix& matrix) override;
  void add_residual(std::span<const double> x, std::span<double> r) override;
  void add_tangent(std::span<const double> x, linear::BlockMatrix& matrix) override;
  /// In an adiabatic phase heat of friction is taken up on the spot.
  bool stores() const override { return phase_ && phase_->span.adiabatic; }
  void begin_stage(const linear::RungeKuttaStage& stage, std::span<const double> before) override;
  void limit_exchange(std::span<const char> nodes) override;
  /// Adds ∂r/∂u: through the conductance, through the heat of friction where slip answers Θ_c (joint), and
  /// with the partner that moves on.
  /// @param rates  of a point that has a partner; valid until the next call
  void add_displacement_tangent(const std::function<HeatRates(Index point)>& rates,
                                std::span<const double> temperature, linear::CoupledMatrix& matrix);
  /// Returns the heat fluxes of every point at these temperatures; zero where there is no partner.
  std::vector<InterfaceHeatFlux> surface_heat(std::span<const double> temperature) const;
  /// Its integral over the points that this process counts [W].
  InterfaceHeatFlux counted_heat(std::span<const double> temperature) const;
  /// h [W/(m² K)] of every point at these temperatures; without any, at room temperature.
  std::vector<double> conductances(std::span<const double> temperature) const;
  /// The gaps of the points, as they are placed: [point].
  std::vector<HeatGap> gaps() const;
  /// Conducts through other gaps until the next place(), wherever a point has a partner in both, [point].
  void set_gaps(std::span<const HeatGap> gaps);
  /// The heat that passes at these temperatures through the gaps `used` instead of the right ones, over the
  /// points that this process counts.
  GapHeat gap_heat(std::span<const HeatGap> used, std::span<const HeatGap> right,
                   std::span<const double> temperature) const;
  /// Θ_c of every point at these temperatures [K]; where friction does not act, as it was at t_n.
  std::vector<double> interface_temperatures(std::span<const double> temperature) const;
  /// Slip at these temperatures of every point where this phase finds it again (HeatPoint::friction); its
  /// dissipation is what the phase has made of it, in both stages. Otherwise nothing. From now on the points
  /// keep it. Before end_phase().
  std::vector<std::optional<FrictionResponse>> keep_slip(std::span<const double> temperature);
  /// Returns the heat of the interface over the phase, at the temperatures of its end. The heat of a point
  /// without a partner goes to no body.
  InterfaceHeat interface_heat(std::span<const double> temperature) const;
  std::size_t bytes() const {
    return slots_.bytes() + points_.capacity() * sizeof(HeatPoint) + limited_nodes_.capacity() +
           (fixed_.capacity() + positive_.capacity()) * sizeof(double);
  }

 private:
  /// Data of one contact point for the assembly.
  struct AtPoint {
    Index point = 0;
    std::span<const Index> nodes;
    std::span<const double> b;  ///< B of every node, of functions that are positive in a limited exchange
    std::size_t n_slave = 0;    ///< nodes
    bool nodal = false;         ///< the form
    bool master_takes_heat = true;
    double slave = 0, master = 0;                ///< Θ_s, Θ_m
    double slave_fourth = 0, master_fourth = 0;  ///< Σ N Θ⁴
    Conductance h;
    double radiation = 0;  ///< e
    bool has_temperature = false;
    double slave_resistance = 0.5;  ///< s, with a temperature; its slope is left out of the tangent
    InterfaceResponse interface;    ///< with a temperature
    FrictionResponse friction;      ///< slip that this phase finds, of the whole step
    double dissipation = 0;         ///< D_c,mech Δt of the whole step [J/m²]
  };
  struct Run;
  AtPoint see(Index point, std::span<const double> temperature) const;
  /// Whether the exchange of a point is limited.
  bool limited(Index point) const;
  /// Finds the positive shares of the points whose exchange is limited.
  void share_out();
  /// Adds `weight_h` × h' + `weight_e` × e' of the heat that every node gives off by conduction and
  /// radiation.
  void add_exchange(const AtPoint& at, std::span<const double> temperature, double weight_h, double weight_e,
                    std::span<double> heat) const;
  /// Adds the heat that every node gives off at a point of the given weight.
  void add_point_heat(const AtPoint& at, std::span<const double> temperature, double weight,
                      std::span<double> heat) const;
  /// Adds per-side fluxes by the shape functions.
  static void add_sides(const AtPoint& at, const std::array<double, 2>& flux, std::span<double> heat);
  /// Derivatives with respect to h of the fluxes Q_1 and Q_2 of the balance at fixed Θ_s, Θ_m, less those of
  /// conduction.
  std::array<double, 2> flux_by_conductance(const AtPoint& at) const;
  /// ∂h_i/∂h of the one-sided conductances.
  static std::array<double, 2> side_shares(const AtPoint& at);
  /// Heat of friction over the phase, found at the end of its last stage [J/m²].
  double dissipated(const AtPoint& at) const;
  /// @param per_h  scratch
  void add_point_tangent(const AtPoint& at, std::span<const double> x, std::span<double> k,
                         std::vector<double>& per_h) const;
  /// Computes the derivative with respect to g_N of the heat that every node gives off.
  void add_gap_slope(const AtPoint& at, std::span<const double> temperature, std::span<double> heat) const;
  /// Adds ∂r_a/∂B_b for one node of the master.
  void add_share_slope(const AtPoint& at, std::span<const double> temperature, std::size_t b,
                       std::span<double> heat) const;
  /// The same of every node of the master, [b][a]; with positive shares by the chain of their slopes.
  void add_share_slopes(const AtPoint& at, std::span<const double> temperature, std::span<double> heat) const;
  InterfaceStep balance_step(Index point) const;
  /// h at the plane gap that resists as that of the point does, and its slope in the gap itself.
  Conductance conductance(Index point, double temperature) const;
  Conductance conductance(Index point, double penetration, double pressure, double temperature) const;
  /// e at a point, and its slope in the width of the gap.
  struct Radiation {
    double factor = 0;  ///< [W/(m² K⁴)]
    double by_gap = 0;  ///< [W/(m³ K⁴)]
  };
  Radiation radiation(Index point) const;
  /// The mean of the curvatures of the master's nodes that a point meets.
  SurfaceCurvature master_curvature(Index point) const;

  Index n_owned_;
  int dimension_;
  const PartnerList& partners_;
  ContactGraph& graph_;
  const HeatTransferLaw& law_;
  bool nodal_;
  bool active_ = true;
  mutable int version_ = 0;  ///< of the graph it has
  std::vector<HeatPoint> points_;
  std::vector<SurfaceCurvature> curvature_;         ///< of the slave, [point]; empty: none
  std::vector<SurfaceCurvature> master_curvature_;  ///< of the master, [local node]; empty: none
  std::vector<Radiation> radiation_;                ///< [point]; empty: none
  std::vector<char> limited_nodes_;                 ///< by limit_exchange(), [local node]; empty: none
  std::vector<double> positive_;  ///< B of limited points, as PartnerList::share; empty: none
  std::optional<double> tool_temperature_;
  struct Phase {
    HeatSpan span;
    double stage_dt = 0;
    bool staged = false;                    ///< from `start` instead of the Θ_c of the points
    std::vector<double> start;              ///< Θ_c that the second stage starts from, [point]
    std::vector<double> first_flux;         ///< heat that the first one took from the bodies, [point] [J/m²]
    std::vector<double> first_dissipation;  ///< and its part of what friction makes in all, [point] [J/m²]
  };
  std::optional<Phase> phase_;
  std::vector<double> fixed_;  ///< h of a law that does not change with the temperature, [point]
  SlotCache slots_, displacement_slots_;
  const linear::BlockMatrix* displacement_ = nullptr;  ///< that displacement_slots_ know
};

}  // namespace solidus::contact
