#include <gtest/gtest.h>

#include "contact/surfaces/master_analytic.hpp"
#include "sliding_bodies.hpp"

namespace solidus::contact {
namespace {

using test::Asked;
using test::Sliding;

// Quantities that are differenced: g_N, ΔG, the carried traction and n.
struct Seen {
  Index face = -1;
  Partner::Region region = Partner::Region::face;
  double penetration = 0;
  Point slip{}, carried{}, normal{};
  std::vector<Point> force;  ///< w B_b f of the node's list
};

constexpr double k_pressure = 3;
// A history that has a traction in a tilted plane, and a way behind it.
ContactPointState old_state(const PointMotion& here, std::size_t dim) {
  ContactPointState old;
  old.anchored = true;
  old.anchor = here.anchor;
  old.anchor[0] += 0.011;
  old.anchor[dim - 1] -= 0.003;
  if (dim == 3) old.anchor[1] -= 0.007;
  Point n = here.master_normal;
  n[0] += 0.2;
  if (dim == 3) n[1] -= 0.1;
  old.master_normal = scale(1 / norm(n), n);
  old.traction = {0.7, dim == 2 ? -0.4 : 0.5, dim == 2 ? 0.0 : -0.6};
  old.traction = add_scaled(old.traction, -dot(old.traction, old.master_normal), old.master_normal);
  return old;
}

Seen look(const SlidingKinematics& k, Index p, const ContactPointState& old, const Point& traction) {
  const PointMotion m = k.motion(p, old, Asked::motion);
  Seen s{k.points().table().partner[static_cast<std::size_t>(p)].face,
         k.points().table().partner[static_cast<std::size_t>(p)].region,
         m.penetration,
         m.slip,
         m.carried,
         m.normal,
         {}};
  const Point f = add_scaled(times(m.push, traction), k_pressure, m.normal);
  for (double b : m.share) s.force.push_back(scale(m.weight * b, f));
  return s;
}

struct Worst {
  double penetration = 0, slip = 0, carried = 0, tangent = 0;
  int points = 0, turning = 0;
};

// Central differences of everything at every closed point, with respect to every coordinate of its nodes.
Worst compare(SlidingKinematics& k, const std::vector<double>& u, std::size_t dim, double length, int stride,
              bool wedges_only = false) {
  Worst worst;
  k.place(u);
  for (Index p = 0; p < k.n_points(); p += stride) {
    if (k.points().table().partner[static_cast<std::size_t>(p)].face < 0 ||
        k.points().table().partner[static_cast<std::size_t>(p)].penetration < 1e-3 * length)
      continue;
    if (wedges_only &&
        k.points().table().partner[static_cast<std::size_t>(p)].region == Partner::Region::face)
      continue;
    const ContactPointState old = old_state(k.motion(p, {}, Asked::motion), dim);
    const PointMotion m = k.motion(p, old, Asked::rates);
    Point traction{0.9, -1.3, dim == 2 ? 0 : 0.8};
    traction = add_scaled(traction, -dot(traction, m.master_normal), m.master_normal);
    const std::size_t n = m.nodes.size();
    std::vector<Tensor> tangent(n * n);
    k.add_geometric_tangent(p, k_pressure, traction, tangent);
    const std::vector<Index> nodes(m.nodes.begin(), m.nodes.end());
    const std::vector<Point> dg(m.penetration_rate.begin(), m.penetration_rate.end());
    const std::vector<Tensor> ds(m.slip_rate.begin(), m.slip_rate.end());
    std::vector<Tensor> dc(m.carried_rate.begin(), m.carried_rate.end());
    if (dc.empty())
      dc.resize(n);
    else
      ++worst.turning;
    const double weight = m.weight;
    const Partner partner = k.points().table().partner[static_cast<std::size_t>(p)];

    // Third derivatives are of the order of the inverse square of the radius of curvature, 0.1 m.
    const double h = 2e-5 * length;
    bool counted = true;
    for (std::size_t c = 0; c < n; ++c)
      for (std::size_t j = 0; j < dim; ++j) {
        std::vector<double> right = u, left = u;
        right[static_cast<std::size_t>(nodes[c]) * dim + j] += h;
        left[static_cast<std::size_t>(nodes[c]) * dim + j] -= h;
        k.place(right);
        const Seen r = look(k, p, old, traction);
        k.place(left);
        const Seen l = look(k, p, old, traction);
        // Where a face or wedge ends the derivative does, too.
        if (r.face != partner.face || l.face != partner.face || r.region != partner.region ||
            l.region != partner.region) {
          counted = false;
          continue;
        }
        worst.penetration =
            std::max(worst.penetration, std::abs((r.penetration - l.penetration) / (2 * h) - dg[c][j]));
        for (std::size_t i = 0; i < dim; ++i) {
          worst.slip = std::max(worst.slip, std::abs((r.slip[i] - l.slip[i]) / (2 * h) - ds[c][i][j]));
          worst.carried = std::max(worst.carried,
                                   length * std::abs((r.carried[i] - l.carried[i]) / (2 * h) - dc[c][i][j]));
          for (std::size_t b = 0; b < n; ++b) {
            const double difference = (r.force[b][i] - l.force[b][i]) / (2 * h);
            worst.tangent =
                std::max(worst.tangent, length / weight * std::abs(difference - tangent[b * n + c][i][j]));
          }
        }
      }
    k.place(u);
    worst.points += counted;
  }
  return worst;
}

// Rates are of order one, tangents of order t_N + |T| over the radius of curvature. A closed point in a
// wedge, where normals turn over the small distance g, has tangents g⁻¹ times that.
void expect_exact(const Worst& worst, int least) {
  EXPECT_GE(worst.points, least);
  EXPECT_LT(worst.penetration, 1e-7);
  EXPECT_LT(worst.slip, 1e-7);
  EXPECT_LT(worst.carried, 1e-7);
  EXPECT_LT(worst.tangent, 1e-6);
}

TEST(SlidingRates, AreThoseOfFiniteDifferencesOnCurvedAndWarpedFacesOfEveryShape) {
  for (mesh::Shape shape : test::k_all_bodies)
    for (bool smoothing : {false, true}) {
      SCOPED_TRACE(std::string(mesh::name(shape)) + (smoothing ? " smooth" : ""));
      const mesh::Mesh mesh = test::wavy_blocks(shape);
      const Sliding sliding(mesh, smoothing, {.gauss_degree = mesh.dimension == 3 ? 1 : 2});
      const auto dim = static_cast<std::size_t>(mesh.dimension);
      const Worst worst = compare(*sliding.kinematics, test::overlapping(mesh), dim, 0.1, 1);
      expect_exact(worst, 2);
    }
}

TEST(SlidingRates, HoldWithTheCircumferenceInTheWeightsOfAxisymmetry) {
  const mesh::Mesh mesh = test::wavy_blocks(mesh::Shape::quad8);
  for (IntegrationRule rule : {IntegrationRule::gauss, IntegrationRule::nodal}) {
    const Sliding sliding(mesh, true, {.rule = rule, .gauss_degree = 4}, AnalysisKind::axisymmetric);
    expect_exact(compare(*sliding.kinematics, test::overlapping(mesh), 2, 0.1, 1), 3);
  }
}

// Both interfaces bent into a groove, or in three dimensions a pit, around a node of the lower surface:
// behind it the normals leave wedges open at edges and at the vertex.
mesh::Mesh grooved(mesh::Shape shape) {
  mesh::Mesh mesh = test::two_blocks(shape);
  const auto last = static_cast<std::size_t>(mesh.dimension - 1);
  for (Point& x : mesh.x)
    x[last] +=
        0.4 * std::abs(x[0] - (last == 1 ? 0.12 : 0.1)) + (last == 2 ? 0.3 * std::abs(x[1] - 0.2 / 3) : 0);
  return mesh;
}

TEST(SlidingRates, AreThoseOfFiniteDifferencesInTheWedgesBehindEdgesAndVertices) {
  for (mesh::Shape shape : {mesh::Shape::quad4, mesh::Shape::tet4, mesh::Shape::hex8}) {
    SCOPED_TRACE(mesh::name(shape));
    const mesh::Mesh mesh = grooved(shape);
    const auto dim = static_cast<std::size_t>(mesh.dimension);
    const Sliding sliding(mesh, false, {.gauss_degree = 9});
    const auto u = test::nodal_field(mesh, mesh.dimension, [&](const Point&, bool upper) {
      std::vector<double> down(dim, 0.0);
      down[dim - 1] = upper ? -0.06 : 0;
      return down;
    });
    // Normals turn over the depth, 0.03 to 0.06.
    const Worst worst = compare(*sliding.kinematics, u, dim, 0.02, dim == 3 ? 3 : 1, true);
    expect_exact(worst, 1);
  }
}

std::vector<RigidSurface> tools() {
  using Shape = RigidSurface::Shape;
  std::vector<RigidSurface> all(5);
  all[0] = {.shape = Shape::plane, .point = {0.1, 0.103, 0.103}, .direction = {-0.1, 1, 0}};
  all[1] = {.shape = Shape::cylinder, .point = {0.13, -0.4, 0}, .direction = {0, 0, 1}, .radius = 0.5};
  all[2] = {.shape = Shape::sphere, .point = {0.13, 0.61, 0}, .radius = 0.5, .hollow = true};
  all[3] = {.shape = Shape::cylinder, .point = {0.1, 0.1, -0.4}, .direction = {1, 0.3, 0}, .radius = 0.5};
  all[4] = {.shape = Shape::sphere, .point = {0.13, 0.1, -0.4}, .radius = 0.5};
  for (RigidSurface& s : all) {
    s.motion.centre = {0.1, 0, 0.2};
    s.motion.angle = Table({0, 1}, {0, 0.05});
    s.motion.translation[0] = Table({0, 1}, {0, 0.02});
  }
  return all;
}

TEST(SlidingRates, AreThoseOfFiniteDifferencesOnMovingPlanesCylindersAndSpheres) {
  const auto surfaces = tools();
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    SCOPED_TRACE(i);
    const std::size_t dim = i < 3 ? 2 : 3;
    const mesh::Mesh mesh = test::wavy_blocks(dim == 2 ? mesh::Shape::quad8 : mesh::Shape::hex8, 0.002);
    SlidingKinematics k(mesh, test::kind_of(mesh), ContactSurface(mesh, "upper_bottom"),
                        std::make_unique<AnalyticMaster>(static_cast<int>(dim), surfaces[i], 0.1),
                        {.gauss_degree = 2});
    k.set_time(0.8);
    expect_exact(compare(k, test::overlapping(mesh, 0.02), dim, 0.1, 1), 2);
  }
}

}  // namespace
}  // namespace solidus::contact
