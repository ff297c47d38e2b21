/// Bodies that grow element by element between the steps of a run.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "coupling/scheme.hpp"
#include "coupling/shot.hpp"
#include "coupling/state.hpp"
#include "numbers/time_events.hpp"

namespace solidus::coupling {

class Growth {
 public:
  virtual ~Growth() = default;
  /// The times at which elements are born, rising, the same on all processes [s].
  virtual const std::vector<double>& births() const = 0;
  /// Whether elements are born until a time that are not there yet.
  virtual bool due(double time) const = 0;
  /// Adds what is born until a time to the phases. Collective.
  /// @param state  gets its heat; null: it has it already
  /// Returns that heat.
  virtual BodyHeat grow(double time, State* state) = 0;
  /// The mass that has been deposited [kg]. Collective.
  virtual double mass() const = 0;
  /// Whether an element is there, by its number in the input.
  virtual bool there(std::int64_t input_element) const = 0;
  /// Whether elements are born after a time.
  bool goes_on(double time) const { return !births().empty() && births().back() > time; }
};

/// Adds what is born until the time of a state, and brings the scheme in line with it. Collective.
/// @param energy  internal energy of a state; empty where it is not followed
/// Returns the heat that has come, with the change of the internal energy.
BodyHeat let_grow(Growth& growth, CouplingScheme& scheme, const std::function<double(const State&)>& energy,
                  State& state);
/// Adds the times of birth to those at which steps end.
void add_births(const Growth& growth, std::vector<TimeEvent>& events);

}  // namespace solidus::coupling
