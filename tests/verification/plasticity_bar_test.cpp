/// A bar between rigid walls that is heated until it yields in compression, and cooled until it yields in
/// tension: what is left when it is cold is the residual stress.
///
///      ▒┌──────────────┐▒      E(Θ), σ_y(Θ) fall linearly, α constant; e = α (Θ − Θ_0)
///      ▒│    Θ(t)      │▒      E (−e − ε^p) = σ,  |σ − X| <= σ_y + H ξ,  X = K ε^p
///      ▒└──────────────┘▒
///
/// Rate independent, so the state depends on the temperature and the turning point alone:
///
///   heating:  ε^p = −ξ,       ξ = (E e − σ_y)/(E + H + K) where positive, σ = −σ_y − (H + K) ξ
///   cooling:  ε^p = −ξ_1 + Δ, Δ = [E (ξ_1 − e) − σ_y + (K − H) ξ_1]/(E + H + K) where positive,
///             σ = E (ξ_1 − Δ − e);  ξ_1 of the hottest state
#include <gtest/gtest.h>

#include "material/hardening.hpp"
#include "plasticity_bodies.hpp"

namespace solidus {
namespace {

using mesh::Shape;
using test::Body;
using verification::March;

constexpr double k_start = 300, k_hot = 900, k_alpha = 1.2e-5;  // [K], [1/K]

double young(double t) {
  return 2.0e11 - (t - k_start) / (k_hot - k_start) * 0.6e11;
}
double yield(double t) {
  return 3.0e8 - (t - k_start) / (k_hot - k_start) * 2.2e8;
}

struct Hardening {
  const char* name;
  double isotropic, kinematic;  ///< H, K [Pa]
};
const std::vector<Hardening> k_hardenings{
    {"perfect", 0, 0}, {"isotropic", 2e10, 0}, {"kinematic", 0, 2e10}, {"both", 1e10, 2e10}};

/// σ on the way up to k_hot and down again.
struct ClosedForm {
  Hardening h;
  double sum(double t) const { return young(t) + h.isotropic + h.kinematic; }
  double heating_flow(double t) const {
    return std::max(0.0, (young(t) * k_alpha * (t - k_start) - yield(t)) / sum(t));
  }
  double heating(double t) const { return young(t) * (heating_flow(t) - k_alpha * (t - k_start)); }
  double cooling(double t) const {
    const double first = heating_flow(k_hot), e = k_alpha * (t - k_start);
    const double back = (young(t) * (first - e) - yield(t) + (h.kinematic - h.isotropic) * first) / sum(t);
    return young(t) * (first - std::max(0.0, back) - e);
  }
};

Body bar(Shape shape, AnalysisKind kind, const Hardening& hardening) {
  material::Material m = verification::plastic_material(
      1, 0.3, Table({k_start, k_hot}, {yield(k_start), yield(k_hot)}), k_alpha);
  m.young_modulus = Table({k_start, k_hot}, {young(k_start), young(k_hot)});
  if (hardening.isotropic > 0) {
    m.flow->isotropic = material::IsotropicHardening::linear;
    set_hardening(*m.flow, {{"hardening_modulus", hardening.isotropic}});
  }
  if (hardening.kinematic > 0) {
    m.flow->kinematic = material::KinematicHardening::linear;
    m.flow->kinematic_modulus = hardening.kinematic;
  }
  Body body({.shape = shape, .cells = {2, 3, 2}, .size = {0.1, 0.3, 0.1}, .distortion = 0.1}, kind, m);
  body.hold("bottom", 1);
  body.hold("top", 1);
  if (kind == AnalysisKind::solid) {
    body.hold("left", 0);
    body.hold("back", 2);
  }
  return body;
}

const std::vector<std::pair<Shape, AnalysisKind>> k_bars{
    {Shape::tri3, AnalysisKind::axisymmetric},  {Shape::quad4, AnalysisKind::axisymmetric},
    {Shape::quad8, AnalysisKind::axisymmetric}, {Shape::tet4, AnalysisKind::solid},
    {Shape::tet10, AnalysisKind::solid},        {Shape::hex8, AnalysisKind::solid},
    {Shape::hex20, AnalysisKind::solid}};

/// Every element's axial stress, all others zero; units of the yield stress.
void expect_uniaxial(const March& march, double exact, const char* what) {
  for (const auto& fields : march.fields())
    for (const auto& stress : fields.stress)
      for (std::size_t i = 0; i < 6; ++i)
        ASSERT_NEAR(stress[i], i == 1 ? exact : 0.0, 1e-8 * yield(k_start)) << what;
}

TEST(BarBetweenWalls, HeatedAndCooledHasTheStressesAndTheResidualStressOfTheClosedForm) {
  std::vector<std::vector<double>> rows{{k_start, 0, 0}};
  for (const Hardening& hardening : k_hardenings) {
    const ClosedForm exact{hardening};
    for (const auto& [shape, kind] : k_bars) {
      Body body = bar(shape, kind, hardening);
      March march(body);
      const std::string what = std::string(mesh::name(shape)) + " " + hardening.name;
      constexpr int n = 24;
      for (int step = 1; step <= 2 * n; ++step) {
        const double warm = step <= n ? 1.0 * step / n : 2 - 1.0 * step / n;
        const double t = k_start + (k_hot - k_start) * warm;
        body.temperature.assign(body.mesh.x.size(), t);
        ASSERT_TRUE(march.to(step)) << what;
        const double stress = step <= n ? exact.heating(t) : exact.cooling(t);
        expect_uniaxial(march, stress, what.c_str());
        if (shape == Shape::hex8 && hardening.isotropic == 0 && hardening.kinematic == 0)
          rows.push_back({t, 1e-6 * stress, 1e-6 * march.fields()[0].stress[0][1]});
      }
      if (shape == Shape::hex8)
        printf("%s hardening: residual stress %.3f MPa (closed form %.3f)\n", hardening.name,
               1e-6 * march.fields()[0].stress[0][1], 1e-6 * exact.cooling(k_start));
    }
    EXPECT_GT(exact.cooling(k_start), 0.9 * yield(k_start));  // it does yield again
  }
  auto out = verification::table("plasticity_bar", "Temperature[K],exact_stress[MPa],stress[MPa]");
  for (const auto& row : rows) out << row[0] << "," << row[1] << "," << row[2] << "\n";
}

// Rate independent and with stress of one sign at a time, so one step is as good as many.
TEST(BarBetweenWalls, ResidualStressDoesNotDependOnTheSteps) {
  for (const Hardening& hardening : k_hardenings) {
    Body body = bar(Shape::hex8, AnalysisKind::solid, hardening);
    March march(body);
    body.temperature.assign(body.mesh.x.size(), k_hot);
    ASSERT_TRUE(march.to(1));
    expect_uniaxial(march, ClosedForm{hardening}.heating(k_hot), hardening.name);
    body.temperature.assign(body.mesh.x.size(), k_start);
    ASSERT_TRUE(march.to(2));
    expect_uniaxial(march, ClosedForm{hardening}.cooling(k_start), hardening.name);
  }
}

}  // namespace
}  // namespace solidus
