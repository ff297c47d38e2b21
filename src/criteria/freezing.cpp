#include "criteria/freezing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "criteria/freezing_history.hpp"
#include "criteria/longest_sides.hpp"
#include "criteria/quantities.hpp"
#include "material/elasticity.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::criteria {

using namespace freezing_history;

namespace {

/// Slots of times, and those of them at which the solid fraction passes a level.
constexpr std::array k_times = {k_liquidus_at, k_evaluated_at,  k_solidified_at,
                                k_healed_at,   k_vulnerable_at, k_safe_at};
constexpr std::array<std::pair<Slot, double>, 3> k_fractions = {
    {{k_healed_at, k_healed_from}, {k_vulnerable_at, k_vulnerable_from}, {k_safe_at, k_vulnerable_to}}};

constexpr double k_mushy = 1, k_sharp = 2, k_waiting = 3;  // in k_mode; zero: not evaluated

// Times of one front are equal but for rounding.
constexpr double k_same_time = 1e-9;

double length(const mesh::Point& v) {
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

std::vector<char> freezing_bodies(const mesh::Mesh& mesh, const heat::NodalEnthalpy& storage,
                                  const std::vector<char>& wanted) {
  std::vector<char> chosen;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b)
    chosen.push_back(storage.can_melt(static_cast<int>(b)) && (wanted.empty() || wanted[b] != 0) ? 1 : 0);
  return chosen;
}

/// α L/ΔT_f of each body that expands and freezes over a range, zero of the others [m/K²]. A body of the
/// length L that cools with Ṫ while its ends are held strains a mush of the thickness ΔT_f/G with the rate α
/// Ṫ L G/ΔT_f, if all of its contraction goes there.
/// @param longest  L of each body [m]
std::vector<double> held_mush(const heat::NodalEnthalpy& storage, std::span<const double> longest) {
  std::vector<double> held(longest.size(), 0.0);
  for (std::size_t b = 0; b < longest.size(); ++b) {
    const material::Material& material = storage.material(static_cast<int>(b));
    const FreezingLevels levels = FreezingLevels::of(material);
    if (!material.mechanical() || !levels.freezes || levels.liquidus <= levels.solidus) continue;
    constexpr double k_directions = 3;  // of a volume
    const double expansion = material::expansion_slope<double>(material, levels.solidus) / k_directions;
    held[b] = expansion * longest[b] / (levels.liquidus - levels.solidus);
  }
  return held;
}

/// The history of a node that has not begun to freeze.
void forget(double* history) {
  std::fill(history, history + k_width, 0.0);
  for (const Slot time : k_times) history[time] = k_never;
}

}  // namespace

struct Freezing::Step {
  const CriterionInput& old;
  const CriterionInput& next;
  const heat::NodalEnthalpy& storage;
  double dt() const { return next.time - old.time; }
  double time(double at) const { return old.time + at * dt(); }
  double temperature(std::size_t node, double at) const {
    return (1 - at) * old.heat.temperature[node] + at * next.heat.temperature[node];
  }
};

struct Freezing::PatchGradient {
  double all = 0, behind = 0;                      ///< of the mean vectors [K/m]
  double all_magnitude = 0, behind_magnitude = 0;  ///< means of the magnitudes [K/m]
  double drop = 0;          ///< the largest temperature difference across an element behind the front [K]
  double since = HUGE_VAL;  ///< when the front passed the first of their nodes [s]
  bool has_behind = false;
};

Freezing::Freezing(const mesh::Mesh& mesh, AnalysisKind kind, const heat::NodalEnthalpy& storage,
                   FreezingOptions options)
    : mesh_(mesh),
      storage_(storage),
      patches_(mesh, kind, freezing_bodies(mesh, storage, options.bodies)),
      ghosts_(mesh) {
  const std::vector<double> longest = longest_sides(mesh);
  held_ = held_mush(storage, longest);
  // The levels of temperature of each material: between solidus and liquidus lies the one at which the
  // gradient is evaluated; a material that evaluates at its solidus does so at the end of freezing.
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    const material::Material& material = storage.material(static_cast<int>(b));
    feeding_.push_back(FeedingLaw::of(material));
    tearing_.push_back(TearingLaw::of(material, longest[b]));
    kou_.push_back(material.solidification() != nullptr
                       ? kou_index(material.solidification()->fraction.points())
                       : k_never);
    Levels& levels = levels_.emplace_back(Levels{FreezingLevels::of(material)});
    levels.evaluation = levels.solidus + options.evaluation * (levels.liquidus - levels.solidus);
    levels.at_end = levels.evaluation <= levels.solidus;
  }
  const std::vector<char> chosen = freezing_bodies(mesh, storage, options.bodies);
  for (Index i = 0; i < mesh.n_owned_nodes; ++i)
    if (const int body = body_of(i, chosen); body >= 0) nodes_.push_back({i, body});
  nodes_.shrink_to_fit();
}

int Freezing::body_of(Index node, const std::vector<char>& chosen) const {
  int body = -1;
  double most = 0;
  for (std::size_t b = 0; b < chosen.size(); ++b) {
    const double volume = chosen[b] != 0 ? storage_.volume(node, static_cast<int>(b)) : 0.0;
    if (volume <= most) continue;
    most = volume;
    body = static_cast<int>(b);
  }
  return body;
}

CriterionRecord Freezing::initial(const CriterionInput& start) const {
  CriterionRecord record{
      k_name, {make_column(mesh_, "history", mesh::FieldPlace::node, k_width, 0)}, {{"frozen", k_row, {}}}};
  // All times begin as "never", which is a negative number.
  std::vector<double>& history = record.columns[0].values;
  for (std::size_t i = 0; i < mesh_.x.size(); ++i)
    for (const Slot time : k_times) history[i * k_width + time] = k_never;
  // Nodes that start between liquidus and solidus freeze from the start on.
  for (const FreezingNode& who : nodes_) {
    const auto i = as_size(who.node);
    if (start.solid_fraction[i] > 0 && start.solid_fraction[i] < 1)
      history[i * k_width + k_liquidus_at] = start.time;
  }
  // Neighbours read each other's times: ghosts need them too.
  ghosts_.update(history, k_width);
  return record;
}

void Freezing::follow(const FreezingNode& who, const Step& step, std::span<double> history,
                      std::vector<Passage>& passages) const {
  // Nodes that stay outside the freezing range in this step are done at once.
  const auto i = as_size(who.node);
  const Levels& levels = levels_[as_size(who.body)];
  const double from = step.old.heat.temperature[i], to = step.next.heat.temperature[i];
  if (std::min(from, to) > levels.liquidus || std::max(from, to) < levels.solidus) return;
  // The history of the node is brought up to date in the order of events: melting again, the fractions that
  // are passed, begin and end of freezing, and the temperature at which gradient and rate are read.
  const double before = step.old.solid_fraction[i], after = step.next.solid_fraction[i];
  double* const h = history.data() + i * k_width;

  // Metal that was solid may be mixed with melt between two steps, where a body grows.
  if (before < 1 && h[k_solidified_at] >= 0) {
    forget(h);
    if (before > 0) h[k_liquidus_at] = step.old.time;
  }
  if (after < 1 && (before == 1 || after == 0)) {  // melted, wholly or in part
    const bool keeps = after > 0 && !levels.at_end && to <= levels.evaluation && h[k_solidified_at] >= 0;
    if (keeps) {  // T_e was not passed: only the time as a solid does not count as solidification
      h[k_liquidus_at] += step.next.time - h[k_solidified_at];
    } else {
      forget(h);
      h[k_liquidus_at] = after == 0 ? k_never : step.next.time;
    }
    h[k_solidified_at] = k_never;
    if (after == 0) return;
  }
  // From here on the node freezes in this step. Times within the step are interpolated: fractions linearly,
  // begin and end by the heat content.
  if (before == 1) return;
  for (const auto& [slot, fraction] : k_fractions)
    if (before < fraction && after >= fraction) h[slot] = step.time((fraction - before) / (after - before));
  if (before < k_healed_from && after >= k_vulnerable_from) h[k_vulnerable_at] = k_never;
  if (before == 0 && after > 0)
    h[k_liquidus_at] = step.time(levels.begin(storage_, who.node, step.old, step.next));
  // The place of evaluation is the temperature T_e, or the end of freezing where the material has it there.
  std::optional<double> evaluated;
  if (after == 1) {
    const double at = levels.end(storage_, who.node, step.old, step.next);
    h[k_solidified_at] = step.time(at);
    if (levels.at_end) evaluated = at;
  }
  if (!levels.at_end && from > levels.evaluation && to <= levels.evaluation)
    evaluated = passing(from, to, levels.evaluation);
  if (!evaluated) return;
  // At that moment the node's gradient and cooling rate are kept, and its passage is noted for the speed of
  // the front.
  h[k_evaluated_at] = step.time(*evaluated);
  passages.push_back({who, *evaluated, (from - to) / step.dt()});
}

Freezing::PatchGradient Freezing::recover(const FreezingNode& who, const Step& step, double at,
                                          std::span<const double> history, bool only_behind) const {
  // The passage of the front counts as the same time within a share of the step, since it is
  // interpolated.
  const Levels& levels = levels_[as_size(who.body)];
  const double level = levels.evaluation, liquidus = levels.liquidus;
  const double now = step.time(at), tolerance = k_same_time * step.dt();
  const auto own = as_size(who.node);
  const bool at_front = std::abs(history[own * k_width + k_evaluated_at] - now) <= tolerance;
  PatchGradient result;
  mesh::Point all{}, behind{};
  double volume = 0, volume_behind = 0;
  // Gradients of all elements of the node's own body are summed, weighted by their volumes.
  for (const Patches::Element e : patches_.around(who.node)) {
    if (patches_.body(e) != who.body) continue;
    std::array<double, k_most_nodes> values{};
    const std::span<const Index> nodes = patches_.nodes(e);
    // An element is behind the front if the front has passed a node of it and no node is melt.
    bool some_passed = false, melt = false;
    double coldest = level, since = HUGE_VAL;
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const auto j = as_size(nodes[a]);
      // On an isothermal change the temperature is not linear in the step: a node at the front has T_e.
      values[a] = j == own && at_front ? level : step.temperature(j, at);
      const double evaluated = history[j * k_width + k_evaluated_at];
      some_passed = some_passed || values[a] < level || (evaluated >= 0 && evaluated < now - tolerance);
      if (evaluated >= 0) since = std::min(since, evaluated);
      melt = melt || values[a] > liquidus;
      coldest = std::min(coldest, values[a]);
    }
    const bool is_behind = some_passed && !melt;
    // The gradient of a node that still waits for its passage counts only elements behind the front.
    if (only_behind && !is_behind) continue;
    const Patches::Gradient g = patches_.gradient(e, std::span(values).first(nodes.size()));
    volume += g.volume;
    result.all_magnitude += g.volume * length(g.value);
    for (std::size_t k = 0; k < 3; ++k) all[k] += g.volume * g.value[k];
    if (!is_behind) continue;
    // Elements behind the front also give the largest drop of a node below the level, and the time since
    // which the front has passed.
    result.has_behind = true;
    result.drop = std::max(result.drop, level - coldest);
    result.since = std::min(result.since, since);
    volume_behind += g.volume;
    result.behind_magnitude += g.volume * length(g.value);
    for (std::size_t k = 0; k < 3; ++k) behind[k] += g.volume * g.value[k];
  }
  // The sums become means. The mean of the lengths is stored in addition to the length of the mean, which
  // vanishes where fronts meet.
  if (volume > 0) {
    result.all = length(all) / volume;
    result.all_magnitude /= volume;
  }
  if (volume_behind > 0) {
    result.behind = length(behind) / volume_behind;
    result.behind_magnitude /= volume_behind;
  }
  return result;
}

void Freezing::evaluate(const Passage& passage, const Step& step, std::span<double> history) const {
  double* const h = history.data() + as_size(passage.who.node) * k_width;
  const Levels& levels = levels_[as_size(passage.who.body)];
  const PatchGradient g = recover(passage.who, step, passage.at, history, false);
  // A front sharper than the patch of elements is seen from the side behind it alone.
  const bool sharp = levels.at_end || g.drop > levels.liquidus - levels.evaluation;
  if (h[k_mode] != 0)  // passed before, and warmed up since without melting: there are no sums
    for (const Slot sum : {k_sum_time, k_sum_gradient, k_sum_magnitude}) h[sum] = 0;
  // Without an element behind the front the node waits for the first one; a mushy front needs none.
  h[k_mode] = !g.has_behind ? k_waiting : (sharp ? k_sharp : k_mushy);
  // A sharp front moves through its patch over several steps: the mean over their time is taken.
  const double share = passage.at * step.dt(), time = h[k_sum_time] + share;
  if (h[k_mode] != k_sharp) {
    h[k_gradient] = g.all;
    h[k_magnitude] = g.all_magnitude;
  } else {
    h[k_gradient] = time > 0 ? (h[k_sum_gradient] + share * g.behind) / time : g.behind;
    h[k_magnitude] = time > 0 ? (h[k_sum_magnitude] + share * g.behind_magnitude) / time : g.behind_magnitude;
  }
  h[k_rate] = passage.rate;
}

// While a front passes a node, the gradient behind it swings about its mean.
void Freezing::accumulate(const FreezingNode& who, const Step& step, std::span<double> history) const {
  const PatchGradient g = recover(who, step, 1.0, history, true);
  if (!g.has_behind || g.since == HUGE_VAL) return;
  double* const h = history.data() + as_size(who.node) * k_width;
  h[k_sum_gradient] += step.dt() * g.behind;
  h[k_sum_magnitude] += step.dt() * g.behind_magnitude;
  // Backward Euler lets the heat of a whole step flow off at its end, also of that in which the front comes.
  h[k_sum_time] +=
      h[k_sum_time] > 0 ? step.dt() : step.next.time - std::clamp(g.since, step.old.time, step.next.time);
}

// The first element around a node that waited is passed.
void Freezing::complete(const FreezingNode& who, const Step& step, std::span<double> history) const {
  // The time at which the first element around the node lies behind the front with all of its
  // nodes.
  double passed_at = step.next.time + step.dt();
  for (const Patches::Element e : patches_.around(who.node)) {
    if (patches_.body(e) != who.body) continue;
    double last = 0;
    for (const Index node : patches_.nodes(e)) {
      const double at = history[as_size(node) * k_width + k_evaluated_at];
      last = at < 0 ? step.next.time + step.dt() : std::max(last, at);
    }
    passed_at = std::min(passed_at, last);
  }
  // Not in this step: it goes on waiting.
  if (passed_at > step.next.time) return;
  const Levels& levels = levels_[as_size(who.body)];
  const double at = std::clamp((passed_at - step.old.time) / step.dt(), 0.0, 1.0);
  const PatchGradient g = recover(who, step, at, history, true);
  double* const h = history.data() + as_size(who.node) * k_width;
  // The same distinction as in evaluate(), now with the gradient behind.
  const bool sharp = levels.at_end || g.drop > levels.liquidus - levels.evaluation;
  h[k_mode] = sharp ? k_sharp : k_mushy;
  if (!sharp) return;
  h[k_gradient] = g.behind;
  h[k_magnitude] = g.behind_magnitude;
}

void Freezing::step(const CriterionInput& old, const CriterionInput& next, CriterionRecord& record) {
  std::vector<double>& history = record.columns[0].values;
  const Step step{old, next, storage_};
  std::vector<Passage> passages;
  std::vector<FreezingNode> waiting, freezing;
  // First the own nodes: who passes a level in this step, who waits for a neighbour, who freezes.
  for (const FreezingNode& who : nodes_) {
    const double* const h = history.data() + as_size(who.node) * k_width;
    if (h[k_mode] == k_waiting) waiting.push_back(who);
    follow(who, step, history, passages);
    if (h[k_liquidus_at] >= 0 && h[k_evaluated_at] < 0) freezing.push_back(who);
  }
  if (!parallel::any_process(!passages.empty() || !waiting.empty() || !freezing.empty())) return;
  ghosts_.update(history, k_width);  // times of neighbours say what lies behind the front
  // Patches of elements are gathered only around the nodes that need a gradient.
  std::vector<Index> needed;
  for (const Passage& passage : passages) needed.push_back(passage.who.node);
  for (const auto* list : {&freezing, &waiting})
    for (const FreezingNode& who : *list) needed.push_back(who.node);
  patches_.gather(needed);
  // Gradients of those that pass now, sums of those that freeze, and those whose waiting is over.
  for (const Passage& passage : passages) evaluate(passage, step, history);
  for (const FreezingNode& who : freezing) accumulate(who, step, history);
  for (const FreezingNode& who : waiting)
    if (history[as_size(who.node) * k_width + k_mode] == k_waiting) complete(who, step, history);
  patches_.clear();
  ghosts_.update(history, k_width);
}

/// The speed of the front at every owned node, zero where it is not known: one over the mean of |∇t_e|, so
/// that slopes of opposite sense do not cancel where fronts meet.
std::vector<double> Freezing::front_speeds(std::span<const double> history) const {
  const auto n = as_size(mesh_.n_owned_nodes);
  // Elements whose nodes have all been passed have a gradient of the passing time; its length is
  // one over speed.
  std::vector<double> slope(n, 0.0), volume(n, 0.0);
  std::vector<int> body(n, -1);
  for (const FreezingNode& who : nodes_) body[as_size(who.node)] = who.body;
  patches_.for_elements([&](const Patches::Element& e) {
    std::array<double, k_most_nodes> times{};
    const std::span<const Index> nodes = patches_.nodes(e);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      times[a] = history[as_size(nodes[a]) * k_width + k_evaluated_at];
      if (times[a] < 0) return;
    }
    const Patches::Gradient g = patches_.gradient(e, std::span(times).first(nodes.size()));
    for (const Index node : nodes) {
      const auto i = as_size(node);
      if (node >= mesh_.n_owned_nodes || body[i] != patches_.body(e)) continue;
      slope[i] += g.volume * length(g.value);
      volume[i] += g.volume;
    }
  });
  // The mean slope by volume, turned into a speed.
  for (std::size_t i = 0; i < n; ++i) slope[i] = slope[i] > 0 ? volume[i] / slope[i] : 0.0;
  return slope;
}

std::span<const quantities::Quantity* const> Freezing::fields() const {
  static_assert(fields::k_of_freezing.size() == k_fields);
  return fields::k_of_freezing;
}

void Freezing::fill(const CriterionInput& /*now*/, const CriterionRecord& record,
                    std::span<const std::span<double>> values) const {
  for (std::size_t f = 0; f < k_fields; ++f) std::ranges::fill(values[f], nothing_known()[f]);
  const std::vector<double> speeds = front_speeds(record.columns[0].values);
  for (const FreezingNode& who : nodes_) {
    const auto of_node = values_of(who, record.columns[0].values, speeds[as_size(who.node)]);
    for (std::size_t f = 0; f < k_fields; ++f) values[f][as_size(who.node)] = of_node[f];
  }
  for (std::size_t f = 0; f < k_fields; ++f) ghosts_.update(values[f], 1);
}

std::size_t Freezing::bytes() const {
  return patches_.bytes() + nodes_.capacity() * sizeof nodes_[0];
}

}  // namespace solidus::criteria
