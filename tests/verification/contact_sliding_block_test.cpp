/// A deformable block under a uniform pressure, pulled over a rigid meshed base, with every internal variable
/// of friction.
///
///        p ↓ ↓ ↓ ↓   → U(t)        block: h, G, plane top and bottom, without lateral strain (ν = 0):
///        ┌───┬───┐                 homogeneous shear, uniform pressure
///   ┌────┴─┬─┴───┴┬──────┬───┐     base: all nodes held
///   └──────┴──────┴──────┴───┘
///
/// The way of the top is slip, elastic slip and shear: U = s + τ (1/ε_T + h/G), τ = μ(ζ) p. Over the slip
///
///   ζ' = p (normal work),   μ(ζ) p (frictional work),   1 (slip)
///
/// and the accumulated dissipation is ∫ μ_0 p ds for normal work (3.58), ∫ μ p ds for the others.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "contact_rubbing.hpp"

namespace solidus {
namespace {

using contact::InternalVariable;
using mesh::Shape;

constexpr double k_pressure = 40e6, k_young = 70e9, k_height = 0.01, k_penalty = 1e13, k_way = 0.1;

test::Rubbing make_block(contact::FrictionParameters friction, Shape shape, contact::IntegrationRule rule) {
  const bool flat = mesh::dimension(shape) == 2;
  mesh::TwoBlocks blocks{{0.16, 0.01}, {0.03, k_height}, {13, 1}, {2, 1}, 0};
  if (!flat) blocks = {{0.16, 0.03, 0.01}, {0.03, 0.02, k_height}, {13, 2, 1}, {2, 1, 1}, 0};
  mesh::RawMesh raw = test::raw_blocks(blocks, shape);
  test::map_body(raw, "upper", [&](mesh::Point x) {
    x[0] += 0.015;
    if (!flat) x[1] += 0.004;
    return x;
  });
  mechanics::MechanicalConditions c;
  const int last = flat ? 1 : 2;
  const std::string top = flat ? "upper_y_max" : "upper_z_max";
  for (int i = 0; i <= last; ++i) c.displacements.push_back({"lower", i, 0.0});
  if (!flat) c.displacements.push_back({"upper", 1, 0.0});
  c.displacements.push_back({top, 0, Table({0, 1}, {0, k_way})});
  c.plane_faces = {{top}, {"upper_bottom"}};
  c.pressures.push_back({top, k_pressure});
  contact::ContactParameters spec = test::rubbing(std::move(friction), k_penalty);
  spec.integration = rule;
  return {test::distribute_blocks(raw),
          flat ? AnalysisKind::plane_strain : AnalysisKind::solid,
          {test::elastic(k_young, 0), test::elastic(k_young, 0)},
          c,
          std::move(spec)};
}

struct Exact {
  double slip = 0, zeta = 0, work = 0, dissipation = 0, force = 0;
};

/// Runge–Kutta over the slip until the way of the top is used up.
Exact exact(const contact::FrictionParameters& spec, double way) {
  const contact::FrictionCoefficient law(spec.coefficient);
  const auto mu = [&](double zeta) { return law.value(zeta, 300).value; };
  const auto rate = [&](double zeta) {
    switch (spec.internal_variable) {
      case InternalVariable::normal_work:
        return k_pressure;
      case InternalVariable::frictional_work:
        return mu(zeta) * k_pressure;
      case InternalVariable::slip:
        break;
    }
    return 1.0;
  };
  const double compliance = k_pressure * (1 / k_penalty + k_height / (0.5 * k_young));
  const bool stores = spec.internal_variable == InternalVariable::normal_work;
  Exact e;
  constexpr double k_ds = 1e-6;
  while (e.slip + mu(e.zeta) * compliance < way) {
    const double left = way - e.slip - mu(e.zeta) * compliance, h = std::min(k_ds, left);
    const double a = rate(e.zeta), b = rate(e.zeta + 0.5 * h * a), c = rate(e.zeta + 0.5 * h * b),
                 d = rate(e.zeta + h * c), next = e.zeta + h / 6 * (a + 2 * b + 2 * c + d);
    const double middle = 0.5 * (mu(e.zeta) + mu(next));
    e.work += middle * k_pressure * h;
    e.dissipation += (stores ? mu(0) : middle) * k_pressure * h;
    e.zeta = next;
    e.slip += h;
    if (h < 1e-16) break;
  }
  e.force = mu(e.zeta) * k_pressure;
  return e;
}

void compare(const contact::FrictionParameters& spec, Shape shape, int steps, const std::string& name,
             contact::IntegrationRule rule = contact::IntegrationRule::gauss) {
  SCOPED_TRACE(name);
  test::Rubbing block = make_block(spec, shape, rule);
  block.advance(1, steps);
  EXPECT_EQ(block.n_cuts, 0);
  const Exact e = exact(spec, k_way);
  const contact::ContactSums sums = block.sums();
  const double area = block.integral([](const auto&) { return 1.0; });
  const Exact found{.slip = block.mean([](const auto& p) { return p.slip; }),
                    .zeta = block.mean([](const auto& p) { return p.internal_variable; }),
                    .work = sums.work / area,
                    .dissipation = sums.dissipation / area,
                    .force = sums.friction / area};
  // For normal work and slip backward Euler is exact in ζ; the rest is of first order in the step.
  const bool exactly = spec.internal_variable != InternalVariable::frictional_work;
  for (auto field : {&Exact::slip, &Exact::zeta, &Exact::force})
    EXPECT_NEAR(found.*field, e.*field, (exactly ? 1e-5 : 0.1 / steps) * e.*field);
  for (auto field : {&Exact::work, &Exact::dissipation})
    EXPECT_NEAR(found.*field, e.*field, 0.1 / steps * e.*field);
  // All points alike: pressure and slip are uniform.
  EXPECT_NEAR(block.mean([&](const auto& p) { return std::abs(p.slip / found.slip - 1); }), 0, 1e-6);
  ::testing::Test::RecordProperty(
      name,
      fmt::format("zeta {:.1e} slip {:.1e} work {:.1e} dissipation {:.1e} force {:.1e}; mu {:.4f}, Newton {}",
                  found.zeta / e.zeta - 1, found.slip / e.slip - 1, found.work / e.work - 1,
                  found.dissipation / e.dissipation - 1, found.force / e.force - 1, found.force / k_pressure,
                  block.most_iterations));
}

contact::FrictionParameters curve(InternalVariable variable, double unit) {
  contact::FrictionParameters spec;
  spec.coefficient.curves = {{300, Table({0, 1, 2, 3}, {0.15, 0.18, 0.16, 0.17})}};
  spec.coefficient.unit = unit;
  spec.internal_variable = variable;
  return spec;
}

TEST(SlidingBlock, FollowsItsClosedFormWithEveryInternalVariable) {
  using contact::friction_spec;
  constexpr double k_unit = contact::k_kilonewton_per_mm;
  constexpr int k_steps = 1000;
  const auto run = [&](const contact::FrictionParameters& spec, const char* name) {
    compare(spec, Shape::quad4, k_steps, name);
  };
  run(friction_spec(contact::galvannealed(), k_unit), "normal_work_linear");
  run(friction_spec(contact::electrogalvanised(), k_unit), "normal_work_polynomial");
  run(curve(InternalVariable::normal_work, k_unit), "normal_work_table");
  run(friction_spec({0.15, 0.03}, k_unit, InternalVariable::frictional_work), "frictional_work_hardens");
  run(friction_spec({0.2, -0.03}, k_unit, InternalVariable::frictional_work), "frictional_work_softens");
  run(curve(InternalVariable::frictional_work, 0.2 * k_unit), "frictional_work_table");
  run(friction_spec({0.15, 0.1}, 1, InternalVariable::slip), "slip_linear");
  run(friction_spec({0.15, 0.5, -4.0}, 1, InternalVariable::slip), "slip_polynomial");
  run(curve(InternalVariable::slip, 0.03), "slip_table");
}

TEST(SlidingBlock, DoesSoInThreeDimensionsAndWithOtherShapes) {
  for (const Shape shape : {Shape::tri3, Shape::quad8, Shape::tri6, Shape::hex8, Shape::tet4})
    compare(contact::friction_spec(contact::galvannealed(), contact::k_kilonewton_per_mm), shape, 100,
            std::string(mesh::name(shape)));
}

TEST(SlidingBlock, DoesSoWithSegmentsThatAreCutAnewInEveryStep) {
  for (const Shape shape : {Shape::quad4, Shape::quad8, Shape::hex8, Shape::tet4})
    compare(contact::friction_spec(contact::galvannealed(), contact::k_kilonewton_per_mm), shape, 100,
            std::string(mesh::name(shape)) + "_segments", contact::IntegrationRule::segments);
}

}  // namespace
}  // namespace solidus
