/// Strains of elements are split by the state of the metal in which they were taken; displacements since
/// coherency give distortion.
#include "criteria/strain_criteria.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "criteria/quantities.hpp"
#include "criteria/strain_lanes.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/processes.hpp"

namespace solidus::criteria {

namespace {

enum Columns : std::size_t { k_at_coherency, k_brittle, k_displacement, k_coherent_for, k_moved, k_followed };
Lane equivalent(const Sym<Lane>& strain) {
  return sqrt(Lane(2.0 / 3.0) * dot(dev(strain), dev(strain)));
}

/// The body of every local node; of ghosts from their owners, which hold all of a node's elements.
std::vector<int> bodies_of_nodes(const mesh::Mesh& mesh, const std::vector<material::Material>& materials) {
  std::vector<double> body(mesh.x.size(), -1.0);
  // Bodies that freeze first: at a node that they share with a mould they decide.
  for (const bool melts : {true, false})
    for (int b = 0; b < static_cast<int>(mesh.bodies.size()); ++b) {
      if ((materials[as_size(b)].solidification() != nullptr) != melts) continue;
      for (const mesh::ElementBlock& block : mesh.blocks) {
        if (block.body != b) continue;
        for (const Index node : block.nodes) {
          double& of_node = body[as_size(node)];
          if (of_node < 0) of_node = b;
        }
      }
    }
  parallel::GhostExchange(mesh).update(body, 1);
  return {body.begin(), body.end()};
}

}  // namespace

StrainCriteria::StrainCriteria(const mesh::Mesh& mesh, const mesh::Mesh& whole, AnalysisKind kind,
                               const std::vector<material::Material>& materials,
                               std::vector<double> temperature)
    : mesh_(mesh),
      whole_(whole),
      components_(as_size(displacement_components(kind))),
      temperature_(std::move(temperature)),
      body_of_node_(bodies_of_nodes(whole, materials)),
      ghosts_(mesh),
      rigid_(mesh, kind) {
  std::size_t first = 0;
  // The nodes of bodies that freeze, each once, and where the points of each block begin in the history.
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const mesh::ElementBlock& block = mesh.blocks[b];
    const material::Material& material = materials[as_size(block.body)];
    blocks_.push_back(
        {ElementStrain(mesh, block, kind), &block, &material.casting, material.solidification(), {}, first});
    std::vector<Index>& nodes = blocks_.back().nodes;
    if (material.solidification() != nullptr) nodes = block.nodes;
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    first += as_size(whole.blocks[b].size());
  }
}

std::span<const double> StrainCriteria::temperature(const CriterionInput& moment) const {
  return temperature_.empty() ? moment.heat.temperature : temperature_;
}

/// f_S of a material at a node; without a heat content, which alone tells it at an isothermal change, melt.
double StrainCriteria::solid_fraction(const material::PhaseChange& freezing, const CriterionInput& moment,
                                      std::size_t node) const {
  const double t = temperature(moment)[node];
  return freezing.fraction.value(t, moment.plateau_at(node));
}

CriterionRecord StrainCriteria::initial(const CriterionInput& /*start*/) const {
  CriterionRecord record{
      "strain",
      {make_column(whole_, "at_coherency", mesh::FieldPlace::cell, k_tensor),
       make_column(whole_, "brittle", mesh::FieldPlace::cell, k_tensor),
       make_column(mesh_, "displacement_at_coherency", mesh::FieldPlace::node, static_cast<int>(components_)),
       make_column(mesh_, "coherent_for", mesh::FieldPlace::node),
       make_column(mesh_, "moved_until_coherent", mesh::FieldPlace::node)},
      {}};
  if (&whole_ != &mesh_) record.columns.push_back(make_column(whole_, "followed", mesh::FieldPlace::cell));
  return record;
}

/// Elements that were activated since the last step: their strain counts from their shape at this moment, and
/// so does the displacement of nodes that have no other element. Where no body grows there are none.
/// @param displacement  at the start of the step
void StrainCriteria::begin_elements(std::span<const double> displacement, CriterionRecord& record) const {
  if (&whole_ == &mesh_) return;
  std::vector<double>&followed = record.columns[k_followed].values,
  &at_coherency = record.columns[k_at_coherency].values, &start = record.columns[k_displacement].values;
  std::vector<char> known(mesh_.x.size(), 0);
  for (const OfBlock& block : blocks_)
    for (Index e = 0; e < block.block->size(); ++e)
      if (followed[block.first + as_size(e)] > 0)
        for (const Index node : block.nodes_of(e)) known[as_size(node)] = 1;
  // New nodes get the displacement, new elements the strain of this moment.
  for (const OfBlock& block : blocks_)
    for (Index batch = 0; batch < block.strain.n_batches(); ++batch) {
      const std::size_t first = block.first + as_size(batch) * k_lanes;
      const int count = std::min<int>(k_lanes, block.strain.n_elements() - batch * k_lanes);
      if (followed[first] > 0) continue;  // a block is activated as a whole
      store_tensors(block.strain.strain(displacement, batch), k_tensor, first, count, at_coherency);
      for (int lane = 0; lane < count; ++lane) {
        followed[first + as_size(lane)] = 1;
        for (const Index node : block.nodes_of(batch * k_lanes + lane))
          if (known[as_size(node)] == 0)
            for (std::size_t i = 0; i < components_; ++i)
              start[as_size(node) * components_ + i] = displacement[as_size(node) * components_ + i];
      }
    }
  ghosts_.update(start, static_cast<int>(components_));
}

void StrainCriteria::step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) {
  std::vector<double>&at_coherency = record.columns[k_at_coherency].values,
  &brittle = record.columns[k_brittle].values;
  std::vector<double> before(mesh_.x.size()), after(mesh_.x.size());  // f_S of the block's material
  // The share of the step in which a node has an element that is melt; zero: none begins the step as melt.
  std::vector<double> soft(mesh_.x.size(), 0);
  // Mean values of quadratic basis functions are negative at some nodes.
  const auto mean = [](const OfBlock& block, const std::vector<double>& fraction, Index batch) {
    return max(min(block.strain.mean(fraction, batch), Lane(1.0)), Lane(0.0));
  };
  const std::vector<double>&old_u = old.mechanics.displacement, &u = next.mechanics.displacement;
  begin_elements(old_u, record);
  // In each element: the strain at coherency is renewed as long as it is melt; the increment counts for the
  // brittle range by the share of the step within it.
  for (const OfBlock& block : blocks_) {
    if (block.freezing == nullptr) continue;
    // Fractions are those of the block's own material, also at nodes that other bodies share.
    for (const Index n : block.nodes) {
      const auto node = as_size(n);
      before[node] = solid_fraction(*block.freezing, old, node);
      after[node] = solid_fraction(*block.freezing, next, node);
    }
    const auto [low, high] = block.casting->brittle_range;
    for (Index batch = 0; batch < block.strain.n_batches(); ++batch) {
      const Lane from = mean(block, before, batch), to = mean(block, after, batch);
      const Sym<Lane> strain = block.strain.strain(u, batch);
      const Sym<Lane> increment = dev(strain - block.strain.strain(old_u, batch));
      const Lane share = share_within(from, to, low, high);
      const double coherent = block.casting->coherency_fraction;
      const LaneMask melt = from < Lane(coherent);
      const std::size_t first = block.first + as_size(batch) * k_lanes;
      const int count = std::min<int>(k_lanes, block.strain.n_elements() - batch * k_lanes);
      // While an element is melt its nodes move with the melt: the share of the step for which that
      // holds.
      for (int lane = 0; lane < count; ++lane) {
        if (from[lane] >= coherent) continue;
        const double until = to[lane] > coherent ? (coherent - from[lane]) / (to[lane] - from[lane]) : 1.0;
        for (const Index node : block.nodes_of(batch * k_lanes + lane)) {
          double& of_node = soft[as_size(node)];
          of_node = std::max(of_node, until);
        }
      }
      Sym<Lane> reference = load_tensors(at_coherency, k_tensor, first, count),
                sum = load_tensors(brittle, k_tensor, first, count);
      // Melt carries no strain: the reference follows, and the sum of the brittle range starts
      // again.
      for (std::size_t i = 0; i < k_tensor; ++i) {
        reference.c[i] = select(melt, strain.c[i], reference.c[i]);
        sum.c[i] = select(melt, Lane(0.0), sum.c[i] + share * increment.c[i]);
      }
      store_tensors(reference, k_tensor, first, count, at_coherency);
      store_tensors(sum, k_tensor, first, count, brittle);
    }
  }
  follow_displacement(old, next, soft, record);
}

/// Metal that becomes coherent within a step goes with the melt until its end: melt that feeds or is pressed
/// out moves far in a step, and stops. What it does after that moment is the motion of the next step, of
/// metal, which is carried back to it. It is not carried further than the node went in the step of that
/// moment: metal that lay on its wall until the end of a long step, and is released in a short one that
/// follows, has not moved since it is coherent.
/// @param soft  the share of the step in which a node has an element that is melt, [local node]
void StrainCriteria::follow_displacement(const CriterionInput& old, const CriterionInput& next,
                                         const std::vector<double>& soft, CriterionRecord& record) const {
  std::vector<double>&displacement = record.columns[k_displacement].values,
  &coherent_for = record.columns[k_coherent_for].values, &moved = record.columns[k_moved].values;
  const std::vector<double>&old_u = old.mechanics.displacement, &u = next.mechanics.displacement;
  const double dt = next.time - old.time;
  for (std::size_t node = 0; node < mesh_.x.size(); ++node) {
    if (soft[node] == 0 && coherent_for[node] == 0) continue;
    double way = 0;
    for (std::size_t i = node * components_; i < (node + 1) * components_; ++i)
      way = std::hypot(way, u[i] - old_u[i]);
    const double rate = coherent_for[node] / dt, back = way * rate > moved[node] ? moved[node] / way : rate;
    for (std::size_t i = node * components_; i < (node + 1) * components_; ++i)
      displacement[i] = soft[node] > 0 ? u[i] : displacement[i] - back * (u[i] - old_u[i]);
    coherent_for[node] = soft[node] > 0 ? (1 - soft[node]) * dt : 0.0;
    moved[node] = soft[node] > 0 ? way : 0.0;
  }
  ghosts_.update(displacement, static_cast<int>(components_));
  ghosts_.update(coherent_for, 1);
  ghosts_.update(moved, 1);
}

std::span<const quantities::Quantity* const> StrainCriteria::fields() const {
  return fields::k_of_strain;
}

void StrainCriteria::fill(const CriterionInput& now, const CriterionRecord& record,
                          std::span<const std::span<double>> values) const {
  const std::vector<double>& u = now.mechanics.displacement;
  // Of each element, in lanes: the strain in the liquid, that since coherency, and the largest principal
  // strain of the brittle range.
  for (const OfBlock& block : blocks_)
    for (Index batch = 0; batch < block.strain.n_batches(); ++batch) {
      const std::size_t first = block.first + as_size(batch) * k_lanes;
      const int count = std::min<int>(k_lanes, block.strain.n_elements() - batch * k_lanes);
      const Sym<Lane> reference = load_tensors(record.columns[k_at_coherency].values, k_tensor, first, count);
      const Lane in_liquid = equivalent(reference),
                 since = equivalent(block.strain.strain(u, batch) - reference);
      for (int lane = 0; lane < count; ++lane) {
        const std::size_t element = first + as_size(lane);
        values[0][element] = in_liquid[lane];
        values[1][element] = since[lane];
        values[2][element] =
            largest_principal(tensor_at(record.columns[k_brittle].values.data() + element * k_tensor));
      }
    }

  // Distortion is the displacement since coherency without the rigid motion of its body, which is fitted.
  const std::vector<double>& start = record.columns[k_displacement].values;
  const std::span<double> distortion = values[3];
  for (std::size_t i = 0; i < u.size(); ++i) distortion[i] = u[i] - start[i];
  const std::vector<SmallMotion> motions = rigid_.fit(distortion);
  for (std::size_t node = 0; node < mesh_.x.size(); ++node) {
    const mesh::Point rigid = motions[as_size(body_of_node_[node])].at(mesh_.x[node]);
    for (std::size_t i = 0; i < components_; ++i) distortion[node * components_ + i] -= rigid[i];
  }
}

std::vector<CriterionResult> StrainCriteria::findings(const CriterionRecord& record) const {
  double mine = 0;
  CriterionResult finding{largest_of(fields::k_brittle_strain), "1", 0, true, {}};
  // The largest strain of the own elements and the centre of its element; then of all processes.
  for (const OfBlock& of_block : blocks_)
    for (Index e = 0; e < of_block.block->n_counted; ++e) {
      const mesh::ElementBlock& block = *of_block.block;
      const std::size_t element = of_block.first + as_size(e);
      const double value =
          largest_principal(tensor_at(record.columns[k_brittle].values.data() + element * k_tensor));
      if (value <= mine) continue;
      mine = value;
      finding.where = {};
      const int n = mesh::node_count(block.shape);
      for (int a = 0; a < n; ++a)
        for (std::size_t i = 0; i < 3; ++i) finding.where[i] += mesh_.x[as_size(block.element(e)[a])][i] / n;
    }
  const processes::Largest most = processes::find_largest(mine);
  processes::broadcast(finding.where, most.rank);
  finding.value = most.value;
  finding.somewhere = most.value > 0;
  return {finding};
}

std::size_t StrainCriteria::bytes() const {
  std::size_t total = body_of_node_.capacity() * sizeof(int);
  for (const OfBlock& block : blocks_) total += block.strain.bytes() + block.nodes.capacity() * sizeof(Index);
  return total;
}

}  // namespace solidus::criteria
