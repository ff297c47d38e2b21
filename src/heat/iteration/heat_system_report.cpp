/// Reports of a heat system: the power of each condition, and its memory.
#include "heat/iteration/heat_system.hpp"
#include "parallel/parallel.hpp"

namespace solidus::heat {

std::vector<HeatSystem::Power> HeatSystem::powers() const {
  std::vector<Power> all;
  for (std::size_t s = 0; s < surfaces_.size(); ++s)
    all.push_back({surfaces_[s].name(), parallel::global_sum(surface_power_[s])});
  for (std::size_t s = 0; s < sources_.size(); ++s)
    all.push_back({sources_[s].name, parallel::global_sum(source_power_[s])});
  return all;
}

std::vector<double> HeatSystem::contribution_powers() const {
  std::vector<double> all;
  for (double power : contribution_power_) all.push_back(parallel::global_sum(power));
  return all;
}

std::vector<HeatSystem::Power> HeatSystem::reaction_powers(std::span<const double> reactions) const {
  std::vector<Power> all;
  for (const Prescribed& p : prescribed_) {
    double sum = 0;
    for (Index node : p.nodes)
      if (node < mesh_.n_owned_nodes) sum += reactions[static_cast<std::size_t>(node)];
    all.push_back({p.name, parallel::global_sum(sum)});
  }
  return all;
}

std::size_t HeatSystem::bytes() const {
  std::size_t total = matrix_->bytes() + (local_.capacity() + contributed_.capacity()) * sizeof(double);
  for (const auto& block : conduction_)
    if (block) total += block->bytes();
  for (const Field& u : fields_)
    total += u.nodes.capacity() * sizeof(Index) + u.value.capacity() * sizeof(double);
  total += (kept_conduction_.capacity() + kept_diagonal_.capacity()) * sizeof(double) + nodal_->bytes() +
           node_body_.capacity() * sizeof(int) + shared_.capacity() * sizeof(SharedPair);
  if (limiter_) total += limiter_->bytes();
  return total;
}

}  // namespace solidus::heat
