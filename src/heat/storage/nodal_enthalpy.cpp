/// Volumes of all bodies at each node are summed once; every question about a node is then a weighted sum
/// over its few shares, which nearly always is a single one.
#include "heat/storage/nodal_enthalpy.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "mesh/block_geometry.hpp"
#include "mesh/block_part.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::heat {

namespace {

/// The temperatures between pieces of any of the curves, rising.
template <class Curve>
std::vector<double> breaks_of(const std::vector<Curve>& curves) {
  std::vector<double> breaks;
  for (const Curve& curve : curves)
    for (const auto& piece : curve.pieces()) breaks.insert(breaks.end(), {piece.t0, piece.t1});
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
  return breaks;
}

}  // namespace

NodalEnthalpy::NodalEnthalpy(const mesh::Mesh& mesh, AnalysisKind kind,
                             const std::vector<material::Material>& materials)
    : materials_(materials) {
  // The curves of all materials, where their pieces start in enthalpy, and where they break in temperature.
  for (const material::Material& m : materials_) {
    curves_.push_back(m.enthalpy());
    starts_.emplace_back();
    for (const auto& piece : curves_.back().pieces()) starts_.back().push_back(piece.h0);
  }
  breaks_ = breaks_of(curves_);

  // Nearly all nodes belong to one body: what others have of a node is kept apart.
  constexpr int k_none = -1;
  const auto n_owned = as_size(mesh.n_owned_nodes);
  std::vector<int> body_of(n_owned, k_none);
  std::vector<double> volume_of(n_owned, 0.0);
  std::map<Index, std::vector<NodeShare>> further;
  // The first body that a node meets has its own two arrays; a second or third one goes to the map.
  const auto volume_in = [&](Index node, int body) -> double& {
    int& own = body_of[as_size(node)];
    if (own == k_none) own = body;
    if (own == body) return volume_of[as_size(node)];
    std::vector<NodeShare>& list = further[node];
    const auto found = std::ranges::find(list, body, &NodeShare::body);
    return (found != list.end() ? *found : list.emplace_back(NodeShare{body, 0.0})).weight;
  };
  // Nodal weights of all elements, the volume ∫ N_a dV of each body at each node.
  for (const mesh::ElementBlock& block : mesh.blocks)
    mesh::for_parts(block, [&](const mesh::ElementBlock& part, Index) {
      const PackVector<Lane> weights = mesh::nodal_weights(mesh, part, kind);
      const Index n = mesh::node_count(part.shape);
      for (Index e = 0; e < part.size(); ++e)
        for (Index a = 0; a < n; ++a)
          if (const Index node = part.element(e)[a]; node < mesh.n_owned_nodes)
            volume_in(node, block.body) += weights[as_size(e / k_lanes * n + a)][e % k_lanes];
    });
  // A mesh of one body needs no list of shares.
  if (n_owned > 0 && further.empty() && body_of.front() != k_none &&
      std::ranges::count(body_of, body_of.front()) == std::ssize(body_of)) {
    shares_ = NodeShares(body_of.front(), std::move(volume_of));
    return;
  }
  // Otherwise a list for each node: its own body first, then the others.
  std::size_t n_shares = n_owned;
  for (const auto& [node, list] : further) n_shares += list.size();
  shares_.reserve(n_shares);
  auto more = further.begin();
  for (std::size_t i = 0; i < n_owned; ++i) {
    // A node may be without elements until one grows there.
    if (body_of[i] != k_none) shares_.add({body_of[i], volume_of[i]});
    if (more != further.end() && as_size(more->first) == i) {
      for (const NodeShare& share : more->second) shares_.add(share);
      ++more;
    }
    shares_.end_node();
  }
}

double NodalEnthalpy::held_by(const linear::ActiveSet& active, Index node, double heat,
                              double temperature) const {
  const NodeShares::List list = shares_[node];
  if (std::all_of(list.begin(), list.end(), [&](const NodeShare& s) { return active.body(s.body); }))
    return heat;
  // The heat of the bodies that stay, at the same temperature and share of the plateau.
  const double share = plateau_share(node, heat, temperature);
  double held = 0;
  for (const NodeShare s : list) {
    if (!active.body(s.body)) continue;
    const double low = curve(s).lower(temperature);
    held += s.weight * (low + share * (curve(s).upper(temperature) - low));
  }
  return held;
}

/// The whole list of shares is kept beside the filtered one, so that bodies can come back.
void NodalEnthalpy::set_active(const linear::ActiveSet& active) {
  if (!all_) all_ = shares_;
  std::vector<char> kept;
  for (std::size_t b = 0; b < materials_.size(); ++b) kept.push_back(active.body(static_cast<int>(b)));
  filter(*all_, kept);
}

/// Bodies that are not kept never come back: no second list is needed.
void NodalEnthalpy::keep_bodies(std::span<const char> kept) {
  filter(shares_, kept);
  all_.reset();
}

/// The volume of metal that moves is scaled by how much of the room it still fills; the rooms themselves are
/// kept for volumes and fractions.
void NodalEnthalpy::hold(std::span<const char> moves, std::span<const double> held) {
  if (!rooms_) rooms_ = shares_;
  shares_ = *rooms_;
  shares_.scale([&](Index node, int body) { return moves[as_size(body)] != 0 ? held[as_size(node)] : 1.0; });
}

/// The part of a node's heat that some of its bodies hold, all at one temperature and one share of a plateau.
double NodalEnthalpy::heat_of(std::span<const char> of, Index node, double heat, double temperature) const {
  const double share = plateau_share(node, heat, temperature);
  double sum = 0;
  for (const NodeShare s : shares_[node]) {
    if (of[as_size(s.body)] == 0) continue;
    const double low = curve(s).lower(temperature);
    sum += s.weight * (low + share * (curve(s).upper(temperature) - low));
  }
  return sum;
}

void NodalEnthalpy::filter(const NodeShares& from, std::span<const char> kept) {
  NodeShares left;
  for (Index node = 0; node < from.n_nodes(); ++node) {
    for (const NodeShare share : from[node])
      if (kept[as_size(share.body)] != 0) left.add(share);
    left.end_node();
  }
  shares_ = std::move(left);
}

/// The enthalpy at a temperature, below its jump where a phase changes there.
double NodalEnthalpy::lower(Index node, double temperature) const {
  double h = 0;
  for (const NodeShare s : shares_[node]) h += s.weight * curve(s).lower(temperature);
  return h;
}

/// The enthalpy at a temperature, above its jump where a phase changes there.
double NodalEnthalpy::upper(Index node, double temperature) const {
  double h = 0;
  for (const NodeShare s : shares_[node]) h += s.weight * curve(s).upper(temperature);
  return h;
}

double NodalEnthalpy::capacity(Index node, double temperature) const {
  double c = 0;
  for (const NodeShare s : shares_[node]) c += s.weight * curve(s).capacity(temperature);
  return c;
}

/// Nodes of several materials: the break below the heat by bisection, then the sum's own quadratic.
double NodalEnthalpy::mixed_temperature(const NodeShares::List& shares, double heat, bool& plateau) const {
  const auto sum = [&](auto f) {
    double h = 0;
    for (const NodeShare s : shares) h += s.weight * f(curve(s));
    return h;
  };
  const auto lower_at = [&](double t) { return sum([t](const auto& c) { return c.lower(t); }); };
  const auto upper_at = [&](double t) { return sum([t](const auto& c) { return c.upper(t); }); };
  const auto capacity_at = [&](double t) { return sum([t](const auto& c) { return c.capacity(t); }); };
  plateau = false;
  // Breaks are common to all curves, so the sum is one quadratic between two of them.
  const auto above =
      std::partition_point(breaks_.begin(), breaks_.end(), [&](double t) { return lower_at(t) <= heat; });
  // Below the lowest break all capacities are constant.
  if (above == breaks_.begin())
    return breaks_.front() + (heat - lower_at(breaks_.front())) / capacity_at(breaks_.front() - 1.0);
  // Within the jump at the break the heat is on the plateau.
  const double t0 = *(above - 1), h = heat - upper_at(t0);
  if (h <= 0) {
    plateau = h < 0 && heat > lower_at(t0);
    return t0;
  }
  const double c0 = capacity_at(t0);
  if (above == breaks_.end()) return t0 + h / c0;
  const double width = *above - t0, c1 = 2.0 * (capacity_at(t0 + 0.5 * width) - c0) / width;
  return std::min(t0 + 2.0 * h / (c0 + std::sqrt(std::max(0.0, c0 * c0 + 2.0 * c1 * h))), *above);
}

double NodalEnthalpy::temperature(Index node, double heat) const {
  const NodeShares::List list = shares_[node];
  assert(!list.empty());
  if (list.size() == 1) return curve(list[0]).temperature(heat / list[0].weight);
  bool plateau = false;
  return mixed_temperature(list, heat, plateau);
}

double NodalEnthalpy::slope(Index node, double heat) const {
  const NodeShares::List list = shares_[node];
  if (list.empty()) return 0.0;
  if (list.size() == 1) return curve(list[0]).inverse_slope(heat / list[0].weight) / list[0].weight;
  bool plateau = false;
  const double temperature = mixed_temperature(list, heat, plateau);
  return plateau ? 0.0 : 1.0 / capacity(node, temperature);
}

NodalEnthalpy::Point NodalEnthalpy::point(Index node, double heat) const {
  const NodeShares::List list = shares_[node];
  if (list.empty()) return {std::numeric_limits<double>::quiet_NaN(), 0.0};  // it stores nothing
  // A node of several bodies has the sum of their curves, which is solved for; one of a single body finds its
  // piece by the enthalpy.
  if (list.size() != 1) {
    bool plateau = false;
    const double t = mixed_temperature(list, heat, plateau);
    return {t, plateau ? 0.0 : 1.0 / capacity(node, t)};
  }
  const NodeShare share = list.front();
  const std::vector<double>& starts = starts_[as_size(share.body)];
  const double h = heat / share.weight;
  const auto above = as_size(std::upper_bound(starts.begin(), starts.end(), h) - starts.begin());
  const std::size_t i = above == 0 ? 0 : above - 1;
  const auto& piece = curve(share).pieces()[i];
  const double from = h - piece.h0, width = piece.t1 - piece.t0;
  // Below the first piece and above the last one capacity is constant; within a piece it is linear, so that
  // enthalpy is quadratic.
  if (from <= 0) return {piece.t0 + from / piece.c0, 1.0 / (piece.c0 * share.weight)};
  const double in_piece = width * (piece.c0 + 0.5 * piece.c1 * width);
  if (from >= in_piece) {
    const double c = piece.c0 + piece.c1 * width;
    if (i + 1 == starts.size()) return {piece.t1 + (from - in_piece) / c, 1.0 / (c * share.weight)};
    // In a jump, or at the end of the piece but for rounding.
    constexpr double k_rounding = 1e-9;
    const double height = starts[i + 1] - piece.h0;
    const bool jumps = height - in_piece > k_rounding * height && from > in_piece;
    return {piece.t1, jumps ? 0.0 : 1.0 / (c * share.weight)};
  }
  const double root = std::sqrt(piece.c0 * piece.c0 + 2.0 * piece.c1 * from);
  return {std::min(piece.t0 + 2.0 * from / (piece.c0 + root), piece.t1), 1.0 / (root * share.weight)};
}

/// Whether some curve of the node jumps at this very temperature.
bool NodalEnthalpy::jumps_at(Index node, double temperature) const {
  return std::ranges::any_of(shares_[node], [&](const NodeShare& s) {
    return std::ranges::any_of(curve(s).jumps(), [&](const auto& j) { return j.temperature == temperature; });
  });
}

double NodalEnthalpy::plateau_share(Index node, double heat, double temperature) const {
  if (!jumps_at(node, temperature)) return 1.0;
  const double low = lower(node, temperature), high = upper(node, temperature);
  return high > low ? std::clamp((heat - low) / (high - low), 0.0, 1.0) : 1.0;
}

int NodalEnthalpy::branch(Index node, double heat, double temperature) const {
  int branch = 0;
  for (const NodeShare s : shares_[node])
    for (const auto& jump : curve(s).jumps()) {
      if (temperature < jump.temperature) continue;
      const double share = temperature > jump.temperature ? 1.0 : plateau_share(node, heat, temperature);
      branch += share == 1.0 ? 2 : share > 0 ? 1 : 0;
    }
  return branch;
}

double NodalEnthalpy::solid_fraction(Index node, double heat, double temperature) const {
  double volume = 0, solid = 0;
  for (const NodeShare s : shares_[node]) {
    if (!can_melt(s.body)) continue;
    volume += this->volume(node, s.body);
    solid += solid_volume(node, s.body, heat, temperature);
  }
  return volume > 0 ? solid / volume : 1.0;
}

double NodalEnthalpy::volume(Index node, int body) const {
  for (const NodeShare s : (rooms_ ? *rooms_ : shares_)[node])
    if (s.body == body) return s.weight;
  return 0.0;
}

/// Within a jump the solid fraction is linear in the heat.
double NodalEnthalpy::solid_volume(Index node, int body, double heat, double temperature) const {
  const double all = volume(node, body);
  const material::PhaseChange* change = materials_[as_size(body)].solidification();
  if (!change || all == 0) return all;
  const double below = change->fraction.below(temperature), above = change->fraction.above(temperature);
  if (below == above) return all * below;
  return all * (below - plateau_share(node, heat, temperature) * (below - above));
}

double NodalEnthalpy::latent(Index node, double heat, double temperature) const {
  double latent = 0;
  for (const NodeShare s : shares_[node]) {
    const material::Material& m = materials_[as_size(s.body)];
    // Fractions of all changes, within a jump by the share of it that is done.
    for (const material::PhaseChange& change : m.phase_changes) {
      const double below = change.fraction.below(temperature), above = change.fraction.above(temperature);
      const double share = below == above ? 0.0 : plateau_share(node, heat, temperature);
      latent += s.weight * m.density * change.latent_heat * (1.0 - below + share * (below - above));
    }
  }
  return latent;
}

double NodalEnthalpy::entropy(Index node, double heat, double temperature) const {
  const double share = plateau_share(node, heat, temperature);
  double entropy = 0;
  for (const NodeShare s : shares_[node]) {
    const double low = curve(s).lower_entropy(temperature);
    entropy += s.weight * (share > 0 ? low + share * (curve(s).upper_entropy(temperature) - low) : low);
  }
  return entropy;
}

bool NodalEnthalpy::has_plateaus() const {
  return std::any_of(curves_.begin(), curves_.end(), [](const auto& c) { return !c.jumps().empty(); });
}

double NodalEnthalpy::latent_capacity(Index node) const {
  double heat = 0;
  for (const NodeShare s : shares_[node]) {
    if (curve(s).jumps().empty()) continue;
    const material::Material& m = materials_[as_size(s.body)];
    for (const material::PhaseChange& change : m.phase_changes)
      heat += s.weight * m.density * change.latent_heat;
  }
  return heat;
}

std::size_t NodalEnthalpy::bytes() const {
  return shares_.bytes() + (all_ ? all_->bytes() : 0) + (rooms_ ? rooms_->bytes() : 0);
}

}  // namespace solidus::heat
