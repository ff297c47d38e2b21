#include "mechanics/elements/structural_points.hpp"

#include <algorithm>
#include <cmath>

#include "material/derivatives/structural_lines.hpp"
#include "material/derivatives/structural_partials.hpp"
#include "material/thermal_potential.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::mechanics {

StructuralPoints::StructuralPoints(const mesh::BlockGeometry& geometry, const material::Material& material)
    : geometry_(geometry),
      material_(material),
      n_points_(as_size(geometry.n_batches) * as_size(geometry.n_points)) {
  material_.phase_changes.clear();
}

void StructuralPoints::set_temperature(Index batch, int point, Lane temperature, Lane pass_temperature,
                                       Lane thermal_strain) {
  if (!kept()) return;
  Point& p = at(batch, point);
  p.temperature = temperature;
  p.lines = material::elastic_lines(material_, temperature);
  p.pass_temperature = pass_temperature;
  const Lane reference(material_.expansion_reference);
  p.strain_offset = thermal_strain - properties_at(material_, pass_temperature, reference).thermal_strain;
}

StructuralPoints::State StructuralPoints::state(const Point& at, const Deformation& deformation,
                                                Lane temperature) const {
  return state(at.lines, at.strain_offset, deformation, temperature);
}

StructuralPoints::State StructuralPoints::state(const StructuralBase& base, const Deformation& deformation,
                                                Lane temperature) const {
  return state(material::elastic_lines(material_, base.line_temperature), base.strain_offset, deformation,
               temperature);
}

StructuralPoints::State StructuralPoints::state(const material::ElasticLines<Lane>& lines, Lane strain_offset,
                                                const Deformation& deformation, Lane temperature) const {
  const auto flow =
      material::hardening_along(material_, deformation.hardening, lines.temperature, temperature);
  const auto partials = material::structural_partials<Lane>(
      material_, material::elastic_along(material_, lines, temperature, strain_offset),
      flow ? &*flow : nullptr, temperature, deformation.strain_trace, deformation.elastic_squared,
      deformation.elastic_squared >= Lane(0.0), deformation.hardening, deformation.back_squared);
  return {partials.entropy.value, partials.internal_energy.value + deformation.cold_work,
          partials.internal_energy.temperature};
}

// The state at t_n has the energy that it ended its step with. What the new lines and phases make of it at
// fixed strain and entropy, Δψ + Θ ΔS²/2C, is exchanged with the heat of the point in this step.
void StructuralPoints::set_old(Index batch, int point, const Deformation& deformation,
                               const StructuralBase& base) {
  Point& p = at(batch, point);
  const StructuralDensities ahead =
      ahead_.empty() ? StructuralDensities{Lane(0.0), Lane(0.0)} : ahead_[index(batch, point)];
  const State opened = state(p, deformation, p.temperature);
  if (!carries_energy()) {
    p.old_entropy = opened.entropy + ahead.entropy;
    p.old_energy = opened.internal_energy + ahead.energy;
    p.transformed = Lane(0.0);
    return;
  }
  const State old = state(base, deformation, p.temperature);
  p.old_entropy = old.entropy + ahead.entropy;
  p.old_energy = old.internal_energy + ahead.energy;
  const Lane entropy = opened.entropy - old.entropy;
  const Lane capacity = Lane(material_.density) * material_.specific_heat.value(p.temperature);
  const LaneMask stores = capacity > Lane(0.0);
  p.transformed =
      abs(opened.internal_energy - old.internal_energy - p.temperature * entropy) +
      select(stores, Lane(0.5) * p.temperature * entropy * entropy / select(stores, capacity, Lane(1.0)),
             Lane(0.0));
}

Lane StructuralPoints::entropy_ahead(Index batch, int point, const Deformation& deformation,
                                     const StructuralBase& old) const {
  if (!kept() || !carries_energy()) return Lane(0.0);
  const Point& p = at(batch, point);
  return state(old, deformation, p.pass_temperature).entropy -
         state(p, deformation, p.pass_temperature).entropy;
}

StructuralBase StructuralPoints::base(Index batch, int point, const LaneMask& solid) const {
  const Point& p = at(batch, point);
  return {p.lines.temperature, p.strain_offset, select(solid, Lane(1.0), Lane(0.0))};
}

StructuralBase StructuralPoints::initial_base(Lane initial_temperature) const {
  const Lane reference(material_.expansion_reference);
  return {initial_temperature,
          Lane(-3.0) * material_.expansion.value(initial_temperature) * (initial_temperature - reference),
          Lane(1.0)};
}

void StructuralPoints::hold_deformation(Index batch, int point, const Deformation& deformation,
                                        const StructuralBase& base) {
  if (!kept()) return;
  Point& p = at(batch, point);
  if (carries_energy()) {
    p.lines = material::elastic_lines(material_, base.line_temperature);
    p.strain_offset = base.strain_offset;
  }
  p.now = deformation;
  p.change = {Lane(0.0), Lane(0.0), Lane(0.0), Lane(0.0)};
  p.dissipated = p.work = Lane(0.0);
  set_old(batch, point, deformation, base);
}

void StructuralPoints::expect_expansion() {
  if (!kept()) return;
  expansion_.resize(n_points_);
  for (std::size_t i = 0; i < n_points_; ++i) {
    const Point& at = points_[i];
    const auto elastic = material::elastic_along(material_, at.lines, at.temperature, at.strain_offset);
    const Jet<Lane>&k = elastic.bulk, &expansion = elastic.thermal_strain;
    const Lane slope = k.d * (at.now.strain_trace - expansion.v) - k.v * expansion.d;  // ∂p/∂Θ
    const Lane capacity = Lane(material_.density) * material_.specific_heat.value(at.temperature) +
                          state(at, at.now, at.temperature).capacity;
    const Lane most = Lane(k_most_expansion) * max(capacity, Lane(0.0));
    const LaneMask holds = k.v > Lane(0.0);
    const Lane free = at.temperature * slope * slope / select(holds, k.v, Lane(1.0));
    expansion_[i] = select(holds, min(free, most), Lane(0.0));
  }
}

StructuralDensities StructuralPoints::expected(std::size_t point, Lane temperature) const {
  constexpr double k_least_ratio = 1e-6;  // iterates may be below 0 K
  const Lane from = points_[point].temperature, ratio = max(temperature / from, Lane(k_least_ratio));
  return {expansion_[point] * log(ratio), expansion_[point] * (temperature - from)};
}

PackVector<StructuralDensities> StructuralPoints::expected(std::span<const double> temperature) const {
  PackVector<StructuralDensities> result(expansion_.size());
  for (Index batch = 0; !expansion_.empty() && batch < geometry_.n_batches; ++batch)
    for (int q = 0; q < geometry_.n_points; ++q)
      result[index(batch, q)] = expected(index(batch, q), temperature_at(geometry_, batch, q, temperature));
  return result;
}

void StructuralPoints::begin_with(Index batch, int point, const StructuralDensities& ahead) {
  if (!kept()) return;
  ahead_.resize(n_points_, {Lane(0.0), Lane(0.0)});
  ahead_[index(batch, point)] = ahead;
}

StructuralPoints::State StructuralPoints::state_now(std::size_t point, Lane temperature) const {
  const Point& at = points_[point];
  State now = state(at, at.now, temperature);
  if (expansion_.empty()) return now;
  const StructuralDensities more = expected(point, temperature);
  now.entropy += more.entropy;
  now.internal_energy += more.energy;
  now.capacity += expansion_[point];
  return now;
}

StructuralPoints::Stage StructuralPoints::stage(const linear::RungeKuttaStage& stage,
                                                std::span<const double> temperature) const {
  // The second stage starts from entropy and energy that are extrapolated through the first one, with what
  // was dissipated and done there.
  Stage result{stage, {}};
  if (stage.carried == 0) return result;
  result.carried.resize(points_.size());
  const Lane carried(stage.carried);
  for (Index batch = 0; batch < geometry_.n_batches; ++batch)
    for (int q = 0; q < geometry_.n_points; ++q) {
      const std::size_t i = index(batch, q);
      const Point& at = points_[i];
      const Lane theta = temperature_at(geometry_, batch, q, temperature);
      const State now = state_now(i, theta);
      const Lane entropy = at.old_entropy + at.dissipated / theta, energy = at.old_energy + at.work;
      result.carried[i] = {entropy + carried * (now.entropy - entropy),
                           energy + carried * (now.internal_energy - energy)};
    }
  return result;
}

/// H^ep Δt at t_{n+1} [J/m³] (2.127b).
StructuralPoints::Sloped StructuralPoints::structural_heating(const Point& at, Lane temperature) const {
  using J = Jet<Lane>;
  const auto p = material::elastic_along(material_, at.lines, temperature, at.strain_offset);
  const J &k = p.bulk, &g = p.shear, pull = k * p.thermal_strain;
  const Lane two(2.0);
  // ∂σ/∂Θ : Δε^E and its derivative.
  Lane stress_theta =
      (k.d * at.now.strain_trace - pull.d) * at.change.strain_trace + two * g.d * at.change.elastic_squared;
  Lane stress_theta2 = (k.dd * at.now.strain_trace - pull.dd) * at.change.strain_trace +
                       two * g.dd * at.change.elastic_squared;
  // −∂q/∂Θ of both hardening forces.
  if (const auto parameters =
          material::hardening_along(material_, at.now.hardening, at.lines.temperature, temperature)) {
    const material::Flow& flow = *material_.flow;
    if (flow.isotropic != material::IsotropicHardening::none) {
      const J stress =
          hardening_stress<J>(flow.isotropic, flow.curves, *parameters, J(at.now.hardening)).stress;
      stress_theta += stress.d * at.change.hardening;
      stress_theta2 += stress.dd * at.change.hardening;
    }
    if (flow.kinematic != material::KinematicHardening::none)
      stress_theta += Lane(2.0 / 3.0) * parameters->kinematic_modulus.d * at.change.back_squared;
  }
  return {-temperature * stress_theta, -stress_theta - temperature * stress_theta2};
}

/// Computes the heat that the stage stores at a point [J/m³]; the slope without third derivatives.
StructuralPoints::Sloped StructuralPoints::heat(StructuralForm form, const Stage& stage, std::size_t point,
                                                Lane temperature) const {
  const Point& at = points_[point];
  const bool first =
      stage.carried.empty();  // the deformation comes before the stages, with its work and heat
  const Start start = first ? Start{at.old_entropy, at.old_energy + at.work} : stage.carried[point];
  const Lane dissipated = first ? at.dissipated : Lane(0.0);
  // The form of capacities (4.53a) counts from the temperature of the mechanical phase.
  if (form == StructuralForm::temperature) {
    const Lane capacity = state(at, at.now, temperature).capacity;
    const Lane warmed = temperature - at.temperature;
    const Sloped h = structural_heating(at, temperature);
    return {capacity * warmed + h.value - dissipated,
            capacity * (Lane(1.0) + warmed / temperature) + h.slope};
  }
  const State now = state_now(point, temperature);
  // All others are differences of energy or entropy since the start.
  switch (form) {
    case StructuralForm::energy:
      // Energy gained since the start is the heat (first law).
      return {now.internal_energy - start.energy, now.capacity};
    case StructuralForm::literal: {
      // The literal form: Θ ΔS with the heating of 2.127b.
      const Lane gained = now.entropy - state(at, of_mechanics(point), at.temperature).entropy;
      const Sloped h = structural_heating(at, temperature);
      return {temperature * gained + h.value - dissipated, now.capacity + gained + h.slope};
    }
    case StructuralForm::entropy:
    case StructuralForm::temperature:
      break;
  }
  const Lane gained = now.entropy - start.entropy;
  return {temperature * gained - dissipated, now.capacity + gained};
}

StructuralDensities StructuralPoints::densities(Index batch, int point, Lane temperature) const {
  const Point& p = at(batch, point);
  const State now = state(p, p.now, temperature);
  return {now.entropy, now.internal_energy};
}

void StructuralPoints::spread_as_stored(const PackVector<Lane>& weights) {
  // Heat that is stored at the nodes is spread to them by the weights of the closed rule instead of the shape
  // functions: the difference is kept as a correction.
  const auto n_nodes = as_size(geometry_.n_nodes);
  correction_ = weights;
  double largest = 0;
  // Where both agree, up to rounding, there is none.
  for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
    Lane volume(0.0);
    for (int q = 0; q < geometry_.n_points; ++q) volume += geometry_.weight_at(batch, q);
    const Lane inverse =
        select(volume > Lane(0.0), Lane(1.0) / volume, Lane(0.0));  // padding lanes have none
    for (std::size_t a = 0; a < n_nodes; ++a) {
      Lane& c = correction_[as_size(batch) * n_nodes + a];
      for (int q = 0; q < geometry_.n_points; ++q)
        c -= geometry_.weight_at(batch, q) * Lane(geometry_.values[as_size(q) * n_nodes + a]);
      c *= inverse;
      for (int lane = 0; lane < k_lanes; ++lane) largest = std::max(largest, std::abs(c[lane]));
    }
  }
  constexpr double k_rounding = 1e-12;
  if (largest < k_rounding) correction_.clear();
}

void StructuralPoints::add_heat(StructuralForm form, const Stage& stage, std::span<const double> temperature,
                                bool tangent, std::span<double> out) const {
  // The heat of a point, or its slope, is its rate times the weight, and goes to the nodes by the shape
  // functions.
  const Lane rate(1.0 / stage.stage.dt);
  for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
    const Index* nodes =
        geometry_.nodes.data() + static_cast<std::ptrdiff_t>(batch) * geometry_.n_nodes * k_lanes;
    Lane total(0.0);
    for (int q = 0; q < geometry_.n_points; ++q) {
      const Lane theta = temperature_at(geometry_, batch, q, temperature);
      const Sloped stored = heat(form, stage, index(batch, q), theta);
      Lane density = rate * (tangent ? stored.slope : stored.value);
      density *= geometry_.weight_at(batch, q);
      total += density;
      const double* values = geometry_.values.data() + q * geometry_.n_nodes;
      for (int a = 0; a < geometry_.n_nodes; ++a)
        for (int lane = 0; lane < k_lanes; ++lane)
          out[as_size(nodes[a * k_lanes + lane])] += values[a] * density[lane];
    }
    // The correction moves the element's total to the nodes that store it.
    const Lane* correction = spread(batch);
    if (correction == nullptr) continue;
    for (int a = 0; a < geometry_.n_nodes; ++a)
      for (int lane = 0; lane < k_lanes; ++lane)
        out[as_size(nodes[a * k_lanes + lane])] += correction[a][lane] * total[lane];
  }
}

void StructuralPoints::add_heat_tangent(StructuralForm form, const Stage& stage,
                                        std::span<const double> temperature, const linear::LaneSlots& slots,
                                        linear::BlockMatrix& matrix) const {
  const Lane rate(1.0 / stage.stage.dt);
  const auto n = as_size(geometry_.n_nodes);
  PackVector<Lane> of_element(n * n);
  for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
    std::fill(of_element.begin(), of_element.end(), Lane(0.0));
    for (int q = 0; q < geometry_.n_points; ++q) {
      const Lane theta = temperature_at(geometry_, batch, q, temperature);
      const Lane slope =
          rate * heat(form, stage, index(batch, q), theta).slope * geometry_.weight_at(batch, q);
      const double* values = geometry_.values.data() + q * geometry_.n_nodes;
      for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = 0; b < n; ++b) of_element[a * n + b] += Lane(values[a] * values[b]) * slope;
    }
    const linear::BlockMatrix::Slot* slot = slots.of(batch);
    for (const Lane& entry : of_element)
      for (int lane = 0; lane < k_lanes; ++lane) *matrix.block(*slot++) += entry[lane];
  }
}

StructuralChange StructuralPoints::change(std::span<const double> temperature) const {
  // Energy and entropy of structural heat are summed over the points, less those at the start of the step.
  StructuralChange total;
  std::vector<double> coldness(temperature.size());  // 1/Θ
  std::ranges::transform(temperature, coldness.begin(), [](double theta) { return 1 / theta; });
  for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
    Lane energy(0.0), entropy(0.0), transformed(0.0), heat(0.0), entropy_of_nodes(0.0);
    for (int q = 0; q < geometry_.n_points; ++q) {
      const Point& at = points_[index(batch, q)];
      const Lane theta = temperature_at(geometry_, batch, q, temperature),
                 weight = geometry_.weight_at(batch, q);
      const State now = state_now(index(batch, q), theta);
      transformed += weight * at.transformed;
      energy += weight * (now.internal_energy - at.old_energy);
      const Lane of_point = weight * (now.entropy - at.old_entropy);
      entropy += of_point;
      // Heat that is released at a point reaches nodes of other temperatures: the entropy that it has there
      // is summed besides, with 1/Θ of the nodes.
      heat += theta * of_point;
      entropy_of_nodes += theta * of_point * temperature_at(geometry_, batch, q, coldness);
    }
    // Elements whose heat is spread to their nodes by other weights than the shape functions correct that
    // sum.
    if (const Lane* correction = spread(batch); correction != nullptr) {
      const Index* nodes =
          geometry_.nodes.data() + static_cast<std::ptrdiff_t>(batch) * geometry_.n_nodes * k_lanes;
      for (int a = 0; a < geometry_.n_nodes; ++a) {
        alignas(sizeof(Lane)) double of_node[k_lanes];
        for (int lane = 0; lane < k_lanes; ++lane)
          of_node[lane] = coldness[as_size(nodes[a * k_lanes + lane])];
        entropy_of_nodes += correction[a] * heat * Lane::load(of_node);
      }
    }
    // Elements that several processes hold count once.
    const Lane counted = geometry_.counted[as_size(batch)];
    total.energy += sum(energy * counted);
    total.entropy += sum(entropy * counted);
    total.transformed += sum(transformed * counted);
    total.spread += sum(abs(entropy_of_nodes - entropy) * counted);
  }
  return total;
}

double StructuralPoints::energy(std::span<const double> temperature) const {
  double total = 0;
  for (Index batch = 0; kept() && batch < geometry_.n_batches; ++batch) {
    Lane energy(0.0);
    for (int q = 0; q < geometry_.n_points; ++q) {
      const Point& at = points_[index(batch, q)];
      energy += geometry_.weight_at(batch, q) *
                state(at, at.now, temperature_at(geometry_, batch, q, temperature)).internal_energy;
    }
    total += sum(energy * geometry_.counted[as_size(batch)]);
  }
  return total;
}

StructuralChange StructuralPoints::mechanical_change() const {
  StructuralChange total;
  for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
    Lane energy(0.0), entropy(0.0);
    for (int q = 0; q < geometry_.n_points; ++q) {
      // Nodes keep their heat of before; the sensible heat is that of the points.
      const Point& at = points_[index(batch, q)];
      const State now = state(at, of_mechanics(index(batch, q)), at.pass_temperature);
      const auto sensible = material::sensible_heat(material_, at.temperature, at.pass_temperature);
      energy += geometry_.weight_at(batch, q) * (now.internal_energy - at.old_energy + sensible.heat);
      entropy += geometry_.weight_at(batch, q) * (now.entropy - at.old_entropy + sensible.entropy);
    }
    const Lane counted = geometry_.counted[as_size(batch)];
    total.energy += sum(energy * counted);
    total.entropy += sum(entropy * counted);
  }
  return total;
}

double StructuralPoints::excess_work() const {
  double total = 0;
  for (Index batch = 0; batch < geometry_.n_batches; ++batch) {
    Lane excess(0.0);
    for (int q = 0; q < geometry_.n_points; ++q) {
      const Point& at = points_[index(batch, q)];
      const State now = state(at, of_mechanics(index(batch, q)), at.pass_temperature);
      const Lane middle = Lane(0.5) * (at.temperature + at.pass_temperature);
      // A body at fixed strain whose entropy changes by as much as expansion was expected to take has another
      // energy than what was moved ahead, also at the temperature that an isothermal pass holds; that
      // difference is none of the work of stresses.
      Lane ahead(0.0);
      if (!ahead_.empty()) {
        const StructuralDensities& moved = ahead_[index(batch, q)];
        const Lane capacity = Lane(material_.density) * material_.specific_heat.value(at.temperature) +
                              state(at, at.now, at.temperature).capacity;
        const LaneMask stores =
            (capacity > Lane(0.0)) & (abs(at.pass_temperature - at.temperature) > Lane(0.0));
        const Lane half =
            select(stores, Lane(0.5) * moved.entropy / select(stores, capacity, Lane(1.0)), Lane(0.0));
        ahead = at.temperature * (Lane(1.0) + half) * moved.entropy - moved.energy;
      }
      excess += geometry_.weight_at(batch, q) * (at.work - (now.internal_energy - at.old_energy) + ahead +
                                                 middle * (now.entropy - at.old_entropy) - at.dissipated);
    }
    total += sum(excess * geometry_.counted[as_size(batch)]);
  }
  return total;
}

}  // namespace solidus::mechanics
