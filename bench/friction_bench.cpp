/// Nanoseconds per point of the laws of friction and of the interface's heat balance.
///
///   ./friction_bench
#include <benchmark/benchmark.h>

#include <random>
#include <utility>
#include <vector>

#include "contact/interface/interface_thermodynamics.hpp"

namespace solidus::contact {
namespace {

constexpr std::size_t k_points = 1024;
constexpr double k_penalty = 1e11, k_capacity = 500;

const std::vector<Table> k_eg{0.157, -0.315e-1, 0.104e-1, -0.821e-3, 0.289e-4, -0.410e-6};  // table 7.5
const std::vector<Table> k_thermal{Table({280, 600, 1200}, {0.2, 0.15, 0.1}),
                                   Table({280, 600, 1200}, {0.05, 0.02, -0.03})};

FrictionLaw law(std::vector<Table> terms, InternalVariable variable = InternalVariable::normal_work) {
  FrictionParameters spec;
  spec.coefficient.terms = std::move(terms);
  spec.coefficient.unit = 1e6;
  spec.internal_variable = variable;
  return FrictionLaw(spec, k_penalty, k_capacity);
}
FrictionLaw table() {
  FrictionParameters spec;
  spec.coefficient.curves = {{0, Table({0, 1, 2, 4, 6, 8}, {0.157, 0.136, 0.13, 0.16, 0.2, 0.251})}};
  spec.coefficient.unit = 1e6;
  return FrictionLaw(spec, k_penalty, k_capacity);
}

/// Points under 10 to 40 MPa; `trial` in parts of the limit of friction.
std::vector<FrictionInput> points(double trial) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<FrictionInput> in(k_points);
  for (FrictionInput& p : in) {
    p.pressure = 1e7 + 3e7 * uniform(random);
    p.trial = 0.12 * p.pressure * trial * (0.9 + 0.2 * uniform(random));
    p.internal_variable = 6e6 * uniform(random);
    p.temperature = 300 + 500 * uniform(random);
  }
  return in;
}

template <class Solve>
void time_points(benchmark::State& state, double trial, Solve solve) {
  const auto in = points(trial);
  for (auto _ : state)
    for (const FrictionInput& p : in) benchmark::DoNotOptimize(solve(p));
  state.counters["s/point"] = benchmark::Counter(
      k_points, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
void time_law(benchmark::State& state, const FrictionLaw& law, double trial) {
  time_points(state, trial, [&](const FrictionInput& p) { return law.update(p); });
}

void stick(benchmark::State& state) {
  time_law(state, law({0.2}), 0.5);
}
void slip_constant(benchmark::State& state) {
  time_law(state, law({0.1}), 5);
}
void slip_polynomial(benchmark::State& state) {
  time_law(state, law(k_eg), 5);
}
void slip_frictional_work(benchmark::State& state) {
  time_law(state, law(k_eg, InternalVariable::frictional_work), 5);
}
void slip_table(benchmark::State& state) {
  time_law(state, table(), 5);
}
void slip_thermal(benchmark::State& state) {
  time_law(state, law(k_thermal), 5);
}
void slip_isentropic(benchmark::State& state) {
  const auto thermal = law(k_thermal);
  time_points(state, 5, [&](const FrictionInput& p) { return thermal.isentropic(p); });
}
void balance(benchmark::State& state) {
  time_points(state, 5, [&](const FrictionInput& p) {
    return interface_balance({0.1, k_capacity, p.temperature, 0.2, 0.1 * p.pressure * 1e-4},
                             {{p.temperature + 10, p.temperature - 50}, {3000, 4000}});
  });
}
void return_mapping(benchmark::State& state) {
  const auto thermal = law(k_thermal);
  time_points(state, 5, [&](const FrictionInput& p) {
    return interface_return_mapping(thermal, p, 0.1,
                                    {{p.temperature + 10, p.temperature - 50}, {3000, 4000}});
  });
}
BENCHMARK(stick);
BENCHMARK(slip_constant);
BENCHMARK(slip_polynomial);
BENCHMARK(slip_frictional_work);
BENCHMARK(slip_table);
BENCHMARK(slip_thermal);
BENCHMARK(slip_isentropic);
BENCHMARK(balance);
BENCHMARK(return_mapping);

}  // namespace
}  // namespace solidus::contact

BENCHMARK_MAIN();
