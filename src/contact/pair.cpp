#include "contact/pair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "algebra/parallel.hpp"
#include "contact/heat_term.hpp"
#include "contact/mechanics_term.hpp"
#include "contact/penalty.hpp"

namespace solidus::contact {

namespace {

ContactPoints find_points(const mesh::Mesh& mesh, AnalysisKind kind, const ContactSpec& spec,
                          const ContactSurface& slave, const ContactSurface& master) {
  if (spec.slave == spec.master)
    throw InputError(spec.where,
                     fmt::format("contact '{}': slave and master are the same surface", spec.name));
  IntegrationOptions options;
  options.rule = spec.integration;
  options.gauss_degree = spec.gauss_degree;
  options.search_distance = spec.search_distance.value_or(0.1 * slave.extent());
  ContactPoints points = integrate(mesh, kind, slave, master, options);
  if (points.paired_measure <= 0)
    throw InputError(spec.where,
                     fmt::format("contact '{}': no part of surface '{}' faces surface '{}' within {:.3g} m",
                                 spec.name, spec.slave, spec.master, options.search_distance),
                     "two surfaces that look at each other; or a larger search distance");
  const double touching = spec.touching.value_or(1e-6 * slave.mean_face_size());
  for (double& g : points.initial_penetration)
    if (std::abs(g) <= touching) g = 0;
  return points;
}

double find_penalty(const mesh::Mesh& mesh, const ContactSpec& spec, const ContactSurface& slave,
                    const ContactSurface& master, std::span<const double> modulus) {
  if (!(spec.penalty > 0))
    throw InputError(spec.where, fmt::format("contact '{}': the penalty is not positive", spec.name));
  if (!spec.penalty_is_factor) return spec.penalty;
  double stiffness = 0;
  if (modulus.size() == mesh.bodies.size())
    stiffness = std::max(local_stiffness(mesh, slave, modulus), local_stiffness(mesh, master, modulus));
  if (!(stiffness > 0))
    throw InputError(
        spec.where,
        fmt::format("contact '{}': a penalty factor needs the stiffness of the bodies", spec.name),
        "a penalty in Pa/m");
  return spec.penalty * stiffness;
}

}  // namespace

ContactPair::ContactPair(const mesh::Mesh& mesh, AnalysisKind kind, ContactSpec spec,
                         std::span<const double> body_modulus)
    : mesh_(mesh), spec_(std::move(spec)), components_(displacement_components(kind)) {
  const ContactSurface slave(mesh, spec_.slave), master(mesh, spec_.master);
  points_ = find_points(mesh, kind, spec_, slave, master);
  law_.penalty = find_penalty(mesh, spec_, slave, master, body_modulus);
  mechanics_ = std::make_unique<MechanicsTerm>(mesh, components_, points_, law_, spec_.stabilisation);
  if (spec_.heat) {
    heat_law_.emplace(*spec_.heat);
    heat_ = std::make_unique<HeatTerm>(mesh, points_, *heat_law_, spec_.nodal_heat);
  }
  const auto n = static_cast<std::size_t>(points_.n_points());
  penetration_.resize(n);
  pressure_.resize(n);
  update(std::vector<double>(mesh.x.size() * static_cast<std::size_t>(components_), 0.0));
}

ContactPair::~ContactPair() = default;

void ContactPair::activate(bool on) {
  active_ = on;
  mechanics_->activate(on);
  if (heat_) heat_->activate(on);
}

algebra::Contribution& ContactPair::mechanics() {
  return *mechanics_;
}

algebra::Contribution* ContactPair::heat() {
  return heat_.get();
}

void ContactPair::update(std::span<const double> displacement) {
  for (const Pairing& pairing : points_.pairings)
    for (Index p = pairing.first_point; p < pairing.first_point + pairing.n_points; ++p) {
      const auto i = static_cast<std::size_t>(p);
      const double g = mechanics_->penetration(pairing, p, displacement);
      penetration_[i] = g;
      pressure_[i] = active_ ? law_.update(g).pressure : 0;
    }
  if (heat_) heat_->place(penetration_, pressure_);
}

void ContactPair::add_coupling(std::span<const double> temperature, algebra::CoupledMatrix& matrix) const {
  if (!heat_ || !active_) return;
  std::vector<double> slope(pressure_.size());
  for (std::size_t i = 0; i < slope.size(); ++i) slope[i] = law_.update(penetration_[i]).tangent;
  heat_->add_gap_tangent(slope, temperature, mechanics_->slots(), matrix);
}

double ContactPair::work(std::span<const double> old_penetration, double share) const {
  double work = 0;
  for (const Pairing& pairing : points_.pairings) {
    if (!pairing.counted || !active_) continue;
    for (Index p = pairing.first_point; p < pairing.first_point + pairing.n_points; ++p) {
      const auto i = static_cast<std::size_t>(p);
      const double before = old_penetration[i], now = penetration_[i];
      const double pressure = share * law_.update(now).pressure + (1 - share) * law_.update(before).pressure;
      work += points_.weight[i] * pressure * (now - before);
    }
  }
  return algebra::global_sum(work);
}

ContactSums ContactPair::sums(std::span<const double> temperature) const {
  double points = 0, closed = 0, area = 0, force = 0, energy = 0;
  for (const Pairing& pairing : points_.pairings) {
    if (!pairing.counted) continue;
    for (Index p = pairing.first_point; p < pairing.first_point + pairing.n_points; ++p) {
      const auto i = static_cast<std::size_t>(p);
      const auto response = law_.update(penetration_[i]);
      points += 1;
      if (!response.closed || !active_) continue;
      closed += 1;
      area += points_.weight[i];
      force += points_.weight[i] * response.pressure;
      energy += points_.weight[i] * response.energy;
    }
  }
  ContactSums sums;
  sums.points = static_cast<GlobalIndex>(std::llround(algebra::global_sum(points)));
  sums.closed_points = static_cast<GlobalIndex>(std::llround(algebra::global_sum(closed)));
  sums.closed_area = algebra::global_sum(area);
  sums.force = algebra::global_sum(force);
  sums.energy = algebra::global_sum(energy);
  const double heat = heat_ && !temperature.empty() ? heat_->counted_heat(temperature) : 0.0;
  sums.heat = algebra::global_sum(heat);
  return sums;
}

ContactNodalFields ContactPair::nodal_fields(std::span<const double> temperature) const {
  const std::vector<double> of_points =
      heat_ ? heat_->conductances(temperature) : std::vector<double>(pressure_.size(), 0.0);
  const auto n = static_cast<std::size_t>(mesh_.n_owned_nodes);
  std::vector<double> weight(n, 0), opening(n, 0), pressure(n, 0), conductance(n, 0);
  for (const Pairing& pairing : points_.pairings) {
    const double* b = points_.shape.data() + pairing.first_shape;
    for (Index p = pairing.first_point; p < pairing.first_point + pairing.n_points; ++p) {
      const auto i = static_cast<std::size_t>(p);
      for (int a = 0; a < pairing.n_nodes(); ++a) {
        const auto node =
            static_cast<std::size_t>(points_.nodes[pairing.first_node + static_cast<std::size_t>(a)]);
        if (node >= n) continue;
        const double w = points_.weight[i] * b[a] * b[a];
        weight[node] += w;
        opening[node] -= w * penetration_[i];
        pressure[node] += w * pressure_[i];
        conductance[node] += w * of_points[i];
      }
      b += pairing.n_nodes();
    }
  }
  ContactNodalFields fields;
  fields.nodes = points_.nodes;
  std::sort(fields.nodes.begin(), fields.nodes.end());
  fields.nodes.erase(std::unique(fields.nodes.begin(), fields.nodes.end()), fields.nodes.end());
  std::erase_if(fields.nodes, [&](Index node) { return node >= mesh_.n_owned_nodes; });
  for (Index node : fields.nodes) {
    const auto i = static_cast<std::size_t>(node);
    const double w = weight[i] > 0 ? weight[i] : std::numeric_limits<double>::quiet_NaN();
    fields.opening.push_back(opening[i] / w);
    fields.pressure.push_back(pressure[i] / w);
    fields.conductance.push_back(conductance[i] / w);
  }
  return fields;
}

std::vector<double> ContactPair::nodal_heat(std::span<const double> temperature) const {
  std::vector<double> heat(static_cast<std::size_t>(mesh_.n_owned_nodes), 0.0);
  if (heat_) heat_->add_residual(temperature, heat);
  return heat;
}

std::size_t ContactPair::bytes() const {
  return points_.bytes() + 2 * pressure_.capacity() * sizeof(double) + mechanics_->bytes() +
         (heat_ ? heat_->bytes() : 0);
}

}  // namespace solidus::contact
