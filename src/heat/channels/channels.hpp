/// The cooling channels of a heat system: the fluid on its way through each, and the heat that it takes from
/// the nodes along the way.
///
/// The fluid has its stationary temperature at every moment: it passes a channel in a second or so, in which
/// a die changes little, and what it holds is little beside the heat of the die. Along the way
///
///   ṁ c dΘ_f/ds = q'(s),   q' = Σ_i q_i by channel_line.hpp
///
/// which is solved station by station: with the conductance G = Σ_i w_i L/(1/(h π d) + u_i/k_i) of a station
/// and the mean Θ̄ of its nodes, weighted by it, the fluid takes Q = ṁ c (1 − exp(−G/(ṁ c))) (Θ̄ − Θ_in), which
/// is what the nodes give at the mean fluid temperature Θ̄ − Q/G. Its temperature behind the station follows
/// from its enthalpy, so that what comes out less what went in is the heat of all stations, to rounding.
///
/// Temperatures of nodes follow from those of the fluid, and the other way round: an iteration solves for the
/// nodes with the fluid held, as EnclosedSurfaces does with radiation. Guesses are mixed by Anderson's method
/// of depth one. A guess begins anew with every step, so that it is no part of the state.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "heat/channels/channel_line.hpp"
#include "heat/conduction/kirchhoff_potential.hpp"
#include "heat/loads/named_group.hpp"
#include "heat/loads/thermal_conditions.hpp"
#include "heat/loads/thermal_state.hpp"
#include "linear/active_set.hpp"
#include "linear/block_matrix.hpp"
#include "mesh/mesh.hpp"
#include "numbers/load_window.hpp"

namespace solidus::heat {

/// The fluid counts as found where its temperature changes by less than this from one iteration to the next
/// [K]: in a step, whose nodes take up what is left, and in a steady state.
inline constexpr double k_settled_fluid = 0.01, k_settled_steady_fluid = 1e-6;

class Channels {
 public:
  /// Takes the channels from the conditions. Lines in the mesh are kept where they are those of before.
  /// Collective. Throws InputError for a body that there is not, and where the nodes do not take the heat of
  /// channels (the open rule).
  void set(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active, bool closed,
           const ThermalConditions& conditions);
  bool any() const { return !channels_.empty(); }
  /// Flows and inlet temperatures are their means over the window from here on.
  void set_window(const LoadWindow& window);
  /// The fluid is that of these temperatures, [local node] [K], and the iteration begins. Collective.
  /// @param potentials  one per body, whose conductivity there is between nodes and wall
  void begin(std::span<const double> temperature, std::span<const KirchhoffPotential> potentials);
  /// Ends an iteration, whose temperatures these are. Where the fluid follows from them to a tolerance [K] it
  /// is that from here on, and the result is true; else it is a better guess. Collective.
  bool follow(std::span<const double> temperature, std::span<const KirchhoffPotential> potentials,
              double tolerance);
  /// Adds the heat that leaves the owned nodes [W] and its magnitudes to `moved`; powers() and readings() are
  /// of this call or the last follow().
  void add_residual(std::span<const double> temperature, std::span<double> out, double& moved);
  /// Adds to the diagonal alone.
  void add_tangent(linear::BlockMatrix& matrix) const;
  /// Adds the heat into owned nodes to `gain`, that out of them to `loss`, both positive [W].
  void add_supply(std::span<const double> temperature, std::span<double> gain, std::span<double> loss) const;
  /// The temperatures at which fluids come in, where they flow [K].
  TemperatureRange ambient() const;
  /// Heat into the nodes [W]. Collective.
  std::vector<NamedPower> powers() const;
  void clear_powers();
  /// The fluid of the last begin() or follow(); `heat` in watts.
  std::vector<ChannelReading> readings() const;
  std::size_t bytes() const;

 private:
  struct Fluid {
    std::vector<double> temperature;  ///< mean one of each station [K]
    std::vector<double> taken;        ///< by each station [W]
    std::vector<double> film;         ///< h of each station [W/(m² K)]
    double reynolds = 0;              ///< mean of the stations
    double outlet = 0;                ///< [K]
  };
  struct One {
    Channel channel;
    std::shared_ptr<const ChannelLine> line;
    int body = 0;
    bool active = true;
    std::size_t before = 0;      ///< the channel that feeds it, and one more; zero: none
    double flow = 0, inlet = 0;  ///< mass flow of the whole channel [kg/s], Θ at its begin [K]
    Fluid fluid;
    std::vector<double> conductance;  ///< [share] [W/K]
    std::vector<double> tried, off;   ///< the last guess and what it was off by, for mixing
    double power = 0;                 ///< into this process's nodes [W]
  };
  void march_all(std::span<const double> temperature, std::span<const KirchhoffPotential> potentials);
  static Fluid march(One& one, std::span<const double> temperature, const KirchhoffPotential& conductivity);
  static void mix(One& one, const std::vector<double>& guess);

  std::vector<One> channels_;       ///< in the order of the conditions
  std::vector<std::size_t> order_;  ///< those that feed others first
};

}  // namespace solidus::heat
