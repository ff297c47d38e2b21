/// A criterion as a plug-in: the fields that it shows and how it is made. A criterion describes itself by a
/// struct in its own file:
///
///   struct HotTearing {
///     static constexpr std::array fields = {&k_tearing_rate};  // its rows (quantities/quantity.hpp)
///     std::unique_ptr<Criterion> make(const CriterionContext& c) const;  // null: it has nothing to follow
///   };
///   const AddCriterion<HotTearing> k_hot_tearing;  // at namespace scope: every run that freezes follows it
///
/// Those of every program are criteria/kinds/NAME.cpp with a function in place of the last line:
///
///   SharedCriterionKind criterion_NAME() { return std::make_shared<CriterionKindOf<HotTearing>>(); }
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "criteria/criterion.hpp"
#include "criteria/die_limits.hpp"
#include "criteria/fatigue_law.hpp"
#include "criteria/feeding_graph.hpp"
#include "heat/thermal_phase.hpp"
#include "material/local_law.hpp"
#include "material/material.hpp"

namespace solidus::criteria {

/// The parts of a run that a criterion is made of. References outlive the criterion.
struct CriterionContext {
  const mesh::Mesh& mesh;
  AnalysisKind kind;
  const std::vector<material::Material>& materials;  ///< [body]
  const heat::ThermalPhase* heat;                    ///< null: there is none
  bool mechanics;                                    ///< there is a mechanical phase
  std::vector<double> temperature;                   ///< without a thermal phase [K], [local node]
  std::vector<char> followed;                        ///< bodies that are poured or may melt, [body]
  double evaluation, feeding_limit;                  ///< criteria.evaluation and criteria.feeding_limit
  std::vector<std::string> feeders;                  ///< groups of the mesh
  bool feeding = false;                              ///< feeding.follow
  FeedingOptions feeding_options = {};
  /// Tables of strength and grain of the cards, [body]; empty: there are none.
  std::vector<std::vector<material::LocalLaw>> local_laws = {};
  /// Names of the bodies in the case, which their groups of the mesh need not have, [body].
  std::vector<std::string> names = {};
  /// Fatigue of dies, [body]; empty: none is followed.
  std::vector<std::optional<FatigueLaw>> fatigue = {};
  /// Limits of wear and soldering of dies, [body]; empty: none are followed.
  std::vector<DieLimits> die_limits = {};
  /// All elements, of which `mesh` has those that are active; null: the same.
  const mesh::Mesh* all_elements = nullptr;
  const mesh::Mesh& whole() const { return all_elements != nullptr ? *all_elements : mesh; }
};

class CriterionKind {
 public:
  virtual ~CriterionKind() = default;
  virtual std::span<const quantities::Quantity* const> fields() const = 0;
  /// Criteria come in the order of these numbers, in runs and on the reference page.
  virtual int place() const = 0;
  /// Whether a run has the fields only where a card, or the case, has the data that they follow from.
  virtual bool from_data() const = 0;
  /// Returns null where the criterion has nothing to follow, as one of strains without mechanics. Throws
  /// InputError with no place for a feeder that is no group of the mesh. Collective.
  virtual std::unique_ptr<Criterion> make(const CriterionContext& c) const = 0;
};

using SharedCriterionKind = std::shared_ptr<const CriterionKind>;

/// The place of a criterion that does not give one: behind those of every program.
inline constexpr int k_last_place = 1000;

/// @tparam Description  may also have `static constexpr int place` and `static constexpr bool from_data`
template <class Description>
class CriterionKindOf final : public CriterionKind {
 public:
  std::span<const quantities::Quantity* const> fields() const override { return Description::fields; }
  int place() const override {
    if constexpr (requires { Description::place; }) return Description::place;
    return k_last_place;
  }
  bool from_data() const override {
    if constexpr (requires { Description::from_data; }) return Description::from_data;
    return false;
  }
  std::unique_ptr<Criterion> make(const CriterionContext& c) const override { return Description{}.make(c); }
};

/// All kinds, built in and added, in the order of their places.
const std::vector<SharedCriterionKind>& criterion_kinds();

/// Throws std::logic_error where another criterion has a field of the same name.
void add_criterion(SharedCriterionKind kind);

/// Adds a criterion while the program starts, as an object at namespace scope.
template <class Description>
struct AddCriterion {
  AddCriterion() { add_criterion(std::make_shared<CriterionKindOf<Description>>()); }
};

}  // namespace solidus::criteria
