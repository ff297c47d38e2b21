/// The isentropic split in two halves of the step, a scheme that the sources do not have.
#pragma once
#include "coupling/add_scheme.hpp"
#include "coupling/isentropic_split.hpp"

namespace solidus::coupling {

class HalvedSplit final : public CouplingScheme {
 public:
  explicit HalvedSplit(const Phases& phases) : split_(phases, {.order = PhaseOrder::heat_first}) {}
  void synchronise(const State& state) override { split_.synchronise(state); }
  void forget() override { split_.forget(); }
  StepEffort advance(const State& old, State& trial, double time, double dt) override {
    State half;
    StepEffort effort = split_.advance(old, half, time - 0.5 * dt, 0.5 * dt);
    const contact::InterfaceSums first = effort.energy.interface;
    effort += split_.advance(half, trial, time, 0.5 * dt);
    effort.energy.interface.add(first);
    return effort;
  }

 private:
  IsentropicSplit split_;
};
struct HalvedScheme {
  static constexpr std::string_view name = "halved", doc = "the isentropic split, twice a step";
  SchemeTraits traits() const { return {.leaves_stepping = true, .effort = 2}; }
  std::optional<Objection> objection(const SchemeContext& c) const {
    if (c.inertia) return Objection{"the halved split has no inertia", "no [dynamics]"};
    return std::nullopt;
  }
  std::unique_ptr<CouplingScheme> make(const Phases& phases, const SchemeContext&) const {
    return std::make_unique<HalvedSplit>(phases);
  }
};

inline const AddScheme<HalvedScheme> k_halved_scheme;

}  // namespace solidus::coupling
