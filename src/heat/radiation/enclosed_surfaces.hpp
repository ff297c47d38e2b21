/// The surfaces of a heat system that see each other, and the fixed-point iteration that finds what falls on
/// them.
///
/// Temperatures follow from what falls on the surfaces, and what falls on them from the temperatures: an
/// iteration solves for the one with the other held. What falls on the clusters in the next one is mixed by
/// Anderson's method (D. G. Anderson, J. ACM 12, 1965) from the last ones: with differences of what was
/// taken, x, and of what followed from it, g, it is
///
///   x ← g_k − Σ_j γ_j (g_{j+1} − g_j),   γ the least squares of f_k − Σ_j γ_j (f_{j+1} − f_j),  f = g − x
///
/// Clusters are the same on every process, so that this needs no communication.
#pragma once

#include <deque>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "heat/loads/surface_heats.hpp"
#include "heat/loads/thermal_conditions.hpp"
#include "linear/active_set.hpp"
#include "mesh/mesh.hpp"

namespace solidus::heat {

class Enclosure;

/// What falls on a surface counts as found where it is the radiation of surroundings of a temperature that
/// changes by less than this from one iteration to the next [K]; and the iterations that a solution may take.
/// A step adds what is left to the heats of the nodes; a steady state has nowhere to put it.
inline constexpr double k_settled_radiation = 0.05, k_settled_steady_radiation = 1e-6;
inline constexpr int k_most_radiation_iterations = 60;

class EnclosedSurfaces {
 public:
  EnclosedSurfaces();
  ~EnclosedSurfaces();
  EnclosedSurfaces(EnclosedSurfaces&&) noexcept;
  EnclosedSurfaces& operator=(EnclosedSurfaces&&) noexcept;

  /// Takes the surfaces that see each other from the conditions. View factors are kept where faces and active
  /// bodies are those of before. Collective. Throws InputError where they do not close, or where the nodes do
  /// not take the heat of surfaces (the open rule).
  void set(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active, bool closed,
           const ThermalConditions& conditions);
  bool any() const { return enclosure_ != nullptr; }
  /// What falls on the surfaces is that of these temperatures, [local node] [K], and the iteration begins.
  /// Collective.
  void begin(SurfaceHeats& surfaces, std::span<const double> temperature);
  /// Ends an iteration, whose temperatures these are. Where what falls on the surfaces follows from them to a
  /// tolerance [K], it is that from here on, and the result is true; else it is a better guess. Collective.
  bool follow(SurfaceHeats& surfaces, std::span<const double> temperature, double tolerance);
  /// Numbers of the surfaces in SurfaceHeats::each().
  const std::vector<std::size_t>& numbers() const { return numbers_; }
  /// Heat that went out through the opening at the last begin() or follow() [W].
  double to_environment() const;
  std::size_t bytes() const;

 private:
  struct Iteration {
    std::vector<double> followed, off;  ///< g and f [K⁴]
  };
  std::vector<double> following(SurfaceHeats& surfaces, std::span<const double> temperature);
  void tell(SurfaceHeats& surfaces);
  std::vector<double> mixed() const;

  std::unique_ptr<Enclosure> enclosure_;  ///< null where no surfaces see each other
  std::vector<std::size_t> numbers_;
  std::vector<std::string> names_;           ///< of their groups
  std::unique_ptr<linear::ActiveSet> seen_;  ///< bodies that the view factors are of
  std::vector<double> falling_;              ///< what is taken, x [cluster] [K⁴]
  std::deque<Iteration> iterations_;
};

}  // namespace solidus::heat
