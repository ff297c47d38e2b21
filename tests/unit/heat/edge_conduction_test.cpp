/// Conduction at a re-entrant edge of 90 degrees: a square, or a box, of which a quarter is missing.
///
///        +-------+-------+        s = r^(2/3) cos(2φ/3)   its faces at one temperature
///        |               |        s = r^(2/3) sin(2φ/3)   no heat through them
///        |       +-------+ leg    φ from the bisector, r from the edge
///        |       |                k ∫|∇s|² is exact: the heat that temperature differences of s conduct
///        +-------+
///               leg
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "block.hpp"
#include "heat/conduction/edge_conduction.hpp"
#include "heat/iteration/heat_system.hpp"
#include "parallel/parallel.hpp"

namespace solidus {
namespace {

using mesh::Point;
using mesh::Shape;

constexpr double k_angle = 1.5 * std::numbers::pi, k_alpha = 2.0 / 3, k_height = 0.3;

enum class Faces { one_temperature, insulated };

class Law : public PlaceLaw {
 public:
  using Value = std::function<double(const Position&)>;
  explicit Law(Value value) : value_(std::move(value)) {}
  void values(std::span<const Position> x, double, std::span<double> values) const override {
    for (std::size_t i = 0; i < x.size(); ++i) values[i] = value_(x[i]);
  }

 private:
  Value value_;
};

double singular(const Point& x, Faces faces) {
  double angle = std::atan2(x[1], x[0]);  // from one leg to the other
  if (angle < -1e-9) angle += 2 * std::numbers::pi;
  const double phi = std::min(angle, k_angle) - k_angle / 2, r = std::hypot(x[0], x[1]);
  return std::pow(r, k_alpha) *
         (faces == Faces::one_temperature ? std::cos(k_alpha * phi) : std::sin(k_alpha * phi));
}

/// ∫|∇s|² over the square of half width one less its quarter: α/2 ∫R(φ)^2α dφ for either function.
double exact_energy() {
  constexpr int k_parts = 20000;
  double sum = 0;
  for (int i = 0; i < k_parts; ++i) {
    const double angle = k_angle * (i + 0.5) / k_parts;
    sum += std::pow(1 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle))), 2 * k_alpha);
  }
  return k_alpha / 2 * sum * k_angle / k_parts;
}

/// Places of the nodes on an axis: of even cells, or with three thin ones next to the edge.
std::vector<double> axis(bool graded) {
  std::vector<double> half;
  if (graded) half = {0.03, 0.0675, 0.114};
  const int n = 8;
  const double first = graded ? half.back() : 0.0;
  for (int i = 1; i <= n; ++i) half.push_back(first + (1 - first) * i / n);
  std::vector<double> all;
  for (auto x = half.rbegin(); x != half.rend(); ++x) all.push_back(-*x);
  all.push_back(0);
  all.insert(all.end(), half.begin(), half.end());
  return all;
}

/// The square or box less its quarter x > 0, y < 0, in triangles or tetrahedra with crooked edges inside.
mesh::Mesh angle_mesh(Shape shape, bool graded) {
  mesh::RawMesh raw;
  if (test::rank() == 0) {
    const bool solid = shape == Shape::tet4;
    const std::vector<double> at = axis(graded);
    const int n = static_cast<int>(at.size()) - 1, n_up = solid ? 2 : 0;
    raw.dimension = solid ? 3 : 2;
    std::map<std::array<int, 3>, Index> numbers;
    mesh::RawBlock nodes_of_legs{Shape::point1, {}, {}}, outer = nodes_of_legs;
    const auto node = [&](int i, int j, int k) {
      const auto [found, fresh] = numbers.try_emplace({i, j, k}, static_cast<Index>(raw.x.size()));
      if (!fresh) return found->second;
      Point x{at[static_cast<std::size_t>(i)], at[static_cast<std::size_t>(j)],
              solid ? k_height * k / n_up : 0.0};
      const bool edge = i == 0 || j == 0 || i == n || j == n;
      const bool leg = (2 * i == n && 2 * j <= n) || (2 * j == n && 2 * i >= n);
      if (!edge && !leg) {
        const double h = std::min(
            {at[static_cast<std::size_t>(i) + 1] - x[0], x[0] - at[static_cast<std::size_t>(i) - 1],
             at[static_cast<std::size_t>(j) + 1] - x[1], x[1] - at[static_cast<std::size_t>(j) - 1]});
        x[0] += 0.15 * h * std::sin(12.3 * i + 4.7 * j);
        x[1] += 0.15 * h * std::sin(3.1 * i - 7.9 * j);
      }
      raw.x.push_back(x);
      raw.input_node.push_back(found->second + 1);
      if (edge) outer.nodes.push_back(found->second);
      if (leg) nodes_of_legs.nodes.push_back(found->second);
      return found->second;
    };
    mesh::RawBlock elements{shape, {}, {}};
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        if (2 * i >= n && 2 * j < n) continue;
        if (!solid) {
          const Index a = node(i, j, 0), b = node(i + 1, j, 0), c = node(i + 1, j + 1, 0),
                      d = node(i, j + 1, 0);
          for (const Index v : {a, b, c, a, c, d}) elements.nodes.push_back(v);
          continue;
        }
        constexpr int k_ways[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
        for (int k = 0; k < n_up; ++k)
          for (const auto& way : k_ways) {
            std::array<int, 3> corner{i, j, k};
            elements.nodes.push_back(node(corner[0], corner[1], corner[2]));
            for (const int step : way) {
              ++corner[static_cast<std::size_t>(step)];
              elements.nodes.push_back(node(corner[0], corner[1], corner[2]));
            }
          }
      }
    const auto numbered = [](mesh::RawBlock block) {
      for (std::size_t e = 0;
           e < block.nodes.size() / static_cast<std::size_t>(mesh::node_count(block.shape)); ++e)
        block.input_element.push_back(static_cast<GlobalIndex>(e) + 1);
      return block;
    };
    raw.groups["body"] = {raw.dimension, {numbered(elements)}};
    raw.groups["legs"] = {0, {numbered(nodes_of_legs)}};
    raw.groups["outer"] = {0, {numbered(outer)}};
    mesh::validate_and_orient(raw, "angle");
  }
  return mesh::distribute(raw, {"body"}, {});
}

material::Material conductor() {
  material::Material m = test::metal(10);
  m.phase_changes.clear();
  m.conductivity = Table(1.0);
  return m;
}

AnalysisKind kind_of(Shape shape) {
  return test::is_3d(shape) ? AnalysisKind::solid : AnalysisKind::plane_strain;
}

/// The steady temperatures with `value` on the outside, and on the legs where they have a temperature.
std::vector<double> steady(const mesh::Mesh& mesh, AnalysisKind kind, const Law::Value& value, bool legs,
                           bool correct) {
  heat::ThermalConditions conditions;
  for (const char* group : {"outer", "legs"})
    if (group[0] == 'o' || legs)
      conditions.temperatures.push_back({group, group, PlaceFunction(std::make_shared<Law>(value))});
  heat::HeatOptions options;
  options.edges = correct;
  options.solver = linear::SolverKind::direct;
  heat::ThermalPhase phase(mesh, kind, {conductor()}, conditions, options);
  heat::ThermalState end;
  phase.solve_steady(phase.states().initial(std::array{400.0}), end, 0);
  return end.temperature;
}

/// Σ T_i r_i over the height [W K/m], T counted from 400 K.
double energy(const mesh::Mesh& mesh, AnalysisKind kind, const std::vector<double>& temperature,
              bool correct) {
  heat::HeatSystem system(mesh, kind, {conductor()}, {}, true, {}, linear::BlockMatrix::Storage::whole,
                          correct);
  system.set_window(LoadWindow::at(0));
  std::vector<double> r(static_cast<std::size_t>(mesh.n_owned_nodes));
  system.residual(temperature, r);
  double sum = 0;
  for (std::size_t i = 0; i < r.size(); ++i) sum += r[i] * (temperature[i] - 400);
  return parallel::global_sum(sum) / (kind == AnalysisKind::solid ? k_height : 1.0);
}

class Angle : public testing::TestWithParam<std::tuple<Shape, bool>> {};

TEST_P(Angle, ConductsWhatTheSingularFunctionsDo) {
  const auto [shape, graded] = GetParam();
  const mesh::Mesh mesh = angle_mesh(shape, graded);
  for (const Faces faces : {Faces::one_temperature, Faces::insulated}) {
    const auto value = [faces](const Position& x) { return 400 + singular(x, faces); };
    double error[2];
    for (const bool correct : {false, true}) {
      const std::vector<double> t =
          steady(mesh, kind_of(shape), value, faces == Faces::one_temperature, correct);
      error[correct ? 1 : 0] = energy(mesh, kind_of(shape), t, correct) / exact_energy() - 1;
    }
    const std::string what = faces == Faces::one_temperature ? "faces at one temperature" : "insulated faces";
    RecordProperty(what, std::to_string(error[0]) + " " + std::to_string(error[1]));
    // Where cells are thin next to the edge, more of what is wrong is so elsewhere.
    EXPECT_GT(error[0], graded ? 0.002 : 0.004) << what;
    EXPECT_LT(std::abs(error[1]), (graded ? 0.7 : 0.35) * error[0])
        << what << ": " << error[0] << ", corrected " << error[1];
  }
}

TEST_P(Angle, ALinearTemperatureIsOffByASmallPartOfWhatAnElementSpans) {
  const auto [shape, graded] = GetParam();
  const mesh::Mesh mesh = angle_mesh(shape, graded);
  const auto value = [](const Position& x) { return 400 + x[0] + 0.5 * x[1]; };
  const std::vector<double> t = steady(mesh, kind_of(shape), value, true, true);
  double worst = 0;
  for (std::size_t i = 0; i < t.size(); ++i) worst = std::max(worst, std::abs(t[i] - value(mesh.x[i])));
  const double cell = (1 - (graded ? 0.114 : 0.0)) / 8;
  RecordProperty("worst", std::to_string(worst / cell));
  EXPECT_LT(parallel::global_max(worst), 0.1 * cell);
}

class SolidAngle : public testing::TestWithParam<bool> {};

TEST_P(SolidAngle, ATemperatureLinearAlongTheEdgeIsExact) {
  const Shape shape = Shape::tet4;
  const mesh::Mesh mesh = angle_mesh(shape, GetParam());
  heat::HeatSystem system(mesh, kind_of(shape), {conductor()}, {}, true, {},
                          linear::BlockMatrix::Storage::whole, true);
  system.set_window(LoadWindow::at(0));
  std::vector<double> t, r(static_cast<std::size_t>(mesh.n_owned_nodes));
  for (const Point& x : mesh.x) t.push_back(400 + x[2]);
  system.residual(t, r);
  double worst = 0, sum = 0;
  for (std::size_t i = 0; i < r.size(); ++i) {
    sum += r[i] * (t[i] - 400);
    const bool inside = mesh.x[i][2] > 1e-9 && mesh.x[i][2] < k_height - 1e-9;
    if (inside) worst = std::max(worst, std::abs(r[i]));
  }
  EXPECT_LT(parallel::global_max(worst), 1e-12);
  EXPECT_NEAR(parallel::global_sum(sum), 3 * k_height, 1e-12) << "k |grad T|^2 times the volume";
}

INSTANTIATE_TEST_SUITE_P(EdgeConduction, Angle,
                         testing::Combine(testing::Values(Shape::tri3, Shape::tet4), testing::Bool()),
                         [](const auto& instance) {
                           return std::string(mesh::name(std::get<0>(instance.param))) +
                                  (std::get<1>(instance.param) ? "_graded" : "_even");
                         });

INSTANTIATE_TEST_SUITE_P(EdgeConduction, SolidAngle, testing::Bool(), [](const auto& instance) {
  return std::string(instance.param ? "graded" : "even");
});

TEST(EdgeConduction, LeavesConvexBodiesAndOtherElementsAlone) {
  for (const Shape shape : {Shape::tri3, Shape::tet4, Shape::quad4, Shape::hex20}) {
    const bool solid = test::is_3d(shape);
    const mesh::Mesh mesh =
        test::block_mesh(shape, std::vector<double>(solid ? 3 : 2, 1.0), std::vector<int>(solid ? 3 : 2, 3));
    EXPECT_TRUE(heat::EdgeConduction(mesh).empty()) << mesh::name(shape);
  }
}

}  // namespace
}  // namespace solidus
