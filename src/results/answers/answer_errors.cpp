/// Each kind of answer has its own estimate, from the resolution of the freezing and the errors of the
/// steps.
#include "results/answers/answer_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/quantities.hpp"
#include "criteria/quantities.hpp"
#include "criteria/resolution.hpp"
#include "heat/storage/nodal_enthalpy.hpp"
#include "mechanics/quantities.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "results/fields/spots.hpp"

namespace solidus::results {

namespace {

/// Of a quantity that integrates the flow of heat, in units of η². Meshes of solids have few elements across
/// a wall, so that η² is large there and says less.
double of_flow(const mesh::Mesh& mesh) {
  return mesh.dimension == 3 ? 0.15 : 0.65;
}
/// Of the step in which the last melt of a body froze.
constexpr double k_within = 0.5;
/// Of the difference of an extreme to what is around it.
constexpr double k_around_gap = 0.2, k_around_distortion = 0.5, k_around_stress = 1, k_around_niyama = 0.5;
/// Of the volume that freezing takes away, in units of η.
constexpr double k_pores = 0.01;
/// Of that volume and the share of the time in which the last of it freezes.
constexpr double k_last_pores = 0.5;

constexpr std::array k_kept = {mechanics::fields::k_displacement.name, contact::fields::k_gap.name,
                               mechanics::fields::k_von_mises.name};

/// η² of each body and the largest of the others added up.
std::vector<double> with_others(const std::vector<double>& own) {
  std::vector<double> flow;
  for (std::size_t b = 0; b < own.size(); ++b) {
    double others = 0;
    for (std::size_t o = 0; o < own.size(); ++o)
      if (o != b) others = std::max(others, own[o]);
    flow.push_back(own[b] + others);
  }
  return flow;
}

class ErrorFinder {
 public:
  ErrorFinder(const mesh::Mesh& mesh, const coupling::Phases& phases, const FieldSet& fields,
              const LastStep& last, const criteria::Resolution::Told& told)
      : mesh_(mesh),
        phases_(phases),
        fields_(fields),
        last_(last),
        k_flow_(of_flow(mesh)),
        flow_(with_others(told.flow_error)),
        within_(told.frozen_within) {}

  void find(Answers& answers, const std::vector<criteria::CriterionResult>& criteria);

 private:
  /// The error of the time at which a body froze; what castings share follows from it.
  void of_freezing(CastAnswer& body);
  void of_gap(GapAnswer& answer) const;
  void of_distortion(ValueAt& answer) const;
  void of_stress(ValueAt& answer) const;
  void of_niyama(ValueAt& answer) const {
    const std::optional<Spot> spot = node_spot(mesh_, answer.where, cast_nodes_);
    answer.error = of_state(answer.value, 0, k_around_niyama * at(spot, criteria::fields::k_niyama.name)[1]);
  }
  ErrorBand of_pores(double flow) const {
    return {.step = k_last_pores * shrinkage_ * late_, .mesh = k_pores * shrinkage_ * std::sqrt(flow)};
  }
  std::optional<ErrorBand> of_criterion(const criteria::CriterionResult& found) const;

  /// @param change  of the value in the last step
  /// @param around  the share that counts of its difference to what is around it
  ErrorBand of_state(double value, double change, double around) const {
    return {.step = change + late_ * std::abs(value),
            .mesh = k_flow_ * worst_flow_ * std::abs(value) + around};
  }
  /// What the process that owns a spot knows of a scalar field there: {change, around}, on all. Collective.
  std::array<double, 2> at(const std::optional<Spot>& spot, std::string_view field) const;
  /// The change of a displacement in the last step at a spot, less its mean over the castings. Collective.
  double change_of_shape(const std::optional<Spot>& spot) const;

  const mesh::Mesh& mesh_;
  const coupling::Phases& phases_;
  const FieldSet& fields_;
  const LastStep& last_;
  double k_flow_;                   ///< of_flow()
  std::vector<double> flow_;        ///< [body]
  std::span<const double> within_;  ///< [local node] [s]
  std::vector<char> cast_nodes_;    ///< [local node]
  double worst_flow_ = 0;           ///< of the castings
  double late_ = 0;                 ///< the largest error by the step of a time to freeze, as a share of it
  double shrinkage_ = 0;            ///< |ΔV/V| of freezing
};

void ErrorFinder::of_freezing(CastAnswer& body) {
  const auto b = as_size(body.cast.body);
  worst_flow_ = std::max(worst_flow_, flow_[b]);
  if (const material::PhaseChange* change = phases_.heat->storage().material(body.cast.body).solidification())
    shrinkage_ = std::max(shrinkage_, std::abs(change->volume_change));
  if (!body.froze) return;
  std::vector<char> own(mesh_.bodies.size(), 0);
  own[b] = 1;
  const std::optional<Spot> spot = node_spot(mesh_, body.froze->where, nodes_of(mesh_, own));
  const double step = k_within * parallel::global_max(spot ? within_[spot->at] : 0.0);
  body.froze->error = ErrorBand{.step = step, .mesh = k_flow_ * flow_[b] * body.froze->value};
  late_ = std::max(late_, step / body.froze->value);
}

std::array<double, 2> ErrorFinder::at(const std::optional<Spot>& spot, std::string_view field) const {
  const FieldValues now(fields_, field);
  const std::span<const double> before = last_.before(field);
  std::array<double, 2> found{};
  if (spot && !now.empty()) {
    if (!before.empty()) found[0] = std::abs(now[spot->at] - before[spot->at]);
    found[1] = difference_to_around(*spot, [&](std::size_t i) { return now[i]; });
  }
  for (double& number : found) number = parallel::global_max(number);
  return found;
}

void ErrorFinder::of_gap(GapAnswer& answer) const {
  std::vector<char> slave(mesh_.x.size(), 0);
  for (const contact::ContactPair* pair : phases_.contacts) {
    if (pair->parts().spec.name != answer.contact) continue;
    const auto surface = mesh_.surfaces.find(pair->parts().spec.slave);
    if (surface == mesh_.surfaces.end()) continue;
    for (const Index node : surface->second.nodes) slave[as_size(node)] = 1;
  }
  const auto [change, around] = at(node_spot(mesh_, answer.gap.where, slave), contact::fields::k_gap.name);
  answer.gap.error = of_state(answer.gap.value, change, k_around_gap * around);
}

double ErrorFinder::change_of_shape(const std::optional<Spot>& spot) const {
  const FieldValues now(fields_, mechanics::fields::k_displacement.name);
  const std::span<const double> before = last_.before(mechanics::fields::k_displacement.name);
  // Without a step before there is no change to measure.
  if (before.empty()) return 0;
  // All nodes of castings count alike, over all processes.
  const auto n_owned = as_size(mesh_.n_owned_nodes);
  double square = 0, n = 0;
  for (std::size_t i = 0; i < n_owned; ++i) n += cast_nodes_[i];
  n = parallel::global_sum(n);
  // The change without its mean over the castings, which is rigid; at a spot, or all over.
  for (std::size_t k = 0; k < now.components(); ++k) {
    const auto change = [&](std::size_t i) {
      return now[i * now.components() + k] - before[i * now.components() + k];
    };
    double sum = 0;
    for (std::size_t i = 0; i < n_owned; ++i)
      if (cast_nodes_[i] != 0) sum += change(i);
    const double mean = parallel::global_sum(sum) / n;
    if (spot) square += (change(spot->at) - mean) * (change(spot->at) - mean);
  }
  return parallel::global_max(std::sqrt(square));
}

void ErrorFinder::of_distortion(ValueAt& answer) const {
  const FieldValues distortion(fields_, criteria::fields::k_distortion.name);
  const std::optional<Spot> spot = node_spot(mesh_, answer.where, cast_nodes_);
  const double around = parallel::global_max(
      spot ? difference_to_around(*spot, [&](std::size_t i) { return distortion.length(i); }) : 0.0);
  answer.error = of_state(answer.value, change_of_shape(spot), k_around_distortion * around);
}

void ErrorFinder::of_stress(ValueAt& answer) const {
  const auto [change, around] = at(element_spot(mesh_, answer.where), mechanics::fields::k_von_mises.name);
  answer.error = of_state(answer.value, change, k_around_stress * around);
}

std::optional<ErrorBand> ErrorFinder::of_criterion(const criteria::CriterionResult& found) const {
  const bool is_time = found.name == criteria::largest_of(criteria::fields::k_local_solidification_time),
             is_niyama = found.name == criteria::least_of(criteria::fields::k_niyama);
  if (!is_time && !is_niyama) return {};
  const std::optional<Spot> spot = node_spot(mesh_, found.where, cast_nodes_);
  if (is_niyama)
    return of_state(found.value, 0, k_around_niyama * at(spot, criteria::fields::k_niyama.name)[1]);
  return ErrorBand{.step = k_within * parallel::global_max(spot ? within_[spot->at] : 0.0),
                   .mesh = k_flow_ * worst_flow_ * found.value};
}

void ErrorFinder::find(Answers& answers, const std::vector<criteria::CriterionResult>& criteria) {
  // Freezing comes first: the worst error of flow among the castings, which others use, is found with it.
  std::vector<char> cast(mesh_.bodies.size(), 0);
  for (CastAnswer& body : answers.castings) {
    cast[as_size(body.cast.body)] = 1;
    of_freezing(body);
  }
  cast_nodes_ = nodes_of(mesh_, cast);
  // Each kind of answer by its own estimate; those that follow from freezing use what was found
  // above.
  for (std::vector<GapAnswer>* gaps : {&answers.gaps, &answers.overlaps})
    for (GapAnswer& gap : *gaps) of_gap(gap);
  for (CastAnswer& body : answers.castings) {
    if (body.pores) body.pores->error = of_pores(flow_[as_size(body.cast.body)]);
    if (body.least_niyama) of_niyama(*body.least_niyama);
  }
  if (answers.distortion) of_distortion(*answers.distortion);
  if (answers.stress) of_stress(*answers.stress);
  if (answers.pores) answers.pores->error = of_pores(worst_flow_);
  for (const criteria::CriterionResult& found : criteria)
    if (found.somewhere)
      if (const std::optional<ErrorBand> error = of_criterion(found))
        answers.criteria_errors.emplace_back(found.name, *error);
}

}  // namespace

void LastStep::step(const FieldSet& bodies) {
  if (kept_.empty())
    for (const std::string_view name : k_kept)
      if (bodies.find(name) != nullptr) kept_.push_back({std::string(name), {}, {}});
  for (Kept& kept : kept_) {
    std::swap(kept.before, kept.now);
    const FieldValues values(bodies, kept.field);
    kept.now.assign(values.all().begin(), values.all().end());
  }
}

std::span<const double> LastStep::before(std::string_view field) const {
  const auto kept = std::ranges::find(kept_, field, &Kept::field);
  return kept == kept_.end() ? std::span<const double>() : std::span<const double>(kept->before);
}

void add_errors(const mesh::Mesh& mesh, const coupling::Phases& phases, const coupling::State& state,
                const FieldSet& fields, const LastStep& last, Answers& answers,
                const std::vector<criteria::CriterionResult>& criteria) {
  if (answers.castings.empty()) return;
  const std::optional<criteria::Resolution::Told> told = criteria::Resolution::told(state.criteria);
  if (told) ErrorFinder(mesh, phases, fields, last, *told).find(answers, criteria);
}

}  // namespace solidus::results
