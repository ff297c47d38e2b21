/// The choice of a kernel: by what the phase holds (temperature, entropy, nothing), by the material's law,
/// and by the kind of analysis.
#include "mechanics/elements/block_kernel.hpp"

#include "material/external_law.hpp"
#include "mechanics/elements/block_makers.hpp"
#include "mechanics/elements/coupled_kernel.hpp"
#include "mechanics/elements/mixed_kernel.hpp"
#include "system/errors.hpp"

namespace solidus::mechanics {

namespace {

template <class Law>
std::unique_ptr<BlockKernel> make_block_of_law(const mesh::Mesh& mesh, const mesh::ElementBlock& block,
                                               AnalysisKind kind, const material::Material& material,
                                               bool b_bar) {
  switch (kind) {
    case AnalysisKind::plane_strain:
      return make_block<Law, AnalysisKind::plane_strain>(mesh, block, material, b_bar);
    case AnalysisKind::axisymmetric:
      return make_block<Law, AnalysisKind::axisymmetric>(mesh, block, material, b_bar);
    case AnalysisKind::solid:
      break;
  }
  return make_block<Law, AnalysisKind::solid>(mesh, block, material, b_bar);
}

/// Throws for what no law from outside can do; the model says it before, with the place in the case.
void refuse_external(const material::Material& material, const std::string& what,
                     const std::string& allowed) {
  if (external_law(material) != nullptr)
    throw InputError({}, name_of_law(material) + " cannot serve " + what, allowed);
}

}  // namespace

std::unique_ptr<BlockKernel> make_block_kernel(const mesh::Mesh& mesh, const mesh::ElementBlock& block,
                                               AnalysisKind kind, const material::Material& material,
                                               Mapping mapping, bool b_bar) {
  // A law from outside does not say what it stores, which phases at fixed entropy need. One of the program
  // holds the temperature in them: what deformation heats sand by is next to nothing.
  const material::ExternalLaw* const law = external_law(material);
  const bool isothermal_in_split = law != nullptr && law->built_in() && mapping == Mapping::isentropic;
  if (mapping != Mapping::isothermal && !isothermal_in_split)
    refuse_external(material, "a phase that holds more than its temperature",
                    "a mechanical phase that holds the temperature (coupling.scheme)");
  if (mapping == Mapping::simultaneous) {
    switch (kind) {
      case AnalysisKind::plane_strain:
        return make_coupled_block<AnalysisKind::plane_strain>(mesh, block, material, b_bar);
      case AnalysisKind::axisymmetric:
        return make_coupled_block<AnalysisKind::axisymmetric>(mesh, block, material, b_bar);
      case AnalysisKind::solid:
        return make_coupled_block<AnalysisKind::solid>(mesh, block, material, b_bar);
    }
  }
  // Laws from outside, which keep temperature; then those at fixed entropy.
  if (law != nullptr) return make_block_of_law<ExternalBlockLaw>(mesh, block, kind, material, b_bar);
  if (mapping == Mapping::isentropic)
    return make_block_of_law<material::Isentropic>(mesh, block, kind, material, b_bar);
  // The Maxwell element alone has a shorter history and an isotropic tangent.
  if (!material.flow && material.liquid_model == material::LiquidModel::maxwell)
    return make_block_of_law<material::Viscoelastic>(mesh, block, kind, material, b_bar);
  return make_block_of_law<material::Viscoplastic>(mesh, block, kind, material, b_bar);
}

std::unique_ptr<BlockKernel> make_mixed_kernel(const mesh::Mesh& mesh, const mesh::ElementBlock& block,
                                               AnalysisKind kind, const material::Material& material,
                                               Mapping mapping, Stabilisation stabilisation) {
  refuse_external(material, "mixed elements",
                  "hexahedra, quadrilaterals or elements of second order; mechanics.simplices = "
                  "\"displacement\" locks where the solid flows");
  switch (kind) {
    case AnalysisKind::plane_strain:
      return make_mixed_block<AnalysisKind::plane_strain>(mesh, block, material, mapping, stabilisation);
    case AnalysisKind::axisymmetric:
      return make_mixed_block<AnalysisKind::axisymmetric>(mesh, block, material, mapping, stabilisation);
    case AnalysisKind::solid:
      break;
  }
  return make_mixed_block<AnalysisKind::solid>(mesh, block, material, mapping, stabilisation);
}

}  // namespace solidus::mechanics
