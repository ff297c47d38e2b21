/// Sums over processes and the exchange of ghost values.
#pragma once

#include <memory>
#include <span>

#include "mesh/mesh.hpp"

namespace solidus::parallel {

double global_sum(double value);
double global_max(double value);
double global_min(double value);
bool any_process(bool value);

/// Brings the owners' values to the ghosts. Fields are stored [local node][component]. Collective; works on
/// PETSC_COMM_WORLD, as the sums do.
class GhostExchange {
 public:
  explicit GhostExchange(const mesh::Mesh& mesh);
  /// Exchange of entries that are numbered as nodes are: owned ones contiguous, from `first_owned` on.
  /// @param ghosts  numbers over all processes of the local entries behind the owned ones
  GhostExchange(Index n_owned, GlobalIndex first_owned, std::span<const GlobalIndex> ghosts);
  ~GhostExchange();
  GhostExchange(GhostExchange&&) noexcept;
  GhostExchange& operator=(GhostExchange&&) noexcept;
  void update(std::span<double> values, int components) const { exchange(values, components); }
  void update(std::span<float> values, int components) const { exchange(values, components); }
  Index n_owned_nodes() const { return n_owned_nodes_; }

 private:
  template <class Number>
  void exchange(std::span<Number> values, int components) const;
  struct Implementation;
  Index n_owned_nodes_;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace solidus::parallel
