/// Measures of a case on its mesh: bodies, skins, pours with an estimate of their freezing time, and an
/// estimate of the cost of the run. Findings and the table of `check` read them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "check/body_measures.hpp"
#include "check/freezing_estimate.hpp"
#include "criteria/plate_times.hpp"
#include "setup/assembly.hpp"
#include "setup/skin_measures.hpp"

namespace solidus::check {

/// A body that can freeze and is liquid at the start.
struct Pour {
  std::size_t body = 0;
  double cooled_area = 0;  ///< A: skin that a contact, film, radiation, shared face or temperature cools [m²]
  double depth = 0;        ///< greatest distance of a node from the cooled skin [m]
  double local_modulus = 0;  ///< V/A around the place of that depth; zero: not known [m]
  double spanned = 0;        ///< share of its volume in elements that reach from cooled skin to cooled skin
  double conductance = 0;    ///< mean over A at the start, closed [W/(m² K)]; zero: nothing cools
  /// The reason why there is no estimate; empty: there is one.
  std::string no_estimate;
  FreezingEstimate freezing;         ///< with the heat of what is poured with it
  std::optional<double> alone_time;  ///< until it would be solid without that heat [s]
  criteria::PlateTimes plates;       ///< of its metal in its mould
};

/// Estimate of time and memory of a run, from the number of its steps and nodes (docs/guide/findings.md
/// states its accuracy).
struct Effort {
  double steps = 0;
  bool steps_known = true;
  double seconds = 0, bytes = 0;
};

struct CaseMeasures {
  std::vector<BodyMeasures> bodies;              ///< [body]
  std::vector<setup::ContactMeasures> contacts;  ///< [contact]
  std::vector<setup::SurfaceMeasures> surfaces;  ///< [thermal condition]
  std::vector<Pour> pours;
  Effort effort;

  bool is_poured(std::size_t body) const {
    return std::ranges::any_of(pours, [&](const Pour& pour) { return pour.body == body; });
  }
  /// Returns for each body how long plates of it take to freeze in its mould; empty where it is not poured,
  /// and where the mould was filled.
  std::vector<criteria::PlateTimes> plates() const {
    std::vector<criteria::PlateTimes> by_body(bodies.size());
    for (const Pour& pour : pours) by_body[pour.body] = pour.plates;
    return by_body;
  }
};

/// Measures a case that has been built. Collective.
CaseMeasures measure(const cases::CaseSpec& spec, const setup::Assembly& a);

/// The bodies that are poured, with estimates; `m` has bodies, contacts and surfaces. Collective.
std::vector<Pour> pours(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m);

/// `m` has all but the effort. Collective.
Effort estimate_effort(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m);

}  // namespace solidus::check
