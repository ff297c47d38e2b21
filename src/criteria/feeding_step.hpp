/// What Feeding works with during a step.
#pragma once

#include <vector>

#include "criteria/feeding.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::criteria {

/// Shares of a room below this are rounding.
inline constexpr double k_nothing = 1e-10;
/// A pool has what it asks for when it has it but for this share.
inline constexpr double k_exact = 1e-11;
/// The share of a node that moves counts as no less where metal rises in it.
inline constexpr double k_least_mobile = 0.1;

/// What pools have in common on all processes.
struct FeedingPools {
  std::vector<double> label;    ///< rising: the number of a pool is its place here
  std::vector<char> open;       ///< air reaches it
  std::vector<char> soft_skin;  ///< it reaches a skin
  std::vector<double> metal;    ///< that leaves it in the step [m³]
  std::size_t size() const { return label.size(); }
};

/// Vectors have the length of the local nodes unless their comment says otherwise.
struct Feeding::Step {
  Step(const mesh::Mesh& mesh, FeedingRows rows_, const CriterionInput& old, const CriterionInput& next)
      : rows(rows_),
        dt(next.time - old.time),
        temperature(next.heat.temperature),
        solid_after(next.solid_fraction),
        demands(as_size(mesh.n_owned_nodes)),
        solid(mesh.x.size(), 1.0),
        mobile(mesh.x.size(), 0.0),
        soft(mesh.x.size(), 0),
        inside(mesh.x.size(), 0),
        pool(mesh.x.size(), -1),
        metal_before(demands.size()) {
    for (std::size_t i = 0; i < demands.size(); ++i) metal_before[i] = rows(i, k_metal);
  }

  FeedingRows rows;
  double dt;                                         ///< [s]
  std::span<const double> temperature, solid_after;  ///< at the end of the step
  std::vector<FeedingDemand> demands;                ///< [owned node]
  bool melts = false;                                ///< a node of this process may need metal
  std::vector<double> solid, mobile;                 ///< means of the step
  std::vector<char> soft;                            ///< its metal is not solid all the time
  std::vector<char> inside;                          ///< in a pool at the start of the step
  std::vector<int> pool;                             ///< number in `pools`; −1: none
  std::vector<double> by_air, by_skin;  ///< one where air, or a skin, reaches a node of a pool [owned node]
  FeedingPools pools;
  std::vector<double> metal_before;  ///< [owned node]
};

}  // namespace solidus::criteria
