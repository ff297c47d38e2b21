/// Everything of the thermal balance but storage: conduction, surfaces, sources, contributions from outside.
///
///   r_i = ∫ ∇N_i · ∇u dV − ∫ N_i q dA − ∫ N_i R dV + contributions        [W], heat that leaves node i
///
/// (monograph 2.150 without the capacity terms), k ∇Θ = ∇u by Kirchhoff's transform (conduction_block.hpp).
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "heat/conduction/conduction_block.hpp"
#include "heat/conduction/conduction_limiter.hpp"
#include "heat/conduction/kirchhoff_potential.hpp"
#include "heat/conduction/nodal_potential.hpp"
#include "heat/loads/surface_heat.hpp"
#include "heat/loads/thermal_conditions.hpp"
#include "heat/loads/thermal_state.hpp"
#include "linear/active_set.hpp"
#include "linear/contribution.hpp"
#include "material/material.hpp"
#include "mesh/mesh.hpp"

namespace solidus::heat {

class HeatSystem {
 public:
  /// @param storage        of the matrix: half of it where no tangent that is added is unsymmetric
  /// @param correct_edges  whether conduction beside re-entrant edges is corrected (edge_conduction.hpp)
  /// Throws InputError for a condition that names no group of the mesh, std::invalid_argument for absent
  /// bodies: they leave later.
  HeatSystem(const mesh::Mesh& mesh, AnalysisKind kind, const std::vector<material::Material>& materials,
             const ThermalConditions& conditions, bool closed,
             std::vector<linear::Contribution*> contributions,
             linear::BlockMatrix::Storage storage = linear::BlockMatrix::Storage::whole,
             bool correct_edges = false);
  ~HeatSystem();

  /// Replaces the conditions from here on. If bodies leave or come back, the matrix gets another pattern;
  /// returns whether it did. Throws InputError as the constructor does. Collective.
  bool set_conditions(const ThermalConditions& conditions);
  const linear::ActiveSet& active() const { return active_; }
  /// Loads are their means over the window from here on, temperatures that are prescribed those at its time.
  /// Collective where a condition varies with position. Throws InputError, on every process, where it has no
  /// value that is allowed.
  void set_window(const LoadWindow& window);
  void set_time(double time) { set_window(LoadWindow::at(time)); }
  /// The longest time from `from` on, up to `to`, after which every load that moves still overlaps with
  /// itself; infinite where none moves farther (PlacedLoad::lasting). Collective.
  double lasting(double from, double to) const;
  /// The power of the bodies that burn, constant from here on until the next call.
  /// @param state       at the start of the step, of all local nodes; empty: nothing burns
  /// @param begin, end  of the step [s]
  void set_burning(const BurningState& state, double begin, double end);
  /// Temperatures at which the nodes of bodies that burn ignite, infinite at others; at a node of several
  /// such bodies the lowest one. [local node] [K]; empty where no body burns.
  const std::vector<double>& ignition() const { return ignition_; }
  /// Off: nothing flows, only the contributions that store are terms.
  void exchange(bool on) { exchange_ = on; }
  /// Writes the prescribed temperatures of the time set, ghosts too.
  void prescribe(std::span<double> temperature) const;
  /// [local node]: one where the temperature is prescribed, or stays because the bodies there have been
  /// removed.
  const std::vector<char>& fixed() const { return fixed_; }

  /// Whether conduction is limited from here on (conduction_limiter.hpp). Off at first, and with the open
  /// rule.
  void limit(bool on);
  /// Finds the limits of conduction again at these temperatures; they hold until the next call. Returns
  /// whether they have changed: a change of the flows there by no more than `negligible` [W] over all
  /// processes is left out. Collective.
  bool find_limits(std::span<const double> temperature, double negligible = -1);
  /// Nothing is held back until the next find_limits().
  void clear_limits();
  /// Limits conduction at nodes outside this range as far as possible, until release_nodes(); find_limits()
  /// makes it so. Returns whether there are such nodes, and others than before, on any process. Collective.
  ConductionLimiter::Held hold_nodes(std::span<const double> temperature, const TemperatureRange& range);
  void release_nodes();
  /// The range of the prescribed temperatures and of those around films and radiating surfaces, at the time
  /// set, over all processes [K]; without end where fluxes, sources or contributions (those that bring heat
  /// at the last find_limits(), rather than pass it on) can heat or cool beyond it. Collective.
  /// @param with_contributions  false: they are taken to pass heat on
  TemperatureRange ambient_range(bool with_contributions = true) const;
  /// The range of these temperatures over the nodes that contributions give heat to or take it from, all
  /// processes [K]; +∞ and −∞ where there is none. Friction, say, heats the nodes of its contact, and no node
  /// can be hotter than the hottest of these and of those at the start of a step. Collective.
  TemperatureRange range_of_contributions(std::span<const double> temperature);
  /// `range`, but where contributions alone leave it open that of `start`, of surroundings and of the nodes
  /// that contributions act on, at these temperatures. Collective.
  /// @param range  ambient_range(), or more
  TemperatureRange closed_range(const TemperatureRange& range, const TemperatureRange& start,
                                std::span<const double> temperature);
  /// r on owned nodes [W]. Returns this process's share of the heat moved by surfaces, sources and
  /// contributions, magnitudes before they cancel.
  double residual(std::span<const double> temperature, std::span<double> r);
  /// Frees the vectors that residual() and assemble() work with; the next call makes them again.
  void release_work();
  /// Fills the matrix with ∂r/∂Θ, which is unsymmetric where a conductivity varies.
  void assemble(std::span<const double> temperature);
  /// Conduction at nodes that materials of different k(Θ)/κ share, in assemble_symmetric().
  enum class SharedNodes { exact, plain };
  /// Fills the matrix with ∂r/∂v in the unknown of nodal_potential.hpp. It is symmetric if the contributions
  /// are, and exact but for two parts, which unsymmetric_part() holds:
  ///   conduction   at nodes that materials of different k(Θ)/κ share. With g = (k_m/κ_m)/c, which is one at
  ///                all other nodes, κ_m K_ij √(g_i g_j) stands for κ_m K_ij g_j, the diagonal being exact;
  ///   contributions and surfaces   between nodes of different c = dv/dΘ. With S = ∂r/∂Θ of those,
  ///                c^-1/2 S c^-1/2 stands for S c^-1.
  /// @param slopes   c, [local node], ghosts up to date
  /// @param further  adds to S; may be empty
  /// @param shared   exact is for iterations that make use of unsymmetric_part(). Without it Newton's method
  ///                 for the open rule did not converge in long steps where materials share nodes; plain
  ///                 takes g = 1 there.
  void assemble_symmetric(std::span<const double> temperature, std::span<const double> slopes,
                          const std::function<void(linear::BlockMatrix&)>& further = {},
                          SharedNodes shared = SharedNodes::exact);
  /// ∂r/∂v less what the matrix has, by entries of owned rows, as of the last assemble_symmetric(); not
  /// what the limits of conduction hold back.
  struct Entry {
    Index row, column;
    double value;  ///< [W/K]
  };
  std::span<const Entry> unsymmetric_part() const { return unsymmetric_; }
  /// The unknown of assemble_symmetric().
  const NodalPotential& potential() const { return *nodal_; }
  linear::BlockMatrix& matrix() { return *matrix_; }
  /// Gives the matrix another pattern if a contribution asks for it; returns whether it did. Collective.
  bool follow_graph();

  /// Returns the heat that storing contributions took up at the last residual(), [owned node] [W]; empty:
  /// none stores.
  std::span<const double> stored_by_contributions() const { return storing_; }
  /// The least and the greatest temperature that is prescribed, or that surfaces exchange heat with, at the
  /// time set [K]; +∞ and −∞ where there is none. Collective.
  TemperatureRange surroundings() const;

  /// Heat into the bodies at the last residual() by every surface and source, over all processes [W].
  struct Power {
    std::string name;
    double value;
  };
  std::vector<Power> powers() const;
  /// Entropy that surfaces and sources brought with their heat at the last residual(), at the temperatures of
  /// the bodies there; this process's share [W/K].
  double entropy_power(std::span<const double> temperature) const;
  std::vector<double> contribution_powers() const;  ///< [W]
  /// Sums the reactions [owned node] of each prescribed temperature: heat into the body by it [W].
  std::vector<Power> reaction_powers(std::span<const double> reactions) const;
  std::size_t bytes() const;

 private:
  struct Prescribed {
    std::string name;
    PlaceFunction value;
    std::vector<Index> nodes;  ///< local; of the condition that holds
    std::vector<Position> x;   ///< of the nodes, where the value varies with position
    std::vector<double> now;   ///< [K], one a node
  };
  /// The source of a body as heat into its nodes.
  struct Volume {
    std::string name;
    PlaceFunction power, factor;
    /// Volume that counts for a node [m³].
    struct Share {
      Index node;
      double weight;
    };
    std::vector<Share> shares = {};          ///< where power and factor are the same everywhere
    std::vector<double> heat = {};           ///< into the owned nodes at the time set [W]
    std::unique_ptr<PlacedLoad> load = {};   ///< where power or factor differs from place to place
    std::optional<Exothermic> burning = {};  ///< its power comes from set_burning()
    bool placed() const { return !power.uniform() || !factor.uniform(); }
    void set_window(const LoadWindow& window);
    void burn(const BurningState& state, double begin, double end);
  };
  /// Kirchhoff's potential at the nodes of one body whose conductivity varies.
  struct Field {
    std::vector<Index> nodes;
    std::vector<double> value;  ///< u, or k while the matrix is assembled, [local node]
  };
  void add_prescribed(const std::vector<PrescribedTemperature>& conditions);
  void add_sources(const std::vector<Source>& sources);
  void add_burning(const std::vector<Exothermic>& exothermics);
  int body_named(const std::string& name) const;
  void add_nodal_shares(int body, Volume& volume) const;
  void place(int body, Volume& volume) const;
  linear::NodeGraph graph() const;
  void bind();
  void add_conduction(const std::vector<material::Material>& materials);
  void add_conditions(const ThermalConditions& conditions);
  void change_bodies(const linear::ActiveSet& active);
  void find_field_nodes(std::size_t body);
  void conduct(std::span<const double> temperature);
  double add_flows(std::span<const double> temperature);
  void keep_conduction();
  bool keeps_conduction() const { return !kept_conduction_.empty() || !kept_diagonal_.empty(); }
  void forget_conduction();
  bool only_diagonal_beside_conduction() const;
  void keep_conduction_apart();
  void assemble_diagonal(std::span<const double> temperature, std::span<const double> slopes);
  void find_node_bodies();
  void scale_by_slopes(std::span<const double> slopes);
  void add_kept_conduction(std::span<const double> temperature, std::span<const double> slopes,
                           SharedNodes shared);
  void note_unsymmetric(Index row, Index column, double entry, double exact, double mirrored);
  ConductionBlock& conduction(std::size_t block);

  const mesh::Mesh& mesh_;
  AnalysisKind kind_;
  bool closed_;
  std::vector<char> at_nodes_;  ///< [body]: whether it stores its heat there
  std::vector<linear::Contribution*> contributions_;
  linear::ActiveSet active_;
  /// One per mesh block; null until it is asked for, and of a body that left.
  std::vector<std::unique_ptr<ConductionBlock>> conduction_;
  EdgeConduction edges_;
  std::vector<KirchhoffPotential> potentials_;  ///< one per body
  std::vector<Field> fields_;                   ///< one per body
  std::unique_ptr<NodalPotential> nodal_;
  std::unique_ptr<ConductionLimiter> limiter_;  ///< null where conduction is not limited
  /// Σ_m κ_m ∫∇N_a·∇N_b dV by slot; empty until it is needed. Where nothing else than conduction has entries
  /// beside the diagonal the matrix itself keeps them, and the diagonal stands here, [owned node].
  std::vector<double> kept_conduction_, kept_diagonal_;
  bool keeps_apart_ = false;    ///< nodes belong to several bodies, or something else had entries there
  std::vector<int> node_body_;  ///< the body of each local node, −1 of several; empty: there is one body
  /// K_ij of one body between two nodes that both belong to several bodies, i = j included.
  struct SharedPair {
    Index i, j;
    int body;
    double k;  ///< ∫∇N_i·∇N_j dV [m]
    linear::BlockMatrix::Slot slot;
  };
  std::vector<SharedPair> shared_;
  std::vector<Entry> unsymmetric_;
  std::vector<SurfaceHeat> surfaces_;
  std::vector<Volume> sources_;
  std::vector<double> ignition_;
  std::vector<Prescribed> prescribed_;
  std::vector<char> fixed_;
  bool placed_ = false;  ///< some condition varies with position
  bool exchange_ = true;
  bool contributions_heat_ = false;  ///< whether they bring or take heat, as far as find_limits() has seen
  std::unique_ptr<linear::BlockMatrix> matrix_;
  std::vector<double> local_;     ///< work, [local node]
  std::vector<double> supplied_;  ///< by surfaces and sources at the last residual, sign of r, [local node]
  std::vector<double> contributed_;  ///< work, [owned node]
  std::vector<double> storing_;      ///< its part taken up by storing contributions, last residual
  std::vector<double> surface_power_, source_power_, contribution_power_;  ///< of this process, last residual
};

}  // namespace solidus::heat
