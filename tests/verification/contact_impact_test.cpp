/// Signorini's problem in impact: an elastic bar flies against a rigid wall and back.
///
///   wall ┃  ▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓▓   ← v = 10 m/s      L = 1 m, uniaxial strain, Poisson's ratio 0
///         g_0
///
/// Closed form, c = √(E/ρ): the bar touches for 2 L/c, presses with ρ c v, and leaves with −v all over. With
/// the penalty the wall is a spring of rigidity ε_N: the pressure is ρ c v (1 − exp(−ε_N t/ρc)), late by
/// ρ c/ε_N.
///
/// With the trapezoidal rule and the quotient 5.19, kinetic, elastic and contact energy keep their sum
/// whatever the step; with the penalty's pressure at t_{n+1} they do not.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

#include "contact_steps.hpp"

namespace solidus {
namespace {

using contact::NormalKind;
using mechanics::Motion;

constexpr double k_young = 2e11, k_density = 7800, k_length = 1, k_width = 0.01, k_speed = 10, k_gap = 1e-3;
const double k_wave = std::sqrt(k_young / k_density);  // [m/s]
const double k_pressure = k_density * k_wave * k_speed;
const double k_kinetic = 0.5 * k_density * k_length * k_width * k_speed * k_speed;

/// The bar as what it is, two-node elements in a row with consistent mass: its energies do not come from the
/// program that is tested.
class Bar {
 public:
  explicit Bar(const mesh::Mesh& mesh) {
    for (Index node : mesh.node_sets.at("upper")) {
      const mesh::Point& x = mesh.x[static_cast<std::size_t>(node)];
      if (x[0] < 1e-9) nodes_[x[1]] = static_cast<std::size_t>(node);
    }
  }
  double kinetic(const mechanics::MechanicalState& s) const {
    return sum([&](double h, std::size_t a, std::size_t b) {
      const double va = s.velocity[2 * a + 1], vb = s.velocity[2 * b + 1];
      return k_density * k_width * h / 6 * (va * va + va * vb + vb * vb);
    });
  }
  double elastic(const mechanics::MechanicalState& s) const {
    return sum([&](double h, std::size_t a, std::size_t b) {
      const double stretch = s.displacement[2 * b + 1] - s.displacement[2 * a + 1];
      return 0.5 * k_young * k_width / h * stretch * stretch;
    });
  }
  double mean_velocity(const mechanics::MechanicalState& s) const {
    return sum([&](double h, std::size_t a, std::size_t b) {
             return 0.5 * h * (s.velocity[2 * a + 1] + s.velocity[2 * b + 1]);
           }) /
           k_length;
  }

 private:
  template <class Element>
  double sum(Element element) const {
    double total = 0;
    for (auto a = nodes_.begin(), b = std::next(a); b != nodes_.end(); ++a, ++b)
      total += element(b->first - a->first, a->second, b->second);
    return total;
  }
  std::map<double, std::size_t> nodes_;
};

struct Impact {
  double defect = 0;        ///< largest |change of the energy| over the kinetic energy at the start
  double lost = 0;          ///< at the end
  double contact_time = 0;  ///< over 2 L/c
  double rebound = 0;       ///< mean velocity at the end over v
  double pressure = 0;      ///< mean over the contact, over ρ c v
};

struct Method {
  NormalKind normal = NormalKind::energy_conserving;
  double courant = 0.5;  ///< steps of this many passages through an element
  double factor = 1;     ///< ε_N over E/h
};

Impact impact(int elements, const Method& method, std::ofstream table = {}) {
  const mesh::Mesh mesh = test::distribute_blocks(test::raw_blocks(
      {{k_width, k_width}, {k_width, k_length}, {1, 1}, {1, elements}, k_gap}, mesh::Shape::quad4));
  contact::ContactParameters spec = test::interface();
  std::swap(spec.slave, spec.master);
  spec.normal = method.normal;
  spec.search_distance = 0.1;
  spec.penalty = method.factor;
  mechanics::MechanicalConditions conditions;
  conditions.displacements = {{"lower", 1, 0.0}, {"lower", 0, 0.0}, {"upper", 0, 0.0}};
  mechanics::MechanicsOptions options = test::strict_mechanics();
  options.dynamics = mechanics::DynamicsOptions{
      mechanics::MassKind::consistent, Motion::trapezoidal(), {{0, 0, 0}, {0, -k_speed, 0}}};
  test::ContactSteps run(mesh, AnalysisKind::plane_strain,
                         {test::elastic(k_young, 0), test::elastic(k_young, 0)}, spec, conditions, options);
  const Bar bar(mesh);
  const double passage = 2 * k_length / k_wave, dt = method.courant * k_length / elements / k_wave;
  const double touch = k_gap / k_speed;
  Impact result;
  double pushed = 0;
  while (run.time < touch + 1.5 * passage) {
    run.step(dt);
    const contact::ContactSums sums = contact::sums(run.pair.view(), {});
    const double energy = bar.kinetic(run.state) + bar.elastic(run.state) + sums.energy;
    result.lost = 1 - energy / k_kinetic;
    result.defect = std::max(result.defect, std::abs(result.lost));
    pushed += sums.force / k_width * dt;
    if (sums.force > 0) result.contact_time += dt / passage;
    const double t = (run.time - touch) / passage;
    table << t << "," << (t > 0 && t < 1 ? 1 : 0) << "," << sums.force / k_width / k_pressure << ","
          << energy / k_kinetic << "\n";
  }
  result.rebound = bar.mean_velocity(run.state) / k_speed;
  result.pressure = pushed / passage / k_pressure;
  return result;
}

TEST(BarThatBouncesOffAWall, KeepsItsEnergyWithTheQuotientWhateverStepAndPenalty) {
  auto summary = verification::table("contact_impact_energy", "normal,courant,factor,defect,lost");
  for (const double courant : {0.5, 1.0, 2.0})
    for (const double factor : {1.0, 100.0}) {
      const Impact quotient = impact(25, {NormalKind::energy_conserving, courant, factor});
      const Impact penalty = impact(25, {NormalKind::penalty, courant, factor});
      SCOPED_TRACE(fmt::format("courant {}, factor {}", courant, factor));
      EXPECT_LT(quotient.defect, 1e-6);
      EXPECT_GT(penalty.defect, 1e-3);
      for (const auto& [name, i] : {std::pair{"energy_conserving", quotient}, std::pair{"penalty", penalty}})
        summary << fmt::format("{},{},{},{:.2e},{:.2e}\n", name, courant, factor, i.defect, i.lost);
    }
}

TEST(BarThatBouncesOffAWall, TouchesForTwoPassagesAndLeavesWithTheSpeedItCameWith) {
  auto order = verification::table("contact_impact_order", "elements,rebound_velocity,contact_time,impulse");
  const std::string header = "time[2L/c],exact,pressure,energy";
  std::vector<Impact> impacts;
  for (const int elements : {25, 50, 100}) {
    impacts.push_back(
        impact(elements, {},
               elements == 100 ? verification::table("contact_impact_wall", header) : std::ofstream{}));
    const Impact& i = impacts.back();
    order << elements << "," << 1 - i.rebound << "," << i.contact_time - 1 << "," << 1 - i.pressure << "\n";
  }
  // The front is as wide as a few elements, and what rings behind it stays in the bar: first order.
  for (std::size_t n = 1; n < impacts.size(); ++n) {
    const double rate = verification::order(1 - impacts[n - 1].rebound, 1 - impacts[n].rebound);
    EXPECT_GT(rate, 0.8);
    EXPECT_LT(rate, 1.3);
  }
  EXPECT_NEAR(impacts.back().rebound, 1, 5e-3);
  EXPECT_NEAR(impacts.back().contact_time, 1, 1e-2);
  // Momentum: the impulse is that of a bar that comes with v and leaves with what it has.
  for (const Impact& i : impacts) EXPECT_NEAR(i.pressure, 0.5 * (1 + i.rebound), 1e-3);
}

}  // namespace
}  // namespace solidus
