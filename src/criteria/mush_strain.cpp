/// Elements in the brittle range: their strain rate, gradient and cooling, kept as means over the time in
/// it.
#include "criteria/mush_strain.hpp"

#include <algorithm>
#include <cmath>

#include "criteria/longest_sides.hpp"
#include "criteria/quantities.hpp"
#include "criteria/strain_lanes.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::criteria {

namespace {

/// Numbers of an element.
enum MushNumber : std::size_t {
  k_mush_strain,                                       ///< sum of deviators from coherency to the root
  k_mush_time = k_mush_strain + k_tensor,              ///< near the root [s]
  k_mush_straining,                                    ///< from coherency to the root [s]
  k_mush_gradient,                                     ///< integral of the gradient near the root [K s/m]
  k_mush_cooling,                                      ///< by how much it cooled near the root [K]
  k_strain_in_brittle,                                 ///< sum of deviators in the brittle range
  k_time_in_brittle = k_strain_in_brittle + k_tensor,  ///< [s]
  k_mush_freezing,                                     ///< since it began to freeze [s]
  k_mush_numbers
};

/// Mean solid fractions from here on are one but for rounding.
constexpr double k_frozen = 1 - 1e-9;

/// Gradient and cooling are taken over this last part of the way to the root at least.
constexpr double k_near_root = 0.8;

/// The temperature at which a curve passes a fraction; where it jumps over it, that of the jump.
double temperature_at(const std::vector<std::pair<double, double>>& curve, double fraction) {
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    const auto& [cold, more] = curve[i];
    const auto& [hot, less] = curve[i + 1];
    if (more < fraction || less > fraction) continue;
    return more > less ? std::lerp(cold, hot, (more - fraction) / (more - less)) : cold;
  }
  return curve.empty() ? 0 : curve.back().first;
}

void add(std::vector<double>& column, std::size_t element, MushNumber number, double value, bool anew) {
  double& sum = column[element * k_mush_numbers + number];
  sum = (anew ? 0 : sum) + value;
}

bool tears(const material::Material& material) {
  return material.casting.arm_spacing && TearingLaw::of(material).has_value();
}

bool cracks(const material::Material& material) {
  return material.solidification() != nullptr && material.casting.crack_strain.has_value();
}

}  // namespace

double critical_crack_strain(const material::Casting& casting, double rate, double width) {
  return casting.crack_strain.value_or(0) /
         (std::pow(rate, casting.crack_rate_exponent) * std::pow(width, casting.crack_range_exponent));
}

bool MushStrain::has_something_to_say(const std::vector<material::Material>& materials) {
  return std::ranges::any_of(materials, [](const material::Material& m) { return tears(m) || cracks(m); });
}

MushStrain::MushStrain(const mesh::Mesh& mesh, const mesh::Mesh& whole, AnalysisKind kind,
                       const std::vector<material::Material>& materials)
    : mesh_(mesh), whole_(whole) {
  // Only blocks whose material freezes over a range are followed. `first` counts all elements, so that rows
  // of the record are the element numbers of the mesh.
  std::size_t first = 0;
  const std::vector<double> longest = longest_sides(mesh);
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const mesh::ElementBlock& block = mesh.blocks[b];
    const material::Material& material = materials[as_size(block.body)];
    const material::PhaseChange* freezing = material.solidification();
    if (freezing != nullptr && freezing->fraction.liquidus() > freezing->fraction.solidus()) {
      const auto& curve = freezing->fraction.points();
      const auto [low, high] = material.casting.brittle_range;
      blocks_.push_back({.strain = ElementStrain(mesh, block, kind),
                         .block = &block,
                         .material = &material,
                         .tearing = TearingLaw::of(material, longest[as_size(block.body)]),
                         .root = root_of(curve),
                         .brittle_width = temperature_at(curve, low) - temperature_at(curve, high),
                         .first = first,
                         .nodes = block.nodes});
      // Each block keeps its nodes once, sorted: fractions are evaluated node by node and not element by
      // element.
      std::vector<Index>& nodes = blocks_.back().nodes;
      std::ranges::sort(nodes);
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    }
    first += as_size(whole.blocks[b].size());
  }
  // A field exists only if some material has the law that it comes from.
  const std::array<bool, k_fields> said = {std::ranges::any_of(materials, tears),
                                           std::ranges::any_of(materials, cracks)};
  for (std::size_t f = 0; f < k_fields; ++f) {
    if (!said[f]) continue;
    fields_.push_back(fields::k_of_mush_strain[f]);
    which_.push_back(f);
  }
}

CriterionRecord MushStrain::initial(const CriterionInput& /*start*/) const {
  return {"mush_strain", {make_column(whole_, "elements", mesh::FieldPlace::cell, k_mush_numbers)}, {}};
}

void MushStrain::step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) {
  std::vector<double>& column = record.columns[0].values;
  // Strain is summed while the element's mean solid fraction lies in one of three ranges: near the root of
  // the dendrites, from coherency to the root, and the brittle range.
  std::vector<double> before(mesh_.x.size()), after(mesh_.x.size());  // f_S of the block's material
  const double dt = next.time - old.time;
  const auto mean = [](const OfBlock& block, std::span<const double> nodal, Index batch) {
    return max(min(block.strain.mean(nodal, batch), Lane(1.0)), Lane(0.0));
  };
  // First the fractions of this block's material are evaluated at its nodes, before and after the step.
  for (const OfBlock& block : blocks_) {
    const material::PhaseFraction& fraction = block.material->solidification()->fraction;
    for (const Index n : block.nodes) {
      const auto i = as_size(n);
      before[i] = fraction.value(old.heat.temperature[i], old.plateau_at(i));
      after[i] = fraction.value(next.heat.temperature[i], next.plateau_at(i));
    }
    const material::Casting& casting = block.material->casting;
    const double coherent = casting.coherency_fraction, near = std::min(coherent, k_near_root * block.root);
    for (Index batch = 0; batch < block.strain.n_batches(); ++batch) {
      const Lane from = mean(block, before, batch), to = mean(block, after, batch);
      const std::size_t first = block.first + as_size(batch) * k_lanes;
      const int count = std::min<int>(k_lanes, block.strain.n_elements() - batch * k_lanes);
      bool freezes = false;
      // A batch that is frozen throughout the step is skipped, and is the usual case.
      for (int lane = 0; lane < count; ++lane)
        freezes = freezes || from[lane] < k_frozen || to[lane] < k_frozen;
      if (!freezes) continue;
      // The share of the step within a range is that of the change of fraction within it.
      const Lane near_root = share_within(from, to, near, block.root),
                 straining = coherent < block.root ? share_within(from, to, coherent, block.root) : Lane(0.0),
                 brittle = share_within(from, to, casting.brittle_range[0], casting.brittle_range[1]);
      // Elements that were melt before the step start again from zero: what melts forgets its strain. The
      // deviator of the strain increment is added by its share.
      const LaneMask melt = from < Lane(coherent);
      const Sym<Lane> increment = dev(block.strain.strain(next.mechanics.displacement, batch) -
                                      block.strain.strain(old.mechanics.displacement, batch));
      Sym<Lane> in_mush = load_tensors(column, k_mush_numbers, first, count, k_mush_strain),
                in_brittle = load_tensors(column, k_mush_numbers, first, count, k_strain_in_brittle);
      for (std::size_t i = 0; i < k_tensor; ++i) {
        in_mush.c[i] = select(melt, Lane(0.0), in_mush.c[i] + straining * increment.c[i]);
        in_brittle.c[i] = select(melt, Lane(0.0), in_brittle.c[i] + brittle * increment.c[i]);
      }
      store_tensors(in_mush, k_mush_numbers, first, count, column, k_mush_strain);
      store_tensors(in_brittle, k_mush_numbers, first, count, column, k_strain_in_brittle);
      // Times, gradients and cooling within the ranges are means over the time spent there, so each is summed
      // with its share of the step; `far` and `soft` reset what has not begun.
      const Lane gradient = block.strain.gradient(next.heat.temperature, batch),
                 cooled = block.strain.mean(old.heat.temperature, batch) -
                          block.strain.mean(next.heat.temperature, batch);
      for (int lane = 0; lane < count; ++lane) {
        const std::size_t e = first + as_size(lane);
        const bool soft = from[lane] < coherent, far = from[lane] < near;
        const double share = near_root[lane];
        add(column, e, k_mush_time, share * dt, far);
        add(column, e, k_mush_gradient, share * dt * gradient[lane], far);
        add(column, e, k_mush_cooling, share * cooled[lane], far);
        add(column, e, k_mush_straining, soft ? 0 : straining[lane] * dt, soft);
        add(column, e, k_time_in_brittle, soft ? 0 : brittle[lane] * dt, soft);
        add(column, e, k_mush_freezing, to[lane] > 0 && from[lane] < k_frozen ? dt : 0, to[lane] <= 0);
      }
    }
  }
}

std::span<const quantities::Quantity* const> MushStrain::fields() const {
  return fields_;
}

std::array<double, MushStrain::k_fields> MushStrain::values_of(const OfBlock& block,
                                                               std::span<const double> row) const {
  std::array<double, k_fields> values{};
  for (std::size_t f = 0; f < k_fields; ++f) values[f] = *fields::k_of_mush_strain[f]->no_value;
  auto& [tendency, cracking] = values;
  const material::Casting& casting = block.material->casting;
  // The tendency to tear needs means over the time of freezing: gradient, cooling rate, arm spacing and rate
  // of strain.
  const std::optional<double> spacing =
      row[k_mush_freezing] > 0 ? casting.secondary_arm_spacing(row[k_mush_freezing]) : std::nullopt;
  if (block.tearing && spacing && row[k_mush_time] > 0 && row[k_mush_gradient] > 0 &&
      row[k_mush_cooling] > 0) {
    const double time = row[k_mush_time];
    const double strained = row[k_mush_straining] > 0
                                ? largest_principal(tensor_at(&row[k_mush_strain])) / row[k_mush_straining]
                                : 0;
    tendency = block.tearing->tendency({row[k_mush_gradient] / time, row[k_mush_cooling] / time, *spacing},
                                       strained);
  }
  // Cracking is the strain of the brittle range over the critical one at its rate.
  if (casting.crack_strain && block.brittle_width > 0 && row[k_time_in_brittle] > 0) {
    const double strain = largest_principal(tensor_at(&row[k_strain_in_brittle]));
    cracking = strain > 0 ? strain / critical_crack_strain(casting, strain / row[k_time_in_brittle],
                                                           block.brittle_width)
                          : 0;
  }
  return values;
}

void MushStrain::fill(const CriterionInput& /*now*/, const CriterionRecord& record,
                      std::span<const std::span<double>> values) const {
  for (std::size_t k = 0; k < fields_.size(); ++k) std::ranges::fill(values[k], *fields_[k]->no_value);
  const std::span<const double> column = record.columns[0].values;
  for (const OfBlock& block : blocks_)
    for (std::size_t e = block.first; e < block.first + as_size(block.block->size()); ++e) {
      const auto of_element = values_of(block, column.subspan(e * k_mush_numbers, k_mush_numbers));
      for (std::size_t k = 0; k < fields_.size(); ++k) values[k][e] = of_element[which_[k]];
    }
}

std::vector<CriterionResult> MushStrain::findings(const CriterionRecord& record) const {
  // For each field the largest value with its place, and the share of the volume beyond the threshold, over
  // all processes.
  const std::span<const double> column = record.columns[0].values;
  std::vector<CriterionResult> found;
  for (std::size_t k = 0; k < fields_.size(); ++k) {
    const quantities::Quantity& field = *fields_[k];
    double most = -1;
    std::array<double, 2> volumes{};  // with a value, and beyond the threshold
    mesh::Point where{};
    // Elements without a value do not count, neither for the volume nor for the largest.
    for (const OfBlock& block : blocks_)
      for (Index e = 0; e < block.block->n_counted; ++e) {
        const std::size_t row = block.first + as_size(e);
        const double value =
            values_of(block, column.subspan(row * k_mush_numbers, k_mush_numbers))[which_[k]];
        if (value == *field.no_value) continue;
        const double volume = block.strain.volume(e / k_lanes)[e % k_lanes];
        volumes[0] += volume;
        if (value > *field.threshold) volumes[1] += volume;
        if (value <= most) continue;
        most = value;
        where = {};
        const int n = mesh::node_count(block.block->shape);
        for (int a = 0; a < n; ++a)
          for (std::size_t i = 0; i < 3; ++i) where[i] += mesh_.x[as_size(block.block->element(e)[a])][i] / n;
      }
    // The place of the largest value is told by the process that has it.
    processes::sum(volumes);
    const processes::Largest largest = processes::find_largest(most);
    processes::broadcast(where, largest.rank);
    if (!(volumes[0] > 0)) continue;
    found.push_back({largest_of(field), "1", largest.value, true, where});
    found.push_back({beyond(field), "1", volumes[1] / volumes[0], false, {}});
  }
  return found;
}

std::size_t MushStrain::bytes() const {
  std::size_t total = 0;
  for (const OfBlock& block : blocks_) total += block.strain.bytes() + block.nodes.capacity() * sizeof(Index);
  return total;
}

}  // namespace solidus::criteria
