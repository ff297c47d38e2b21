/// A pair of surfaces that may touch and part: forces and heat between them as terms of the two phases.
///
/// A mechanical pass goes begin(state at t_n) – Newton's iteration with mechanics() – update(solution);
/// state() is then the history at t_{n+1}, which the scheme keeps or throws away. Points do not know each
/// other, and every process brings the points that its nodes can meet to the same state.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "contact/master_wear.hpp"
#include "contact/mechanics_term.hpp"
#include "contact/partners.hpp"
#include "contact/spec.hpp"
#include "linear/contribution.hpp"
#include "linear/coupled_matrix.hpp"

namespace solidus::contact {

class HeatTerm;
struct HeatPoint;
struct HeatSpan;

/// Sums over the interface of a pair in one step, of all processes: heat, stored energy and entropy.
struct InterfaceSums {
  double dissipated = 0;          ///< D_c,mech [J]
  double stored = 0;              ///< Σ Θ_c (S^e_c − S^e_c,n), the heat that did not reach the bodies [J]
  double hardening = 0;           ///< work of friction less its dissipation [J]
  double energy = 0;              ///< change of E_c without springs [J] (3.69)
  double entropy = 0;             ///< change of S^e_c [J/K]
  double mechanical_energy = 0;   ///< the same up to the end of the mechanical phase [J]
  double mechanical_entropy = 0;  ///< [J/K]
  double plastic_entropy = 0;     ///< change of S^p_c [J/K] (3.53c)
};

/// Sums over a pair, all processes (axisymmetric: of the whole revolution; plane strain: per metre).
struct ContactSums {
  GlobalIndex points = 0, closed_points = 0, sticking_points = 0;
  double force = 0;     ///< ∫ t_N dA [N]
  double friction = 0;  ///< ∫ ‖T‖ dA [N]
  Point resultant{};    ///< ∫ (t_N n + F T) dA, the force on the master [N]; on the slave it is the reverse
  Point moment{};       ///< its moment about the origin [N m]
  double closed_area = 0;  ///< area of the closed points [m²]
  double energy = 0;       ///< in the springs, normal and tangential [J]
  double work = 0;         ///< of friction so far, ∫ ∫ ‖T‖ dγ dA [J]
  double dissipation = 0;  ///< of friction so far [J]; the work less this is stored by hardening
  double wet_area = 0;     ///< of points that liquid metal wets [m²]
  /// The part of the liquid skin that has left its wall (ContactSpec::leaving_gap): points, area [m²] and the
  /// largest gap [m].
  GlobalIndex left_points = 0;
  double left_area = 0, left_gap = 0;
  double heat = 0;                               ///< from slave to master by conduction and radiation [W]
  double heat_to_slave = 0, heat_to_master = 0;  ///< in all, that of friction included [W]
};

/// Averages around the nodes of both surfaces, [owned node of the surface]; NaN at nodes without a point that
/// has a partner. Weighted with w N_a²; the history of friction, with w N_a over all points of the slave,
/// which keeps its integral, NaN on the master.
struct ContactNodalFields {
  std::vector<Index> nodes;         ///< local numbers of owned nodes, slave's and master's, sorted
  std::vector<double> opening;      ///< [m], negative: penetration
  std::vector<double> pressure;     ///< t_N [Pa]
  std::vector<double> conductance;  ///< h without radiation [W/(m² K)]; zero without heat
  /// ∫ N_a dA over the points that have a partner, of which the values here are means; zero where there is
  /// none [m²].
  std::vector<double> paired_area;
  /// Heat flux into the body of the node, through the gap, the spots and radiation and from friction; and its
  /// part by friction (SurfaceHeat). Zero without heat or temperatures [W/m²].
  std::vector<double> heat_flux, frictional_heat_flux;
  /// With friction, else empty: 0 open, 1 sticks, 2 slips; and F T, on the master [Pa].
  std::vector<double> status;
  std::vector<Point> traction;
  /// History of the points, with friction; else empty. μ is that of ζ_c and Θ_c. A master that wears has its
  /// own dissipation and depth.
  std::vector<double> slip, internal_variable, coefficient, dissipation, wear_depth;
  std::vector<double> temperature;  ///< Θ_c, with friction or where the interface stores heat [K]
};

/// Input of a pass of the mechanical phase: the times, the fields at t_n and the way in which the interface's
/// temperature is found.
struct ContactPass {
  double time = 0, dt = 0;                 ///< t_{n+1} and the step [s]
  std::span<const double> displacement{};  ///< u_n, [local node][component] [m]
  std::span<const double> temperature{};   ///< Θ_n, [local node] [K]; empty: unknown
  /// f_S/f_c at t_n, the solid fraction over that at which metal is coherent, [local node]; one where nothing
  /// melts. Empty: nothing does.
  std::span<const double> coherency{};
  bool isentropic = false;    ///< the pass holds the entropy of the interface, not Θ_c
  bool simultaneous = false;  ///< Θ_c is found together with the slip (5.40), see set_temperature()
  /// Result of the pass before in a scheme whose phases take turns within the step: friction holds its Θ_c,
  /// or its entropy, and multipliers start from the ones found there, so that passes that have not come to
  /// their end go on where they were. Null: that of t_n.
  const ContactState* iterate = nullptr;
  double share = 1;  ///< s of normal.hpp
};

class ContactPair {
 public:
  /// Finds the partners and starts with zero displacement. Collective.
  /// @param body_modulus E [Pa] of every body of the mesh, for a penalty given as a factor
  /// Throws InputError for surfaces that do not exist, have no partner at all, or for a law that is none.
  ContactPair(const mesh::Mesh& mesh, AnalysisKind kind, ContactSpec spec,
              std::span<const double> body_modulus = {});
  ~ContactPair();
  ContactPair(const ContactPair&) = delete;
  ContactPair& operator=(const ContactPair&) = delete;

  /// Off: open at every point, without force, heat, energy or stabilisation, whatever the gap; gaps are still
  /// measured. Friction's history stays, but slip is counted anew after it. Between steps; holds from the
  /// next update() or restore() on.
  void activate(bool on);
  bool active() const { return active_; }

  /// The term of the mechanical phase, of the displacement it is called with and the start of the step,
  /// whatever the state of update().
  linear::Contribution& mechanics() { return *mechanics_; }
  /// The term of the thermal phase, with the configuration of the last update(); null without a heat law.
  linear::Contribution* heat();
  /// Whether the derivative of mechanics() is symmetric.
  bool symmetric() const;
  /// Whether that of heat() is.
  bool symmetric_heat() const;

  /// The history of bodies that have not moved.
  ContactState initial_state() const;
  /// The history where bodies of a side are new (a casting of the next shot) and without displacement: points
  /// of a new slave and nodes of a new master have none; a slave that stays keeps what wears it. Melt fills
  /// the space between deformed walls: gaps are those of the drawing, whatever the displacement of a meshed
  /// master or of a slave that stays. Local.
  /// @param displacement  [local node][component] [m]
  ContactState renewed_state(const ContactState& old, bool new_slave, bool new_master,
                             std::span<const double> displacement, double time) const;
  /// Begins a step from the state `old`; empty: initial_state(). Local, no communication.
  void begin(const ContactState& old, const ContactPass& pass);
  /// Sets the present temperatures of the bodies within a simultaneous pass, [local node], for mechanics()
  /// and the next update(). Local.
  void set_temperature(std::span<const double> temperature);
  /// Updates forces and history of every point for a displacement, and their data for the heat term: [local
  /// node][component], ghosts up to date [m]. Local, no communication.
  void update(std::span<const double> displacement);
  /// Restores the pair as it was after the update() that ended in `state` (empty: initial_state()) at this
  /// displacement and time. Local.
  void restore(const ContactState& state, std::span<const double> displacement, double time);
  /// Whether the interface has a temperature Θ_c of its own: heat passes, and it rubs or stores heat.
  bool has_temperature() const { return heat_ && (law_.friction || spec_.interface_heat_capacity > 0); }
  /// Begins a step of bodies that do not deform and updates the pair: heat alone, where the interface stores
  /// it. Local.
  void rest(const ContactState& old, double time, double dt, std::span<const double> temperature);
  /// State of the points at the last update() or restore().
  const ContactState& state() const { return now_; }

  /// Begins a thermal phase over `dt`, which need not be the time step of the mechanical pass; an adiabatic
  /// phase has no fluxes. commit_heat() ends it. Without this call the heat is that of the mechanical pass.
  void begin_heat(double dt, bool adiabatic);
  /// Holds the present deformation: the heat of friction of the last update() is dropped, so that a thermal
  /// phase that follows has none.
  void hold_deformation();
  /// Predicts the heat of the second of two equal mechanical passes of a step by that of the first. The
  /// thermal phase between them takes heat and entropy of the slip of the first pass twice, and the same
  /// amount is subtracted from those of the second pass.
  void predict_heat();
  /// Ends the thermal phase: computes Θ_c and S^p_c of every point at the temperatures found [local node] and
  /// commits them to state(). Zero without friction or heat. Collective.
  InterfaceSums commit_heat(std::span<const double> temperature);

  /// Uzawa's step of the augmented Lagrangian: the multipliers grow with the mean penetrations around the
  /// slave's nodes, λ += ε_N Σ N_a ḡ_a, and friction starts from the tractions of the last update(). There
  /// are more points than the unknowns of a face can bring to zero penetration one by one, but their means
  /// can be. Where a mean falls slowly from turn to turn the step is lengthened by Aitken's factor: a node at
  /// the edge of contact has few closed points, hence a weak spring. Collective.
  void augment();
  /// The largest mean penetration around a node of the slave at the last update(), over closed points, as a
  /// share of what is allowed; zero where there is no augmented Lagrangian. Collective.
  double excess() const;
  /// Describes the place of the largest mean penetration, for messages. Collective.
  std::string worst_penetration() const;

  /// Drops the recorded sparsity pattern (coupling/scheme.hpp, forget()).
  void forget() { graph_->forget(); }
  /// Describes why an iteration failed, from the last residual, for messages: empty, or with the pair's name.
  /// Collective.
  std::string failure_text() const;
  /// Points that changed between open, sticking and slipping at the last residual. Collective.
  GlobalIndex changes() const;

  /// Adds the derivatives of the heat with respect to the displacement and of the forces with respect to the
  /// temperature, at the last update(); nothing without a heat law.
  void add_coupling(std::span<const double> temperature, linear::CoupledMatrix& matrix) const;

  /// Sums at the last update(); `temperature` [local node] or empty (heat = 0). Collective.
  ContactSums sums(std::span<const double> temperature) const;
  /// Work that the bodies do on contact from the start of the step to the last update(), by the mean of the
  /// forces at both [J]. Contact that is off has no force at the end, but the balance of a method with a mean
  /// still holds that of t_n in the first step without it. Collective.
  /// @param share of the last update() in the mean
  double work(double share);
  /// Work that a rigid master does on contact meanwhile: ∫ (t_N Δg_N + T·ΔG) dA less work(). Where a point
  /// has a partner at one end of the step only, Δg_N and ΔG are those of the motion of both bodies there.
  /// Collective.
  double rigid_work(double share);
  /// Averages at nodes, at the last update(); without temperatures, conductances at room temperature. Local.
  ContactNodalFields nodal_fields(std::span<const double> temperature) const;
  /// Heat that leaves the slave's and enters the master's surface around every owned node [W]: positive where
  /// the node loses heat; the sum over all is zero. [owned node].
  std::vector<double> nodal_heat(std::span<const double> temperature) const;

  /// Temperature of a rigid master at the last update() or restore() [K]; absent: it takes no heat.
  std::optional<double> tool_temperature() const;
  const ContactSpec& spec() const { return spec_; }
  double penalty() const { return law_.normal.penalty; }  ///< ε_N [Pa/m]
  const ContactKinematics& kinematics() const { return *kinematics_; }
  const PointLaw& law() const { return law_; }
  /// Partners of the points at the last update().
  const PartnerList& partners() const { return partners_; }
  /// Part of the slave surface that has a partner at the start, 0 to 1.
  double coverage() const { return kinematics_->coverage(); }
  std::size_t bytes() const;

 private:
  void make_kinematics(AnalysisKind kind, const ContactSurface& slave, const ContactSurface* master);
  void make_laws(const ContactSurface& slave, double penalty);
  std::optional<double> tool_temperature_at(double time) const;
  void set_out_from(const ContactState& state);
  void find_wet_points(std::span<const double> coherency);
  void wear_master(const PointMotion& motion, const PointState& now, const PointForces& forces);
  HeatPoint heat_point(const PointState& from, const PointState& now, const PointForces& forces) const;
  /// Takes over the slip that the thermal phase has found anew.
  void take_slip(std::span<const double> temperature);
  void require_apart(const ContactSurface& slave, const ContactSurface& master) const;
  void show_whole_step();
  void find_interface_temperatures(std::span<const double> temperature);
  /// Lengthens the steps of the nodes from their mean penetrations now and one turn before.
  void accelerate(const std::vector<double>& penetration);
  /// Mean penetrations ḡ_a of the augmented Lagrangian, weighted with w N_a², [local node] [m]. Collective.
  std::vector<double> nodal_penetration() const;
  /// The state of a point at t_n, with the traction that it had there.
  PointState at_start(std::size_t point) const;
  /// u_{n+1} − u_n, [local node][component] [m].
  std::vector<double> increment() const;
  /// ∫ f · ΔΣ B_b u_b of the points' forces at the start or at the end of the step, this process's part [J].
  enum class End { start, finish };
  double force_times_increment(End end, std::span<const double> increment);
  /// The work of points with a partner at one end of the step alone: ∫ f · (Δu_s − Δy) dA with the way Δy of
  /// the rigid master's particle there, this process's part [J].
  double force_times_relative_way(End end, std::span<const double> increment);

  const mesh::Mesh& mesh_;
  ContactSpec spec_;
  int components_;
  bool active_ = true;
  double touching_ = 0;             ///< initial gaps up to this are none [m]
  double allowed_penetration_ = 0;  ///< [m]; augmented Lagrangian
  std::unique_ptr<ContactKinematics> kinematics_;
  std::unique_ptr<CurrentConfiguration> configuration_;
  std::unique_ptr<ContactGraph> graph_;
  PointLaw law_;
  std::optional<HeatTransferLaw> heat_law_;
  ContactStep step_;
  std::unique_ptr<MasterWear> worn_;   ///< absent where the master does not wear
  std::vector<WornNode> worn_from_;    ///< at t_n
  std::vector<Point> start_traction_;  ///< at t_n, [point] [Pa]; empty where step_.from still has them
  /// ḡ_a [m] and the factors of the steps in the last turn of the augmented Lagrangian of this step, [local
  /// node]; empty in the first turn.
  std::vector<double> last_penetration_, step_factor_;
  ContactState now_;
  std::vector<double> displacement_;  ///< of now_
  double time_ = 0;                   ///< likewise
  std::vector<double> before_heat_;   ///< Θ_c that the mechanical phase left, [point]
  /// D_c,mech [J/m²] and entropy [J/(m² K)] that predict_heat() has counted in advance, [point]; or empty.
  std::vector<std::array<double, 2>> predicted_;
  PartnerList partners_;
  std::vector<Index> surface_nodes_;  ///< owned nodes of both surfaces, sorted
  std::unique_ptr<MechanicsTerm> mechanics_;
  std::unique_ptr<HeatTerm> heat_;
};

}  // namespace solidus::contact
