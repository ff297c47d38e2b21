#include "results/tables/probes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <stdexcept>

#include "mesh/block_geometry.hpp"
#include "mesh/locate.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "results/output/output_error.hpp"
#include "system/processes.hpp"

namespace solidus::results {

namespace {

using mesh::Mesh;

// A point this far outside, in sizes of the element there, still counts as inside: a chord of a curved
// boundary with six elements to the quarter turn runs 3 % of its length below the arc.
constexpr double k_slack = 0.05;

std::size_t cell_offset(const Mesh& mesh, std::size_t block) {
  std::size_t offset = 0;
  for (std::size_t b = 0; b < block; ++b) offset += as_size(mesh.blocks[b].size());
  return offset;
}

int body_index(const Mesh& mesh, const std::string& name) {
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b)
    if (mesh.bodies[b].name == name) return static_cast<int>(b);
  return -1;
}

std::string group_names(const Mesh& mesh) {
  std::string names;
  for (const mesh::Body& body : mesh.bodies) names += (names.empty() ? "" : ", ") + body.name;
  for (const auto& [name, surface] : mesh.surfaces) names += (names.empty() ? "" : ", ") + name;
  for (const auto& [name, nodes] : mesh.node_sets)
    if (mesh.surfaces.count(name) == 0 && body_index(mesh, name) < 0)
      names += (names.empty() ? "" : ", ") + name;
  return names;
}

// The extent of an element in its widest direction.
double element_size(const Mesh& mesh, const mesh::ElementBlock& block, Index e) {
  double size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = [&](int a) { return mesh.x[as_size(block.element(e)[a])][i]; };
    double low = at(0), high = at(0);
    for (int a = 1; a < mesh::node_count(block.shape); ++a) {
      low = std::min(low, at(a));
      high = std::max(high, at(a));
    }
    size = std::max(size, high - low);
  }
  return size;
}

/// The share of each counted element in the volume of its body.
std::vector<std::pair<std::size_t, double>> cell_weights(const Mesh& mesh, AnalysisKind kind, int body) {
  std::vector<std::pair<std::size_t, double>> weights;
  double all = 0;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const mesh::ElementBlock& block = mesh.blocks[b];
    if (block.body != body) continue;
    const mesh::BlockGeometry g(mesh, block, kind, mesh::stiffness_rule(block.shape));
    for (Index e = 0; e < block.n_counted; ++e) {
      double volume = 0;
      for (int q = 0; q < g.n_points; ++q) volume += g.weight_at(e / k_lanes, q)[e % k_lanes];
      weights.emplace_back(cell_offset(mesh, b) + as_size(e), volume);
      all += volume;
    }
  }
  all = parallel::global_sum(all);
  for (auto& [cell, weight] : weights) weight /= all;
  return weights;
}

/// The elements of this process around each node of a group, with the places of their values; blocks in
/// order.
struct ElementAt {
  std::size_t cell;
  std::span<const Index> nodes;
};
std::map<Index, std::vector<ElementAt>> elements_at(const Mesh& mesh, const std::vector<Index>& group) {
  std::map<Index, std::vector<ElementAt>> at;
  for (const Index node : group) at[node];
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const mesh::ElementBlock& block = mesh.blocks[b];
    const auto n = as_size(mesh::node_count(block.shape));
    for (Index e = 0; e < block.size(); ++e) {
      const ElementAt here{cell_offset(mesh, b) + as_size(e), {block.element(e), n}};
      for (const Index node : here.nodes)
        if (const auto found = at.find(node); found != at.end()) found->second.push_back(here);
    }
  }
  return at;
}

/// The share of the element behind each face in the area of a surface; behind a face between two bodies that
/// share nodes that of the first. A process that counts a face holds the elements at its nodes.
std::vector<std::pair<std::size_t, double>> face_weights(const Mesh& mesh, AnalysisKind kind,
                                                         const std::string& group) {
  std::vector<std::pair<std::size_t, double>> weights;
  double all = 0;
  if (const auto surface = mesh.surfaces.find(group); surface != mesh.surfaces.end()) {
    const auto around = elements_at(mesh, surface->second.nodes);
    for (const mesh::ElementBlock& faces : surface->second.faces) {
      const mesh::FaceGeometry g(mesh, faces, kind, mesh::gauss_rule(faces.shape, 4));
      const auto n_points = as_size(g.n_points), n = as_size(g.n_nodes);
      for (Index f = 0; f < faces.n_counted; ++f) {
        const std::span<const Index> nodes(faces.element(f), n);
        const std::vector<ElementAt>& candidates = around.at(nodes[0]);
        const auto owner = std::ranges::find_if(candidates, [&](const ElementAt& element) {
          return std::ranges::all_of(nodes, [&](Index node) {
            return std::ranges::find(element.nodes, node) != element.nodes.end();
          });
        });
        if (owner == candidates.end()) continue;
        double area = 0;
        for (std::size_t q = 0; q < n_points; ++q) area += g.weight[as_size(f) * n_points + q];
        weights.emplace_back(owner->cell, area);
        all += area;
      }
    }
  }
  all = parallel::global_sum(all);
  for (auto& [cell, weight] : weights) weight /= all;
  return weights;
}

/// Elements around the nodes of a set: every node counts alike, and at a node every element.
std::vector<std::pair<std::size_t, double>> weights_around(const Mesh& mesh,
                                                           const std::vector<Index>& nodes) {
  std::vector<std::pair<std::size_t, double>> weights;
  double n = 0;
  for (const auto& [node, elements] : elements_at(mesh, nodes)) {
    if (node >= mesh.n_owned_nodes || elements.empty()) continue;
    for (const ElementAt& element : elements)
      weights.emplace_back(element.cell, 1.0 / static_cast<double>(elements.size()));
    ++n;
  }
  n = parallel::global_sum(n);
  for (auto& [cell, weight] : weights) weight /= n;
  return weights;
}

/// @param values  of the field
double component_of(const Field& field, std::span<const double> values, std::size_t entity, int component) {
  const auto nc = as_size(field.components);
  const double* v = values.data() + entity * nc;
  if (component != k_magnitude) return v[component];
  double square = 0;
  for (std::size_t c = 0; c < nc; ++c) square += v[c] * v[c];
  return std::sqrt(square);
}

const Reading* find_global(const std::vector<Reading>& globals, const std::string& name) {
  const auto found = std::find_if(globals.begin(), globals.end(),
                                  [&](const Reading& global) { return global.first.name == name; });
  return found == globals.end() ? nullptr : &*found;
}

units::Conversion conversion_to(const CsvColumn& column, const std::string& si, units::Temperature kind,
                                const SourceLocation& where) {
  if (!units::compatible(column.unit, si))
    throw InputError(where, fmt::format("probe '{}': the unit '{}' does not fit", column.name, column.unit),
                     fmt::format("it measures {}, for example in '{}'", units::dimension_name(si), si));
  return units::conversion(si, column.unit, kind);
}

}  // namespace

int component_index(std::string_view name, int components, AnalysisKind kind) {
  using Names = std::vector<std::pair<std::string_view, int>>;
  const bool turned = kind == AnalysisKind::axisymmetric;
  Names names;
  // Names depend on the number of components and on the kind of analysis; Cartesian ones always hold.
  if (components == 1)
    names = {{"", 0}};
  else if (components == 6)
    names = turned ? Names{{"rr", 0}, {"zz", 1}, {"tt", 2}, {"rz", 3}, {"xx", 0}, {"yy", 1}, {"xy", 3}}
                   : Names{{"xx", 0}, {"yy", 1}, {"zz", 2}, {"xy", 3}, {"yz", 4}, {"xz", 5}};
  else
    names = turned ? Names{{"r", 0}, {"z", 1}, {"x", 0}, {"y", 1}, {"magnitude", k_magnitude}}
                   : Names{{"x", 0}, {"y", 1}, {"z", 2}, {"magnitude", k_magnitude}};
  std::string known;
  for (const auto& [text, index] : names) {
    if (index >= components) continue;
    if (text == name) return index;
    known += fmt::format("{}\"{}\"", known.empty() ? "" : ", ", text);
  }
  throw std::invalid_argument("components: " + known);
}

Probes::Probes(const Mesh& mesh, AnalysisKind kind, const std::vector<Probe>& probes, const FieldSet& fields,
               const std::vector<Reading>& globals) {
  const auto field_of = [&](const Sampled& probe) -> const Field& {
    if (const Field* field = fields.find(probe.field)) return *field;
    std::string known;
    for (const Field& field : fields.all()) known += (known.empty() ? "" : ", ") + field.name;
    throw InputError(probe.where,
                     fmt::format("probe '{}': there is no field '{}'", probe.column.name, probe.field),
                     "fields: " + known);
  };
  for (const Probe& probe : probes) {
    if (const auto* point = std::get_if<PointProbe>(&probe))
      samples_.push_back(point_sample(mesh, *point, field_of(*point)));
    else if (const auto* group = std::get_if<GroupProbe>(&probe))
      samples_.push_back(group_sample(mesh, kind, *group, field_of(*group)));
    else if (const auto* linear = std::get_if<LinearProbe>(&probe))
      samples_.push_back(linear_sample(*linear));
    else
      samples_.push_back(global_sample(std::get<GlobalProbe>(probe), globals));
    columns_.push_back(std::visit([](const auto& p) { return p.column; }, probe));
  }
}

Probes::Sample Probes::point_sample(const Mesh& mesh, const PointProbe& probe, const Field& field) const {
  Sample sample;
  sample.field = probe.field;
  sample.component = probe.component;
  sample.unit = field.unit;
  sample.shown = conversion_to(probe.column, field.unit, units::Temperature::absolute, probe.where);
  const mesh::LocatedPoint place = mesh::locate(mesh, probe.at, probe.body);
  const auto block = as_size(std::max(place.block, Index{0}));
  const double size =
      parallel::global_max(place.here ? element_size(mesh, mesh.blocks[block], place.element) : 0.0);
  if (!(place.distance <= k_slack * size)) {
    const std::string body =
        probe.body < 0 ? "the mesh" : "body '" + mesh.bodies[as_size(probe.body)].name + "'";
    throw InputError(probe.where,
                     fmt::format("probe '{}': the point ({:g}, {:g}, {:g}) m lies outside {}",
                                 probe.column.name, probe.at[0], probe.at[1], probe.at[2], body),
                     fmt::format("the nearest element is {:.3g} m away", place.distance));
  }
  const int here = place.here && place.block >= 0 ? mesh.blocks[block].body : -1;
  sample.body = static_cast<int>(parallel::global_max(static_cast<double>(here)));
  if (place.here && field.place == mesh::FieldPlace::cell)
    sample.weights = {{cell_offset(mesh, block) + as_size(place.element), 1.0}};
  else
    for (std::size_t a = 0; a < place.nodes.size(); ++a)
      sample.weights.emplace_back(as_size(place.nodes[a]), place.weights[a]);
  return sample;
}

Probes::Sample Probes::group_sample(const Mesh& mesh, AnalysisKind kind, const GroupProbe& probe,
                                    const Field& field) const {
  // A probe of a group is a sum of weighted values, or their extreme. Which values it needs depends on where
  // the field lives and what the group is.
  const auto refuse = [&](const std::string& what, const std::string& allowed) {
    throw InputError(probe.where, fmt::format("probe '{}': {}", probe.column.name, what), allowed);
  };
  const int body = body_index(mesh, probe.group);
  const bool extreme = probe.statistic == Statistic::minimum || probe.statistic == Statistic::maximum;
  const auto nodes = mesh.node_sets.find(probe.group);
  if (nodes == mesh.node_sets.end())
    refuse(fmt::format("there is no group '{}'", probe.group), "groups: " + group_names(mesh));
  // A group may be a surface on some processes only, so all of them decide together.
  const bool surface = parallel::any_process(mesh.surfaces.contains(probe.group));
  const auto of_elements = [&] {
    return body >= 0 ? cell_weights(mesh, kind, body)
           : surface ? face_weights(mesh, kind, probe.group)
                     : weights_around(mesh, nodes->second);
  };

  Sample sample;
  sample.field = probe.field;
  sample.component = probe.component;
  sample.unit = field.unit;
  sample.body = body;
  // Extremes need no weights, but every value once: owned nodes, or the elements of the group.
  if (extreme) {
    sample.reduce = probe.statistic == Statistic::minimum ? Reduce::minimum : Reduce::maximum;
    if (field.place == mesh::FieldPlace::node) {
      for (const Index node : nodes->second)
        if (node < mesh.n_owned_nodes) sample.weights.emplace_back(as_size(node), 1.0);
    } else {
      sample.weights = of_elements();
    }
    if (!parallel::any_process(!sample.weights.empty()))
      refuse(fmt::format("the group '{}' is empty", probe.group), {});
    // Means over cells are weighted by volume or area, those over nodes by the integrals of their shape
    // functions.
  } else if (field.place == mesh::FieldPlace::cell) {
    sample.weights = of_elements();
  } else {
    const mesh::NodalFunctional mean = mesh::group_mean(mesh, probe.group, kind);
    sample.weights.reserve(mean.nodes.size());
    for (std::size_t a = 0; a < mean.nodes.size(); ++a)
      sample.weights.emplace_back(as_size(mean.nodes[a]), mean.weights[a]);
  }
  // An integral is the mean times the measure of the group, with the unit of both.
  if (probe.statistic == Statistic::integral) {
    const double measure = mesh::group_measure(mesh, probe.group, kind);
    if (!(measure > 0))
      refuse(fmt::format("'{}' is a set of points; it has no integral", probe.group),
             "take a body or a surface");
    sample.factor = measure;
    sample.unit = (field.unit == "1" ? "" : field.unit + " ") + (body < 0 ? "m2" : "m3");
  }
  sample.shown = conversion_to(probe.column, sample.unit, units::Temperature::absolute, probe.where);
  return sample;
}

Probes::Sample Probes::linear_sample(const LinearProbe& probe) const {
  // A probe that combines others: each has to be before it, and all measure the same.
  Sample sample;
  sample.reduce = Reduce::linear;
  double sum = 0;
  for (const auto& term : probe.terms) {
    const double factor = term.first;
    const std::string& name = term.second;
    const auto found =
        std::find_if(columns_.begin(), columns_.end(), [&](const CsvColumn& c) { return c.name == name; });
    if (found == columns_.end()) {
      std::string known;
      for (const CsvColumn& column : columns_) known += (known.empty() ? "" : ", ") + column.name;
      throw InputError(probe.where,
                       fmt::format("probe '{}': there is no probe '{}' before it", probe.column.name, name),
                       "probes so far: " + known);
    }
    const auto index = as_size(found - columns_.begin());
    const std::string& unit = samples_[index].unit;
    if (!sample.unit.empty() && !units::compatible(unit, sample.unit))
      throw InputError(probe.where, fmt::format("probe '{}': '{}' measures something else than '{}'",
                                                probe.column.name, name, probe.terms.front().second));
    if (sample.unit.empty()) sample.unit = unit;
    sample.terms.emplace_back(factor, index);
    sum += factor;
  }
  if (sample.terms.empty())
    throw InputError(probe.where, fmt::format("probe '{}' combines nothing", probe.column.name));
  // If the factors sum to one the result is of the kind of its parts (a temperature), otherwise a difference,
  // which converts without offset.
  const bool absolute = std::abs(sum - 1) < 1e-12;
  sample.shown =
      conversion_to(probe.column, sample.unit,
                    absolute ? units::Temperature::absolute : units::Temperature::difference, probe.where);
  return sample;
}

Probes::Sample Probes::global_sample(const GlobalProbe& probe, const std::vector<Reading>& globals) {
  const Reading* found = find_global(globals, probe.global);
  if (found == nullptr) {
    std::string known;
    for (const Reading& global : globals) known += (known.empty() ? "" : ", ") + global.first.name;
    throw InputError(
        probe.where,
        fmt::format("probe '{}': history.csv has no column '{}'", probe.column.name, probe.global),
        "columns: " + known);
  }
  Sample sample;
  sample.reduce = Reduce::global;
  sample.field = probe.global;
  sample.factor = probe.factor;
  sample.unit = found->first.unit;
  if (!probe.column.unit.empty())
    sample.shown = conversion_to(probe.column, sample.unit, units::Temperature::absolute, probe.where);
  return sample;
}

void Probes::take(const Sample& sample, const Field& field, std::span<const double> values,
                  const linear::ActiveSet* active, Totals to) {
  const double sign = sample.reduce == Reduce::minimum ? -1.0 : 1.0;
  for (const auto& [entity, weight] : sample.weights) {
    const double value = component_of(field, values, entity, sample.component);
    if (sample.reduce == Reduce::sum) {
      to.sum += weight * value * (field.covered.empty() ? 1.0 : field.covered[entity]);
      continue;
    }
    // Written so that a NaN stays and is found in the end, which std::max would lose.
    const auto raise = [&](double& peak) { peak = sign * value <= peak ? peak : sign * value; };
    raise(to.peak_of_all);
    const bool there =
        active == nullptr || field.place == mesh::FieldPlace::cell || active->node(as_index(entity));
    if (there) raise(to.peak);
  }
}

std::vector<double> Probes::values(const FieldSet& fields, const std::vector<Reading>& globals) const {
  // In SI; minima and maxima in one reduction (the maximum of the negated value is the minimum). The second
  // half of the peaks counts bodies that have left too: for groups that are theirs alone.
  const std::size_t n_samples = samples_.size();
  std::vector<double> sums(n_samples, 0.0), peaks(2 * n_samples, 0.0);
  const linear::ActiveSet* active = fields.active();
  // A field is read once, one at a time; on all processes in one order, whoever has its nodes: to compute it
  // may be collective.
  struct Read {
    const Field* field;
    int body;
    std::vector<std::size_t> samples;
  };
  std::vector<Read> reads;
  for (std::size_t s = 0; s < n_samples; ++s) {
    const Sample& sample = samples_[s];
    if (sample.reduce == Reduce::linear || sample.reduce == Reduce::global) continue;
    const Field* field = fields.find(sample.field);
    if (field == nullptr) throw std::invalid_argument("probes: no field '" + sample.field + "'");
    if (sample.reduce != Reduce::sum)
      peaks[s] = peaks[n_samples + s] = -std::numeric_limits<double>::infinity();
    const int body = field->compute_of ? sample.body : -1;
    const auto same = std::ranges::find_if(
        reads, [&](const Read& read) { return read.field == field && read.body == body; });
    if (same == reads.end())
      reads.push_back({field, body, {s}});
    else
      same->samples.push_back(s);
  }
  for (const auto& [field, body, samples] : reads) {
    const bool none =
        std::ranges::all_of(samples, [&](std::size_t s) { return samples_[s].weights.empty(); });
    if (none && !field->compute_of) continue;
    std::vector<double> storage;
    const std::span<const double> values = field->read(storage, body);
    for (const std::size_t s : samples)
      take(samples_[s], *field, values, active, {sums[s], peaks[s], peaks[n_samples + s]});
  }
  processes::sum(sums);
  processes::largest(peaks);

  std::vector<double> si(samples_.size()), shown(samples_.size());
  for (std::size_t s = 0; s < samples_.size(); ++s) {
    const Sample& sample = samples_[s];
    if (sample.reduce == Reduce::sum) si[s] = sums[s] * sample.factor;
    const double peak = std::isinf(peaks[s]) ? peaks[n_samples + s] : peaks[s];
    if (sample.reduce == Reduce::maximum) si[s] = peak;
    if (sample.reduce == Reduce::minimum) si[s] = -peak;
    if (sample.reduce == Reduce::global) si[s] = sample.factor * find_global(globals, sample.field)->second;
    for (const auto& [factor, term] : sample.terms) si[s] += factor * si[term];
    shown[s] = sample.shown(si[s]);
    if (!std::isfinite(shown[s])) throw NotFiniteError("probe '" + columns_[s].header() + "'", {});
  }
  return shown;
}

std::size_t Probes::bytes() const {
  std::size_t bytes = 0;
  for (const Sample& sample : samples_) bytes += sample.weights.size() * sizeof(sample.weights[0]);
  return bytes;
}

}  // namespace solidus::results
