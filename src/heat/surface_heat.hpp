/// Heat through a surface as a function of its temperature: flux, film or radiation.
#pragma once

#include <optional>
#include <span>
#include <string>
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

/// The law of one surface at one time.
class SurfaceLaw {
 public:
  explicit SurfaceLaw(const Flux& flux);
  explicit SurfaceLaw(const Film& film);
  explicit SurfaceLaw(const Radiation& radiation);
  void set_time(double time);
  /// Where the derivative would make heat run away (a film coefficient that falls steeply with temperature),
  /// the slope is that of the frozen coefficient.
  SurfaceFlux at(double temperature) const;
  /// The temperature that heat is exchanged with [K]; a flux has none.
  std::optional<double> ambient() const {
    return kind_ == Kind::flux ? std::nullopt : std::optional(driver_now_);
  }

 private:
  enum class Kind { flux, film, radiation };
  Kind kind_;
  Coefficient coefficient_;
  TimeFunction driver_;  ///< flux or ambient over time
  double driver_now_ = 0, coefficient_now_ = 0;
};

/// Integrates a law over a surface. With the closed rule faces of linear shapes are lumped to their nodes,
/// with weights ∫ N_i dA; else Gauss points.
class SurfaceHeat {
 public:
  SurfaceHeat(const mesh::Mesh& mesh, AnalysisKind kind, const mesh::Surface& surface, std::string name,
              SurfaceLaw law, bool closed);
  const std::string& name() const { return name_; }
  std::optional<double> ambient() const { return law_.ambient(); }  ///< as of its law
  void set_time(double time) { law_.set_time(time); }
  /// The nodes of a face are nodes of one element: its graph holds them.
  void bind(const algebra::BlockMatrix& matrix);
  /// r −= heat into the nodes [W], [local node]; ghost rows are scrap. Returns the sum over the counted
  /// points.
  double add_residual(std::span<const double> temperature, std::span<double> r) const;
  void add_tangent(std::span<const double> temperature, algebra::BlockMatrix& matrix) const;

 private:
  /// Points with the values of the nodes they see; a lumped node is a face of one node and one point.
  struct Patch {
    int n_nodes = 1, n_points = 1;
    Index n_faces = 0, n_counted = 0;
    std::vector<Index> nodes;    ///< [face][node]
    std::vector<double> values;  ///< [point][node]
    std::vector<double> weight;  ///< [face][point] [m²]
    std::vector<algebra::BlockMatrix::Slot> slots;
    double temperature(std::span<const double> t, Index face, int point) const;
  };
  std::string name_;
  SurfaceLaw law_;
  std::vector<Patch> patches_;
};

}  // namespace solidus::heat
