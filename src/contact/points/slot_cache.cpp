/// Slots are looked up again only for the points whose nodes have changed since the last call.
#include "contact/points/slot_cache.hpp"

#include <algorithm>

#include "numbers/index_casts.hpp"

namespace solidus::contact {

std::span<const SlotCache::Slot> SlotCache::slots(Index first_point, std::span<const Index> nodes) {
  Run& run = runs_[as_size(first_point)];
  if (!std::equal(nodes.begin(), nodes.end(), run.nodes.begin(), run.nodes.end())) {
    run.nodes.assign(nodes.begin(), nodes.end());
    run.slots.clear();
    for (const Index row : nodes)
      for (const Index column : nodes)
        run.slots.push_back(row < n_owned_ ? matrix_->slot(row, column) : linear::BlockMatrix::k_no_slot);
  }
  return run.slots;
}

std::size_t SlotCache::bytes() const {
  std::size_t total = runs_.capacity() * sizeof(Run);
  for (const Run& run : runs_)
    total += run.nodes.capacity() * sizeof(Index) + run.slots.capacity() * sizeof(Slot);
  return total;
}

}  // namespace solidus::contact
