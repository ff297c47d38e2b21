/// The mechanical phase with mixed triangles and tetrahedra: what their pressure does over steps, between
/// bodies and in the balance of energy.
#include <gtest/gtest.h>

#include <cmath>

#include "mechanics/elements/simplices.hpp"
#include "plastic_material.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"

namespace solidus {
namespace {

using mechanics::Mapping;
using mechanics::Simplices;
using mesh::Shape;
using test::Body;
using test::Solved;

Shape simplex(AnalysisKind kind) {
  return kind == AnalysisKind::solid ? Shape::tet4 : Shape::tri3;
}

const AnalysisKind k_kinds[] = {AnalysisKind::plane_strain, AnalysisKind::axisymmetric, AnalysisKind::solid};

test::Lattice lattice(AnalysisKind kind) {
  return {.shape = simplex(kind), .cells = {3, 3, 2}, .distortion = 0.15, .map = [](const mesh::Point& x) {
            return mesh::Point{x[0] + 0.3, x[1], x[2]};
          }};
}

/// Held at one side and pulled at the other, far into plastic flow.
Body pulled(AnalysisKind kind, Mapping mapping) {
  Body body(lattice(kind), kind, test::plastic_material());
  body.options.mapping = mapping;
  body.options.newton.inexact = false;
  for (int i = 0; i < displacement_components(kind); ++i) body.hold("bottom", i);
  body.hold("top", 1, Table({0, 2}, {0, 4e-3}));
  return body;
}

TEST(MixedPhase, TheWorkOfTheForcesIsThatOfTheLawAndOfTheSubScales) {
  for (const AnalysisKind kind : k_kinds)
    for (const Mapping mapping : {Mapping::isothermal, Mapping::isentropic}) {
      const Body body = pulled(kind, mapping);
      Solved solved(body);
      for (const double time : {1.0, 2.0}) {
        if (time > 1) solved.step(body, time, 1.0);
        const mechanics::MechanicalWork& work = solved.report.work;
        EXPECT_NE(work.numerical, 0.0);
        // Newton's criterion is 1e-11 of the forces.
        EXPECT_NEAR(work.external_work + work.support_work + work.residual_work,
                    work.internal_work + work.numerical, 1e-10 * std::abs(work.internal_work));
        EXPECT_LT(std::abs(work.numerical), 0.05 * std::abs(work.internal_work));
      }
    }
}

TEST(MixedPhase, NewtonsMethodEndsQuadraticallyInPlasticFlow) {
  for (const AnalysisKind kind : k_kinds)
    for (const Mapping mapping : {Mapping::isothermal, Mapping::isentropic}) {
      Body body = pulled(kind, mapping);
      body.options.newton.chords = false;
      const Solved solved(body);
      const std::vector<double>& r = solved.report.newton.residuals;
      ASSERT_GE(r.size(), 4u);
      // The last step squares the residual, down to what the linear solver leaves, 1e-8 of it.
      const std::size_t n = r.size();
      EXPECT_LT(r[n - 1], 30 * r[n - 2] * r[n - 2] + 1e-8 * r[n - 2] + 1e-11);
    }
}

TEST(MixedPhase, GoesOnFromAStateWithTheSameBits) {
  for (const Mapping mapping : {Mapping::isothermal, Mapping::isentropic}) {
    const Body body = pulled(AnalysisKind::plane_strain, mapping);
    Solved first(body);
    const mechanics::MechanicalState middle = first.state;
    first.phase->system().solver().forget();
    first.step(body, 2.0, 1.0);
    const auto fresh = body.phase();
    mechanics::MechanicalState end = fresh->initial_state();
    fresh->solve(middle, end, body.temperature, 2.0, 1.0);
    const int n_processes = processes::count();
    if (n_processes == 1) {
      EXPECT_EQ(end.displacement, first.state.displacement);
      EXPECT_EQ(end.pressure, first.state.pressure);
      continue;
    }
    // MUMPS adds up in the order in which messages come: the criterion is 1e-11 of the forces.
    for (std::size_t i = 0; i < end.displacement.size(); ++i)
      EXPECT_NEAR(end.displacement[i], first.state.displacement[i], 1e-8 * 4e-3);
  }
}

TEST(MixedPhase, AMeltUnderItsWeightRests) {
  for (const AnalysisKind kind : k_kinds)
    for (const auto stabilisation :
         {mechanics::Stabilisation::orthogonal, mechanics::Stabilisation::algebraic}) {
      material::Material melt = test::elastic_material(2e11, 0.3);
      melt.liquid_viscosity = 1e6;
      melt.phase_changes.push_back({.name = "freezing",
                                    .fraction = material::PhaseFraction::linear(200, 250),
                                    .solidification = true});
      Body body(lattice(kind), kind, melt);
      body.options.stabilisation = stabilisation;
      body.hold("bottom", 1);
      for (const char* side : {"left", "right"}) body.hold(side, 0);
      if (kind == AnalysisKind::solid)
        for (const char* side : {"front", "back"}) body.hold(side, 2);
      body.conditions.gravity = {0, -10, 0};
      const Solved solved(body);
      const double bulk = 2e11 / (3 * (1 - 0.6)), bottom = 7800 * 10;  // of a column of one metre
      for (Index node = 0; node < body.mesh.n_nodes(); ++node) {
        const double depth = 1 - body.mesh.x[static_cast<std::size_t>(node)][1];
        // The sinking is quadratic in height, the elements are linear: a second-order share of it is left
        // over as flow.
        EXPECT_NEAR(solved.state.pressure[static_cast<std::size_t>(node)], -bottom * depth, 1e-4 * bottom);
        for (int i = 0; i < solved.phase->bodies().components; ++i)
          EXPECT_LT(std::abs(solved.u(body, node, i)), bottom / bulk);  // twice the sinking of the top
      }
    }
}

/// Two layers of different stiffness that share nodes, pressed between smooth walls.
TEST(MixedPhase, ThePressureJumpsBetweenMaterialsThatShareNodes) {
  mesh::RawMesh raw = test::make_raw({.shape = Shape::tri3, .cells = {4, 4, 1}});
  auto layers = raw.groups["body"];
  auto upper = layers, lower = layers;
  for (auto* layer : {&upper, &lower}) layer->blocks[0] = {Shape::tri3, {}, {}};
  const mesh::RawBlock& all = layers.blocks[0];
  for (std::size_t e = 0; e < all.input_element.size(); ++e) {
    double height = 0;
    for (std::size_t a = 0; a < 3; ++a)
      height += raw.x[static_cast<std::size_t>(all.nodes[3 * e + a])][1] / 3;
    mesh::RawBlock& to = (height > 0.5 ? upper : lower).blocks[0];
    to.nodes.insert(to.nodes.end(), all.nodes.begin() + static_cast<std::ptrdiff_t>(3 * e),
                    all.nodes.begin() + static_cast<std::ptrdiff_t>(3 * e + 3));
    to.input_element.push_back(all.input_element[e]);
  }
  raw.groups.erase("body");
  raw.groups["lower"] = lower;
  raw.groups["upper"] = upper;
  mesh::validate_and_orient(raw, "layers");
  Body body(mesh::distribute(raw, {"lower", "upper"}, {}), AnalysisKind::plane_strain,
            test::elastic_material(2e11, 0.3));
  body.materials.push_back(test::elastic_material(1e10, 0.49));
  body.materials[1].name = "rubber";
  body.options.simplices = Simplices::mixed;
  body.hold("bottom", 1);
  for (const char* side : {"left", "right"}) body.hold(side, 0);
  body.conditions.pressures.push_back({"top", 1e6});
  const Solved solved(body);
  const auto fields = test::element_fields(solved);
  for (std::size_t b = 0; b < fields.size(); ++b) {
    const double nu = body.mesh.blocks[b].body == 0 ? 0.3 : 0.49;
    for (const double p : fields[b].pressure)  // uniaxial strain: σ_xx = ν/(1−ν) σ_yy
      EXPECT_NEAR(p, 1e6 * (1 + 2 * nu / (1 - nu)) / 3, 1e-8 * 1e6);
  }
}

TEST(Simplices, AreMixedWhereTheVolumeIsNearlyKept) {
  mesh::ElementBlock tet, hex, quadratic;
  tet.shape = Shape::tet4;
  hex.shape = Shape::hex8;
  quadratic.shape = Shape::tet10;
  const material::Material elastic = test::elastic_material(2e11, 0.3);
  EXPECT_FALSE(is_mixed(tet, elastic, Simplices::automatic));
  EXPECT_TRUE(is_mixed(tet, elastic, Simplices::mixed));
  EXPECT_TRUE(is_mixed(tet, test::elastic_material(2e11, 0.46), Simplices::automatic));
  EXPECT_TRUE(is_mixed(tet, test::plastic_material(), Simplices::automatic));
  EXPECT_FALSE(is_mixed(tet, test::plastic_material(), Simplices::displacement));
  EXPECT_FALSE(is_mixed(hex, test::plastic_material(), Simplices::mixed));
  EXPECT_FALSE(is_mixed(quadratic, test::plastic_material(), Simplices::mixed));
}

TEST(MixedPhase, RefusesSolversThatCannotFindThePressure) {
  Body body(lattice(AnalysisKind::plane_strain), AnalysisKind::plane_strain, test::plastic_material());
  body.options.solver = linear::SolverKind::jacobi;
  EXPECT_THROW(body.phase(), InputError);
}

}  // namespace
}  // namespace solidus
