/// The values of elements that results show. Every mechanical pass makes those of the state that it finds;
/// they belong to that state (MechanicalState::elements) and no step reads them, so checkpoints do without.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "mechanics/state/element_field.hpp"
#include "mesh/mesh.hpp"

namespace solidus::mechanics {

struct MechanicalState;

/// The values of one mesh block. They do not change once a state has them: copies of a state share them.
class ElementValues {
 public:
  virtual ~ElementValues() = default;
  /// out[element][component]: averages over the elements, zero where the law does not know the field.
  virtual void get(ElementField which, std::span<double> out) const = 0;
  virtual std::size_t bytes() const = 0;
};

/// Those of one block of a state. Null: zero everywhere, as of a body that has not been solved for.
using SharedElementValues = std::shared_ptr<const ElementValues>;

/// A field of all elements at a state, [block of the mesh][element][component].
std::vector<double> element_field(const mesh::Mesh& mesh, const MechanicalState& state, ElementField which);

}  // namespace solidus::mechanics
