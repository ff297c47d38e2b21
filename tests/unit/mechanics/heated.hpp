/// A solved step whose structural heat can be asked for.
#pragma once

#include "body.hpp"
#include "mechanics/structural_heat.hpp"

namespace solidus::test {

/// As Solved, of a phase that knew before: it keeps what structural heat needs from when one is made.
struct Heated {
  std::unique_ptr<mechanics::MechanicalPhase> phase;
  mechanics::StructuralHeat announced;
  mechanics::MechanicalState state;
  mechanics::MechanicalReport report;

  explicit Heated(const Body& body)
      : phase(body.phase()),
        announced(*phase, mechanics::StructuralForm::entropy),
        state(phase->initial_state()) {
    step(body, 1.0, 1.0);
  }
  void step(const Body& body, double time, double dt) {
    const mechanics::MechanicalState old = state;
    report = phase->solve(old, state, body.temperature, time, dt);
  }
};

}  // namespace solidus::test
