#include "linear/block_multigrid.hpp"

#include <optional>

namespace solidus::linear {

BlockMultigrid::BlockMultigrid(const mesh::Mesh& mesh, int components, Modes modes, bool symmetric,
                               GlobalIndex coarsest)
    : Multigrid(symmetric, coarsest), mesh_(mesh), components_(components), modes_(modes) {}

void BlockMultigrid::set_up(BlockMatrix& a) {
  multigrid::NearNullSpace modes = modes_(mesh_, components_);
  a.constrained([&] {
    multigrid::Numbering numbering{mesh_.n_owned_nodes, mesh_.first_owned, {}};
    numbering.ghosts.assign(mesh_.global_node.begin() + mesh_.n_owned_nodes, mesh_.global_node.end());
    std::optional<multigrid::LowerPart> lower;
    if (a.storage() == BlockMatrix::Storage::upper) lower.emplace(a.row_start(), a.columns());
    const std::size_t n_owned =
        static_cast<std::size_t>(mesh_.n_owned_nodes) * static_cast<std::size_t>(a.block_size());
    Multigrid::set_up({a.block_size(), a.row_start(), a.columns(), a.block(0), lower ? &*lower : nullptr},
                      std::move(numbering), std::span(a.fixed()).first(n_owned), std::move(modes));
  });
}

}  // namespace solidus::linear
