/// Sums over processes and the exchange of ghost values.
#pragma once

#include <mpi.h>

#include <memory>
#include <span>

#include "mesh/mesh.hpp"

namespace solidus::algebra {

double global_sum(double value);
double global_max(double value);
double global_min(double value);
bool any_process(bool value);

/// Brings the owners' values to the ghosts. Fields are stored [local node][component]. Collective; works on
/// PETSC_COMM_WORLD, as the sums do.
class GhostExchange {
 public:
  explicit GhostExchange(const mesh::Mesh& mesh);
  ~GhostExchange();
  void update(std::span<double> values, int components) const;
  Index n_owned_nodes() const { return n_owned_nodes_; }

 private:
  struct Implementation;
  Index n_owned_nodes_;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace solidus::algebra
