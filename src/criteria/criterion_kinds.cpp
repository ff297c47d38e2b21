/// The criteria that every program has, in the order of the reference page.
#include "criteria/criterion_kind.hpp"
#include "criteria/die_life.hpp"
#include "criteria/die_wear.hpp"
#include "criteria/feeding.hpp"
#include "criteria/freezing.hpp"
#include "criteria/gas_pores.hpp"
#include "criteria/local_properties.hpp"
#include "criteria/mush_strain.hpp"
#include "criteria/pools.hpp"
#include "criteria/quantities.hpp"
#include "criteria/resolution.hpp"
#include "criteria/soldering.hpp"
#include "criteria/strain_criteria.hpp"

namespace solidus::criteria {

namespace {

struct FreezingKind {
  static constexpr auto fields = criteria::fields::k_of_freezing;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const {
    if (c.heat == nullptr) return nullptr;
    return std::make_unique<Freezing>(c.mesh, c.kind, c.heat->storage(),
                                      FreezingOptions{.evaluation = c.evaluation, .bodies = c.followed});
  }
};

/// Shows no field: the errors of answers are estimated with it.
struct ResolutionKind {
  static constexpr std::array<const quantities::Quantity*, 0> fields = {};
  std::unique_ptr<Criterion> make(const CriterionContext& c) const {
    if (c.heat == nullptr) return nullptr;
    return std::make_unique<Resolution>(c.mesh, c.kind, c.followed);
  }
};

struct PoolsKind {
  static constexpr auto fields = criteria::fields::k_of_pools;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const {
    if (c.heat == nullptr) return nullptr;
    return std::make_unique<Pools>(
        c.mesh, c.heat->storage(),
        PoolOptions{.limit = c.feeding_limit, .feeders = c.feeders, .bodies = c.followed});
  }
};

bool follows_feeding(const CriterionContext& c) {
  return c.heat != nullptr && !c.mechanics && c.feeding && Feeding::has_shrinkage(c.materials, c.followed);
}

/// Feeding with heat alone. With mechanics, mixed elements feed and open pores.
struct FeedingKind {
  static constexpr auto fields = criteria::fields::k_of_feeding;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const {
    if (!follows_feeding(c)) return nullptr;
    return std::make_unique<Feeding>(c.mesh, c.kind, c.heat->storage(), c.feeding_options);
  }
};

/// Gas where feeding does not follow it.
struct GasKind {
  static constexpr auto fields = criteria::fields::k_of_gas;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const {
    if (c.heat == nullptr || follows_feeding(c)) return nullptr;
    return GasPores::make(c.mesh, c.heat->storage(), c.followed, c.feeding_options.gas);
  }
};

struct StrainKind {
  static constexpr auto fields = criteria::fields::k_of_strain;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const {
    if (!c.mechanics) return nullptr;
    return std::make_unique<StrainCriteria>(c.mesh, c.kind, c.materials, c.temperature);
  }
};

/// Hot tears of the strain that mush takes.
struct MushStrainKind {
  static constexpr auto fields = criteria::fields::k_of_mush_strain;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const {
    if (!c.mechanics || c.heat == nullptr || !MushStrain::has_something_to_say(c.materials)) return nullptr;
    return std::make_unique<MushStrain>(c.mesh, c.kind, c.materials);
  }
};

/// Strength and grain of metals whose cards have tables of them.
struct LocalPropertiesKind {
  static constexpr auto fields = criteria::fields::k_of_local_properties;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const { return LocalProperties::make(c); }
};

/// Fatigue of dies that the case gives constants of.
struct DieLifeKind {
  static constexpr auto fields = criteria::fields::k_of_die_life;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const { return DieLife::make(c); }
};

/// Wear of dies from shot to shot.
struct DieWearKind {
  static constexpr auto fields = criteria::fields::k_of_die_wear;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const { return DieWear::make(c); }
};

/// Dies that are hot enough for metal to stick to them.
struct SolderingKind {
  static constexpr auto fields = criteria::fields::k_of_soldering;
  std::unique_ptr<Criterion> make(const CriterionContext& c) const { return Soldering::make(c); }
};

}  // namespace

std::vector<std::unique_ptr<const CriterionKind>>& criterion_kinds() {
  static std::vector<std::unique_ptr<const CriterionKind>> kinds = [] {
    std::vector<std::unique_ptr<const CriterionKind>> all;
    all.push_back(std::make_unique<CriterionKindOf<FreezingKind>>());
    all.push_back(std::make_unique<CriterionKindOf<ResolutionKind>>());
    all.push_back(std::make_unique<CriterionKindOf<PoolsKind>>());
    all.push_back(std::make_unique<CriterionKindOf<FeedingKind>>());
    all.push_back(std::make_unique<CriterionKindOf<GasKind>>());
    all.push_back(std::make_unique<CriterionKindOf<StrainKind>>());
    all.push_back(std::make_unique<CriterionKindOf<MushStrainKind>>());
    all.push_back(std::make_unique<CriterionKindOf<LocalPropertiesKind>>());
    all.push_back(std::make_unique<CriterionKindOf<DieLifeKind>>());
    all.push_back(std::make_unique<CriterionKindOf<DieWearKind>>());
    all.push_back(std::make_unique<CriterionKindOf<SolderingKind>>());
    return all;
  }();
  return kinds;
}

}  // namespace solidus::criteria
