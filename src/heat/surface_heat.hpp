/// Heat through a surface as a function of its temperature: flux, film or radiation.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "algebra/block_matrix.hpp"
#include "heat/conditions.hpp"
#include "mesh/mesh.hpp"

namespace solidus::heat {

/// q(Θ) into the body and its derivative.
struct SurfaceFlux {
  double q = 0;      ///< [W/m²]
  double slope = 0;  ///< dq/dΘ [W/(m² K)]
};

/// The law of one surface at one time, at points of the surface.
class SurfaceLaw {
 public:
  explicit SurfaceLaw(const Flux& flux);
  explicit SurfaceLaw(const Film& film);
  explicit SurfaceLaw(const Radiation& radiation);
  /// Whether it differs from point to point.
  bool placed() const;
  /// The points that at() will be asked for; needed where it is placed.
  void set_points(std::vector<Position> points) { points_ = std::move(points); }
  /// Throws InputError where a function of position has no value that is allowed. Not collective.
  void set_time(double time);
  /// Where the derivative would make heat run away (a film coefficient that falls steeply with temperature),
  /// the slope is that of the frozen coefficient.
  /// @param point  number in set_points(); without meaning where the law is the same everywhere
  SurfaceFlux at(double temperature, std::size_t point = 0) const;

 private:
  /// A function at the time set: one value, or one a point.
  class Now {
   public:
    void set(const PlaceFunction& function, std::span<const Position> points, double time);
    double at(std::size_t point) const { return values_.empty() ? uniform_ : values_[point]; }

   private:
    double uniform_ = 0;
    std::vector<double> values_;
  };
  enum class Kind { flux, film, radiation };
  Kind kind_;
  Coefficient coefficient_;
  PlaceFunction driver_;  ///< flux or ambient
  PlaceFunction factor_;
  std::vector<Position> points_;
  Now driver_now_, coefficient_now_, factor_now_;
};

/// Integrates a law over a surface. With the closed rule faces of linear shapes are lumped to their nodes,
/// with weights ∫ N_i dA; else Gauss points.
class SurfaceHeat {
 public:
  SurfaceHeat(const mesh::Mesh& mesh, AnalysisKind kind, const mesh::Surface& surface, std::string name,
              SurfaceLaw law, bool closed);
  const std::string& name() const { return name_; }
  bool placed() const { return law_.placed(); }
  /// Throws as SurfaceLaw::set_time does.
  void set_time(double time) { law_.set_time(time); }
  /// The nodes of a face are nodes of one element: its graph holds them.
  void bind(const algebra::BlockMatrix& matrix);
  /// r −= heat into the nodes [W], [local node]; ghost rows are scrap. Returns the sum over the counted
  /// points; adds its magnitude, before heat into the body cancels heat out of it, to `moved`.
  double add_residual(std::span<const double> temperature, std::span<double> r, double& moved) const;
  void add_tangent(std::span<const double> temperature, algebra::BlockMatrix& matrix) const;

 private:
  /// Points with the values of the nodes they see; a lumped node is a face of one node and one point.
  struct Patch {
    int n_nodes = 1, n_points = 1;
    Index n_faces = 0, n_counted = 0;
    std::vector<Index> nodes;     ///< [face][node]
    std::vector<double> values;   ///< [point][node]
    std::vector<double> weight;   ///< [face][point] [m²]
    std::size_t first_point = 0;  ///< number of its first point among those of the surface
    std::vector<algebra::BlockMatrix::Slot> slots;
    std::size_t number(Index face, int point) const {
      return static_cast<std::size_t>(face) * static_cast<std::size_t>(n_points) +
             static_cast<std::size_t>(point);
    }
    double temperature(std::span<const double> t, Index face, int point) const;
  };
  /// Numbers the points of the patches and tells the law where they are.
  void place_points(const mesh::Mesh& mesh);
  std::string name_;
  SurfaceLaw law_;
  std::vector<Patch> patches_;
};

}  // namespace solidus::heat
