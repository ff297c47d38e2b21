/// Nanoseconds per lane (eight numbers): exp, log, pow and sqrt as vectors and number by number, property
/// tables and phase fractions.
///
///   ./numbers_bench
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

#include "material/phase_change.hpp"
#include "numbers/table.hpp"

namespace solidus {
namespace {

constexpr std::size_t k_packs = 128;  ///< fits the first cache, too long for a branch predictor to learn

PackVector<Lane> arguments(double low, double high) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(low, high);
  PackVector<Lane> x(k_packs);
  for (Lane& pack : x)
    for (int i = 0; i < k_lanes; ++i) pack.set(i, uniform(random));
  return x;
}

template <class Function>
void time_lanes(benchmark::State& state, const PackVector<Lane>& x, Function f) {
  for (auto _ : state)
    for (const Lane& pack : x) benchmark::DoNotOptimize(f(pack));
  state.counters["s/lane"] = benchmark::Counter(
      k_packs, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void exp_of_lane(benchmark::State& state) {
  time_lanes(state, arguments(-20, 20), [](Lane x) { return exp(x); });
}
void exp_of_numbers(benchmark::State& state) {
  time_lanes(state, arguments(-20, 20),
             [](const Lane& x) { return for_each_lane(x, [](double a) { return std::exp(a); }); });
}
void log_of_lane(benchmark::State& state) {
  time_lanes(state, arguments(1e-6, 100), [](Lane x) { return log(x); });
}
void log_of_numbers(benchmark::State& state) {
  time_lanes(state, arguments(1e-6, 100),
             [](const Lane& x) { return for_each_lane(x, [](double a) { return std::log(a); }); });
}
void pow_of_lane(benchmark::State& state) {
  time_lanes(state, arguments(1e-6, 100), [](Lane x) { return pow(x, 4.7); });
}
void pow_of_numbers(benchmark::State& state) {
  time_lanes(state, arguments(1e-6, 100),
             [](const Lane& x) { return for_each_lane(x, [](double a) { return std::pow(a, 4.7); }); });
}
void sqrt_of_lane(benchmark::State& state) {
  time_lanes(state, arguments(0, 100), [](Lane x) { return sqrt(x); });
}
BENCHMARK(exp_of_lane);
BENCHMARK(exp_of_numbers);
BENCHMARK(log_of_lane);
BENCHMARK(log_of_numbers);
BENCHMARK(pow_of_lane);
BENCHMARK(pow_of_numbers);
BENCHMARK(sqrt_of_lane);

constexpr double k_cold = 300, k_hot = 1000;  ///< [K]

/// A smooth property between 300 and 1000 K; the points are not equally spaced.
Table property(std::size_t pieces) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double s = static_cast<double>(i) / static_cast<double>(pieces);
    x.push_back(k_cold + (k_hot - k_cold) * s * (1.5 - 0.5 * s));
    y.push_back(200 - 80 * s * s);
  }
  return Table(x, y);
}

void table_line(benchmark::State& state) {
  const Table table = property(static_cast<std::size_t>(state.range(0)));
  time_lanes(state, arguments(k_cold - 20, k_hot + 20), [&](const Lane& x) { return table.line(x); });
}
void table_line_by_numbers(benchmark::State& state) {
  const Table table = property(static_cast<std::size_t>(state.range(0)));
  time_lanes(state, arguments(k_cold - 20, k_hot + 20), [&](const Lane& x) {
    Table::Line<Lane> line;
    for (int i = 0; i < k_lanes; ++i) {
      const Table::Line<double> at = table.line(x[i]);
      line.value.set(i, at.value);
      line.slope.set(i, at.slope);
    }
    return line;
  });
}
BENCHMARK(table_line)->Arg(1)->Arg(3)->Arg(6)->Arg(10)->Arg(14)->Arg(20)->Arg(100);
BENCHMARK(table_line_by_numbers)->Arg(1)->Arg(3)->Arg(6)->Arg(20)->Arg(100);

void phase_fraction(benchmark::State& state, const material::PhaseFraction& fraction) {
  time_lanes(state, arguments(fraction.solidus() - 10, fraction.liquidus() + 10),
             [&](const Lane& t) { return fraction.line(t); });
}
BENCHMARK_CAPTURE(phase_fraction, linear, material::PhaseFraction::linear(860, 900));
BENCHMARK_CAPTURE(phase_fraction, scheil, material::PhaseFraction::scheil(933, 886, 821, 0.14));

}  // namespace
}  // namespace solidus

BENCHMARK_MAIN();
