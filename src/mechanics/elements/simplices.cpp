/// Linear simplices are mixed where the material may become incompressible, unless the user says otherwise.
#include "mechanics/elements/simplices.hpp"

#include "material/external_law.hpp"
#include "mesh/shape_table.hpp"

namespace solidus::mechanics {

namespace {
/// Bulk over shear modulus is ten there; from about here on a constant strain affects the accuracy visibly.
constexpr double k_incompressible = 0.45;

/// Whether the law is a library's, which may keep the volume as it flows. Grains do not.
bool is_from_outside(const material::Material& material) {
  const material::ExternalLaw* const law = external_law(material);
  return law != nullptr && !law->built_in();
}
}  // namespace

bool nearly_incompressible(const material::Material& material) {
  return material.solidification() != nullptr || material.flow.has_value() || is_from_outside(material) ||
         material.poisson_ratio.max_value() > k_incompressible;
}

bool is_mixed(const mesh::ElementBlock& block, const material::Material& material, Simplices simplices) {
  if (!mesh::row_of(block.shape).mixed) return false;
  const material::ExternalLaw* const law = external_law(material);
  if (law != nullptr && law->built_in()) return false;
  return simplices == Simplices::mixed ||
         (simplices == Simplices::automatic && nearly_incompressible(material));
}

}  // namespace solidus::mechanics
