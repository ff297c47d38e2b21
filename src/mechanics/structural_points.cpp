#include "mechanics/structural_points.hpp"

#include <algorithm>
#include <cmath>

#include "material/hardening_heat.hpp"
#include "material/thermal_potential.hpp"

namespace solidus::mechanics {

Lane temperature_at(const mesh::BlockGeometry& geometry, Index batch, int point,
                    std::span<const double> nodal) {
  const double* values = geometry.values.data() + point * geometry.n_nodes;
  const Index* nodes =
      geometry.nodes.data() + static_cast<std::ptrdiff_t>(batch) * geometry.n_nodes * k_lanes;
  alignas(sizeof(Lane)) double sum[k_lanes] = {};
  for (int a = 0; a < geometry.n_nodes; ++a)
    for (int lane = 0; lane < k_lanes; ++lane)
      sum[lane] += values[a] * nodal[static_cast<std::size_t>(nodes[a * k_lanes + lane])];
  return Lane::load(sum);
}

StructuralPoints::StructuralPoints(const mesh::BlockGeometry& geometry, const material::Material& material)
    : geometry_(geometry),
      material_(material),
      points_(static_cast<std::size_t>(geometry.n_batches) * static_cast<std::size_t>(geometry.n_points)) {
  material_.phase_changes.clear();
}

void StructuralPoints::set_temperature(Index batch, int point, Lane temperature, Lane pass_temperature,
                                       Lane thermal_strain) {
  Point& p = at(batch, point);
  p.temperature = temperature;
  p.pass_temperature = pass_temperature;
  const Lane reference(material_.expansion_reference);
  p.strain_offset = thermal_strain - properties_at(material_, pass_temperature, reference).thermal_strain;
}

StructuralPoints::State StructuralPoints::state(const Point& at, const Deformation& deformation,
                                                Lane temperature, Want want) const {
  auto p = properties_at(material_, temperature, Lane(material_.expansion_reference));
  p.thermal_strain += at.strain_offset;
  const auto d = derivatives_at(material_, temperature, temperature);
  const Lane deviator_squared = Lane(4.0) * p.shear * p.shear * deformation.elastic_squared;
  const auto structural = structural_state(p, d, temperature, deformation.strain_trace, deviator_squared);
  State r{structural.entropy, structural.internal_energy, Lane(0.0)};
  if (want == Want::state_and_capacity)
    r.capacity = structural_capacity(p, d, curvatures_at(material_, temperature), temperature,
                                     deformation.strain_trace, deviator_squared);
  if (!material_.flow || !any(deformation.hardening > Lane(0.0))) return r;  // ζ moves with ξ only
  const auto stored =
      hardening_state(*material_.flow, deformation.hardening, deformation.back_squared, temperature);
  r.entropy += stored.entropy;
  r.internal_energy += stored.internal_energy;
  r.capacity += stored.capacity;
  return r;
}

void StructuralPoints::set_old(Index batch, int point, const Deformation& deformation) {
  Point& p = at(batch, point);
  const State old = state(p, deformation, p.temperature, Want::state);
  p.old_entropy = old.entropy;
  p.old_energy = old.internal_energy;
}

void StructuralPoints::spread_as_stored(const PackVector<Lane>& weights) {
  const auto n_nodes = static_cast<std::size_t>(geometry_.n_nodes);
  correction_ = weights;
  double largest = 0;
  for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
    Lane volume(0.0);
    for (int q = 0; q < geometry_.n_points; ++q) volume += geometry_.weight_at(batch, q);
    const Lane inverse =
        select(volume > Lane(0.0), Lane(1.0) / volume, Lane(0.0));  // padding lanes have none
    for (std::size_t a = 0; a < n_nodes; ++a) {
      Lane& c = correction_[static_cast<std::size_t>(batch) * n_nodes + a];
      for (int q = 0; q < geometry_.n_points; ++q)
        c -=
            geometry_.weight_at(batch, q) * Lane(geometry_.values[static_cast<std::size_t>(q) * n_nodes + a]);
      c *= inverse;
      for (int lane = 0; lane < k_lanes; ++lane) largest = std::max(largest, std::abs(c[lane]));
    }
  }
  constexpr double k_rounding = 1e-12;
  if (largest < k_rounding) correction_.clear();
}

void StructuralPoints::add_heat(StructuralForm form, std::span<const double> temperature, bool tangent,
                                std::span<double> out) const {
  const Lane rate(1.0 / dt_);
  for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
    const Index* nodes =
        geometry_.nodes.data() + static_cast<std::ptrdiff_t>(batch) * geometry_.n_nodes * k_lanes;
    Lane total(0.0);
    for (int q = 0; q < geometry_.n_points; ++q) {
      const Point& at = points_[index(batch, q)];
      const Lane theta = temperature_at(geometry_, batch, q, temperature);
      const State now = state(at, at.now, theta, tangent ? Want::state_and_capacity : Want::state);
      Lane density;
      if (tangent) {
        density = rate * now.capacity;
        if (form == StructuralForm::entropy) density += rate * (now.entropy - at.old_entropy);
      } else if (form == StructuralForm::entropy) {
        density = rate * theta * (now.entropy - at.old_entropy) - at.dissipation;
      } else {
        density = rate * (now.internal_energy - at.old_energy - at.work);
      }
      density *= geometry_.weight_at(batch, q);
      total += density;
      const double* values = geometry_.values.data() + q * geometry_.n_nodes;
      for (int a = 0; a < geometry_.n_nodes; ++a)
        for (int lane = 0; lane < k_lanes; ++lane)
          out[static_cast<std::size_t>(nodes[a * k_lanes + lane])] += values[a] * density[lane];
    }
    if (correction_.empty()) continue;
    const Lane* correction = correction_.data() + static_cast<std::ptrdiff_t>(batch) * geometry_.n_nodes;
    for (int a = 0; a < geometry_.n_nodes; ++a)
      for (int lane = 0; lane < k_lanes; ++lane)
        out[static_cast<std::size_t>(nodes[a * k_lanes + lane])] += correction[a][lane] * total[lane];
  }
}

StructuralChange StructuralPoints::change(std::span<const double> temperature) const {
  StructuralChange total;
  for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
    Lane energy(0.0), entropy(0.0);
    for (int q = 0; q < geometry_.n_points; ++q) {
      const Point& at = points_[index(batch, q)];
      const State now = state(at, at.now, temperature_at(geometry_, batch, q, temperature), Want::state);
      energy += geometry_.weight_at(batch, q) * (now.internal_energy - at.old_energy);
      entropy += geometry_.weight_at(batch, q) * (now.entropy - at.old_entropy);
    }
    const Lane counted = geometry_.counted[static_cast<std::size_t>(batch)];
    total.energy += sum(energy * counted);
    total.entropy += sum(entropy * counted);
  }
  return total;
}

StructuralChange StructuralPoints::mechanical_change() const {
  StructuralChange total;
  for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
    Lane energy(0.0), entropy(0.0);
    for (int q = 0; q < geometry_.n_points; ++q) {
      const Point& at = points_[index(batch, q)];
      const State now = state(at, at.now, at.pass_temperature, Want::state);
      const auto sensible = material::sensible_heat(material_, at.temperature, at.pass_temperature);
      energy += geometry_.weight_at(batch, q) * (now.internal_energy - at.old_energy + sensible.heat);
      entropy += geometry_.weight_at(batch, q) * (now.entropy - at.old_entropy + sensible.entropy);
    }
    const Lane counted = geometry_.counted[static_cast<std::size_t>(batch)];
    total.energy += sum(energy * counted);
    total.entropy += sum(entropy * counted);
  }
  return total;
}

}  // namespace solidus::mechanics
