/// Large sliding with segments: means over cells of the slave's faces.
#include "contact/points/segment_kinematics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "contact/surfaces/face_cells.hpp"
#include "sliding_bodies.hpp"

namespace solidus::contact {
namespace {

using test::Asked;

constexpr double k_pressure = 3;

/// "upper_bottom" on "lower_top".
std::unique_ptr<SegmentKinematics> segments(const mesh::Mesh& mesh, bool smoothing = false) {
  const ContactSurface slave(mesh, "upper_bottom"), master(mesh, "lower_top");
  return std::make_unique<SegmentKinematics>(
      mesh, test::kind_of(mesh), slave, master,
      std::make_unique<MeshMaster>(mesh.dimension, master,
                                   MeshMasterOptions{.search_distance = 0.1, .smoothing = smoothing}),
      0.1);
}

/// Both bodies sheared and stretched alike, the upper one pushed into the lower and along it: interfaces stay
/// flat and parallel.
std::vector<double> sheared(const mesh::Mesh& mesh, double shift) {
  const auto dim = static_cast<std::size_t>(mesh.dimension);
  return test::nodal_field(mesh, mesh.dimension, [&](const Point& x, bool upper) {
    std::vector<double> u(dim);
    u[0] = 0.03 * x[0] + (upper ? shift : 0);
    u[dim - 1] = 0.05 * x[0] - (upper ? 0.004 : 0);
    if (dim == 3) u[1] = 0.02 * x[1] - 0.01 * x[0] + (upper ? 0.3 * shift : 0);
    return u;
  });
}

TEST(FaceCells, CoverTheirFaceOnceAndKnowTheirPlaces) {
  for (const auto shape : {mesh::Shape::line2, mesh::Shape::line3, mesh::Shape::tri3, mesh::Shape::tri6,
                           mesh::Shape::quad4, mesh::Shape::quad8}) {
    SCOPED_TRACE(mesh::name(shape));
    Face face;
    face.shape = shape;
    face.n_nodes = mesh::node_count(shape);
    for (std::size_t a = 0; a < static_cast<std::size_t>(face.n_nodes); ++a) face.x[a] = node_xi(shape, a);
    double area = 0;
    const auto cells = face_cells(shape);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      for (const SlaveRulePoint& q : cell_rule(face, AnalysisKind::solid, cells[c], 4)) {
        EXPECT_EQ(cell_of(shape, q.xi), c);
        area += q.weight;
      }
    }
    EXPECT_NEAR(area, face.measure(), 1e-12);
  }
}

TEST(SegmentKinematics, ForcesOfAnEvenPressureAreExactOnBothSidesWhereverTheBodiesAre) {
  const mesh::Mesh mesh = test::two_blocks(mesh::Shape::quad4);
  const auto k = segments(mesh);
  const ContactSurface slave(mesh, "upper_bottom"), master(mesh, "lower_top");
  for (const double shift : {0.0, 0.017, 0.06, 0.071, 0.19}) {
    SCOPED_TRACE(shift);
    const std::vector<double> u = sheared(mesh, shift);
    k->place(u);
    // The slave's particle X lies on x = 1.03 X + shift, this much above the master, whose slope is s.
    const double s = 0.05 / 1.03, above = -(s * shift + 0.004);
    const double further = (shift + above * s / (1 + s * s)) / 1.03;  // its partner on the master
    std::vector<double> expected(mesh.x.size(), 0.0), found(mesh.x.size(), 0.0);
    const auto add_shapes = [&](const ContactSurface& surface, double x, double weight) {
      for (Index f = 0; f < surface.n_faces(); ++f) {
        const auto nodes = surface.nodes(f);
        const auto end = [&](std::size_t a) { return mesh.x[static_cast<std::size_t>(nodes[a])][0]; };
        const double along = (x - end(0)) / (end(1) - end(0));
        if (along < 0 || along >= 1) continue;
        expected[static_cast<std::size_t>(nodes[0])] += weight * (1 - along);
        expected[static_cast<std::size_t>(nodes[1])] += weight * along;
      }
    };
    // ∫ N over the part of each surface that the other one covers, by many points.
    const double covered = 0.3 - std::abs(further), first = std::max(0.0, -further);
    constexpr int k_many = 20000;
    for (int i = 0; i < k_many; ++i) {
      const double x = first + (i + 0.5) * covered / k_many;
      add_shapes(slave, x, covered / k_many);
      add_shapes(master, x + further, covered / k_many);
    }
    double sum = 0;
    for (Index p = 0; p < k->n_points(); ++p) {
      const PointMotion m = k->motion(p, {}, Asked::motion);
      if (!m.partnered) continue;
      sum += m.weight;
      EXPECT_EQ(m.weight, k->particle(p).weight);
      for (std::size_t b = 0; b < m.nodes.size(); ++b)
        found[static_cast<std::size_t>(m.nodes[b])] += m.weight * norm(m.normal_at(b));
    }
    EXPECT_NEAR(sum, covered, 1e-9);
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 2e-6) << i;
  }
}

/// Central differences of gap, slip and forces of every closed cell, with respect to every coordinate of its
/// nodes.
TEST(SegmentKinematics, RatesAreThoseOfFiniteDifferences) {
  // Quadratic faces in space: what the quadrature misses of bent faces changes with them, 10 to 15 % of
  // single entries.
  for (const auto shape : {mesh::Shape::quad4, mesh::Shape::quad8, mesh::Shape::tet4, mesh::Shape::hex8}) {
    SCOPED_TRACE(mesh::name(shape));
    const mesh::Mesh mesh = test::two_blocks(shape);
    const auto dim = static_cast<std::size_t>(mesh.dimension);
    const auto k = segments(mesh);
    const std::vector<double> u = sheared(mesh, 0.013);
    constexpr double h = 1e-7;
    int compared = 0;
    const int stride = dim == 2 ? 1 : 11;
    k->place(u);
    double whole = 0;
    for (Index p = 0; p < k->n_points(); ++p) whole = std::max(whole, k->particle(p).weight);
    for (Index p = 0; p < k->n_points(); p += stride) {
      k->place(u);
      const PointMotion start = k->motion(p, {}, Asked::motion);
      // What the master's end uncovers is in the forces alone.
      if (!start.partnered || start.weight < (1 - 1e-9) * whole) continue;
      ContactPointState old;
      old.anchored = true;
      old.anchor = start.anchor;
      old.anchor[0] += 0.011;
      old.master_normal = start.master_normal;
      old.traction = {0.7, dim == 2 ? 0 : 0.5, 0};
      Point traction{0.9, dim == 2 ? 0.0 : 0.8, 0};
      const PointMotion m = k->motion(p, old, Asked::rates);
      const std::size_t n = m.nodes.size();
      std::vector<Tensor> tangent(n * n);
      k->add_geometric_tangent(p, k_pressure, traction, tangent);
      const std::vector<Index> nodes(m.nodes.begin(), m.nodes.end());
      const std::vector<Point> dg(m.penetration_rate.begin(), m.penetration_rate.end());
      const std::vector<Tensor> ds(m.slip_rate.begin(), m.slip_rate.end());
      const double weight = m.weight;
      struct Seen {
        double penetration;
        Point slip;
        std::vector<Point> force;  ///< of the nodes of `m`
      };
      const auto look = [&](std::size_t node, std::size_t j, double by) {
        std::vector<double> moved = u;
        moved[static_cast<std::size_t>(nodes[node]) * dim + j] += by;
        k->place(moved);
        const PointMotion at = k->motion(p, old, Asked::motion);
        Seen seen{at.penetration, at.slip, std::vector<Point>(n)};
        for (std::size_t b = 0; b < at.nodes.size(); ++b) {
          const auto place = std::ranges::find(nodes, at.nodes[b]) - nodes.begin();
          EXPECT_LT(place, static_cast<std::ptrdiff_t>(n));
          if (place < static_cast<std::ptrdiff_t>(n))
            seen.force[static_cast<std::size_t>(place)] =
                scale(at.weight, at.force_at(b, k_pressure, traction));
        }
        return seen;
      };
      for (std::size_t c = 0; c < n; ++c)
        for (std::size_t j = 0; j < dim; ++j) {
          const Seen right = look(c, j, h), left = look(c, j, -h);
          EXPECT_NEAR((right.penetration - left.penetration) / (2 * h), dg[c][j], 1e-5);
          for (std::size_t i = 0; i < dim; ++i) {
            EXPECT_NEAR((right.slip[i] - left.slip[i]) / (2 * h), ds[c][i][j], 2e-5);
            for (std::size_t b = 0; b < n; ++b)
              EXPECT_NEAR((right.force[b][i] - left.force[b][i]) / (2 * h) / weight,
                          tangent[b * n + c][i][j] / weight, 1e-2)  // of some 100
                  << b << " " << c << " " << i << " " << j;
          }
          ++compared;
        }
    }
    EXPECT_GT(compared, 20);
  }
}

TEST(SegmentKinematics, ACellThatIsCoveredInPartSlipsAsFarAsItsSlave) {
  for (const auto shape : {mesh::Shape::quad4, mesh::Shape::hex8, mesh::Shape::tet4}) {
    SCOPED_TRACE(mesh::name(shape));
    const mesh::Mesh mesh = test::two_blocks(shape);
    const auto k = segments(mesh);
    const auto pushed = [&](double shift) {
      return test::nodal_field(mesh, mesh.dimension, [&](const Point&, bool upper) {
        std::vector<double> u(static_cast<std::size_t>(mesh.dimension));
        u[0] = upper ? shift : 0;
        u.back() = upper ? -1e-4 : 0;
        return u;
      });
    };
    k->place(pushed(0.011));
    std::vector<ContactPointState> old(static_cast<std::size_t>(k->n_points()));
    for (Index p = 0; p < k->n_points(); ++p) {
      const PointMotion m = k->motion(p, {}, Asked::motion);
      ContactPointState& state = old[static_cast<std::size_t>(p)];
      state.anchored = m.partnered;
      state.anchor = m.anchor;
      state.master_normal = m.master_normal;
    }
    k->place(pushed(0.019));
    double most = 0, least = 1;
    for (Index p = 0; p < k->n_points(); ++p) {
      const PointMotion m = k->motion(p, old[static_cast<std::size_t>(p)], Asked::motion);
      if (!m.partnered) continue;
      EXPECT_NEAR(m.slip[0], 0.008, 1e-10);
      most = std::max(most, m.weight);
      least = std::min(least, m.weight);
    }
    EXPECT_LT(least, 0.9 * most);
  }
}

}  // namespace
}  // namespace solidus::contact
