/// A criterion: a result for the foundry engineer that accumulates while the casting freezes.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "criteria/criteria_state.hpp"
#include "criteria/plate_times.hpp"
#include "heat/loads/thermal_state.hpp"
#include "mechanics/state/mechanical_state.hpp"
#include "quantities/quantity.hpp"

namespace solidus::criteria {

/// A committed state, as criteria see it.
struct CriterionInput {
  double time = 0;                              ///< [s]
  const heat::ThermalState& heat;               ///< empty without a thermal phase
  const mechanics::MechanicalState& mechanics;  ///< empty without a mechanical phase
  /// f_S of the materials around each node that can melt, 1 if none can; [local node], ghosts up to date.
  /// Empty without a thermal phase. Criteria fills it in.
  std::span<const double> solid_fraction = {};
  /// heat::ThermalPhase::plateau_share: the share of isothermal changes of any material that is done at their
  /// nodes. Empty without one. Criteria fills it in.
  std::span<const double> plateau_share = {};
  /// Depth of wear by contact at this moment [m], [local node], of owned nodes; empty where nothing wears,
  /// and in Criterion::fill. Criteria fills it in.
  std::span<const double> wear = {};
  /// The same as plateau_share of a node; one without any such change.
  double plateau_at(std::size_t node) const { return plateau_share.empty() ? 1.0 : plateau_share[node]; }
};

/// A number for the summary, with where it was found.
struct CriterionResult {
  std::string name, unit;  ///< "niyama_min", SI
  double value = 0;
  bool somewhere = false;  ///< `where` says where
  mesh::Point where = {};  ///< [m]
};

/// Names of the least and of the largest value of a field among the findings: "niyama_min", "niyama_max".
inline std::string least_of(const quantities::Quantity& field) {
  return std::string(field.name) + "_min";
}
inline std::string largest_of(const quantities::Quantity& field) {
  return std::string(field.name) + "_max";
}

/// Name of the share of the castings in which a field is beyond its threshold: "tearing_tendency_beyond".
inline std::string beyond(const quantities::Quantity& field) {
  return std::string(field.name) + "_beyond";
}

class Criterion {
 public:
  virtual ~Criterion() = default;
  /// The record at the start of a run. Collective.
  virtual CriterionRecord initial(const CriterionInput& start) const = 0;
  /// The record where other castings come while some stay: as at the start, with what is to be kept of the
  /// record before. Collective.
  virtual CriterionRecord restart(const CriterionRecord& /*before*/, const CriterionInput& start) const {
    return initial(start);
  }
  /// The record where another shot begins, of a record at the end of the one before: as at the start, with
  /// what is to be kept of dies. Collective.
  virtual CriterionRecord next_shot(const CriterionRecord& /*before*/, const CriterionInput& start) const {
    return initial(start);
  }
  /// A step from `old` to `next` was committed: brings the record from t_n to t_{n+1}. Phases that the
  /// criterion knows have just reached `next`. Collective. Neither throws nor depends on anything but its
  /// arguments: a run that is continued goes the same way.
  virtual void step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) = 0;
  /// The fields that the criterion shows: rows of its kind (criterion_kind.hpp). Values are finite always;
  /// where a criterion says nothing (yet) they are the row's mark for no value, or zero.
  virtual std::span<const quantities::Quantity* const> fields() const = 0;
  /// Values of all fields at this moment, in their order; each span has the shape of a CriterionColumn.
  /// Collective.
  virtual void fill(const CriterionInput& now, const CriterionRecord& record,
                    std::span<const std::span<double>> values) const = 0;
  /// Returns the findings for the summary at the end; the same on every process. Collective.
  virtual std::vector<CriterionResult> findings(const CriterionRecord& /*record*/) const { return {}; }
  /// Tells how long plates take in the moulds of a run, before its first step. Most criteria need not know.
  /// @param plates  [body]
  virtual void know_plates(std::span<const PlateTimes> /*plates*/) {}
  virtual std::size_t bytes() const { return 0; }
};

}  // namespace solidus::criteria
