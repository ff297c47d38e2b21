#include "build/criteria_input.hpp"

#include <algorithm>

#include "build/cast_bodies.hpp"
#include "criteria/criteria.hpp"
#include "criteria/criterion_kind.hpp"

namespace solidus::model {

std::unique_ptr<criteria::Criteria> make_criteria(const CaseSpec& spec, const mesh::Mesh& mesh,
                                                  const std::vector<material::Material>& materials,
                                                  const std::vector<InitialTemperatureRange>& start,
                                                  const coupling::Phases& phases) {
  const bool melts = std::any_of(materials.begin(), materials.end(),
                                 [](const material::Material& m) { return m.solidification() != nullptr; });
  if (!spec.criteria.follow || !melts || spec.time.steady) return nullptr;
  const criteria::CriterionContext context{
      .mesh = mesh,
      .kind = spec.analysis.kind,
      .materials = materials,
      .heat = phases.heat,
      .mechanics = phases.mechanics != nullptr,
      .temperature = phases.heat != nullptr ? std::vector<double>{} : phases.temperature,
      .followed = followed_bodies(spec, materials, start),
      .evaluation = spec.criteria.evaluation,
      .feeding_limit = spec.criteria.feeding_limit,
      .feeders = spec.criteria.feeders};
  auto all = std::make_unique<criteria::Criteria>(phases.heat);
  for (const auto& kind : criteria::criterion_kinds()) {
    try {
      if (std::unique_ptr<criteria::Criterion> criterion = kind->make(context))
        all->add(std::move(criterion));
    } catch (const InputError& error) {
      throw InputError(spec.criteria.where, error.what(),
                       "groups of the mesh: `solidus mesh-info` lists them");
    }
  }
  return all;
}

}  // namespace solidus::model
