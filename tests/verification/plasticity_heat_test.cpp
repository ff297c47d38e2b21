/// Heat of plastic flow: a block sheared without heat coming in or out, u_x = Γ(t) y on its boundary, so that
/// its state is uniform.
///
///        ┌─────────┐ →        Γ = τ/G + √3 ξ,   √3 τ = σ_0 + K_ξ(ξ)      (von Mises in shear; errata
///        to 2.118)
///       ╱         ╱           ρC Θ̇ = D_mech = √⅔ σ_0 γ̇ = σ_0 ξ̇
///      ╱         ╱
///     ▒▒▒▒▒▒▒▒▒▒▒             what hardening stores, ∫ K_ξ dξ, does not become heat
///
/// No thermal expansion and constant moduli: nothing else exchanges heat.
#include <gtest/gtest.h>

#include "coupling_bodies.hpp"
#include "material/hardening.hpp"
#include "plasticity_bodies.hpp"

namespace solidus {
namespace {

using mechanics::StructuralForm;
using mesh::Shape;
using verification::Coupled;
using verification::CoupledRun;

constexpr double k_young = 2e11, k_poisson = 0.3, k_shear = k_young / (2 * (1 + k_poisson));  // [Pa]
constexpr double k_yield = 3e8, k_start = 300, k_capacity = 7800 * 500.0;  // [Pa], [K], [J/(m³ K)]
constexpr double k_strain = 0.3;                                           // Γ at the end
const double k_root3 = std::sqrt(3.0);

Coupled sheared(Shape shape, AnalysisKind kind, const material::Material& material, StructuralForm form) {
  Coupled c;
  c.mesh = test::make_mesh({.shape = shape, .cells = {2, 2, 2}, .distortion = 0.1});
  c.kind = kind;
  c.materials = {material};
  c.start = {k_start};
  c.form = form;
  std::vector<char> boundary(c.mesh.x.size(), 0);
  for (const auto& [name, surface] : c.mesh.surfaces)
    for (const Index node : surface.nodes) boundary[static_cast<std::size_t>(node)] = 1;
  for (const auto& [name, nodes] : c.mesh.node_sets) {
    if (name.rfind("node ", 0) != 0) continue;
    const auto node = static_cast<std::size_t>(nodes[0]);
    if (boundary[node] == 0) continue;
    c.hold(name, 0, Table({0, 1}, {0, k_strain * c.mesh.x[node][1]}));
    for (int i = 1; i < displacement_components(kind); ++i) c.hold(name, i);
  }
  return c;
}

const std::vector<std::pair<Shape, AnalysisKind>> k_blocks{{Shape::quad4, AnalysisKind::plane_strain},
                                                           {Shape::tri3, AnalysisKind::plane_strain},
                                                           {Shape::tet4, AnalysisKind::solid},
                                                           {Shape::hex8, AnalysisKind::solid}};

/// The rise of a temperature that is the same at every node.
double rise(const Coupled& c, const CoupledRun& run) {
  const auto& t = run.end.heat.temperature;
  const auto [low, high] = std::minmax_element(t.begin(), t.end());
  EXPECT_NEAR(*low, *high, 1e-7) << mesh::name(c.mesh.blocks[0].shape);
  return *low - k_start;
}

struct Hardening {
  double saturation = k_yield, rate = 0, slope = 0;  ///< σ_∞, δ, H
  double stress(double xi) const {
    return k_yield + (saturation - k_yield) * (1 - std::exp(-rate * xi)) + slope * xi;
  }
  double stored(double xi) const {
    const double saturated = rate > 0 ? xi - (1 - std::exp(-rate * xi)) / rate : 0;
    return (saturation - k_yield) * saturated + 0.5 * slope * xi * xi;
  }
  double flow(double strain) const {  ///< ξ at Γ
    double low = 0, high = strain;
    for (int i = 0; i < 100; ++i) {
      const double xi = 0.5 * (low + high);
      (stress(xi) / (k_root3 * k_shear) + k_root3 * xi < strain ? low : high) = xi;
    }
    return low;
  }
};

material::Material material_of(const Hardening& hardening) {
  material::Material m = verification::plastic_material(k_young, k_poisson, k_yield);
  if (hardening.saturation == k_yield && hardening.slope == 0) return m;
  m.flow->isotropic = material::IsotropicHardening::saturation;
  set_hardening(*m.flow, {{"saturation_stress", hardening.saturation},
                          {"saturation_rate", hardening.rate},
                          {"hardening_modulus", hardening.slope}});
  return m;
}

// The strain grows along a line, so backward Euler finds ξ without error, and D_mech Δt is σ_0 Δξ.
TEST(PlasticShearWithoutHeatFlow, WarmsByTheFlowStressTimesThePlasticStrain) {
  for (const auto& [shape, kind] : k_blocks) {
    const Hardening perfect;
    const Coupled c = sheared(shape, kind, material_of(perfect), StructuralForm::entropy);
    const double exact = k_yield * perfect.flow(k_strain) / k_capacity;
    const double computed = rise(c, verification::march(c, 1, 20));
    EXPECT_NEAR(computed, exact, 1e-8 * exact) << mesh::name(shape);
    if (shape == Shape::hex8) printf("perfect: %.6f K (closed form %.6f K)\n", computed, exact);
  }
}

TEST(PlasticShearWithoutHeatFlow, DoesNotReleaseWhatHardeningStores) {
  const Hardening hardening{6e8, 16.93, 1e9};
  const double xi = hardening.flow(k_strain), exact = k_yield * xi / k_capacity;
  const double elastic = 0.5 / k_shear * std::pow(hardening.stress(xi) / k_root3, 2);
  const double total = k_capacity * exact + hardening.stored(xi) + elastic;  // the work
  for (const auto& [shape, kind] : k_blocks) {
    const Coupled c = sheared(shape, kind, material_of(hardening), StructuralForm::entropy);
    const CoupledRun run = verification::march(c, 1, 200);
    const double computed = rise(c, run);
    EXPECT_NEAR(computed, exact, 1e-8 * exact) << mesh::name(shape);
    double work = 0;
    for (const auto& step : run.steps) work += step.work;
    // stress at the end of each step: first order, half a step of the strain times the rise of the stress
    EXPECT_NEAR(work, total, 0.005 * total) << mesh::name(shape);
    if (shape == Shape::hex8)
      printf("saturation: %.6f K (closed form %.6f K), %.1f %% of the work is stored\n", computed, exact,
             100 * hardening.stored(xi) / work);
  }
  EXPECT_GT(hardening.stored(xi), 0.2 * total);  // it is seen
}

// σ_0 falls with temperature, σ_0 = σ_00 − b (Θ − Θ_0): along ξ the distance to the temperature without
// strength decays exponentially. The mechanical phase takes σ_0 at Θ_n: first order in the step.
TEST(PlasticShearWithoutHeatFlow, WithThermalSofteningFollowsTheExponentialAtFirstOrder) {
  constexpr double k_softening = 4e5;  // b [Pa/K]
  const double room = k_yield / k_softening;
  const auto warm = [&](double xi) { return room * (1 - std::exp(-k_softening * xi / k_capacity)); };
  double low = 0, high = k_strain;
  for (int i = 0; i < 100; ++i) {
    const double xi = 0.5 * (low + high), stress = k_yield - k_softening * warm(xi);
    (stress / (k_root3 * k_shear) + k_root3 * xi < k_strain ? low : high) = xi;
  }
  const double exact = warm(low);
  material::Material m =
      verification::plastic_material(k_young, k_poisson, Table({k_start, k_start + room}, {k_yield, 0}));
  const Coupled c = sheared(Shape::quad4, AnalysisKind::plane_strain, m, StructuralForm::entropy);
  std::vector<double> errors;
  auto out = verification::table("plasticity_heat_order", "step[s],temperature[K]");
  for (const int n : {25, 50, 100, 200}) {
    errors.push_back(std::abs(rise(c, verification::march(c, 1, n)) - exact));
    out << 1.0 / n << "," << errors.back() << "\n";
    if (errors.size() == 1) continue;
    EXPECT_NEAR(verification::order(errors[errors.size() - 2], errors.back()), 1, 0.1);
  }
  printf("softening: %.4f K, error %.4f K in 200 steps\n", exact, errors.back());
  EXPECT_LT(errors.back(), 1e-2 * exact);
}

// With a Taylor–Quinney factor its share of the plastic power becomes heat whatever hardening stores; the
// rest is stored, and the internal energy of the fields holds it.
TEST(PlasticShearWithoutHeatFlow, WarmsByTheTaylorQuinneyShareOfThePlasticWork) {
  const Hardening hardening{6e8, 16.93, 1e9};
  const double xi = hardening.flow(k_strain), work = k_yield * xi + hardening.stored(xi);  // ∫ σ_y dξ
  const double elastic = 0.5 / k_shear * std::pow(hardening.stress(xi) / k_root3, 2);
  for (const double share : {0.0, 0.9})
    for (const auto mapping :
         {mechanics::Mapping::isothermal, mechanics::Mapping::isentropic, mechanics::Mapping::simultaneous})
      for (const StructuralForm form : {StructuralForm::energy, StructuralForm::entropy}) {
        material::Material m = material_of(hardening);
        m.flow->heat_share = share;
        Coupled c = sheared(Shape::quad4, AnalysisKind::plane_strain, m, form);
        c.mapping = mapping;
        constexpr int k_steps = 60;
        verification::Assembly assembly(c, 1);
        coupling::State state = assembly.start();
        assembly.scheme().synchronise(state);
        const double first = coupling::internal_energy(assembly.phases(), state);
        coupling::EnergyAudit sum;
        for (int n = 1; n <= k_steps; ++n) {
          coupling::State trial;
          const coupling::StepEffort effort =
              assembly.advance(state, trial, static_cast<double>(n) / k_steps, 1.0 / k_steps);
          EXPECT_GE(effort.least_dissipation, 0);
          sum += effort.energy;
          state = std::move(trial);
        }
        sum.internal = coupling::internal_energy(assembly.phases(), state) - first;
        EXPECT_NEAR(sum.plastic_dissipation, share * sum.plastic_work, 1e-12 * sum.plastic_work);
        EXPECT_NEAR(sum.plastic_work, work, 1e-8 * work) << share;
        // The energy form also heats by the work of the stress at the end of a step: half a step's rise.
        const double warmed = state.heat.temperature[0] - k_start, exact = share * work / k_capacity;
        EXPECT_NEAR(warmed, exact, (form == StructuralForm::energy ? 2e-2 : 1e-8) * work / k_capacity)
            << share;
        if (form == StructuralForm::energy) {
          EXPECT_LT(std::abs(sum.state_defect()), 1e-9 * sum.work) << share;
          EXPECT_LT(std::abs(sum.defect()), 1e-9 * sum.work) << share;
        }
        // Elastic energy and (1 − β) of the plastic work are stored, and no more, whatever hardening stores.
        const double heat = form == StructuralForm::energy
                                ? sum.work - elastic - (1 - share) * sum.plastic_work
                                : share * sum.plastic_work;
        EXPECT_NEAR(k_capacity * warmed, heat, 1e-9 * sum.work) << share;
      }
}

// The energy form takes the work less what is stored: the stress at the end of each elastic or hardening step
// is half a step's rise too high.
TEST(PlasticShearWithoutHeatFlow, InEnergyFormTendsToTheSameAtFirstOrder) {
  for (const Hardening& hardening : {Hardening{}, Hardening{6e8, 16.93, 1e9}}) {
    const Coupled c =
        sheared(Shape::quad4, AnalysisKind::plane_strain, material_of(hardening), StructuralForm::energy);
    const double exact = k_yield * hardening.flow(k_strain) / k_capacity;
    std::vector<double> errors;
    for (const int n : {100, 200, 400}) {
      const CoupledRun run = verification::march(c, 1, n);
      errors.push_back(std::abs(rise(c, run) - exact));
      EXPECT_LT(run.worst_defect(), 1e-8 * run.exchanged());
    }
    printf("energy form: %.4f K, errors %.2e %.2e %.2e K\n", exact, errors[0], errors[1], errors[2]);
    EXPECT_LT(errors.back(), 2e-2 * exact);
    EXPECT_LT(errors.back(), 0.7 * errors.front());
  }
}

}  // namespace
}  // namespace solidus
