#include "mechanics/structural_points.hpp"

#include <algorithm>
#include <cmath>

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
      thermoelastic_(material),
      points_(static_cast<std::size_t>(geometry.n_batches) * static_cast<std::size_t>(geometry.n_points)) {
  thermoelastic_.phase_changes.clear();
}

void StructuralPoints::set_temperature(Index batch, int point, Lane temperature, Lane thermal_strain) {
  Point& p = at(batch, point);
  p.temperature = temperature;
  const Lane reference(thermoelastic_.expansion_reference);
  p.strain_offset = thermal_strain - properties_at(thermoelastic_, temperature, reference).thermal_strain;
}

material::PointProperties<Lane> StructuralPoints::properties(const Point& at, Lane temperature) const {
  auto p = properties_at(thermoelastic_, temperature, Lane(thermoelastic_.expansion_reference));
  p.thermal_strain += at.strain_offset;
  return p;
}

material::StructuralState<Lane> StructuralPoints::state(const Point& at, Lane temperature, Lane strain_trace,
                                                        Lane elastic_squared) const {
  const auto p = properties(at, temperature);
  const auto d = derivatives_at(thermoelastic_, temperature, temperature);
  return structural_state(p, d, temperature, strain_trace, Lane(4.0) * p.shear * p.shear * elastic_squared);
}

void StructuralPoints::set_old(Index batch, int point, Lane strain_trace, Lane elastic_squared) {
  Point& p = at(batch, point);
  const auto old = state(p, p.temperature, strain_trace, elastic_squared);
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
      const auto p = properties(at, theta);
      const auto d = derivatives_at(thermoelastic_, theta, theta);
      const Lane deviator_squared = Lane(4.0) * p.shear * p.shear * at.elastic_squared;
      const auto now = structural_state(p, d, theta, at.strain_trace, deviator_squared);
      Lane density;
      if (tangent) {
        const auto c = curvatures_at(thermoelastic_, theta);
        density = rate * structural_capacity(p, d, c, theta, at.strain_trace, deviator_squared);
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

double StructuralPoints::energy_change(std::span<const double> temperature) const {
  double total = 0;
  for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
    Lane change(0.0);
    for (int q = 0; q < geometry_.n_points; ++q) {
      const Point& at = points_[index(batch, q)];
      const auto now =
          state(at, temperature_at(geometry_, batch, q, temperature), at.strain_trace, at.elastic_squared);
      change += geometry_.weight_at(batch, q) * (now.internal_energy - at.old_energy);
    }
    total += sum(change * geometry_.counted[static_cast<std::size_t>(batch)]);
  }
  return total;
}

}  // namespace solidus::mechanics
