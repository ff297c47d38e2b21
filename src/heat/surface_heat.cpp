#include "heat/surface_heat.hpp"

#include <cmath>

#include "base/types.hpp"
#include "mesh/block_geometry.hpp"

namespace solidus::heat {

SurfaceLaw::SurfaceLaw(const Flux& flux) : kind_(Kind::flux), driver_(flux.value) {}
SurfaceLaw::SurfaceLaw(const Film& film)
    : kind_(Kind::film), coefficient_(film.coefficient), driver_(film.ambient) {}
SurfaceLaw::SurfaceLaw(const Radiation& radiation)
    : kind_(Kind::radiation), coefficient_(radiation.emissivity), driver_(radiation.ambient) {}

void SurfaceLaw::set_time(double time) {
  driver_now_ = driver_.value(time);
  if (!coefficient_.of_temperature) coefficient_now_ = coefficient_.table.value(time);
}

SurfaceFlux SurfaceLaw::at(double temperature) const {
  if (kind_ == Kind::flux) return {driver_now_, 0.0};
  const bool varies = coefficient_.of_temperature;
  const double c = varies ? coefficient_.table.value(temperature) : coefficient_now_;
  const double c_slope = varies ? coefficient_.table.derivative(temperature) : 0.0;
  double drive = 0, drive_slope = 0;
  if (kind_ == Kind::film) {
    drive = driver_now_ - temperature;
    drive_slope = -1.0;
  } else {
    // Θ|Θ|³ instead of Θ⁴: the same above absolute zero, and rising everywhere an iterate may stray.
    const double cube = k_stefan_boltzmann * std::abs(temperature * temperature * temperature);
    const double ambient = driver_now_ * driver_now_;
    drive = k_stefan_boltzmann * ambient * ambient - cube * temperature;
    drive_slope = -4.0 * cube;
  }
  const double slope = c * drive_slope + c_slope * drive;
  return {c * drive, slope <= 0 ? slope : c * drive_slope};
}

std::optional<double> SurfaceLaw::ambient() const {
  if (kind_ == Kind::flux) return std::nullopt;
  return driver_now_;
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
    if (closed) {
      for (Index face = 0; face < g.n_faces; ++face)
        for (int a = 0; a < g.n_nodes; ++a) {
          const Index node = faces.element(face)[a];
          double weight = 0;
          for (int q = 0; q < g.n_points; ++q)
            weight += g.weight[static_cast<std::size_t>(face * g.n_points + q)] *
                      g.values[static_cast<std::size_t>(q * g.n_nodes + a)];
          if (node < mesh.n_owned_nodes) lumped[static_cast<std::size_t>(node)] += weight;
          const int corners = g.n_nodes / 2;  // of faces in three dimensions
          if (weight >= 0 || mesh.dimension == 2 || a >= corners || !law_.ambient()) continue;
          for (const int middle : {corners + a, corners + (a + corners - 1) % corners}) {
            flows_.push_back({node, faces.element(face)[middle]});
            flow_weight_.push_back(-0.5 * weight);
          }
        }
      continue;
    }
    patches_.push_back({g.n_nodes, g.n_points, g.n_faces, g.n_counted, faces.nodes, g.values, g.weight, {}});
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
}

void SurfaceHeat::bind(const algebra::BlockMatrix& matrix) {
  for (Patch& patch : patches_) patch.slots = matrix.clique_slots(patch.nodes, patch.n_nodes);
}

double SurfaceHeat::add_residual(std::span<const double> temperature, std::span<double> r) const {
  double counted = 0;
  for (const Patch& patch : patches_)
    for (Index face = 0; face < patch.n_faces; ++face)
      for (int q = 0; q < patch.n_points; ++q) {
        const double power = law_.at(patch.temperature(temperature, face, q)).q *
                             patch.weight[static_cast<std::size_t>(face * patch.n_points + q)];
        if (face < patch.n_counted) counted += power;
        for (int a = 0; a < patch.n_nodes; ++a)
          r[static_cast<std::size_t>(patch.nodes[static_cast<std::size_t>(face * patch.n_nodes + a)])] -=
              power * patch.values[static_cast<std::size_t>(q * patch.n_nodes + a)];
      }
  for (std::size_t i = 0; i < flows_.size(); ++i) {
    if (flows_[i].left == 0) continue;
    const double heat = flows_[i].left * flow(temperature, i);
    r[static_cast<std::size_t>(flows_[i].from)] -= heat;
    r[static_cast<std::size_t>(flows_[i].to)] += heat;
  }
  return counted;
}

double SurfaceHeat::flow(std::span<const double> temperature, std::size_t i) const {
  return flow_weight_[i] * law_.at(temperature[static_cast<std::size_t>(flows_[i].from)]).q;
}

void SurfaceHeat::update_flows(std::span<const double> temperature) {
  for (std::size_t i = 0; i < flows_.size(); ++i) flows_[i].heat = flow(temperature, i);
}

void SurfaceHeat::add_tangent(std::span<const double> temperature, algebra::BlockMatrix& matrix) const {
  for (const Patch& patch : patches_) {
    const algebra::BlockMatrix::Slot* slot = patch.slots.data();
    for (Index face = 0; face < patch.n_faces; ++face, slot += patch.n_nodes * patch.n_nodes)
      for (int q = 0; q < patch.n_points; ++q) {
        const double slope = law_.at(patch.temperature(temperature, face, q)).slope *
                             patch.weight[static_cast<std::size_t>(face * patch.n_points + q)];
        const double* n = patch.values.data() + static_cast<std::ptrdiff_t>(q) * patch.n_nodes;
        for (int a = 0; a < patch.n_nodes; ++a)
          for (int b = 0; b < patch.n_nodes; ++b)
            *matrix.block(slot[a * patch.n_nodes + b]) -= slope * n[a] * n[b];
      }
  }
  // The corner's own part: what the middles of the edges get by it would not be symmetric.
  for (std::size_t i = 0; i < flows_.size(); ++i) {
    const Index from = flows_[i].from;
    *matrix.block(matrix.slot(from, from)) -=
        flows_[i].left * flow_weight_[i] * law_.at(temperature[static_cast<std::size_t>(from)]).slope;
  }
}

}  // namespace solidus::heat
