/// Heat through a surface as a function of its temperature: flux, film or radiation.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "heat/loads/load_mean.hpp"
#include "heat/loads/placed_load.hpp"
#include "heat/loads/thermal_conditions.hpp"
#include "heat/loads/thermal_state.hpp"
#include "linear/block_matrix.hpp"
#include "mesh/block_geometry.hpp"
#include "mesh/mesh.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::heat {

/// q(Θ) into the body and its derivative.
struct SurfaceFlux {
  double q = 0;      ///< [W/m²]
  double slope = 0;  ///< dq/dΘ [W/(m² K)]
};

/// Data of a surface that exchanges radiation with others, at the time set.
struct EnclosedSide {
  double factor = 1;       ///< ε, or what a table of it is multiplied by
  double environment = 0;  ///< Θ_∞⁴ of the opening [K⁴]
  std::optional<Table> of_temperature;
  double emissivity(double temperature) const {
    return of_temperature ? factor * of_temperature->value(temperature) : factor;
  }
};

/// The law of one surface as a mean over a part of a step, or at one time, at points of the surface.
///
/// With Θ the temperature of the surface at the end of that part, the mean of h(t) (Θ_a(t) − Θ) is
/// ⟨h⟩ (⟨h Θ_a⟩/⟨h⟩ − Θ): a film with the mean coefficient and a mean ambient temperature, weighted by it;
/// radiation likewise with ⟨ε Θ_a⁴⟩.
class SurfaceLaw {
 public:
  explicit SurfaceLaw(const Flux& flux);
  explicit SurfaceLaw(const Film& film);
  explicit SurfaceLaw(const Radiation& radiation);
  /// Whether it differs from point to point.
  bool placed() const { return enclosed_ || !law_.uniform(); }
  /// Data of a surface whose irradiation is given point by point (SurfaceHeat::irradiate); null for others.
  const EnclosedSide* enclosed() const { return enclosed_ ? &*enclosed_ : nullptr; }
  bool has_values() const { return !now_.empty(); }
  /// The points that at() will be asked for; needed where it is placed.
  void set_points(std::vector<Position> points) { points_ = std::move(points); }
  /// Throws InputError where a function of position has no value that is allowed. Not collective.
  void set_window(const LoadWindow& window);
  /// Gives the means of a law that is placed, one per point, in place of set_window().
  void set_values(std::span<const LoadValues> means);
  const LoadLaw& law() const { return law_; }
  /// Returns the flux and its slope at a temperature. If the exact derivative would make heat run away (a
  /// film coefficient that falls steeply with temperature), the slope is that of the frozen coefficient.
  /// @param point  number in set_points(); without meaning where the law is the same everywhere
  SurfaceFlux at(double temperature, std::size_t point = 0) const;
  /// The least and the greatest Θ_a of a film or of radiation at the time set [K]; none of a flux.
  std::optional<TemperatureRange> ambient() const;

 private:
  /// The means set: of the flux, or of the coefficient (of its factor, where it is one of temperature) and
  /// Θ_a.
  struct Now {
    double coefficient = 1, driver = 0;
  };
  LoadValues mean_over(const LoadWindow& window) const;
  Now now(const LoadValues& mean, double otherwise) const;

  std::optional<EnclosedSide> enclosed_;
  LoadLaw law_;
  std::optional<Table> of_temperature_;  ///< the coefficient, where it is a table of the temperature
  std::vector<Position> points_;
  std::vector<Now> now_;  ///< one, or one a point
};

/// Whether heat is exchanged with surroundings, by a film or by radiation.
inline bool exchanges(const SurfaceLaw& law) {
  return law.law().kind != LoadLaw::Kind::power;
}

/// A flow between two nodes that a limit may hold back (conduction_limiter.hpp).
struct LimitedFlow {
  Index from, to;
  double heat = 0;  ///< from -> to [W]
  double left = 0;  ///< the share that is not let through
};

/// Integrates a law over a surface. With the closed rule faces are lumped to their nodes, with weights
/// ∫ N_i dA; else Gauss points.
///
/// At the corners of quadratic quadrilaterals these weights are negative: a film takes heat from them when it
/// heats the face. With limits this heat goes back, in part or all of it, from the nodes at the middles of
/// the two edges there, which share it: a flow q(Θ_c) |∫ N_c dA|/2 from the corner c to each of them. What
/// keeps strong films stable is the part of ∫ N_c q dA that draws corners and middles m together, −∫ N_c N_m
/// dA (q_c − q_m) where that integral is negative; with it a film has no less than the matrix ∫ N_i N_j h dA
/// of the Gauss points.
class SurfaceHeat {
 public:
  SurfaceHeat(const mesh::Mesh& mesh, AnalysisKind kind, const mesh::Surface& surface, std::string name,
              SurfaceLaw law, bool closed);
  const std::string& name() const { return name_; }
  const SurfaceLaw& law() const { return law_; }
  /// Collective where it is placed. Throws InputError, on every process, where a function of position has no
  /// value that is allowed.
  void set_window(const LoadWindow& window);
  /// The longest time after which a load that moves still overlaps with itself; collective (PlacedLoad).
  double lasting(double from, double to) const { return load_ ? load_->lasting(from, to) : HUGE_VAL; }
  /// What falls on an enclosed surface from here on.
  /// @param fourth  G/σ, [local node] [K⁴]
  void irradiate(std::span<const double> fourth);
  /// The least and the greatest flux into the body at the time set, at a temperature of zero [W/m²].
  std::pair<double, double> flux_range() const;
  /// The nodes of a face are nodes of one element: its graph holds them.
  void bind(const linear::BlockMatrix& matrix);
  /// r −= heat into the nodes [W], [local node]; ghost rows are scrap. Returns the sum over the counted
  /// points; adds its magnitude, before heat into the body cancels heat out of it, to `moved`.
  double add_residual(std::span<const double> temperature, std::span<double> r, double& moved) const;
  void add_tangent(std::span<const double> temperature, linear::BlockMatrix& matrix) const;
  /// Whether add_tangent() adds to the diagonal alone.
  bool diagonal() const;
  /// The flows from corners with negative weights, at the last add_supply(); `left` is set by the limiter.
  /// Not of a flux, which has no ambient temperature to stay within.
  std::span<LimitedFlow> flows() { return flows_; }
  /// Heat that comes to owned nodes and leaves them [W], both positive, spread with positive weights: a node
  /// gains only where its film or the radiation around it is hotter than it is. Updates flows().
  void add_supply(std::span<const double> temperature, std::span<double> gain, std::span<double> loss);

 private:
  /// Quadratic faces with negative weights.
  void add_corners(const mesh::ElementBlock& faces, const mesh::FaceGeometry& g);
  double flow(std::span<const double> temperature, std::size_t i) const;
  void update_flows(std::span<const double> temperature);
  SurfaceFlux at_node(std::span<const double> temperature, Index node) const;

  /// Points with the values of the nodes they see; a lumped node is a face of one node and one point.
  struct Patch {
    int n_nodes = 1, n_points = 1;
    Index n_faces = 0, n_counted = 0;
    std::vector<Index> nodes;     ///< [face][node]
    std::vector<double> values;   ///< [point][node]
    std::vector<double> weight;   ///< [face][point] [m²]
    std::size_t first_point = 0;  ///< number of its first point among those of the surface
    std::vector<linear::BlockMatrix::Slot> slots;
    std::size_t number(Index face, int point) const {
      return as_size(face) * as_size(n_points) + as_size(point);
    }
    double temperature(std::span<const double> t, Index face, int point) const;
  };
  /// Draws the nodes of a face together.
  struct Pair {
    Index i, j;
    double weight;  ///< −∫ N_i N_j dA > 0 [m²]
    linear::BlockMatrix::Slot ij = 0, ji = 0, ii = 0, jj = 0;
  };
  /// Numbers the points of the patches and hands them to the load.
  void place_points(const mesh::Mesh& mesh, AnalysisKind kind, const mesh::Surface& surface, bool closed);
  bool is_placed_flux() const { return load_ && !exchanges(law_); }
  std::string name_;
  SurfaceLaw law_;
  std::unique_ptr<PlacedLoad> load_;  ///< where the law differs from point to point
  std::vector<Index> point_nodes_;    ///< the node of each point of an enclosed surface
  std::vector<Patch> patches_;
  /// Numbers in the points of the law, [local node]; empty where the law is the same everywhere.
  std::vector<std::size_t> point_of_node_;
  std::vector<Pair> pairs_;
  std::vector<Index> supplied_nodes_;  ///< of add_supply()
  std::vector<double> supply_weight_;  ///< area of their faces by ∫ N_i² dA [m²]
  std::vector<LimitedFlow> flows_;
  std::vector<double> flow_weight_;  ///< |∫ N_c dA|/2 of each [m²]
};

}  // namespace solidus::heat
