/// Nanoseconds per point of the constitutive update, stress, history and tangent together, for numbers and
/// for packs of eight lanes (per lane).
///
///   ./material_bench        (build with -DSOLIDUS_MARCH=native for the numbers of docs/log/benchmarks.md)
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>
#include <vector>

#include "material/derivatives/isentropic.hpp"
#include "material/laws/hardening_law.hpp"
#include "material/laws/perzyna.hpp"
#include "material/viscoplastic.hpp"

namespace solidus::material {
namespace {

constexpr double k_cold = 600, k_hot = 1100;  ///< [K], solid and liquid
constexpr std::size_t k_points = 64;          ///< 23 KiB of properties, history and strain: the first cache

Material casting() {
  Material m;
  m.density = 2650;
  m.specific_heat = 1000;
  m.young_modulus = Table({300, 800}, {70e9, 40e9});
  m.poisson_ratio = 0.33;
  m.expansion = 2.4e-5;
  m.liquid_viscosity = 1e3;
  m.phase_changes = {{"solidification", PhaseFraction::linear(880, 930), 4e5, -0.06, true}};
  return m;
}

Material casting(IsotropicHardening isotropic, double viscosity, double exponent,
                 KinematicHardening kinematic = KinematicHardening::none) {
  Material m = casting();
  Flow& flow = m.flow.emplace();
  flow.flow_stress = Table({300, 900}, {80e6, 10e6});
  flow.isotropic = isotropic;
  set_hardening(flow, {{"hardening_modulus", 0.5e9},
                       {"saturation_stress", 150e6},
                       {"saturation_rate", 40},
                       {"reference_strain", 2e-3},
                       {"hardening_exponent", 0.2}});
  flow.kinematic = kinematic;
  flow.kinematic_modulus = 5e9;
  flow.recall[0] = 100;
  flow.rate[Perzyna::viscosity] = viscosity;
  flow.rate[Perzyna::exponent] = exponent;
  flow.rate[Perzyna::drag_stress] = 50e6;
  if (isotropic == IsotropicHardening::table)
    flow.curves = FlowCurves({0, 1e-3, 5e-3, 0.02, 0.1}, {300, 900},
                             {80e6, 95e6, 110e6, 130e6, 150e6, 10e6, 12e6, 13e6, 14e6, 15e6});
  return m;
}

/// Points with a history and a strain that is new: 1e-4 elastic, 4e-3 plastic everywhere.
template <class Law, class T>
struct Points {
  struct Point {
    typename Law::template Properties<T> properties;
    Viscoplastic::State<T> start;
    Sym<T> strain;
  };
  std::vector<Point> points;
  static constexpr std::size_t lanes = sizeof(T) / sizeof(double);

  Points(const Law& law, double temperature, double amplitude) : points(k_points / lanes) {
    double phase = 0;
    const auto wave = [&](double size) {
      double values[lanes];
      for (double& value : values) value = size * std::sin(phase += 0.7);
      T number(0.0);
      __builtin_memcpy(static_cast<void*>(&number), values, sizeof number);
      return number;
    };
    for (Point& p : points) {
      p.properties = law.properties_at(T(temperature) + wave(20.0), T(temperature));
      for (int i = 0; i < 6; ++i) {
        p.strain[i] = wave(1e-5);
        p.start.plastic_strain[i] = wave(1e-5);
        p.start.back_strain[i] = wave(1e-5);
      }
      // A common part, so that every point is on the same side of the yield surface.
      p.strain[0] += T(amplitude);
      p.strain[1] -= T(0.5 * amplitude);
      p.strain[2] -= T(0.5 * amplitude);
      p.start.plastic_strain = dev(p.start.plastic_strain);
      p.start.back_strain = dev(p.start.back_strain);
      p.start.hardening = T(1e-3) + wave(1e-4);
      if constexpr (std::is_same_v<Law, Isentropic>) {
        for (int i = 0; i < 3; ++i) p.strain[i] += T(amplitude / 3);  // cools by kelvins
        p.properties.entropy = law.entropy(p.properties, Sym<T>{}, p.start);
      }
    }
  }
};

template <class Law, class T>
void update(benchmark::State& state, const Material& material, double temperature, double amplitude) {
  const Law law(material);
  const Points<Law, T> set(law, temperature, amplitude);
  for (auto _ : state)
    for (const auto& p : set.points) {
      auto response = law.update(p.properties, p.start, p.strain, 0.1);
      benchmark::DoNotOptimize(response);  // all of it: in memory
    }
  state.counters["per_point"] =
      benchmark::Counter(static_cast<double>(k_points),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <class Law = Viscoplastic>
void both(const char* name, const Material& material, double temperature, double amplitude) {
  const std::string stem(name);
  benchmark::RegisterBenchmark((stem + "/scalar").c_str(), [=](benchmark::State& s) {
    update<Law, double>(s, material, temperature, amplitude);
  });
  benchmark::RegisterBenchmark((stem + "/packed").c_str(), [=](benchmark::State& s) {
    update<Law, Lane>(s, material, temperature, amplitude);
  });
}

void register_all() {
  using enum IsotropicHardening;
  constexpr double k_elastic = 1e-4, k_plastic = 4e-3;
  both("no_flow", casting(), k_cold, k_plastic);
  both("elastic", casting(linear, 0, 1), k_cold, k_elastic);
  both("plastic_none", casting(none, 0, 1), k_cold, k_plastic);
  both("plastic_linear", casting(linear, 0, 1), k_cold, k_plastic);
  both("plastic_saturation", casting(saturation, 0, 1), k_cold, k_plastic);
  both("plastic_power", casting(power, 0, 1), k_cold, k_plastic);
  both("plastic_table", casting(table, 0, 1), k_cold, k_plastic);
  both("perzyna_n1", casting(saturation, 1e9, 1), k_cold, k_plastic);
  both("perzyna_n5", casting(linear, 1e9, 5), k_cold, k_plastic);
  both("armstrong_frederick", casting(linear, 0, 1, KinematicHardening::armstrong_frederick), k_cold,
       k_plastic);
  both<Isentropic>("isentropic_no_flow", casting(), k_cold, k_elastic);
  both<Isentropic>("isentropic_elastic", casting(linear, 0, 1), k_cold, k_elastic);
  both<Isentropic>("isentropic_linear", casting(linear, 0, 1), k_cold, k_plastic);
  both<Isentropic>("isentropic_saturation", casting(saturation, 0, 1), k_cold, k_plastic);
  both<Isentropic>("isentropic_n3", casting(linear, 1e9, 3), k_cold, k_plastic);
  both<Isentropic>("isentropic_armstrong_frederick",
                   casting(linear, 0, 1, KinematicHardening::armstrong_frederick), k_cold, k_plastic);
  both("liquid", casting(linear, 0, 1), k_hot, k_plastic);
}

}  // namespace
}  // namespace solidus::material

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  solidus::material::register_all();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
