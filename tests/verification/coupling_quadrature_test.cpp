/// Heat that is stored at nodes (closed rule) or thermal points (open rule) and energies of deformation at
/// the mechanical points: neither loses to the other, in every shape (docs/theory/coupling.md, mixed
/// quadrature).
#include <gtest/gtest.h>

#include "coupling_bodies.hpp"

namespace solidus {
namespace {

using mesh::Shape;
using verification::Coupled;
using verification::CoupledRun;

/// A distorted block that is pulled while one side is chilled.
Coupled pulled(Shape shape) {
  Coupled c;
  const bool solid = mesh::dimension(shape) == 3;
  c.mesh =
      test::make_mesh({.shape = shape, .cells = {3, 3, 2}, .size = {0.05, 0.05, 0.05}, .distortion = 0.1});
  c.kind = solid ? AnalysisKind::solid : AnalysisKind::plane_strain;
  material::Material m = test::elastic_material(2e11, 0.3);
  m.young_modulus = Table({300, 900}, {2e11, 1.2e11});
  m.expansion = Table({300, 900}, {1.1e-5, 1.5e-5});
  c.materials = {m};
  c.start = {800};
  c.hold("bottom", 0);
  c.hold("bottom", 1);
  if (solid) c.hold("bottom", 2);
  c.hold("top", 1, Table({0, 8}, {0, 1e-4}));
  c.thermal.films.push_back({"chill", "top", {4000.0}, Table({0, 8}, {800, 300})});
  c.form = mechanics::StructuralForm::energy;
  return c;
}

TEST(MixedQuadrature, LosesNoEnergyBetweenTheRules) {
  for (const Shape shape : {Shape::tri3, Shape::quad4, Shape::tri6, Shape::quad8, Shape::tet4, Shape::hex8})
    for (const auto rule : {heat::HeatIntegration::closed, heat::HeatIntegration::open})
      for (const auto mapping : {mechanics::Mapping::isothermal, mechanics::Mapping::isentropic}) {
        Coupled c = pulled(shape);
        c.integration = rule;
        c.mapping = mapping;
        const CoupledRun run = verification::march(c, 8, 4);
        // Newton's criteria are 1e-12 of the heat and 1e-11 of the forces.
        EXPECT_LT(run.worst_defect(), 1e-10 * run.exchanged()) << mesh::name(shape);
        EXPECT_LT(std::abs(run.defect()), 1e-10 * run.exchanged()) << mesh::name(shape);
      }
}

}  // namespace
}  // namespace solidus
