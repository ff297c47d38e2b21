/// The parts of the thermal balance without storage, each with a contract of its own.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "heat/channels/channels.hpp"
#include "heat/conduction/conduction_elements.hpp"
#include "heat/conduction/kept_conduction.hpp"
#include "heat/conduction/unsymmetric_part.hpp"
#include "heat/iteration/heat_contributions.hpp"
#include "heat/loads/body_sources.hpp"
#include "heat/loads/prescribed_nodes.hpp"
#include "heat/loads/surface_heats.hpp"
#include "heat/radiation/enclosed_surfaces.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::heat {

struct HeatParts {
  /// @param at_nodes  [body]: whether it stores its heat there
  /// Throws InputError for a condition that names no group of the mesh.
  HeatParts(const mesh::Mesh& mesh, AnalysisKind kind, const std::vector<material::Material>& materials,
            const ThermalConditions& conditions, bool closed, std::span<const char> at_nodes,
            std::vector<linear::Contribution*> terms, bool correct_edges)
      : elements(mesh, kind, closed, correct_edges, terms.empty(), materials),
        conduction(mesh, elements),
        surfaces(mesh, kind, elements.active(), closed, conditions),
        sources(mesh, kind, elements.active(), at_nodes, conditions),
        prescribed(mesh, elements.active(), conditions.temperatures),
        contributions(std::move(terms), mesh.n_owned_nodes),
        supplied(mesh.x.size()),
        n_owned(as_size(mesh.n_owned_nodes)) {
    enclosed.set(mesh, kind, elements.active(), closed, conditions);
    channels.set(mesh, kind, elements.active(), closed, conditions);
  }

  ConductionElements elements;  ///< with the bodies that are active in the present stage
  KeptConduction conduction;
  SurfaceHeats surfaces;
  EnclosedSurfaces enclosed;  ///< those of `surfaces` that see each other
  Channels channels;
  BodySources sources;
  PrescribedNodes prescribed;
  HeatContributions contributions;
  /// ∂r/∂v less what the matrix has, of the last HeatSystem::assemble_symmetric(); not what the limits of
  /// conduction hold back.
  UnsymmetricPart unsymmetric;
  /// By surfaces, channels and sources at the last HeatSystem::residual(), sign of r, [local node].
  std::vector<double> supplied;
  std::size_t n_owned;    ///< nodes
  bool exchanges = true;  ///< off: nothing flows, only the contributions that store are terms
};

}  // namespace solidus::heat
