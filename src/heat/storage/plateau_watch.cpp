/// The front is deep where a node has changed its side of a plateau together with all of its neighbours
/// since the last call.
#include "heat/storage/plateau_watch.hpp"

#include <algorithm>

#include "numbers/index_casts.hpp"

namespace solidus::heat {

PlateauWatch::PlateauWatch(const mesh::Mesh& mesh, const NodalEnthalpy& storage,
                           const linear::BlockMatrix& matrix, const parallel::GhostExchange& ghosts)
    : mesh_(mesh), storage_(storage), matrix_(matrix), ghosts_(ghosts) {}

bool PlateauWatch::passed_in_depth(std::span<const double> heat, std::span<const double> temperature) {
  // The branch of a node says on which side of its plateaus it is. A node in depth is one that has changed
  // its branch together with all its neighbours.
  if (!storage_.has_plateaus()) return false;
  const auto n = as_size(mesh_.n_owned_nodes);
  const bool first = branch_.empty();
  branch_.resize(n);
  std::vector<float> moved(mesh_.x.size());  // a number, as ghosts are exchanged
  for (std::size_t i = 0; i < n; ++i) {
    const auto branch = static_cast<std::int16_t>(storage_.branch(as_index(i), heat[i], temperature[i]));
    moved[i] = branch != branch_[i] ? 1.0F : 0.0F;
    branch_[i] = branch;
  }
  // The first look only notes the branches.
  if (parallel::any_process(first)) return false;
  ghosts_.update(moved, 1);
  // A row shows both neighbours of an entry, so that a matrix stored by halves is enough.
  std::vector<char> inside(n, 1);
  const std::span<const std::int64_t> start = matrix_.row_start();
  const std::span<const Index> columns = matrix_.columns();
  for (std::size_t i = 0; i < n; ++i)
    for (std::int64_t s = start[i]; s < start[i + 1]; ++s) {
      const auto j = as_size(columns[as_size(s)]);
      if (moved[i] == 0 || moved[j] == 0) inside[i] = 0;
      if (j < n && moved[i] == 0) inside[j] = 0;
    }
  return parallel::any_process(std::find(inside.begin(), inside.end(), 1) != inside.end());
}

}  // namespace solidus::heat
