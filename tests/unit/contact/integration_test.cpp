#include "contact/points/integration.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "bodies.hpp"
#include "mesh/quadrature.hpp"
#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::contact {
namespace {

using mesh::Shape;

constexpr std::array k_shapes{Shape::tri3, Shape::quad4, Shape::tri6,  Shape::quad8,
                              Shape::tet4, Shape::hex8,  Shape::tet10, Shape::hex20};

// ∫ N_a dA over a surface at the owned nodes, by quadrature face by face.
std::map<Index, double> exact_integrals(const mesh::Mesh& mesh, const ContactSurface& surface,
                                        AnalysisKind kind) {
  std::map<Index, double> integrals;
  for (Index f = 0; f < surface.n_faces(); ++f) {
    const Face face = surface.reference_face(f);
    std::array<double, k_max_face_nodes> n;
    for (const auto& q : mesh::gauss_rule(face.shape, 8)) {
      mesh::basis_values(face.shape, q.xi, n);
      const double r = kind == AnalysisKind::axisymmetric ? 2 * std::numbers::pi * face.at(q.xi)[0] : 1;
      const auto nodes = surface.nodes(f);
      for (std::size_t a = 0; a < nodes.size(); ++a)
        if (nodes[a] < mesh.n_owned_nodes) integrals[nodes[a]] += q.weight * face.jacobian(q.xi) * r * n[a];
    }
  }
  return integrals;
}

// Σ_p w N_a of the points: slave's nodes positive, master's negative.
std::map<Index, double> point_sums(const mesh::Mesh& mesh, const ContactPoints& points) {
  std::map<Index, double> sums;
  for (const Pairing& pairing : points.pairings)
    for (Index p = 0; p < pairing.n_points; ++p)
      for (int a = 0; a < pairing.n_nodes(); ++a) {
        const Index node = points.nodes[pairing.first_node + static_cast<std::size_t>(a)];
        if (node < mesh.n_owned_nodes)
          sums[node] +=
              points.weight[static_cast<std::size_t>(pairing.first_point + p)] *
              points.shape[pairing.first_shape + static_cast<std::size_t>(p * pairing.n_nodes() + a)];
      }
  return sums;
}

IntegrationOptions options(IntegrationRule rule = IntegrationRule::segments) {
  IntegrationOptions o;
  o.rule = rule;
  o.search_distance = 0.05;
  return o;
}

// The largest defect of Σ w N_a at a node of either side and of the covered area, as a part of the area.
double largest_miss(const mesh::Mesh& mesh, AnalysisKind kind, const std::string& slave_name,
                    const std::string& master_name, IntegrationRule rule = IntegrationRule::segments) {
  const ContactSurface slave(mesh, slave_name), master(mesh, master_name);
  const ContactPoints points = integrate(mesh, kind, slave, master, options(rule));
  auto sums = point_sums(mesh, points);
  double miss = std::abs(points.paired_measure - points.slave_measure);
  for (const auto& [node, integral] : exact_integrals(mesh, slave, kind))
    miss = std::max(miss, std::abs(sums[node] - integral));
  for (const auto& [node, integral] : exact_integrals(mesh, master, kind))
    miss = std::max(miss, std::abs(sums[node] + integral));
  miss = parallel::global_max(miss) / points.slave_measure;
  ::testing::Test::RecordProperty(std::string(mesh::name(slave.shape(0))), fmt::format("{:.1e}", miss));
  return miss;
}

// An even pressure makes the forces of segments; every vertex of the slave has one point with the surface
// around it.
TEST(Mortar, IntegratesAsSegmentsDoWithOnePointForEveryVertexOfTheSlave) {
  for (Shape shape : k_shapes) {
    SCOPED_TRACE(mesh::name(shape));
    const mesh::Mesh mesh = test::two_blocks(shape);
    const AnalysisKind kind = mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
    EXPECT_LT(largest_miss(mesh, kind, "upper_bottom", "lower_top", IntegrationRule::mortar), 1e-12);
    const ContactSurface slave(mesh, "upper_bottom"), master(mesh, "lower_top");
    const ContactPoints points = integrate(mesh, kind, slave, master, options(IntegrationRule::mortar));
    std::map<Index, int> vertices;
    for (Index f = 0; f < slave.n_faces(); ++f)
      for (const Index node :
           slave.nodes(f).first(static_cast<std::size_t>(mesh::vertex_count(slave.shape(f)))))
        if (node < mesh.n_owned_nodes) vertices[node] = 1;
    GlobalIndex counted = 0;
    for (const Pairing& pairing : points.pairings) counted += pairing.counted ? 1 : 0;
    EXPECT_EQ(parallel::global_sum(static_cast<double>(counted)),
              parallel::global_sum(static_cast<double>(vertices.size())));
    for (const Point& n : points.normal) EXPECT_NEAR(norm(n), 1, 1e-14);
  }
}

TEST(Segments, IntegrateTheShapeFunctionsOfBothSidesExactlyOnMeshesThatDoNotMatch) {
  for (Shape shape : k_shapes) {
    SCOPED_TRACE(mesh::name(shape));
    const mesh::Mesh mesh = test::two_blocks(shape);
    const auto kind = mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
    EXPECT_LT(largest_miss(mesh, kind, "lower_top", "upper_bottom"), 1e-13);
    EXPECT_LT(largest_miss(mesh, kind, "upper_bottom", "lower_top"), 1e-13);
  }
}

TEST(Segments, CarryTheCircumferenceOnAxisymmetricBodiesFromTheAxisOn) {
  for (Shape shape : {Shape::tri3, Shape::quad8}) {
    SCOPED_TRACE(mesh::name(shape));
    const mesh::Mesh mesh = test::two_blocks(shape);
    EXPECT_LT(largest_miss(mesh, AnalysisKind::axisymmetric, "lower_top", "upper_bottom"), 1e-13);
    const ContactSurface slave(mesh, "lower_top"), master(mesh, "upper_bottom");
    const ContactPoints points = integrate(mesh, AnalysisKind::axisymmetric, slave, master, options());
    EXPECT_NEAR(points.slave_measure, std::numbers::pi * 0.3 * 0.3, 1e-14);
  }
}

// Moves the nodes within the interface so that quads become general ones.
void distort(mesh::RawMesh& raw) {
  for (auto& x : raw.x) {
    const double sx = std::sin(std::numbers::pi * x[0] / 0.3), sy = std::sin(std::numbers::pi * x[1] / 0.2);
    const double side = x[2] > 0.1 + 1e-9 || x[2] < 0.1 - 1e-9 ? 0 : 1;
    x[0] += 0.02 * side * sx * sy;
    x[1] -= 0.015 * side * sx * sy;
  }
}

mesh::Mesh distorted(Shape shape) {
  mesh::RawMesh raw = test::raw_blocks(test::standard_blocks(shape), shape);
  distort(raw);
  return test::distribute_blocks(raw);
}

TEST(Segments, OnDistortedTrianglesAreExactToo) {
  EXPECT_LT(largest_miss(distorted(Shape::tet4), AnalysisKind::solid, "lower_top", "upper_bottom"), 1e-13);
}

TEST(Segments, OnDistortedQuadsMissByWhatTheHighDegreeRuleLeaves) {
  // Shape functions of general quads are rational in the plane.
  EXPECT_LT(largest_miss(distorted(Shape::hex8), AnalysisKind::solid, "lower_top", "upper_bottom"), 1e-10);
}

TEST(Segments, OnFacesWithCurvedEdgesMissByTheSagittasOfTheirChords) {
  for (Shape shape : {Shape::tet10, Shape::hex20}) {
    SCOPED_TRACE(mesh::name(shape));
    const mesh::Mesh mesh = distorted(shape);
    EXPECT_LT(largest_miss(mesh, AnalysisKind::solid, "lower_top", "upper_bottom"), 1e-3);
  }
}

TEST(Segments, CoverOnlyTheOverlapWhenTheSlaveIsWider) {
  for (Shape shape : {Shape::quad4, Shape::hex8, Shape::tet4}) {
    SCOPED_TRACE(mesh::name(shape));
    mesh::TwoBlocks blocks = test::standard_blocks(shape);
    blocks.upper[0] = 0.17;
    const mesh::Mesh mesh = test::distribute_blocks(test::raw_blocks(blocks, shape));
    const ContactSurface lower(mesh, "lower_top"), upper(mesh, "upper_bottom");
    const auto kind = mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
    const ContactPoints points = integrate(mesh, kind, lower, upper, options());
    EXPECT_NEAR(points.paired_measure / points.slave_measure, 0.17 / 0.3, 1e-12);
  }
}

TEST(Segments, MeasureTheInitialGapAlongTheNormalFromSlaveToMaster) {
  for (Shape shape : {Shape::tri3, Shape::hex8}) {
    const mesh::Mesh mesh = test::two_blocks(shape, 2e-3);
    const auto last = static_cast<std::size_t>(mesh.dimension - 1);
    const auto kind = mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
    const ContactSurface lower(mesh, "lower_top"), upper(mesh, "upper_bottom");
    for (const bool up : {true, false}) {
      const ContactPoints points = up ? integrate(mesh, kind, lower, upper, options())
                                      : integrate(mesh, kind, upper, lower, options());
      for (std::size_t p = 0; p < points.weight.size(); ++p) {
        EXPECT_NEAR(points.initial_penetration[p], -2e-3, 1e-15);
        EXPECT_NEAR(points.normal[p][last], up ? 1 : -1, 1e-14);
      }
    }
  }
}

TEST(Segments, StopAtTheSearchDistance) {
  const mesh::Mesh mesh = test::two_blocks(Shape::quad4, 0.06);
  const ContactSurface lower(mesh, "lower_top"), upper(mesh, "upper_bottom");
  EXPECT_EQ(integrate(mesh, AnalysisKind::plane_strain, lower, upper, options()).paired_measure, 0);
}

TEST(NodalAndGaussRules, IntegrateTheSlavesShapeFunctions) {
  for (Shape shape : k_shapes)
    for (auto rule : {IntegrationRule::nodal, IntegrationRule::gauss}) {
      // The corner functions of 8-node faces have negative integrals, which contact cannot use.
      if (shape == Shape::hex20 && rule == IntegrationRule::nodal) continue;
      SCOPED_TRACE(mesh::name(shape));
      const mesh::Mesh mesh = test::two_blocks(shape);
      const auto kind = mesh.dimension == 2 ? AnalysisKind::axisymmetric : AnalysisKind::solid;
      const ContactSurface slave(mesh, "lower_top"), master(mesh, "upper_bottom");
      const ContactPoints points = integrate(mesh, kind, slave, master, options(rule));
      const auto sums = point_sums(mesh, points);
      for (const auto& [node, integral] : exact_integrals(mesh, slave, kind)) {
        const auto found = sums.find(node);
        EXPECT_NEAR(found == sums.end() ? 0 : found->second, integral, 1e-13 * points.slave_measure);
      }
    }
}

TEST(NodalRule, SharesOutTheAreaOf8NodeFacesWithPositiveWeights) {
  const mesh::Mesh mesh = test::two_blocks(Shape::hex20);
  const ContactSurface slave(mesh, "lower_top"), master(mesh, "upper_bottom");
  const ContactPoints points =
      integrate(mesh, AnalysisKind::solid, slave, master, options(IntegrationRule::nodal));
  for (double w : points.weight) EXPECT_GT(w, 0);
  EXPECT_NEAR(points.paired_measure, 0.3 * 0.2, 1e-15);
}

TEST(ContactPoints, AreCountedOnceOverAllProcessesAndCompleteForOwnedRows) {
  for (Shape shape : {Shape::tri3, Shape::hex8}) {
    const mesh::Mesh mesh = test::two_blocks(shape);
    const auto kind = mesh.dimension == 2 ? AnalysisKind::plane_strain : AnalysisKind::solid;
    const ContactSurface slave(mesh, "lower_top"), master(mesh, "upper_bottom");
    const ContactPoints points = integrate(mesh, kind, slave, master, options());
    double counted = 0;
    for (const Pairing& p : points.pairings)
      for (Index i = 0; p.counted && i < p.n_points; ++i)
        counted += points.weight[static_cast<std::size_t>(p.first_point + i)];
    EXPECT_NEAR(parallel::global_sum(counted), slave.measure(), 1e-14);
  }
}

// An L: the bottom and the right wall of a box that lies in a trough, as one surface each.
TEST(Segments, PairEachWallOfACornerWithTheWallItFaces) {
  mesh::CylinderInMould c{0.02, 0.05, 0.01, 0.01, 0.08, 0.004, 0.006};
  const int rank = processes::rank();
  const mesh::RawMesh raw = rank == 0 ? mesh::make_cylinder_in_mould(c, Shape::tri3) : mesh::RawMesh{};
  const mesh::Mesh mesh = mesh::distribute(raw, {"part", "mould"}, {"part_surface", "mould_surface"});
  const ContactSurface slave(mesh, "part_surface"), master(mesh, "mould_surface");
  const ContactPoints points = integrate(mesh, AnalysisKind::axisymmetric, slave, master, options());
  const double area = std::numbers::pi * 0.02 * 0.02 + 2 * std::numbers::pi * 0.02 * 0.05;
  EXPECT_NEAR(points.paired_measure, area, 1e-12 * area);
  for (std::size_t p = 0; p < points.weight.size(); ++p) {
    EXPECT_NEAR(points.initial_penetration[p], 0, 1e-15);
    const bool side = points.position[p][0] > 0.02 - 1e-12;
    EXPECT_NEAR(points.normal[p][side ? 0 : 1], side ? 1 : -1, 1e-14);
  }
}

}  // namespace
}  // namespace solidus::contact
