/// Without sources no temperature leaves the range of the initial and boundary ones: every element, obtuse
/// and bent meshes, one or two materials, sudden chills and long steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "block.hpp"
#include "parallel/parallel.hpp"
#include "system/errors.hpp"

namespace solidus {
namespace {

using mesh::Shape;

constexpr Shape k_shapes[] = {Shape::tri3, Shape::tri6,  Shape::quad4, Shape::quad8,
                              Shape::tet4, Shape::tet10, Shape::hex8,  Shape::hex20};

/// One problem, drawn by its number.
struct Problem {
  Shape shape = Shape::tri3;
  AnalysisKind kind = AnalysisKind::plane_strain;
  mesh::Mesh mesh;
  std::vector<material::Material> materials;
  std::vector<double> start;  ///< of each body [K]
  heat::ThermalConditions conditions;
  double lowest = 0, highest = 0;  ///< of initial and boundary temperatures [K]
  double dt = 0;
};

class Draw {
 public:
  explicit Draw(unsigned seed) : generator_(seed) {}
  double between(double low, double high) {
    // Not a distribution of the library: those differ from one library to the next.
    return low + (high - low) * (static_cast<double>(generator_()) / 4294967296.0);
  }
  int integer(int low, int high) { return low + static_cast<int>(between(0, high - low + 1 - 1e-9)); }
  bool coin() { return between(0, 1) < 0.5; }

 private:
  std::mt19937 generator_;
};

material::Material draw_material(Draw& draw) {
  material::Material m;
  m.name = "drawn";
  m.density = draw.between(1500, 8000);
  m.specific_heat = draw.coin() ? Table(900.0) : Table({300, 1200}, {700, 1300});
  const double k = std::pow(10.0, draw.between(-0.3, 2.3));
  switch (draw.integer(0, 2)) {
    case 0:
      m.conductivity = Table(k);
      break;
    case 1:
      m.conductivity = Table({300, 1300}, {k, k * draw.between(0.3, 3)});
      break;
    default:
      m.conductivity = Table({300, 899, 900, 1300}, {k, k, k * draw.between(0.1, 10), k});
  }
  switch (draw.integer(0, 3)) {
    case 0:
      break;  // no change of phase
    case 1:
      m.phase_changes = {{"solidification", material::PhaseFraction::linear(900, 900), 3e5, 0.0, true}};
      break;
    case 2:
      m.phase_changes = {{"solidification", material::PhaseFraction::linear(900 - draw.between(1, 80), 900),
                          3e5, 0.0, true}};
      break;
    default:
      m.phase_changes = {
          {"solidification", material::PhaseFraction::scheil(933, 900, 850, 0.13), 3.9e5, 0.0, true}};
  }
  return m;
}

/// A block that is stretched, sheared and bent, so that most of its elements are obtuse or warped; its left
/// half may be another body.
mesh::Mesh draw_mesh(Draw& draw, Shape shape, AnalysisKind kind, bool two_bodies) {
  const bool solid = test::is_3d(shape);
  const int dims = solid ? 3 : 2, most = mesh::order(shape) == 1 ? (solid ? 7 : 14) : (solid ? 4 : 7);
  std::vector<double> size;
  std::vector<int> divisions;
  for (int i = 0; i < dims; ++i) {
    size.push_back(0.02 * std::pow(10.0, draw.between(0, 0.7)));
    divisions.push_back(draw.integer(2, most));
  }
  const double shear = draw.between(-1.5, 1.5), lean = draw.between(-1, 1),
               bend = draw.between(0, mesh::order(shape) == 1 ? 0.12 : 0.03), waves = draw.between(3, 12),
               inside = draw.between(0, 0.05);
  const auto map = [=](mesh::Point x) {
    const double a = size[0], s = std::sin(waves * x[0] / a + 2 * x[1] / size[1]),
                 c = std::cos(waves * x[1] / size[1] + 3 * x[0] / a);
    mesh::Point y = x;
    y[0] += bend * a * c / waves * 3;
    y[1] += shear * x[0] * size[1] / a + bend * size[1] * s / waves * 3;
    if (solid) {
      y[1] += lean * x[2] * size[1] / size[2];
      y[2] += lean * x[0] * size[2] / a + bend * size[2] * s / waves * 3;
    }
    if (kind == AnalysisKind::axisymmetric) y[0] += inside + 0.12 * a;
    return y;
  };
  mesh::RawMesh raw;
  if (test::rank() == 0) {
    raw = mesh::make_block({size, {}, divisions, "block"}, shape);
    if (two_bodies) {
      const int n = mesh::node_count(shape);
      mesh::RawGroup& block = raw.groups.at("block");
      mesh::RawGroup other = block;
      for (std::size_t b = 0; b < block.blocks.size(); ++b) {
        mesh::RawBlock left = block.blocks[b], right = left;
        for (auto* part : {&left, &right}) {
          part->nodes.clear();
          part->input_element.clear();
        }
        const mesh::RawBlock& all = block.blocks[b];
        for (std::size_t e = 0; e < all.input_element.size(); ++e) {
          const Index* nodes = all.nodes.data() + e * static_cast<std::size_t>(n);
          double x = 0;
          for (int i = 0; i < n; ++i) x += raw.x[static_cast<std::size_t>(nodes[i])][0] / n;
          mesh::RawBlock& part = x < size[0] * (divisions[0] / 2) / divisions[0] ? left : right;
          part.nodes.insert(part.nodes.end(), nodes, nodes + n);
          part.input_element.push_back(all.input_element[e]);
        }
        block.blocks[b] = left;
        other.blocks[b] = right;
      }
      raw.groups["other"] = other;
    }
    for (mesh::Point& x : raw.x) x = map(x);
    mesh::validate_and_orient(raw, "block");
  }
  return mesh::distribute(
      raw, two_bodies ? std::vector<std::string>{"block", "other"} : std::vector<std::string>{"block"}, {});
}

Problem draw_problem(unsigned number) {
  Draw draw(number);
  Problem p;
  p.shape = k_shapes[number % 8];
  p.kind = test::is_3d(p.shape) ? AnalysisKind::solid
           : draw.coin()        ? AnalysisKind::plane_strain
                                : AnalysisKind::axisymmetric;
  const bool two = draw.coin();
  p.mesh = draw_mesh(draw, p.shape, p.kind, two);
  p.lowest = HUGE_VAL;
  p.highest = -HUGE_VAL;
  const auto draw_temperature = [&] {
    const double t = draw.coin() ? draw.between(300, 400) : draw.between(900, 1100);
    p.lowest = std::min(p.lowest, t);
    p.highest = std::max(p.highest, t);
    return t;
  };
  for (int body = 0; body <= (two ? 1 : 0); ++body) {
    p.materials.push_back(draw_material(draw));
    p.start.push_back(draw_temperature());
  }
  std::vector<std::string> sides{"x_min", "x_max", "y_min", "y_max"};
  if (test::is_3d(p.shape)) sides.insert(sides.end(), {"z_min", "z_max"});
  for (const std::string& side : sides) {
    const std::string name = "on_" + side;
    switch (draw.integer(0, 5)) {
      case 0:
        p.conditions.temperatures.push_back({name, side, Table(draw_temperature())});
        break;
      case 1:
        p.conditions.films.push_back(
            {name, side, {Table(std::pow(10.0, draw.between(1, 5))), false}, Table(draw_temperature())});
        break;
      case 2:
        p.conditions.radiations.push_back(
            {name, side, {Table(draw.between(0.1, 1)), false}, Table(draw_temperature())});
        break;
      default:
        break;  // insulated
    }
  }
  if (p.conditions.temperatures.empty())
    p.conditions.temperatures.push_back({"chill", "x_max", Table(draw_temperature())});
  p.dt = std::pow(10.0, draw.between(-3, 3));
  return p;
}

struct Excursion {
  double kelvins = 0;  ///< the furthest beyond the range
  int iterations = 0;  ///< of the worst step
  double defect = 0;   ///< of the heat balance over the heat exchanged
  int rejected = 0;    ///< steps that did not converge; a shorter one follows
};

/// @param tolerance  0: the default
Excursion run(const Problem& p, bool bounds, int steps, double tolerance = 0) {
  heat::HeatOptions options;
  options.tolerance = tolerance;
  options.bounds = bounds;
  options.alone = true;
  heat::ThermalPhase phase(p.mesh, p.kind, p.materials, p.conditions, options);
  heat::ThermalState state = phase.states().initial(p.start);
  Excursion out;
  double time = 0, dt = p.dt;
  for (int i = 1; i <= steps;) {
    try {
      const heat::ThermalReport report = phase.solve(state, state, time + dt, dt);
      time += dt;
      ++i;
      out.iterations = std::max(out.iterations, report.newton.iterations);
      if (report.balance.exchanged > 0)
        out.defect = std::max(out.defect, std::abs(report.balance.defect()) / report.balance.exchanged);
    } catch (const StepRejected&) {
      dt *= 0.25;  // as a run does
      if (++out.rejected > 10) break;
    }
    for (const double t : state.temperature)
      out.kelvins = std::max({out.kelvins, p.lowest - t, t - p.highest});
  }
  return out;
}

TEST(Bounds, HoldInRandomProblemsWithEveryElement) {
  double worst_without = 0;
  int sum = 0, hard = 0, sum_coarse = 0, hard_coarse = 0;
  for (unsigned number = 0; number < 300; ++number) {
    const Problem p = draw_problem(number);
    const Excursion kept = run(p, true, 5), free = run(p, false, 5);
    EXPECT_LE(kept.kelvins, 1e-6) << "problem " << number << ", " << mesh::name(p.shape);
    EXPECT_EQ(kept.rejected, 0) << "problem " << number << ", " << mesh::name(p.shape);
    EXPECT_LE(kept.defect, 1e-10) << "problem " << number << ", " << mesh::name(p.shape);
    worst_without = std::max(worst_without, free.kelvins);
    sum += kept.iterations;
    const int coarse = run(p, true, 5, 1e-5).iterations;
    sum_coarse += coarse;
    if (coarse > 12) ++hard_coarse;
    if (kept.iterations > 12) ++hard;
    if (std::getenv("SOLIDUS_BOUNDS_VERBOSE") != nullptr && test::rank() == 0)
      std::printf("%3u %-5s %d nodes, dt %.3g: %.2e K in %d iterations, %d rejected, without %.2e K in %d\n",
                  number, std::string(mesh::name(p.shape)).c_str(), p.mesh.n_owned_nodes, p.dt, kept.kelvins,
                  kept.iterations, kept.rejected, free.kelvins, free.iterations);
  }
  // Half of the problems have two materials that share nodes: with a symmetric matrix alone 13 take up to 37.
  EXPECT_LE(sum_coarse, 300 * 2.4);
  EXPECT_LE(hard_coarse, 0);
  EXPECT_LE(sum, 300 * 2.6);
  EXPECT_LE(hard, 0);
  EXPECT_GT(worst_without, 10.0);  // kelvins: the problems are hard enough
}

/// How far temperatures move [K] from one pass of a step to a second that starts from them.
/// @param keeps  the second pass limits conduction as the first has left it
double moved_by_second_pass(const Problem& p, bool keeps) {
  heat::HeatOptions options;
  options.tolerance = 1e-11;
  options.alone = true;
  heat::ThermalPhase phase(p.mesh, p.kind, p.materials, p.conditions, options);
  const heat::ThermalState old = phase.states().initial(p.start);
  heat::ThermalState first, second;
  phase.solve(old, first, p.dt, p.dt);
  phase.solve(old, second, {.time = p.dt, .dt = p.dt, .iterate = &first, .keeps_limits = keeps});
  double moved = 0;
  for (std::size_t i = 0; i < first.temperature.size(); ++i)
    moved = std::max(moved, std::abs(second.temperature[i] - first.temperature[i]));
  return moved;
}

// Where every pass finds limits of its own, an iteration between the phases goes round between them.
TEST(Bounds, LimitsThatAreKeptLeaveTheTemperaturesOfThePassBefore) {
  double kept = 0, found_anew = 0;
  for (unsigned number = 0; number < 80; ++number) {
    const Problem p = draw_problem(number);
    if (mesh::order(p.shape) == 1) continue;
    kept = std::max(kept, moved_by_second_pass(p, true));
    found_anew = std::max(found_anew, moved_by_second_pass(p, false));
  }
  EXPECT_LT(kept, 1e-6);
  EXPECT_GT(found_anew, 1e-3);
}

/// A block of unit length along x and height `height`, bent inside so that elements are obtuse or warped.
mesh::Mesh bent(Shape shape, int cells, double height) {
  const bool solid = test::is_3d(shape);
  const auto bump = [](double s) { return std::sin(3.14159265358979323846 * s); };
  return test::block_mesh(
      shape, solid ? std::vector<double>{1, height, height} : std::vector<double>{1, height},
      solid ? std::vector<int>{cells, cells, cells} : std::vector<int>{cells, cells}, [&](mesh::Point x) {
        const double y = x[1] / height, z = x[2] / height;
        const double b = 0.15 * bump(x[0]) * bump(y) * (solid ? bump(z) : 1.0);
        return mesh::Point{x[0] + b, x[1] - 0.7 * height * b, solid ? x[2] + 0.5 * height * b : 0.0};
      });
}

material::Material conductor() {
  material::Material m;
  m.name = "conductor";
  m.density = 2500;
  m.conductivity = Table(100.0);
  m.specific_heat = Table(1000.0);
  return m;
}

AnalysisKind kind_of(Shape shape) {
  return test::is_3d(shape) ? AnalysisKind::solid : AnalysisKind::plane_strain;
}

TEST(Bounds, LeaveLinearTemperaturesExact) {
  for (const Shape shape : k_shapes) {
    const mesh::Mesh mesh = bent(shape, mesh::order(shape) == 1 ? 6 : 3, 0.4);
    heat::ThermalConditions conditions;
    conditions.temperatures.push_back({"cold", "x_min", Table(300.0)});
    conditions.temperatures.push_back({"hot", "x_max", Table(500.0)});
    heat::HeatOptions options;
    options.tolerance = 1e-13;
    heat::ThermalPhase phase(mesh, kind_of(shape), {conductor()}, conditions, options);
    std::vector<double> start;
    for (const mesh::Point& x : mesh.x) start.push_back(300 + 200 * x[0]);
    heat::ThermalState state = phase.states().initial_at_nodes(start);
    for (int i = 1; i <= 3; ++i) phase.solve(state, state, 100.0 * i, 100.0);
    heat::ThermalState steady;
    phase.solve_steady(phase.states().initial(std::vector<double>{350.0}), steady, 0.0);
    for (std::size_t i = 0; i < mesh.x.size(); ++i) {
      EXPECT_NEAR(state.temperature[i], start[i], 2e-10) << mesh::name(shape);
      EXPECT_NEAR(steady.temperature[i], start[i], 2e-8) << mesh::name(shape);
    }
  }
}

/// The root of the mean square of the error of a cosine that dies away, insulated, at the nodes; the error of
/// backward Euler taken out.
double cosine_error(Shape shape, int cells, bool bounds) {
  constexpr double k_pi = 3.14159265358979323846;
  const mesh::Mesh mesh = bent(shape, cells, 0.4);
  heat::HeatOptions options;
  options.bounds = bounds;
  options.tolerance = 1e-10;
  heat::ThermalPhase phase(mesh, kind_of(shape), {conductor()}, {}, options);
  const double rate = k_pi * k_pi * 4e-5, dt = 0.1 / rate;
  std::vector<double> start;
  for (const mesh::Point& x : mesh.x) start.push_back(600 + 200 * std::cos(k_pi * x[0]));
  heat::ThermalState state = phase.states().initial_at_nodes(start);
  double factor = 1;
  for (int i = 1; i <= 4; ++i) {
    phase.solve(state, state, i * dt, dt);
    factor /= 1 + rate * dt;
  }
  double sum = 0;
  for (Index i = 0; i < mesh.n_owned_nodes; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const double error = state.temperature[n] - 600 - factor * (start[n] - 600);
    sum += error * error;
  }
  return std::sqrt(parallel::global_sum(sum) / static_cast<double>(mesh.n_global_nodes));
}

TEST(Bounds, KeepTheSecondOrderOfSmoothTransients) {
  if (test::processes() > 1) return;  // the serial run proves it
  for (const Shape shape : k_shapes) {
    const int n = mesh::order(shape) == 1 ? (test::is_3d(shape) ? 6 : 8) : (test::is_3d(shape) ? 3 : 4);
    std::vector<double> with, without;
    for (const int cells : {n, 2 * n}) {
      with.push_back(cosine_error(shape, cells, true));
      without.push_back(cosine_error(shape, cells, false));
    }
    EXPECT_GE(std::log2(with[0] / with[1]), 1.7) << mesh::name(shape);
    for (std::size_t i = 0; i < with.size(); ++i)
      EXPECT_NEAR(with[i], without[i], 1e-3 * without[i]) << mesh::name(shape);
  }
}

}  // namespace
}  // namespace solidus
