/// A pin that slides over a plate and wears it by Archard's law.
///
///        ┌──a──┐ ──► s from 0 to L
///   ─────┴─────┴──────────────────────   the plate, x
///
/// Both move as rigid bodies, so the pressure p is uniform under the pin. A place x of the plate is under the
/// pin while x − a <= s <= x: it loses the depth
///
///   h(x) = m k p/H · |[x − a, x] ∩ [0, L]|
///
/// a trapezium, flat at m k p a/H where the whole pin has passed, whatever the size of the pin's faces. The
/// pin loses (1 − m) k p L/H everywhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact_rubbing.hpp"

namespace solidus {
namespace {

constexpr double k_pin = 0.02, k_way = 0.04, k_start = 0.01;                // [m]
constexpr double k_archard = 1e-4, k_hardness = 1e9, k_penetration = 1e-6;  // [1], [Pa], [m]
constexpr double k_penalty = 1e13;                                          // [Pa/m]
constexpr int k_steps = 80;  // of an eighth of a face of the plate

test::Rubbing make(mesh::Shape shape, double share, AnalysisKind kind = AnalysisKind::plane_strain) {
  mesh::TwoBlocks blocks{{0.08, 0.01}, {k_pin, 0.01}, {20, 1}, {7, 1}, 0};
  if (mesh::dimension(shape) == 3) {
    blocks = {{0.08, 0.02, 0.01}, {k_pin, 0.02, 0.01}, {20, 1, 1}, {7, 3, 1}, 0};
    kind = AnalysisKind::solid;
  }
  mesh::RawMesh raw = test::raw_blocks(blocks, shape);
  test::map_body(raw, "upper", [](mesh::Point x) {
    x[0] += k_start;
    return x;
  });
  mesh::Mesh mesh = test::distribute_blocks(raw);
  mechanics::MechanicalConditions c;
  const auto up = static_cast<std::size_t>(mesh.dimension - 1);
  for (int i = 0; i < mesh.dimension; ++i) c.displacements.push_back({"lower", i, 0.0});
  c.displacements.push_back({"upper", 0, Table({0, 1}, {0, k_way})});
  if (up == 2) c.displacements.push_back({"upper", 1, 0.0});
  c.displacements.push_back({"upper", static_cast<int>(up), -k_penetration});
  contact::ContactParameters s = test::rubbing(test::coulomb(0.2), k_penalty);
  s.search_distance = 1e-3;
  s.friction->tangential_penalty = 1e18;  // no elastic slip to speak of
  s.wear = contact::WearParameters{k_archard, k_hardness, share, {}};
  return {std::move(mesh), kind, {test::elastic(2e11, 0.3), test::elastic(2e11, 0.3)}, c, s};
}

/// The depth at the nodes of a body's contact surface, by x.
template <class Visit>
void each_depth(const test::Rubbing& r, const char* surface, const Visit& visit) {
  const contact::ContactNodalFields fields = contact::nodal_fields(r.pair.view(), {});
  const std::vector<Index>& nodes = r.mesh.surfaces.at(surface).nodes;
  for (std::size_t k = 0; k < fields.nodes.size(); ++k)
    if (std::find(nodes.begin(), nodes.end(), fields.nodes[k]) != nodes.end())
      visit(r.mesh.x[static_cast<std::size_t>(fields.nodes[k])][0], fields.wear_depth[k],
            fields.dissipation[k]);
}

double trapezium(double x) {
  const double from = std::max(x - k_start - k_pin, 0.0), to = std::min(x - k_start, k_way);
  return std::max(to - from, 0.0);
}

void wears(mesh::Shape shape, double share) {
  SCOPED_TRACE(std::string(mesh::name(shape)) + " " + std::to_string(share));
  test::Rubbing r = make(shape, share);
  r.advance(1, k_steps);
  const double pressure = k_penalty * k_penetration, rate = k_archard * pressure / k_hardness;
  const double face = 0.08 / 20;
  double worst = 0;
  each_depth(r, "lower_top", [&](double x, double depth, double dissipation) {
    // A node shows the mean around it: the bends of the trapezium are a face wide.
    double bend = 1;
    for (const double at : {k_start, k_start + k_pin, k_start + k_way, k_start + k_way + k_pin})
      bend = std::min(bend, std::abs(x - at));
    const double exact = share * rate * trapezium(x);
    if (bend > 1.01 * face) worst = std::max(worst, std::abs(depth - exact));
    EXPECT_NEAR(dissipation, 0.2 * pressure * depth / (share * rate), 1e-9 * pressure * k_pin);
  });
  // Steps of an eighth of a face, so that the sum over them is exact on straight pieces of the profile and
  // counts a place up to half a step early.
  EXPECT_LT(parallel::global_max(worst), share * rate * 0.51 * k_way / k_steps);
  double volume = 0;
  for (const contact::WornNode& node : r.contact.master)
    if (node.counted) volume += node.volume;
  const double width = mesh::dimension(shape) == 3 ? 0.02 : 1;
  EXPECT_NEAR(parallel::global_sum(volume), share * rate * k_way * k_pin * width,
              1e-9 * rate * k_way * k_pin);
  each_depth(r, "upper_bottom", [&](double, double depth, double) {
    EXPECT_NEAR(depth, (1 - share) * rate * k_way, 1e-9 * rate * k_way);
  });
}

TEST(Wear, OfThePlateUnderAPinIsTheTrapeziumOfTheClosedForm) {
  wears(mesh::Shape::quad4, 1);
  wears(mesh::Shape::hex8, 1);
}

TEST(Wear, IsSharedByBothSidesAsAsked) {
  wears(mesh::Shape::quad4, 0.25);
}

TEST(Wear, OfThePlateStaysWhereItIsWhenThePinIsLiftedOff) {
  test::Rubbing once = make(mesh::Shape::quad4, 1);
  once.advance(1, k_steps);
  std::vector<double> before;
  for (const contact::WornNode& node : once.contact.master) before.push_back(node.volume);
  // Lifted off, and pressed there again: nothing changes.
  contact::ContactState kept = once.contact;
  once.pair.activate(false);
  once.pair.restore(kept, once.state.displacement, once.time);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(once.pair.state().master[i].volume, before[i]);
  once.pair.activate(true);
  once.pair.restore(once.pair.state(), once.state.displacement, once.time);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(once.pair.state().master[i].volume, before[i]);
}

TEST(Wear, OfARigidMasterIsRefused) {
  test::Rubbing r = make(mesh::Shape::quad4, 1);
  contact::ContactParameters s = r.pair.parts().spec;
  s.rigid_master = contact::RigidSurface{};
  EXPECT_THROW(contact::ContactPair(r.mesh, AnalysisKind::plane_strain, s), InputError);
}

}  // namespace
}  // namespace solidus
