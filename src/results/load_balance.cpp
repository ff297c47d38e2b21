/// The largest of all processes over their mean.
#include "results/load_balance.hpp"

#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::results {

double largest_over_mean(double mine) {
  const double largest = parallel::global_max(mine), sum = parallel::global_sum(mine);
  return sum > 0 ? largest * processes::count() / sum : 1;
}

Balance balance(const mesh::Mesh& mesh, const std::vector<std::pair<std::string, double>>& seconds) {
  double held = 0, counted = 0;
  for (const mesh::ElementBlock& block : mesh.blocks) {
    held += block.size();
    counted += block.n_counted;
  }
  Balance balance;
  auto& even = balance.largest_over_mean;
  even.emplace_back("nodes", largest_over_mean(mesh.n_owned_nodes));
  even.emplace_back("elements", largest_over_mean(held));
  for (const auto& [phase, mine] : seconds) even.emplace_back(phase, largest_over_mean(mine));
  const double all = parallel::global_sum(counted);
  balance.computed_again = all > 0 ? (parallel::global_sum(held) - all) / all : 0;
  return balance;
}

}  // namespace solidus::results
