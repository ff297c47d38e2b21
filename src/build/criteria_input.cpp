#include "build/criteria_input.hpp"

#include <algorithm>

#include "build/cast_bodies.hpp"
#include "criteria/freezing.hpp"
#include "criteria/pools.hpp"
#include "criteria/resolution.hpp"
#include "criteria/strain_criteria.hpp"

namespace solidus::model {

std::unique_ptr<criteria::Criteria> make_criteria(const CaseSpec& spec, const mesh::Mesh& mesh,
                                                  const std::vector<material::Material>& materials,
                                                  const std::vector<InitialTemperatureRange>& start,
                                                  const coupling::Phases& phases) {
  const bool melts = std::any_of(materials.begin(), materials.end(),
                                 [](const material::Material& m) { return m.solidification() != nullptr; });
  if (!spec.criteria.follow || !melts || spec.time.steady) return nullptr;
  auto all = std::make_unique<criteria::Criteria>(phases.heat);
  if (phases.heat != nullptr) {
    const heat::NodalEnthalpy& storage = phases.heat->storage();
    const std::vector<char> followed = followed_bodies(spec, materials, start);
    all->add(std::make_unique<criteria::Freezing>(
        mesh, spec.analysis.kind, storage,
        criteria::FreezingOptions{.evaluation = spec.criteria.evaluation, .bodies = followed}));
    all->add(std::make_unique<criteria::Resolution>(mesh, spec.analysis.kind, followed));
    try {
      all->add(std::make_unique<criteria::Pools>(
          mesh, storage,
          criteria::PoolOptions{
              .limit = spec.criteria.feeding_limit, .feeders = spec.criteria.feeders, .bodies = followed}));
    } catch (const InputError& error) {
      throw InputError(spec.criteria.where, error.what(),
                       "groups of the mesh: `solidus mesh-info` lists them");
    }
  }
  if (phases.mechanics != nullptr)
    all->add(std::make_unique<criteria::StrainCriteria>(
        mesh, spec.analysis.kind, materials,
        phases.heat != nullptr ? std::vector<double>{} : phases.temperature));
  return all;
}

}  // namespace solidus::model
