/// The mechanical phase that holds the entropy of its points: what the elements make of the isentropic
/// mapping.
#include <gtest/gtest.h>

#include <numeric>

#include "material/derivatives/isentropic.hpp"
#include "mechanics/elements/block_kernel.hpp"
#include "plastic_material.hpp"

namespace solidus {
namespace {

using material::Isentropic;
using material::KinematicHardening;
using mechanics::Mapping;
using mechanics::TimeIntegration;
using mesh::Shape;
using test::Body;
using test::Solved;

struct Element {
  Shape shape;
  AnalysisKind kind;
  bool b_bar;
};
const Element k_elements[] = {
    {Shape::tri3, AnalysisKind::plane_strain, false}, {Shape::tri6, AnalysisKind::axisymmetric, false},
    {Shape::quad4, AnalysisKind::plane_strain, true}, {Shape::quad4, AnalysisKind::axisymmetric, false},
    {Shape::quad4, AnalysisKind::axisymmetric, true}, {Shape::quad8, AnalysisKind::plane_strain, true},
    {Shape::tet4, AnalysisKind::solid, false},        {Shape::tet10, AnalysisKind::solid, false},
    {Shape::hex8, AnalysisKind::solid, true},         {Shape::hex20, AnalysisKind::solid, true}};

test::Lattice lattice(const Element& element) {
  return {.shape = element.shape, .cells = {3, 3, 2}, .distortion = 0.15, .map = [](const mesh::Point& x) {
            return mesh::Point{x[0] + 0.3, x[1], x[2]};
          }};
}

/// Moduli and expansion that vary with temperature, three times the expansion of steel: strongly coupled.
material::Material strongly_coupled(material::Material m) {
  m.young_modulus = Table({300, 500}, {2e11, 1.5e11});
  m.poisson_ratio = Table({300, 500}, {0.3, 0.35});
  m.expansion = Table({300, 500}, {4e-5, 5e-5});
  m.specific_heat_at = material::SpecificHeatAt::constant_strain;  // as C_p it would be less than C_p − C_v
  return m;
}
/// Half solid at 350 K.
material::Material mushy() {
  material::Material m = strongly_coupled(test::plastic_material());
  m.liquid_viscosity = 1e10;
  m.phase_changes.push_back({.name = "freezing",
                             .fraction = material::PhaseFraction::linear(340, 360),
                             .volume_change = -0.01,
                             .solidification = true});
  return m;
}

/// A kernel in the middle of a step: a displacement at its start, another one now, and two directions.
struct Kernel {
  mesh::Mesh mesh;
  int components;
  std::unique_ptr<mechanics::BlockKernel> kernel;
  std::vector<double> temperature, old_u, u;
  std::vector<double> directions[2];
  mechanics::BlockHistory history;

  Kernel(const Element& element, const material::Material& material)
      : mesh(test::make_mesh(lattice(element))),
        components(displacement_components(element.kind)),
        kernel(mechanics::make_block_kernel(mesh, mesh.blocks.front(), element.kind, material,
                                            Mapping::isentropic, element.b_bar)),
        history(kernel->initial_history()) {
    for (const mesh::Point& x : mesh.x) temperature.push_back(345 + 10 * x[0] - 8 * x[1]);
    for (Index node = 0; node < mesh.n_nodes(); ++node)
      for (int i = 0; i < components; ++i) {
        const double s =
            static_cast<double>(mesh.input_node[static_cast<std::size_t>(node)] * components + i);
        old_u.push_back(2e-4 * std::sin(0.7 * s));
        u.push_back(1e-3 * std::sin(1.3 * s));
        directions[0].push_back(1e-3 * std::cos(2.1 * s));
        directions[1].push_back(1e-3 * std::cos(3.7 * s + 1));
      }
    const std::vector<material::Material> materials{material};
    mechanics::NodalPhases nodal(mesh, materials, temperature);
    kernel->prepare({.temperature = temperature,
                     .pass_temperature = temperature,
                     .initial_temperature = temperature,
                     .old_displacement = old_u,
                     .held_displacement = old_u,
                     .held_history = &history,
                     .old_history = &history,
                     .start_history = &history,
                     .dt = 0.5,
                     .effective = 0.5,
                     .phases = nodal.evaluate(0, {temperature, {}}, {})});
  }
  /// K d by the tangent for both directions, [owned node][component].
  std::array<std::vector<double>, 2> products() {
    linear::NodeGraph graph(mesh);
    for (const auto& block : mesh.blocks) graph.add_cliques(block.nodes, mesh::node_count(block.shape));
    linear::BlockMatrix matrix(mesh, components, std::move(graph));
    kernel->bind(matrix);
    // The second tangent at one iterate is the consistent one: the directions of flow are known by then.
    for (int i = 0; i < 2; ++i) {
      matrix.set_zero();
      kernel->add_tangent(u, matrix);
    }
    std::array<std::vector<double>, 2> result;
    for (std::size_t i = 0; i < 2; ++i) {
      result[i].resize(static_cast<std::size_t>(mesh.n_owned_nodes * components));
      matrix.multiply(directions[i], result[i]);
    }
    return result;
  }
  std::vector<double> forces(const std::vector<double>& direction, double step) {
    std::vector<double> x = u, f(u.size(), 0.0);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += step * direction[i];
    kernel->add_forces(x, f);
    return f;
  }
};

double dot(const std::vector<double>& owned, const std::vector<double>& local) {
  return parallel::global_sum(std::inner_product(owned.begin(), owned.end(), local.begin(), 0.0));
}

TEST(IsentropicTangent, IsTheDerivativeOfTheForcesAndSymmetricButForArmstrongFrederick) {
  const material::Material materials[] = {
      strongly_coupled(test::elastic_material(2e11, 0.3)), strongly_coupled(test::plastic_material()),
      strongly_coupled(test::plastic_material(KinematicHardening::armstrong_frederick)), mushy()};
  for (const Element& element : k_elements)
    for (const auto& material : materials) {
      SCOPED_TRACE(std::string(mesh::name(element.shape)));
      Kernel k(element, material);
      const bool recalls =
          material.flow && material.flow->kinematic == KinematicHardening::armstrong_frederick;
      EXPECT_EQ(k.kernel->symmetric(), !recalls);
      const auto [y, z] = k.products();
      constexpr double k_step = 1e-4;  // truncation h² = 1e-8, rounding 1e-12/h
      const auto plus = k.forces(k.directions[0], k_step), minus = k.forces(k.directions[0], -k_step);
      double size = 0;
      for (double value : y) size = std::max(size, std::abs(value));
      for (std::size_t i = 0; i < y.size(); ++i)
        ASSERT_NEAR(y[i], (plus[i] - minus[i]) / (2 * k_step), 1e-6 * size) << "row " << i;
      if (recalls) continue;
      const double there = dot(y, k.directions[1]), back = dot(z, k.directions[0]);
      EXPECT_NEAR(there, back, 1e-12 * std::sqrt(dot(y, k.directions[0]) * dot(z, k.directions[1])));
    }
}

/// Every element at the same intermediate temperature.
void expect_temperature(const Solved& solved, double exact, double tolerance) {
  for (const auto& fields : test::element_fields(solved))
    for (const double t : fields.intermediate_temperature) EXPECT_NEAR(t, exact, tolerance);
}

constexpr double k_alpha = 4e-5, k_capacity = 7800 * 500.0;  // [1/K], [J/(m³ K)]
constexpr double k_bulk = 7e10 / (3 * (1 - 2 * 0.33));       // [Pa]
const auto k_soft = [] {
  material::Material m = test::elastic_material(7e10, 0.33, k_alpha);
  m.specific_heat_at = material::SpecificHeatAt::constant_strain;
  return m;
}();

/// Prescribed on the whole boundary: the same strain everywhere, tr ε = 3 × size.
Body dilated(const Element& element, const material::Material& material) {
  Body body(lattice(element), element.kind, material);
  const double in_plane = element.kind == AnalysisKind::plane_strain ? 1.5 : 1.0;
  body.hold_boundary([&](const mesh::Point& x) {
    return mesh::Point{in_plane * x[0], in_plane * x[1], x[2]};
  });
  for (auto& d : body.conditions.displacements) {
    const double value = d.value.value(0);
    d.value = Table({0, 1, 2}, {0, value * 1e-3, value * -2e-3});
  }
  body.options.mapping = Mapping::isentropic;
  body.options.b_bar = element.b_bar;
  return body;
}

// C ln(Θ̄/Θ_n) + 3αk (tr ε − tr ε_n) = 0 with constant properties.
TEST(IsentropicPhase, AnAdiabaticBlockCoolsAndWarmsAsItsEntropySays) {
  for (const Element& element : k_elements) {
    Body body = dilated(element, k_soft);
    const auto exact = [](double trace) {
      return 300 * std::exp(-3 * k_alpha * k_bulk * trace / k_capacity);
    };
    Solved solved(body);
    constexpr double k_rounding = 1e-8;  // [K], the tolerance of the mapping
    expect_temperature(solved, exact(3e-3), k_rounding);
    // The next step holds the entropy of this displacement: from the temperature reached it goes on along
    // the same adiabat.
    body.temperature.assign(body.mesh.x.size(), exact(3e-3));
    solved.step(body, 2, 1);
    expect_temperature(solved, exact(-6e-3), k_rounding);
  }
}

// Kelvin's ΔΘ = −α Θ σ/C_p for small stresses.
TEST(IsentropicPhase, AnAdiabaticBarInTensionCoolsByKelvinsFormula) {
  constexpr double k_stress = 1e5;
  for (const auto& [shape, kind] : {std::pair{Shape::quad4, AnalysisKind::axisymmetric},
                                    {Shape::hex8, AnalysisKind::solid},
                                    {Shape::tet10, AnalysisKind::solid}}) {
    Body body({.shape = shape, .cells = {2, 2, 2}, .distortion = 0.1}, kind, k_soft);
    body.materials[0].expansion_reference = 300;
    body.hold("bottom", 1);
    if (kind == AnalysisKind::solid) {
      body.hold("left", 0);
      body.hold("back", 2);
    }
    body.conditions.pressures.push_back({"top", -k_stress});
    body.options.mapping = Mapping::isentropic;
    const Solved solved(body);
    const double c_p = k_capacity + 9 * k_alpha * k_alpha * k_bulk * 300;
    const double kelvin = -k_alpha * 300 * k_stress / c_p;
    expect_temperature(solved, 300 + kelvin, 1e-5 * std::abs(kelvin));  // ΔΘ/Θ = 1e-6 of it
  }
}

TEST(IsentropicPhase, ALinearDisplacementGivesTheStressAndTheHistoryOfTheLaw) {
  for (const auto& material : {strongly_coupled(test::plastic_material()), mushy()})
    for (const Element& element : k_elements) {
      Body body = dilated(element, material);
      body.conditions.displacements.clear();
      const bool solid = element.kind == AnalysisKind::solid,
                 hoop = element.kind == AnalysisKind::axisymmetric;
      body.hold_boundary([&](const mesh::Point& x) {
        return mesh::Point{2e-3 * x[0], -1e-3 * x[1], -5e-4 * x[2]};
      });
      body.temperature.assign(body.mesh.x.size(), 350.0);
      const Solved solved(body);
      const Isentropic law(body.materials[0]);
      auto properties = law.properties_at(350.0, 300.0);
      // The mean of the step, which begins at 300 K.
      if (material.solidification() != nullptr)
        properties.solid_fraction = 0.5 * (material.solid_fraction(300) + material.solid_fraction(350));
      properties.entropy = law.entropy(properties, Sym<double>{}, Isentropic::State<double>{});
      const Sym<double> strain{{2e-3, -1e-3, solid ? -5e-4 : hoop ? 2e-3 : 0, 0, 0, 0}};
      const auto exact = law.update(properties, Isentropic::State<double>{}, strain, 1.0);
      ASSERT_GT(std::abs(exact.temperature - 350), 0.3);
      expect_temperature(solved, exact.temperature, 1e-7);
      for (const auto& fields : test::element_fields(solved))
        for (std::size_t e = 0; e < fields.stress.size(); ++e) {
          for (std::size_t i = 0; i < 6; ++i) {
            const auto c = static_cast<int>(i);
            EXPECT_NEAR(fields.stress[e][i], exact.stress[c], 1e-9 * 3e9);
            EXPECT_NEAR(fields.plastic_strain[e][i], exact.state.plastic_strain[c], 1e-9 * 1e-3);
            EXPECT_NEAR(fields.viscous_strain[e][i], exact.state.viscous_strain[c], 1e-9 * 1e-3);
          }
          EXPECT_NEAR(fields.equivalent_plastic_strain[e], exact.state.hardening, 1e-9 * 1e-3);
          EXPECT_NEAR(fields.dissipation[e], exact.dissipation, 1e-8 * exact.dissipation);
        }
    }
}

TEST(IsentropicPhase, IsTheIsothermalOneWhereDeformationHasNoEntropy) {
  material::Material m = test::perfectly_plastic(5e7);  // constant moduli
  m.expansion = 0.0;
  for (const auto integration : {TimeIntegration::backward_euler, TimeIntegration::two_step}) {
    Body body({.shape = Shape::hex8, .cells = {2, 2, 2}, .distortion = 0.1}, AnalysisKind::solid, m);
    for (int i = 0; i < 3; ++i) body.hold("bottom", i);
    body.hold("top", 0, Table({0, 2}, {0, 2e-3}));
    body.hold("top", 1, Table({0, 2}, {0, 1e-3}));
    body.options.integration = integration;
    Solved isothermal(body);
    body.options.mapping = Mapping::isentropic;
    Solved isentropic(body);
    isothermal.step(body, 2, 1);
    isentropic.step(body, 2, 1);
    expect_temperature(isentropic, 300, 1e-9);
    for (std::size_t i = 0; i < isothermal.state.displacement.size(); ++i)
      EXPECT_NEAR(isentropic.state.displacement[i], isothermal.state.displacement[i], 1e-12);
    EXPECT_NEAR(isentropic.report.work.dissipation, isothermal.report.work.dissipation,
                1e-9 * isothermal.report.work.dissipation);
  }
}

// Near the solution the residual goes with the square of the one before.
TEST(IsentropicPhase, NewtonConvergesQuadratically) {
  for (const auto kinematic : {KinematicHardening::linear, KinematicHardening::armstrong_frederick}) {
    Body body({.shape = Shape::hex8, .cells = {3, 3, 3}, .distortion = 0.1}, AnalysisKind::solid,
              strongly_coupled(test::plastic_material(kinematic)));
    for (int i = 0; i < 3; ++i) body.hold("bottom", i);
    body.conditions.tractions.push_back({"top", {4e7, 6e7, 2e7}});
    body.options.mapping = Mapping::isentropic;
    const Solved solved(body);
    ASSERT_GT(solved.report.work.plastic_dissipation, 0.0);
    const auto& r = solved.report.newton.residuals;
    ASSERT_GE(r.size(), 4u);
    std::size_t last = r.size() - 1;  // the last one may be rounding
    if (r[last] < 1e-12) --last;
    EXPECT_GT(std::log(r[last] / r[last - 1]) / std::log(r[last - 1] / r[last - 2]), 1.6);
  }
}

}  // namespace
}  // namespace solidus
