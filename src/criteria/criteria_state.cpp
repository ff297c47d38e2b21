/// Columns of records, sized by what they are stored at: nodes or elements.
#include "criteria/criteria_state.hpp"

#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus::criteria {

CriterionColumn make_column(const mesh::Mesh& mesh, std::string name, mesh::FieldPlace place, int components,
                            double value) {
  std::size_t n = 0;
  if (place == mesh::FieldPlace::node)
    n = mesh.x.size();
  else
    for (const mesh::ElementBlock& block : mesh.blocks) n += as_size(block.size());
  return {std::move(name), place, components, std::vector<double>(n * as_size(components), value)};
}

}  // namespace solidus::criteria
