/// Watches the temperatures of each body and warns once when a property is used outside the range of its
/// source.
///
/// A property counts where it acts: those of the solid (elasticity, expansion, flow) where something is
/// solid, up to the solidus, and in bodies that deform; none of them in an analysis of heat alone. A
/// twentieth beyond the range, or 10 K, is no reason to warn: tables go on with their end values.
#pragma once

#include <string>
#include <vector>

#include "coupling/observer.hpp"
#include "setup/assembly.hpp"

namespace solidus::run {

/// Returns a warning about properties that a body at these temperatures [K] uses outside of their data: one
/// text for all that are not among `said`, to which they are added; empty: there are none. Throws InputError
/// for a table whose extrapolation is an error.
std::string left_data(const cases::CaseSpec& spec, std::size_t body, const material::Material& material,
                      double low, double high, std::vector<std::string>& said);

class RangeWatch : public coupling::Observer {
 public:
  RangeWatch(const cases::CaseSpec& spec, const setup::Assembly& a)
      : spec_(spec), a_(a), warned_(spec.bodies.size()) {}
  void begin(const coupling::State& state) override { look(state); }
  void step(const coupling::StepRecord&, const coupling::State& state) override { look(state); }
  void stopped(const coupling::Stop&, const coupling::State&) override {}
  void end(const coupling::State&) override {}

 private:
  void look(const coupling::State& state);

  const cases::CaseSpec& spec_;
  const setup::Assembly& a_;
  std::vector<std::vector<std::string>> warned_;
};

}  // namespace solidus::run
