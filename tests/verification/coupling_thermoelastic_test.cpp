/// Thermoelastic coupling in closed form: homogeneous bodies of constant properties that exchange no heat
/// with anything, so the entropy C ln(Θ/Θ_0) + 3αk tr ε of every point stays what it was (C per volume, at
/// constant strain).
///
///   strain given:     Θ = Θ_0 exp(−3αk tr ε/C)
///   uniaxial stress:  C ln(Θ/Θ_0) + 9α²k (Θ − Θ_0) + α σ = 0, since 3k tr ε = σ + 9αk (Θ − Θ_0);
///                     for small changes Kelvin's ΔΘ = −α Θ σ/C_p (W. Thomson, 1855), C_p = C + 9α²k Θ
///   free, heated Q:   C ΔΘ + 9α²k (Θ_0 ΔΘ + ΔΘ²/2) = Q, the energy at zero stress: C_p takes the heat
#include <gtest/gtest.h>

#include "coupling_bodies.hpp"

namespace solidus {
namespace {

using mechanics::StructuralForm;
using mesh::Shape;
using verification::Coupled;

constexpr double k_young = 7e10, k_poisson = 0.33, k_alpha = 4e-5, k_start = 400;  // [Pa], 1, [1/K], [K]
constexpr double k_bulk = k_young / (3 * (1 - 2 * k_poisson));
constexpr double k_capacity = 7800 * 500.0;  // [J/(m³ K)]

/// Every way in which heat at mechanical points reaches nodes that store it by another rule.
struct Kind {
  Shape shape;
  AnalysisKind kind;
  heat::HeatIntegration integration;
};
constexpr auto k_closed = heat::HeatIntegration::closed, k_open = heat::HeatIntegration::open;
const std::vector<Kind> k_bodies{{Shape::quad4, AnalysisKind::plane_strain, k_closed},
                                 {Shape::tri3, AnalysisKind::plane_strain, k_closed},
                                 {Shape::tri6, AnalysisKind::plane_strain, k_open},
                                 {Shape::tri3, AnalysisKind::axisymmetric, k_closed},
                                 {Shape::tri3, AnalysisKind::axisymmetric, k_open},
                                 {Shape::tri6, AnalysisKind::axisymmetric, k_closed},
                                 {Shape::tri6, AnalysisKind::axisymmetric, k_open},
                                 {Shape::quad4, AnalysisKind::axisymmetric, k_closed},
                                 {Shape::quad8, AnalysisKind::plane_strain, k_closed},
                                 {Shape::tet10, AnalysisKind::solid, k_closed},
                                 {Shape::quad8, AnalysisKind::axisymmetric, k_open},
                                 {Shape::tet4, AnalysisKind::solid, k_closed},
                                 {Shape::hex8, AnalysisKind::solid, k_closed},
                                 {Shape::hex20, AnalysisKind::solid, k_closed},
                                 {Shape::hex20, AnalysisKind::solid, k_open}};

constexpr std::pair<StructuralForm, mechanics::Mapping> k_schemes[] = {
    {StructuralForm::entropy, mechanics::Mapping::isothermal},
    {StructuralForm::energy, mechanics::Mapping::isothermal},
    {StructuralForm::entropy, mechanics::Mapping::isentropic},
    {StructuralForm::energy, mechanics::Mapping::isentropic}};

Coupled cube(const Kind& body, StructuralForm form) {
  test::Lattice lattice{.shape = body.shape, .cells = {2, 2, 2}, .distortion = 0.15};
  Coupled c;
  c.mesh = test::make_mesh(lattice);
  c.kind = body.kind;
  c.integration = body.integration;
  c.materials = {test::elastic_material(k_young, k_poisson, k_alpha)};
  c.materials[0].expansion_reference = k_start;
  c.materials[0].specific_heat_at = material::SpecificHeatAt::constant_strain;
  c.start = {k_start};
  c.form = form;
  c.hold("bottom", 1);
  if (body.kind != AnalysisKind::axisymmetric) c.hold("left", 0);
  if (body.kind == AnalysisKind::solid) c.hold("back", 2);
  return c;
}

/// The mean temperature at the end, after a check that it is uniform.
double uniform_temperature(const Coupled& c, const verification::CoupledRun& run) {
  double low = 1e300, high = 0;
  for (Index i = 0; i < c.mesh.n_owned_nodes; ++i) {
    low = std::min(low, run.end.heat.temperature[static_cast<std::size_t>(i)]);
    high = std::max(high, run.end.heat.temperature[static_cast<std::size_t>(i)]);
  }
  low = parallel::global_min(low);
  high = parallel::global_max(high);
  EXPECT_NEAR(low, high, 1e-8);
  return 0.5 * (low + high);
}

/// Temperatures with 16, 32 and 64 steps against the exact one: order 1. @return the errors
std::vector<double> converges(const Coupled& c, double exact, const std::string& name) {
  std::vector<double> errors;
  for (int n : {16, 32, 64}) errors.push_back(uniform_temperature(c, verification::march(c, 1, n)) - exact);
  for (std::size_t i = 1; i < errors.size(); ++i)
    EXPECT_NEAR(verification::order(std::abs(errors[i - 1]), std::abs(errors[i])), 1, 0.15) << name;
  // a change of temperature right to half a percent in 64 steps
  EXPECT_LT(std::abs(errors.back()), 0.005 * std::abs(exact - k_start)) << name;
  return errors;
}

std::string name(Shape shape, StructuralForm form) {
  return std::string(mesh::name(shape)) + (form == StructuralForm::entropy ? "_entropy" : "_energy");
}

/// Newton for an increasing function of the temperature.
template <class F>
double root(F f) {
  double t = k_start;
  for (int i = 0; i < 50; ++i) t -= f(t) / ((f(t + 1e-3) - f(t - 1e-3)) / 2e-3);
  return t;
}

TEST(AdiabaticStraining, CoolsAsTheEntropySays) {
  auto out = verification::table("coupling_straining_order", "step[s],entropy_form[K],energy_form[K]");
  std::vector<std::vector<double>> of_quad4;
  constexpr double k_strain = 5e-3;
  const double exact = k_start * std::exp(-3 * k_alpha * k_bulk * k_strain / k_capacity);
  for (const Kind& body : k_bodies)
    for (StructuralForm form : {StructuralForm::entropy, StructuralForm::energy}) {
      Coupled c = cube(body, form);
      c.hold("top", 1, Table({0, 1}, {0, k_strain}));
      c.hold("right", 0);
      if (body.kind == AnalysisKind::solid) c.hold("front", 2);
      const auto errors = converges(c, exact, name(body.shape, form));
      if (body.shape == Shape::quad4) of_quad4.push_back(errors);
    }
  for (std::size_t i = 0; i < 3; ++i)
    out << 1.0 / (16 << i) << "," << of_quad4[0][i] << "," << of_quad4[1][i] << "\n";
}

// For small strains ΔΘ = −3αkΘ tr ε/C, in a single step. What is left is of the order of ΔΘ/Θ.
TEST(AdiabaticStraining, ASmallStrainCoolsByKelvinsFormulaToOneInTenThousand) {
  constexpr double k_strain = 2e-6;
  const double kelvin = -3 * k_alpha * k_bulk * k_start * k_strain / k_capacity;
  for (const Kind& body : k_bodies)
    for (StructuralForm form : {StructuralForm::entropy, StructuralForm::energy}) {
      Coupled c = cube(body, form);
      c.hold("top", 1, Table({0, 1}, {0, k_strain}));
      c.hold("right", 0);
      if (body.kind == AnalysisKind::solid) c.hold("front", 2);
      const double change = uniform_temperature(c, verification::march(c, 1, 1)) - k_start;
      EXPECT_NEAR(change, kelvin, 1e-4 * std::abs(kelvin)) << name(body.shape, form);
    }
}

TEST(AdiabaticTension, CoolsAsKelvinSays) {
  constexpr double k_stress = 2e8;
  const double exact = root([](double t) {
    return k_capacity * std::log(t / k_start) + 9 * k_alpha * k_alpha * k_bulk * (t - k_start) +
           k_alpha * k_stress;
  });
  const double kelvin =
      -k_alpha * k_start * k_stress / (k_capacity + 9 * k_alpha * k_alpha * k_bulk * k_start);
  EXPECT_NEAR(exact - k_start, kelvin, 2e-3 * std::abs(kelvin));  // (ΔΘ/Θ)/2 of it
  for (const Kind& body : k_bodies) {
    if (body.kind == AnalysisKind::plane_strain) continue;  // not uniaxial
    for (const auto& [form, mapping] : k_schemes) {
      Coupled c = cube(body, form);
      c.mapping = mapping;
      c.mechanical.pressures.push_back({"top", Table({0, 1}, {0, -k_stress})});
      converges(c, exact, name(body.shape, form));
    }
  }
}

TEST(AFreeBodyThatIsHeated, TakesTheHeatWithItsCapacityAtConstantPressure) {
  constexpr double k_heat = 4e8;  // [J/m³]
  constexpr double k_mechanical = 9 * k_alpha * k_alpha * k_bulk;
  const double exact = root([](double t) {
    const double d = t - k_start;
    return k_capacity * d + k_mechanical * (k_start * d + d * d / 2) - k_heat;
  });
  EXPECT_LT(exact, k_start + 0.95 * k_heat / k_capacity);  // that is seen
  for (const Kind& body : k_bodies) {
    if (body.kind == AnalysisKind::plane_strain) continue;  // not free
    for (const auto& [form, mapping] : k_schemes) {
      Coupled c = cube(body, form);
      c.mapping = mapping;
      c.thermal.sources.push_back({"heat", "body", k_heat});
      converges(c, exact, name(body.shape, form));
    }
  }
}

}  // namespace
}  // namespace solidus
