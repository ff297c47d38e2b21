#include "heat/surface_heat.hpp"

#include <cmath>

#include "base/types.hpp"
#include "mesh/block_geometry.hpp"

namespace solidus::heat {

SurfaceLaw::SurfaceLaw(const Flux& flux) : kind_(Kind::flux), driver_(flux.value), factor_(flux.factor) {}
SurfaceLaw::SurfaceLaw(const Film& film)
    : kind_(Kind::film), coefficient_(film.coefficient), driver_(film.ambient), factor_(film.factor) {}
SurfaceLaw::SurfaceLaw(const Radiation& radiation)
    : kind_(Kind::radiation),
      coefficient_(radiation.emissivity),
      driver_(radiation.ambient),
      factor_(radiation.factor) {}

bool SurfaceLaw::placed() const {
  return !driver_.uniform() || !factor_.uniform() || !coefficient_.table.uniform();
}

void SurfaceLaw::Now::set(const PlaceFunction& function, std::span<const Position> points, double time) {
  if (function.uniform()) {
    uniform_ = function.value(time);
    return;
  }
  values_.resize(points.size());
  function.values(points, time, values_);
}

void SurfaceLaw::set_time(double time) {
  driver_now_.set(driver_, points_, time);
  factor_now_.set(factor_, points_, time);
  if (!coefficient_.of_temperature) coefficient_now_.set(coefficient_.table, points_, time);
}

SurfaceFlux SurfaceLaw::at(double temperature, std::size_t point) const {
  const double factor = factor_now_.at(point), driver = driver_now_.at(point);
  if (kind_ == Kind::flux) return {factor * driver, 0.0};
  const bool varies = coefficient_.of_temperature;
  const double c = factor * (varies ? coefficient_.table.value(temperature) : coefficient_now_.at(point));
  const double c_slope = varies ? factor * coefficient_.table.derivative(temperature) : 0.0;
  double drive = 0, drive_slope = 0;
  if (kind_ == Kind::film) {
    drive = driver - temperature;
    drive_slope = -1.0;
  } else {
    // Θ|Θ|³ instead of Θ⁴: the same above absolute zero, and rising everywhere an iterate may stray.
    const double cube = k_stefan_boltzmann * std::abs(temperature * temperature * temperature);
    const double ambient = driver * driver;
    drive = k_stefan_boltzmann * ambient * ambient - cube * temperature;
    drive_slope = -4.0 * cube;
  }
  const double slope = c * drive_slope + c_slope * drive;
  return {c * drive, slope <= 0 ? slope : c * drive_slope};
}

double SurfaceHeat::Patch::temperature(std::span<const double> t, Index face, int point) const {
  const Index* of_face = nodes.data() + static_cast<std::ptrdiff_t>(face) * n_nodes;
  const double* n = values.data() + static_cast<std::ptrdiff_t>(point) * n_nodes;
  double sum = 0;
  for (int a = 0; a < n_nodes; ++a) sum += n[a] * t[static_cast<std::size_t>(of_face[a])];
  return sum;
}

SurfaceHeat::SurfaceHeat(const mesh::Mesh& mesh, AnalysisKind kind, const mesh::Surface& surface,
                         std::string name, SurfaceLaw law, bool closed)
    : name_(std::move(name)), law_(std::move(law)) {
  std::vector<double> lumped(static_cast<std::size_t>(mesh.n_owned_nodes), 0.0);  // ∫ N_i dA
  for (const mesh::Block& faces : surface.faces) {
    const int order = mesh::order(faces.shape);
    // Exact for N_a N_b times the radius on straight faces.
    const mesh::FaceGeometry g(mesh, faces, kind, mesh::gauss_rule(faces.shape, 2 * order + 1));
    if (closed && order == 1) {
      for (Index face = 0; face < g.n_faces; ++face)
        for (int a = 0; a < g.n_nodes; ++a) {
          const Index node = faces.element(face)[a];
          if (node >= mesh.n_owned_nodes) continue;
          for (int q = 0; q < g.n_points; ++q)
            lumped[static_cast<std::size_t>(node)] +=
                g.weight[static_cast<std::size_t>(face * g.n_points + q)] *
                g.values[static_cast<std::size_t>(q * g.n_nodes + a)];
        }
      continue;
    }
    patches_.push_back({.n_nodes = g.n_nodes,
                        .n_points = g.n_points,
                        .n_faces = g.n_faces,
                        .n_counted = g.n_counted,
                        .nodes = faces.nodes,
                        .values = g.values,
                        .weight = g.weight,
                        .slots = {}});
  }
  Patch nodes;
  nodes.values = {1.0};
  for (std::size_t i = 0; i < lumped.size(); ++i) {
    if (lumped[i] == 0.0) continue;
    nodes.nodes.push_back(static_cast<Index>(i));
    nodes.weight.push_back(lumped[i]);
  }
  nodes.n_faces = nodes.n_counted = static_cast<Index>(nodes.nodes.size());
  patches_.push_back(std::move(nodes));
  if (law_.placed()) place_points(mesh);
}

void SurfaceHeat::place_points(const mesh::Mesh& mesh) {
  std::vector<Position> points;
  for (Patch& patch : patches_) {
    patch.first_point = points.size();
    for (Index face = 0; face < patch.n_faces; ++face)
      for (int q = 0; q < patch.n_points; ++q) {
        Position& x = points.emplace_back();
        for (int a = 0; a < patch.n_nodes; ++a) {
          const Index node = patch.nodes[static_cast<std::size_t>(face * patch.n_nodes + a)];
          const double n = patch.values[static_cast<std::size_t>(q * patch.n_nodes + a)];
          for (std::size_t i = 0; i < 3; ++i) x[i] += n * mesh.x[static_cast<std::size_t>(node)][i];
        }
      }
  }
  law_.set_points(std::move(points));
}

void SurfaceHeat::bind(const algebra::BlockMatrix& matrix) {
  for (Patch& patch : patches_) patch.slots = matrix.clique_slots(patch.nodes, patch.n_nodes);
}

double SurfaceHeat::add_residual(std::span<const double> temperature, std::span<double> r,
                                 double& moved) const {
  double counted = 0;
  for (const Patch& patch : patches_)
    for (Index face = 0; face < patch.n_faces; ++face)
      for (int q = 0; q < patch.n_points; ++q) {
        const std::size_t point = patch.number(face, q);
        const double power = law_.at(patch.temperature(temperature, face, q), patch.first_point + point).q *
                             patch.weight[point];
        if (face < patch.n_counted) {
          counted += power;
          moved += std::abs(power);
        }
        for (int a = 0; a < patch.n_nodes; ++a)
          r[static_cast<std::size_t>(patch.nodes[static_cast<std::size_t>(face * patch.n_nodes + a)])] -=
              power * patch.values[static_cast<std::size_t>(q * patch.n_nodes + a)];
      }
  return counted;
}

void SurfaceHeat::add_tangent(std::span<const double> temperature, algebra::BlockMatrix& matrix) const {
  for (const Patch& patch : patches_) {
    const algebra::BlockMatrix::Slot* slot = patch.slots.data();
    for (Index face = 0; face < patch.n_faces; ++face, slot += patch.n_nodes * patch.n_nodes)
      for (int q = 0; q < patch.n_points; ++q) {
        const std::size_t point = patch.number(face, q);
        const double slope =
            law_.at(patch.temperature(temperature, face, q), patch.first_point + point).slope *
            patch.weight[point];
        const double* n = patch.values.data() + static_cast<std::ptrdiff_t>(q) * patch.n_nodes;
        for (int a = 0; a < patch.n_nodes; ++a)
          for (int b = 0; b < patch.n_nodes; ++b)
            *matrix.block(slot[a * patch.n_nodes + b]) -= slope * n[a] * n[b];
      }
  }
}

}  // namespace solidus::heat
