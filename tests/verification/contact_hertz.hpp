/// Hertz's contacts, half of them by symmetry: an elastic round body, the cap of a cylinder or a sphere of
/// radius R, on an elastic block or a rigid plane; a rigid round body in an elastic block.
///
///          │  cap   ╱                 line (plane strain)   p_0 = √(F E*/(π R)),  a = √(4 F R/(π E*))
///   x = 0  │     _╱                   point (axisymmetric)  p_0 = (6 F E*²/(π³ R²))^⅓,  a = (3 F R/(4 E*))^⅓
///          ├───''──────────           p = p_0 √(1 − x²/a²)
///          │  block                   1/E* = Σ (1 − ν²)/E over the elastic bodies
///
/// K. L. Johnson, Contact Mechanics, 1985, ch. 4. Bodies are W wide and high, W about 20 a, under a
/// displacement of the far face. F, in line contact per length, is what the contact carries, so that only the
/// shape of the pressure is compared.
#pragma once

#include <numbers>
#include <optional>

#include "contact_steps.hpp"

namespace solidus::test {

struct HertzCase {
  enum class Bodies { round_on_block, round_on_rigid, rigid_in_block } bodies = Bodies::round_on_block;
  AnalysisKind kind = AnalysisKind::plane_strain;
  contact::Formulation formulation = contact::Formulation::large_sliding;
  mesh::Shape shape = mesh::Shape::quad4;
  int n = 24;  ///< elements along a side, fine at the contact: 0.4 n of them under half the contact
  contact::NormalKind normal = contact::NormalKind::penalty;
  double stiffness = 1.5;  ///< ε_N over n E/a; the smallest elements have 0.4 n E/a
  contact::IntegrationRule rule = contact::IntegrationRule::automatic;
  std::optional<double> penalty_factor{};      ///< of a case file, in place of `stiffness`
  std::optional<double> pressure_tolerance{};  ///< of the augmented Lagrangian; absent: by penetration
  double stabilisation = contact::ContactParameters{}.stabilisation;
};

inline constexpr double k_hertz_radius = 1, k_hertz_width = 0.6, k_hertz_young = 200e9, k_hertz_poisson = 0.3;
inline constexpr double k_hertz_half_width = 0.03;  ///< about what comes out

/// Fine at the origin: sinh(5 s)/sinh 5 of the width.
inline double hertz_graded(double x) {
  return k_hertz_width * std::sinh(5 * x / k_hertz_width) / std::sinh(5.0);
}

inline double hertz_arc(double x) {
  return k_hertz_radius - std::sqrt(k_hertz_radius * k_hertz_radius - x * x);
}

inline mesh::Mesh hertz_mesh(const HertzCase& c) {
  const double w = k_hertz_width;
  // The block's lines lie between those of the cap; with a rigid plane it is idle.
  const bool idle = c.bodies == HertzCase::Bodies::round_on_rigid;
  const int m = c.n - c.n / 8;
  const std::vector<int> divisions = idle ? std::vector{2, 2} : std::vector{m, c.n};
  mesh::RawMesh raw = raw_blocks({{w, w}, {w, w}, divisions, {c.n, c.n}, 0}, c.shape);
  std::vector<char> upper(raw.x.size(), 0);
  for (const mesh::RawBlock& block : raw.groups["upper"].blocks)
    for (Index node : block.nodes) upper[static_cast<std::size_t>(node)] = 1;
  for (std::size_t i = 0; i < raw.x.size(); ++i) {
    mesh::Point& x = raw.x[i];
    const double depth = hertz_graded(std::abs(x[1] - w));
    x[0] = hertz_graded(x[0]);
    // The arc fades out towards the far face.
    x[1] = upper[i] != 0 ? depth + hertz_arc(x[0]) * (1 - depth / w) : -depth;
  }
  return distribute_blocks(raw);
}

struct Hertz {
  mesh::Mesh mesh;
  bool round, line;
  std::unique_ptr<ContactSteps> run;
  double star = 0;  ///< E* [Pa]

  explicit Hertz(const HertzCase& c, const mechanics::MechanicsOptions& options = strict_mechanics())
      : mesh(hertz_mesh(c)),
        round(c.bodies != HertzCase::Bodies::rigid_in_block),
        line(c.kind == AnalysisKind::plane_strain) {
    contact::ContactParameters spec = interface();
    std::swap(spec.slave, spec.master);
    spec.formulation = c.formulation;
    spec.integration = c.rule;
    spec.normal = c.normal;
    spec.penalty = c.stiffness * c.n * k_hertz_young / k_hertz_half_width;
    spec.penalty_is_factor = c.penalty_factor.has_value();
    if (c.penalty_factor) spec.penalty = *c.penalty_factor;
    spec.pressure_tolerance = c.pressure_tolerance;
    spec.search_distance = 0.05;
    spec.stabilisation = c.stabilisation;
    // Gives a half width of about 0.03 R.
    const bool block = c.bodies == HertzCase::Bodies::round_on_block;
    const double approach = (line ? 1.6e-3 : 1e-3) * (block ? 1.3 : 1);
    mechanics::MechanicalConditions conditions;
    for (const char* side : {"lower_x_min", "upper_x_min"})
      conditions.displacements.push_back({side, 0, 0.0});
    conditions.displacements.push_back({"lower_y_min", 1, 0.0});
    conditions.displacements.push_back({"upper_y_max", 1, Table({0, 1}, {0, round ? -approach : 0})});
    if (!block) spec.rigid_master = contact::RigidSurface{};
    if (c.bodies == HertzCase::Bodies::rigid_in_block) {
      spec.slave = "lower_top";
      spec.master = "tool";
      contact::RigidSurface& tool = *spec.rigid_master;
      tool.shape = line ? contact::RigidSurface::Shape::cylinder : contact::RigidSurface::Shape::sphere;
      tool.point = {0, k_hertz_radius, 0};
      tool.direction = {0, 0, 1};
      tool.radius = k_hertz_radius;
      tool.motion.translation[1] = Table({0, 1}, {0, -approach});
    }
    star = k_hertz_young / (1 - k_hertz_poisson * k_hertz_poisson) / (block ? 2 : 1);
    const material::Material steel = elastic(k_hertz_young, k_hertz_poisson);
    run = std::make_unique<ContactSteps>(mesh, c.kind, std::vector{steel, steel}, spec, conditions, options);
  }

  double force() const {
    return contact::sums(run->pair.view(), {}).force * (line ? 2 : 1);
  }  ///< F [N/m], [N]
  double exact_half_width() const {
    const double f = force(), r = k_hertz_radius;
    return line ? std::sqrt(4 * f * r / (std::numbers::pi * star)) : std::cbrt(3 * f * r / (4 * star));
  }
  double exact_pressure() const {
    return star * exact_half_width() / k_hertz_radius * (line ? 0.5 : 2 / std::numbers::pi);
  }

  /// Averages of the pressure at the slave's nodes over their distance from the axis.
  std::vector<std::pair<double, double>> profile() const {
    const contact::ContactNodalFields fields = contact::nodal_fields(run->pair.view(), {});
    const std::vector<Index> slave = contact::ContactSurface(mesh, run->pair.parts().spec.slave).all_nodes();
    std::vector<std::pair<double, double>> points;
    for (std::size_t i = 0; i < fields.nodes.size(); ++i)
      if (std::binary_search(slave.begin(), slave.end(), fields.nodes[i]) && fields.pressure[i] >= 0)
        points.emplace_back(mesh.x[static_cast<std::size_t>(fields.nodes[i])][0], fields.pressure[i]);
    std::sort(points.begin(), points.end());
    return points;
  }

  struct Measured {
    double pressure = 0, half_width = 0;  ///< of the ellipse through p² over x² by least squares [Pa], [m]
    double edge = 0;                      ///< the outermost closed point [m]
    double deviation = 0;                 ///< largest, from Hertz's ellipse within 0.9 a, over p_0
  };
  Measured measure() const {
    Measured m;
    const double a = exact_half_width(), p0 = exact_pressure();
    double s[5] = {};
    for (const auto& [x, p] : profile()) {
      if (x > 0.9 * a) break;
      const double q = x * x, terms[] = {1, q, q * q, p * p, p * p * q};
      for (int k = 0; k < 5; ++k) s[k] += terms[k];
      m.deviation = std::max(m.deviation, std::abs(p / p0 - std::sqrt(1 - q / (a * a))));
    }
    const double slope = (s[0] * s[4] - s[1] * s[3]) / (s[0] * s[2] - s[1] * s[1]);
    const double at_zero = (s[3] - slope * s[1]) / s[0];
    m.pressure = std::sqrt(at_zero);
    m.half_width = std::sqrt(-at_zero / slope);
    for (std::size_t i = 0; i < run->points().size(); ++i)
      if (run->points()[i].pressure > 0) m.edge = std::max(m.edge, run->particle(i).position[0]);
    return m;
  }
};

}  // namespace solidus::test
