/// Everything that a kernel is given is counted from the birth of its elements, and what it returns goes on
/// as it is: forces and tangents know no reference.
#include "mechanics/elements/growing_block.hpp"

#include <algorithm>
#include <utility>

#include "mechanics/elements/padding.hpp"

namespace solidus::mechanics {

GrowingBlock::GrowingBlock(mesh::Shape shape, int components, std::unique_ptr<BlockKernel> kernel,
                           std::shared_ptr<SinceBirth> fields)
    : n_nodes_(as_size(mesh::node_count(shape))),
      components_(as_size(components)),
      kernel_(std::move(kernel)),
      fields_(std::move(fields)) {}

/// Called when the elements are activated: the list of their nodes, and where each element finds its own in
/// it.
void GrowingBlock::come(const mesh::ElementBlock& block) {
  there_ = true;
  nodes_ = block.nodes;
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  place_.clear();
  for (const Index node : block.nodes)
    place_.push_back(as_size(std::lower_bound(nodes_.begin(), nodes_.end(), node) - nodes_.begin()));
  birth_.assign(nodes_.size() * numbers(), 0.0);
  old_.assign(nodes_.size() * components_, 0.0);
}

/// How many lanes of the history the kernel has at a point, and how many follow for the numbers of
/// activation.
const GrowingBlock::Layout& GrowingBlock::layout() const {
  if (layout_.points > 0) return layout_;
  const BlockHistory history = kernel_->initial_history();
  const std::size_t n = n_nodes_ * numbers();
  layout_.points = as_size(history.n_points);
  layout_.kernel = as_size(history.n_components);
  layout_.birth = (n + layout_.points - 1) / layout_.points;
  return layout_;
}

/// Copies the part of a history that the kernel knows.
void GrowingBlock::strip(const BlockHistory& from, BlockHistory& to) const {
  const Layout& l = layout();
  const std::size_t n = from.values.size() / l.all();  // points of all batches
  to.n_components = static_cast<int>(l.kernel);
  to.n_points = from.n_points;
  to.values.resize(n * l.kernel);
  for (std::size_t i = 0; i < n; ++i)
    std::copy_n(from.values.data() + i * l.all(), l.kernel, to.values.data() + i * l.kernel);
}

/// The reverse of strip(): the kernel's part goes back between the numbers of activation.
void GrowingBlock::spread(const BlockHistory& from, BlockHistory& to) const {
  const Layout& l = layout();
  const std::size_t n = from.values.size() / l.kernel;
  to.n_components = static_cast<int>(l.all());
  to.n_points = from.n_points;
  to.values.resize(n * l.all(), Lane(0.0));
  for (std::size_t i = 0; i < n; ++i)
    std::copy_n(from.values.data() + i * l.kernel, l.kernel, to.values.data() + i * l.all());
}

void GrowingBlock::read_birth(const BlockHistory& history) {
  const Layout& l = layout();
  // The numbers of an element's nodes, one after the other, fill the lanes behind the kernel's at its points.
  for (std::size_t e = 0; e < place_.size() / n_nodes_; ++e)
    for (std::size_t a = 0; a < n_nodes_; ++a)
      for (std::size_t k = 0; k < numbers(); ++k) {
        const std::size_t i = a * numbers() + k, point = e / k_lanes * l.points + i / l.birth;
        birth_[place_[e * n_nodes_ + a] * numbers() + k] =
            history.values[point * l.all() + l.kernel + i % l.birth][static_cast<int>(e % k_lanes)];
      }
}

void GrowingBlock::write_birth(std::span<const double> birth, BlockHistory& history) const {
  const Layout& l = layout();
  const std::size_t n = place_.size() / n_nodes_;
  for (std::size_t e = 0; e < n; ++e)
    for (std::size_t a = 0; a < n_nodes_; ++a)
      for (std::size_t k = 0; k < numbers(); ++k) {
        const std::size_t i = a * numbers() + k, point = e / k_lanes * l.points + i / l.birth;
        history.values[point * l.all() + l.kernel + i % l.birth].set(
            static_cast<int>(e % k_lanes), birth[place_[e * n_nodes_ + a] * numbers() + k]);
      }
  // Padding repeats the last element, as everywhere in a history.
  if (n == 0) return;
  const std::size_t last = (n - 1) / k_lanes;
  for (std::size_t q = 0; q < l.points; ++q)
    for (std::size_t k = 0; k < l.birth; ++k)
      repeat_last_element(history.values[(last * l.points + q) * l.all() + l.kernel + k], as_index(last),
                          as_index(n));
}

BlockHistory GrowingBlock::initial_history() const {
  BlockHistory history;
  spread(kernel_->initial_history(), history);
  return history;
}

/// The history with which the elements begin: displacement, temperature and volumetric strain of phase
/// changes of their nodes at this moment.
BlockHistory GrowingBlock::born_at(const BirthFields& fields) const {
  std::vector<double> birth;
  for (const Index node : nodes_) {
    const auto i = as_size(node);
    for (std::size_t k = 0; k < components_; ++k) birth.push_back(fields.displacement[i * components_ + k]);
    birth.push_back(fields.temperature[i]);
    birth.push_back(fields.straining.empty() ? 0.0 : fields.straining[i]);
  }
  BlockHistory history = initial_history();
  write_birth(birth, history);
  return history;
}

/// Displacements since the activation of these elements, at their nodes alone.
std::span<const double> GrowingBlock::shift(std::span<const double> u, std::vector<double>& to) const {
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    for (std::size_t k = 0; k < components_; ++k) {
      const std::size_t i = as_size(nodes_[n]) * components_ + k;
      to[i] = u[i] - birth_[n * numbers() + k];
    }
  return to;
}

/// Blocks share the arrays of fields: each writes the values of its own nodes before its kernel reads them.
void GrowingBlock::enter() const {
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const auto i = as_size(nodes_[n]);
    for (std::size_t k = 0; k < components_; ++k)
      fields_->old[i * components_ + k] = old_[n * components_ + k];
    fields_->temperature[i] = birth_[n * numbers() + components_];
  }
}

/// The start of a step as the kernel has to see it: strain, temperature and volumetric strain counted from
/// the activation. Displacements and histories that are the same object remain the same object.
StepStart GrowingBlock::since_birth(const StepStart& start) const {
  enter();
  StepStart since = start;
  since.initial_temperature = fields_->temperature;
  since.old_displacement = fields_->old;
  const bool same = start.held_displacement.data() == start.old_displacement.data();
  since.held_displacement = same ? since.old_displacement : shift(start.held_displacement, fields_->held);
  since.old_history = &old_history_;
  since.held_history = start.held_history == start.old_history ? &old_history_ : &held_history_;
  since.start_history = start.start_history == start.old_history ? &old_history_ : &start_history_;
  if (start.phases.straining.empty()) return since;
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const auto i = as_size(nodes_[n]);
    fields_->straining[i] = start.phases.straining[i] - birth_[n * numbers() + components_ + 1];
  }
  since.phases.straining = fields_->straining;
  return since;
}

/// Takes the numbers of birth and the histories of a step, to which the kernel refers from now on.
StepStart GrowingBlock::take(const StepStart& start) {
  read_birth(*start.old_history);
  strip(*start.old_history, old_history_);
  if (start.held_history != start.old_history) strip(*start.held_history, held_history_);
  if (start.start_history != start.old_history) strip(*start.start_history, start_history_);
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    for (std::size_t k = 0; k < components_; ++k)
      old_[n * components_ + k] =
          start.old_displacement[as_size(nodes_[n]) * components_ + k] - birth_[n * numbers() + k];
  return since_birth(start);
}

void GrowingBlock::bind(const linear::BlockMatrix& matrix) {
  if (there_) kernel_->bind(matrix);  // before birth its nodes may have no unknowns
}

bool GrowingBlock::set_initial_stress(const StepStart& start, std::span<const double> stress) {
  return kernel_->set_initial_stress(start, stress);
}

double GrowingBlock::prepare(const StepStart& start) {
  return there_ ? kernel_->prepare(take(start)) : 0.0;
}

double GrowingBlock::add_forces(std::span<const double> u, std::span<double> forces) {
  if (!there_) return 0;
  enter();
  return kernel_->add_forces(shift(u, fields_->now), forces);
}

void GrowingBlock::add_tangent(std::span<const double> u, linear::BlockMatrix& matrix) {
  if (!there_) return;
  enter();
  kernel_->add_tangent(shift(u, fields_->now), matrix);
}

BlockWork GrowingBlock::finish(std::span<const double> old_u, std::span<const double> u,
                               const BlockEnd& end) {
  // Elements that are not there yet have a history of zeros and no results.
  if (!there_) {
    std::ranges::fill(end.history.values, Lane(0.0));
    if (end.elements != nullptr) end.elements->reset();
    if (end.deformation != nullptr) end.deformation->reset();
    return {};
  }
  enter();
  strip(end.history, trial_);
  const BlockEnd of_kernel{.history = trial_,
                           .stress = end.stress,
                           .at_work = end.at_work,
                           .elements = end.elements,
                           .deformation = end.deformation};
  const BlockWork work = kernel_->finish(shift(old_u, fields_->held), shift(u, fields_->now), of_kernel);
  spread(trial_, end.history);
  write_birth(birth_, end.history);
  return work;
}

FlowChange GrowingBlock::restart_flow(const StepStart& start, std::span<const double> old_u,
                                      std::span<const double> u, const BlockEnd& end) {
  if (!there_) return {};
  strip(end.history, trial_);
  const BlockEnd of_kernel{.history = trial_, .elements = end.elements, .deformation = end.deformation};
  // The histories are those of the last prepare(), with the same arguments.
  StepStart since = since_birth(start);
  const FlowChange change =
      kernel_->restart_flow(since, shift(old_u, fields_->held), shift(u, fields_->now), of_kernel);
  spread(trial_, end.history);
  return change;
}

std::shared_ptr<const StructuralPoints> GrowingBlock::held_deformation(const StepStart& start) {
  if (!there_) return {};
  return kernel_->held_deformation(take(start));
}

LawFailure GrowingBlock::failure(std::span<const double> u) const {
  if (!there_) return {};
  enter();
  return kernel_->failure(shift(u, fields_->now));
}

FlowingVolume GrowingBlock::flowing(std::span<const double> u) const {
  if (!there_) return {};
  enter();
  return kernel_->flowing(shift(u, fields_->now));
}

void GrowingBlock::add_nodal_volume(double weight, std::span<double> out) const {
  if (there_) kernel_->add_nodal_volume(weight, out);
}

void GrowingBlock::spread_heat_as_stored(const PackVector<Lane>& weights) {
  if (weights.empty()) return;  // it was told when it had elements
  kernel_->spread_heat_as_stored(weights);
  layout_ = {};  // the kernel keeps more at its points from now on
}

std::size_t GrowingBlock::bytes() const {
  std::size_t total = kernel_->bytes() + (birth_.capacity() + old_.capacity()) * sizeof(double) +
                      nodes_.capacity() * sizeof(Index) + place_.capacity() * sizeof(std::size_t);
  for (const BlockHistory* history : {&old_history_, &held_history_, &start_history_, &trial_})
    total += history->values.capacity() * sizeof(Lane);
  return total;
}

}  // namespace solidus::mechanics
