/// The tangent is the derivative of the forces, for every kernel and both forms of the law's tangent.
#include <gtest/gtest.h>

#include "body.hpp"
#include "lattice.hpp"
#include "mechanics/elements/law_block.hpp"
#include "plastic_material.hpp"

namespace solidus {
namespace {

using mechanics::BlockKernel;
using mesh::Shape;

/// A law with a full tangent: σ = C ε + a (ε:ε) ε, whose derivative is C + a (ε:ε) I + 2 a ε ⊗ ε; with a = 0
/// the viscoelastic law of a solid through the general path.
struct Stiffening : material::Viscoelastic {
  using Viscoelastic::Viscoelastic;
  static inline double stiffening = 0;  ///< a/G
  template <class T>
  struct Response {
    Sym<T> stress;
    Sym4<T> tangent;
    State<T> state;
    T dissipation;
    material::Status status = material::Status::converged;
  };
  template <class T>
  static Response<T> update(const material::PointProperties<T>& p, const State<T>&, const Sym<T>& e,
                            const material::TimeStep&) {
    const T a = T(stiffening) * p.shear, size = dot(e, e);
    Response<T> r;
    r.tangent = Sym4<T>::isotropic(p.bulk, T(2.0) * p.shear);
    r.stress = T(2.0) * p.shear * dev(e) + a * size * e;
    for (int i = 0; i < 3; ++i) r.stress[i] += p.bulk * trace(e);
    for (int i = 0; i < 6; ++i) {
      r.tangent[i][static_cast<std::size_t>(i)] += a * size * T(i < 3 ? 1.0 : 0.5);
      for (int j = 0; j < 6; ++j) r.tangent[i][static_cast<std::size_t>(j)] += T(2.0) * a * e[i] * e[j];
    }
    r.dissipation = T(0.0);
    return r;
  }
};

struct Setting {
  mesh::Mesh mesh;
  AnalysisKind kind;
  material::Material material = test::elastic_material(2e11, 0.3, 1e-5);
  std::vector<double> temperature, u, direction;

  Setting(Shape shape, AnalysisKind k)
      : mesh(test::make_mesh({.shape = shape,
                              .cells = {3, 3, 2},
                              .distortion = 0.15,
                              .map =
                                  [](const mesh::Point& x) {
                                    return mesh::Point{x[0] + 0.3, x[1], x[2]};
                                  }})),
        kind(k) {
    const int nc = displacement_components(kind);
    temperature.assign(mesh.x.size(), 350.0);
    for (Index node = 0; node < mesh.n_nodes(); ++node)
      for (int i = 0; i < nc; ++i) {
        const double s = static_cast<double>(mesh.input_node[static_cast<std::size_t>(node)] * nc + i);
        u.push_back(1e-3 * std::sin(1.3 * s));
        direction.push_back(1e-3 * std::cos(2.1 * s));
      }
  }

  /// K d by the tangent, on owned rows.
  std::vector<double> product(BlockKernel& kernel) {
    const int nc = displacement_components(kind);
    linear::NodeGraph graph(mesh);
    for (const auto& block : mesh.blocks) graph.add_cliques(block.nodes, mesh::node_count(block.shape));
    linear::BlockMatrix matrix(mesh, nc, std::move(graph));
    kernel.bind(matrix);
    const mechanics::BlockHistory history = kernel.initial_history();
    kernel.prepare({temperature, temperature, temperature, u, u, &history, &history, &history, 0.5, 0.5});
    matrix.set_zero();
    kernel.add_tangent(u, matrix);
    std::vector<double> y(static_cast<std::size_t>(mesh.n_owned_nodes * nc));
    matrix.multiply(direction, y);
    return y;
  }
  /// Share of the elements that flow at u.
  double plastic_share(BlockKernel& kernel) {
    const mechanics::BlockHistory history = kernel.initial_history();
    mechanics::BlockHistory trial = history;
    kernel.prepare({temperature, temperature, temperature, u, u, &history, &history, &history, 0.5, 0.5});
    mechanics::SharedElementValues values;
    kernel.finish(u, u, {.history = trial, .elements = &values});
    std::vector<double> xi(static_cast<std::size_t>(mesh.blocks[0].size()));
    values->get(mechanics::ElementField::equivalent_plastic_strain, xi);
    return static_cast<double>(std::count_if(xi.begin(), xi.end(), [](double x) { return x > 0; })) /
           static_cast<double>(xi.size());
  }
  /// The same by central differences of the forces.
  std::vector<double> difference(BlockKernel& kernel, double step) {
    const mechanics::BlockHistory history = kernel.initial_history();
    kernel.prepare({temperature, temperature, temperature, u, u, &history, &history, &history, 0.5, 0.5});
    const auto forces = [&](double s) {
      std::vector<double> x = u, f(u.size(), 0.0);
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += s * direction[i];
      kernel.add_forces(x, f);
      return f;
    };
    std::vector<double> plus = forces(step), minus = forces(-step);
    for (std::size_t i = 0; i < plus.size(); ++i) plus[i] = (plus[i] - minus[i]) / (2 * step);
    return plus;
  }
};

void expect_near(const std::vector<double>& a, const std::vector<double>& b, double relative) {
  double size = 0;
  for (double value : a) size = std::max(size, std::abs(value));
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], relative * size) << "row " << i;
}

template <int n, Shape shape, AnalysisKind kind, bool b_bar>
void check() {
  Setting s(shape, kind);
  ASSERT_EQ(s.mesh.blocks.size(), 1u);
  const auto& block = s.mesh.blocks.front();
  const auto viscoelastic =
      mechanics::make_block_kernel(s.mesh, block, kind, s.material, mechanics::Mapping::isothermal, b_bar);
  const auto product = s.product(*viscoelastic);
  expect_near(product, s.difference(*viscoelastic, 1.0), 1e-10);  // the law is linear: no truncation
  mechanics::LawBlock<Stiffening, n, kind, b_bar> general(s.mesh, block, s.material);
  Stiffening::stiffening = 0;
  expect_near(product, s.product(general), 1e-12);  // two ways to the same matrix
  Stiffening::stiffening = 1e4;
  // truncation h² = 1e-8 of a cubic law, round-off 1e-16/h
  expect_near(s.product(general), s.difference(general, 1e-4), 1e-7);

  using material::KinematicHardening;
  for (const auto kinematic : {KinematicHardening::linear, KinematicHardening::armstrong_frederick}) {
    s.material = test::plastic_material(kinematic);
    const auto plastic =
        mechanics::make_block_kernel(s.mesh, block, kind, s.material, mechanics::Mapping::isothermal, b_bar);
    EXPECT_EQ(plastic->symmetric(), kinematic == KinematicHardening::linear);
    const auto tangent = s.product(*plastic);
    // the same truncation and round-off, on a law that yields in every point
    expect_near(tangent, s.difference(*plastic, 1e-4), 1e-6);
    ASSERT_GT(s.plastic_share(*plastic), 0.9);
  }
}

TEST(Tangent, IsTheDerivativeOfTheForcesInPlaneStrain) {
  constexpr auto kind = AnalysisKind::plane_strain;
  check<3, Shape::tri3, kind, false>();
  check<6, Shape::tri6, kind, false>();
  check<4, Shape::quad4, kind, false>();
  check<4, Shape::quad4, kind, true>();
  check<8, Shape::quad8, kind, false>();
  check<8, Shape::quad8, kind, true>();
}

TEST(Tangent, IsTheDerivativeOfTheForcesInAxisymmetry) {
  constexpr auto kind = AnalysisKind::axisymmetric;
  check<3, Shape::tri3, kind, false>();
  check<6, Shape::tri6, kind, false>();
  check<4, Shape::quad4, kind, false>();
  check<4, Shape::quad4, kind, true>();
  check<8, Shape::quad8, kind, false>();
  check<8, Shape::quad8, kind, true>();
}

TEST(Tangent, IsTheDerivativeOfTheForcesInSolids) {
  constexpr auto kind = AnalysisKind::solid;
  check<4, Shape::tet4, kind, false>();
  check<10, Shape::tet10, kind, false>();
  check<8, Shape::hex8, kind, false>();
  check<8, Shape::hex8, kind, true>();
  check<20, Shape::hex20, kind, true>();
}

}  // namespace
}  // namespace solidus
