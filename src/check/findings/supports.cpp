// Findings on the motion of whole bodies: directions in which neither a support nor a contact holds them,
// when the run begins or in a later stage.
#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "check/finding_family.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/symmetric_eigen.hpp"
#include "parallel/parallel.hpp"
#include "setup/body_input.hpp"
#include "setup/mechanics_input.hpp"

namespace solidus::check {

namespace {

/// An eigenvalue below this is that of a direction that nothing holds; a support counts as one, a contact by
/// the shares of its area that face each direction.
constexpr double k_nothing = 1e-6;
/// A body falls where it can follow at least this share of its weight.
constexpr double k_falls = 0.1;

SymmetricEigen modes_of(const Eigen::MatrixXd& form) {
  return symmetric_eigen({form.data(), form.data() + form.size()}, as_size(form.rows()));
}
Eigen::Map<const Eigen::VectorXd> vector_of(const SymmetricEigen& modes, Eigen::Index k) {
  const auto n = static_cast<Eigen::Index>(modes.values.size());
  return {modes.vectors.data() + k * n, n};
}

/// The supports and contacts that hold the translations of the bodies: a quadratic form in their n directions
/// each, and the part of it that acts from one body to another.
class Translations {
 public:
  /// @param stage  in which they hold; null: the run has none
  Translations(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
               const cases::StageRun* stage);

  /// Bodies that are joined to each other by contacts and common nodes: the number of the first one of each.
  const std::vector<int>& group() const { return group_; }
  bool moves(std::size_t body) const { return moves_[body] != 0; }
  int directions() const { return n_; }
  /// The index of a direction in a point: axisymmetric bodies move along their axis alone.
  std::size_t axis(int direction) const { return as_size(direction) + (axisymmetric_ ? 1 : 0); }
  /// Whether a support acts on a body along a direction.
  bool supported(std::size_t body, const Eigen::VectorXd& along) const {
    const auto first = n_ * static_cast<int>(body);
    return along.dot(supports_.block(first, 0, n_, n_) * along) > k_nothing;
  }
  /// The form that holds the bodies of a group together, [direction][direction].
  Eigen::MatrixXd held(int group) const;
  /// The motion of one body that follows a pull on it alone, where nothing holds it: the part of the pull in
  /// the kernel of the form.
  Eigen::VectorXd followed(std::size_t body, const Eigen::VectorXd& pull) const;

 private:
  void add_supports(const cases::CaseSpec& spec, const setup::Assembly& a, const cases::StageRun* stage);
  void add_contacts(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                    const cases::StageRun* stage);
  void join(int one, int other, const Eigen::MatrixXd& normals);
  void hold(int body, const Eigen::MatrixXd& normals) {
    form_.block(n_ * body, n_ * body, n_, n_) += normals;
    fixed_.block(n_ * body, 0, n_, n_) += normals;
  }
  Eigen::MatrixXd normals_of(const mesh::Mesh& mesh, const std::string& surface) const;

  bool axisymmetric_;
  int n_;
  std::vector<char> moves_;
  std::vector<int> group_;
  Eigen::MatrixXd form_, fixed_;  ///< fixed_: [body and direction][direction]
  Eigen::MatrixXd supports_;      ///< the part of fixed_ by supports
};

Translations::Translations(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                           const cases::StageRun* stage)
    : axisymmetric_(spec.analysis.kind == AnalysisKind::axisymmetric),
      n_(axisymmetric_ ? 1 : displacement_components(spec.analysis.kind)),
      group_(spec.bodies.size()) {
  // One block of directions a body; the form holds what ties bodies to each other, the fixed part
  // what ties them to the ground.
  const auto n_bodies = static_cast<int>(spec.bodies.size());
  std::iota(group_.begin(), group_.end(), 0);
  form_.setZero(n_ * n_bodies, n_ * n_bodies);
  fixed_.setZero(n_ * n_bodies, n_);
  // Bodies that do not move in this stage are held; then supports, contacts and shared nodes tie what moves.
  for (const cases::BodySpec& body : spec.bodies)
    moves_.push_back(!cases::only_conducts(body) && cases::holds(body.stages, stage));
  for (std::size_t b = 0; b < moves_.size(); ++b)
    if (moves_[b] == 0) hold(static_cast<int>(b), Eigen::MatrixXd::Identity(n_, n_));
  add_supports(spec, a, stage);
  supports_ = fixed_;
  add_contacts(spec, a, m, stage);
  // Shared nodes tie all directions of two bodies that are both there.
  for (std::size_t b = 0; b < m.bodies.size(); ++b)
    for (std::size_t other = 0; other < b; ++other)
      if (m.bodies[b].shared_nodes[other] > 0 && cases::holds(spec.bodies[b].stages, stage) &&
          cases::holds(spec.bodies[other].stages, stage))
        join(static_cast<int>(b), static_cast<int>(other), Eigen::MatrixXd::Identity(n_, n_));
}

void Translations::add_supports(const cases::CaseSpec& spec, const setup::Assembly& a,
                                const cases::StageRun* stage) {
  using Bits = std::uint64_t;
  const auto bit = [](std::size_t body) { return Bits{1} << std::min<std::size_t>(body, 63); };
  // A bit of each body at its nodes tells which bodies a group of nodes belongs to; the last bit is shared by
  // all bodies from the 64th on.
  std::vector<Bits> of_node(a.mesh.x.size(), 0);
  for (const mesh::ElementBlock& block : a.mesh.blocks)
    for (const Index node : block.nodes) of_node[as_size(node)] |= bit(as_size(block.body));
  for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) {
    if (c.kind != cases::MechanicalConditionSpec::Kind::displacement || !cases::holds(c.stages, stage))
      continue;
    // Which bodies the nodes of the group belong to, as far as this process sees them.
    Bits touched = 0;
    if (const auto nodes = a.mesh.node_sets.find(c.group); nodes != a.mesh.node_sets.end())
      for (const Index node : nodes->second) touched |= of_node[as_size(node)];
    // Radial motion counts as the first direction, and in two dimensions uz as the second.
    const std::array<bool, 3> along{c.ux || c.ur, c.uy || (n_ < 3 && c.uz), n_ == 3 && c.uz};
    // All processes must hold alike, or their matrices would differ.
    for (std::size_t b = 0; b < moves_.size(); ++b) {
      if (!parallel::any_process((touched & bit(b)) != 0)) continue;
      Eigen::MatrixXd held = Eigen::MatrixXd::Zero(n_, n_);
      for (int d = 0; d < n_; ++d) held(d, d) = along[axis(d)] ? 1 : 0;
      hold(static_cast<int>(b), held);
    }
  }
}

/// The mean of n nᵀ over the faces of a surface. Collective.
Eigen::MatrixXd Translations::normals_of(const mesh::Mesh& mesh, const std::string& surface) const {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  if (const auto found = mesh.surfaces.find(surface); found != mesh.surfaces.end())
    for (const mesh::ElementBlock& faces : found->second.faces)
      for (Index f = 0; f < faces.n_counted; ++f) {
        const auto at = [&](int k) {
          const mesh::Point& x = mesh.x[as_size(faces.element(f)[k])];
          return Eigen::Vector3d(x[0], x[1], x[2]);
        };
        const Eigen::Vector3d along = at(1) - at(0);
        const Eigen::Vector3d area = mesh.dimension == 3 ? Eigen::Vector3d(along.cross(at(2) - at(0)))
                                                         : Eigen::Vector3d(along.y(), -along.x(), 0);
        if (area.norm() > 0) sum += area * area.transpose() / area.norm();
      }
  // Scaled to a trace of one, so that large and small surfaces hold alike.
  for (double& entry : sum.reshaped()) entry = parallel::global_sum(entry);
  if (sum.trace() > 0) sum /= sum.trace();
  const auto first = static_cast<int>(axis(0));
  return sum.block(first, first, n_, n_);
}

void Translations::add_contacts(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                                const cases::StageRun* stage) {
  for (std::size_t c = 0; c < spec.contacts.size(); ++c) {
    const cases::ContactSpec& contact = spec.contacts[c];
    const setup::ContactMeasures& sides = m.contacts[c];
    if (!setup::holds(spec, contact, a.mesh, stage)) continue;
    // With friction a contact holds in all directions; without it along its normals alone.
    const Eigen::MatrixXd normals = contact.friction ? Eigen::MatrixXd(Eigen::MatrixXd::Identity(n_, n_))
                                                     : normals_of(a.mesh, sides.slave);
    // A side of several bodies is taken to stand still: no finding is better than a wrong one.
    if (sides.slave_body >= 0 && sides.master_body >= 0)
      join(sides.slave_body, sides.master_body, normals);
    else
      for (const int body : {sides.slave_body, sides.master_body})
        if (body >= 0) hold(body, normals);
    // With several bodies on a side every one of them may be the one that is held.
    if (sides.slave_body == setup::k_several_bodies || sides.master_body == setup::k_several_bodies)
      for (std::size_t b = 0; b < moves_.size(); ++b)
        hold(static_cast<int>(b), Eigen::MatrixXd::Identity(n_, n_));
  }
}

void Translations::join(int one, int other, const Eigen::MatrixXd& normals) {
  if (one == other) return;
  for (const int body : {one, other}) form_.block(n_ * body, n_ * body, n_, n_) += normals;
  form_.block(n_ * one, n_ * other, n_, n_) -= normals;
  form_.block(n_ * other, n_ * one, n_, n_) -= normals;
  const int low = std::min(group_[as_size(one)], group_[as_size(other)]),
            high = std::max(group_[as_size(one)], group_[as_size(other)]);
  std::replace(group_.begin(), group_.end(), high, low);
}

Eigen::MatrixXd Translations::held(int group) const {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n_, n_);
  for (std::size_t b = 0; b < group_.size(); ++b)
    if (group_[b] == group) sum += fixed_.block(n_ * static_cast<int>(b), 0, n_, n_);
  return sum;
}

Eigen::VectorXd Translations::followed(std::size_t body, const Eigen::VectorXd& pull) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(form_.rows());
  all.segment(n_ * static_cast<int>(body), n_) = pull;
  // What of the pull lies in motions that nothing resists.
  const SymmetricEigen modes = modes_of(form_);
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(all.size());
  for (Eigen::Index k = 0; k < all.size(); ++k)
    if (modes.values[as_size(k)] < k_nothing) {
      const auto mode = vector_of(modes, k);
      motion += mode.dot(all) * mode;
    }
  return motion.segment(n_ * static_cast<int>(body), n_);
}

/// "x", or the components of a direction that is none of the axes.
std::string direction_text(const Translations& t, const Eigen::VectorXd& direction) {
  for (int d = 0; d < direction.size(); ++d)
    if (std::abs(direction[d]) > 0.999 * direction.norm()) return std::string(1, "xyz"[t.axis(d)]);
  std::string text;
  for (int d = 0; d < direction.size(); ++d)
    text += fmt::format("{}{:.2g}", d > 0 ? ", " : "(", direction[d] / direction.norm());
  return text + ")";
}

/// Groups of bodies that hold each other, but that can move together.
/// @param when  " in the stage 'air'"; empty: when the run begins
void loose_groups(const cases::CaseSpec& spec, const Translations& t, const std::string& when,
                  std::vector<char>& told, Findings& findings) {
  // The first body of a group speaks for it.
  for (std::size_t first = 0; first < spec.bodies.size(); ++first) {
    if (t.group()[first] != static_cast<int>(first)) continue;
    // Directions in which the group can move without resistance are those of next to no stiffness.
    const SymmetricEigen modes = modes_of(t.held(static_cast<int>(first)));
    if (modes.values.front() >= k_nothing || told[first] != 0) continue;
    // All bodies of the group are named and marked, so that the later stages and the weight do not
    // tell them again.
    std::string names;
    for (std::size_t b = first; b < spec.bodies.size(); ++b)
      if (t.group()[b] == static_cast<int>(first)) {
        names += (names.empty() ? "'" : ", '") + spec.bodies[b].name + "'";
        told[b] = 1;
      }
    // One body with nothing at all, a group that is free in all directions, and one that is free
    // along some are told in different words.
    const bool alone = names == "'" + spec.bodies[first].name + "'",
               nowhere = modes.values.back() < k_nothing;
    std::string what = fmt::format("nothing holds {}{}{}", alone ? "the body " : "", names, when);
    if (alone && nowhere)
      what += ": no support, no contact";
    else if (!nowhere)
      what += fmt::format(" along {}: the place in that direction is arbitrary",
                          direction_text(t, vector_of(modes, 0)));
    else
      what += ": they are in contact with each other alone";
    findings.push_back({false, spec.bodies[first].where, std::move(what),
                        "a [[mechanical_condition]] with a displacement of zero, on a plane of symmetry or "
                        "on the floor"});
  }
}

/// The direction of gravity among those in which bodies move, of length one; zero where none acts.
Eigen::VectorXd direction_of_weight(const cases::CaseSpec& spec, const Translations& t) {
  const std::array<double, 3> g = setup::gravity(spec.analysis);
  Eigen::VectorXd weight(t.directions());
  for (int d = 0; d < t.directions(); ++d) weight[d] = g[t.axis(d)];
  return weight.normalized();  // which leaves zero as it is
}

/// Bodies whose weight neither a support nor a contact takes.
void falling_bodies(const cases::CaseSpec& spec, const Translations& t, const std::string& when,
                    std::vector<char>& told, Findings& findings) {
  // Without weight nothing falls.
  const Eigen::VectorXd weight = direction_of_weight(spec, t);
  if (weight.isZero()) return;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    if (told[b] != 0 || !t.moves(b)) continue;
    // The motion that the weight would cause, past supports and contacts: none where they all
    // resist.
    if (const Eigen::VectorXd motion = t.followed(b, weight); motion.norm() > k_falls) {
      told[b] = 1;
      findings.push_back(
          {false, spec.bodies[b].where,
           fmt::format("nothing holds '{}' against its weight{}: gravity acts along {}, and no support or "
                       "contact of it faces that way",
                       spec.bodies[b].name, when, direction_text(t, weight)),
           "is gravity_direction right? Else a support or a mould below"});
    }
  }
}

/// Whether a contact carries the weight of a set of bodies: contacts push and do not pull, so something of it
/// has to lie below them. Friction on upright faces counts, for a mould may clamp what it holds.
bool carries(const cases::ContactSpec& contact, const setup::ContactMeasures& sides,
             const std::vector<char>& bodies) {
  const auto is_of_them = [&](int body) { return body >= 0 && bodies[as_size(body)] != 0; };
  constexpr double k_least_share_of_area = 0.01;  // of the area
  const bool slave = is_of_them(sides.slave_body), master = is_of_them(sides.master_body);
  if (slave == master) return false;
  const double below = slave ? sides.below : sides.above;
  return below + (contact.friction ? sides.beside : 0.0) > k_least_share_of_area * sides.paired;
}

/// Bodies that two-sided contacts would hold, but that gravity takes off what they lie on. A body that shares
/// nodes with others counts as one with them.
void lifted_bodies(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                   const Translations& t, const std::vector<char>& told, Findings& findings) {
  const Eigen::VectorXd weight = direction_of_weight(spec, t);
  if (weight.isZero()) return;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    if (told[b] != 0 || !t.moves(b)) continue;
    // The bodies that shared nodes join to this one, found by repeating until nothing more is
    // added.
    std::vector<char> one(spec.bodies.size(), 0);
    one[b] = 1;
    for (bool more = true; more;) {
      more = false;
      for (std::size_t i = 0; i < one.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
          if (one[i] != one[k] && m.bodies[i].shared_nodes[k] > 0) one[i] = one[k] = 1, more = true;
    }
    // Held by a body that does not move, by a support, or by a contact that lies below.
    bool held = false, touches = false;
    for (std::size_t i = 0; i < one.size(); ++i)
      held |= one[i] != 0 && (!t.moves(i) || t.supported(i, weight));
    for (std::size_t c = 0; c < spec.contacts.size(); ++c) {
      const setup::ContactMeasures& sides = m.contacts[c];
      // Contacts count from the start only; with several bodies on a side it may be held there.
      if (!setup::holds(spec, spec.contacts[c], a.mesh, a.first_stage())) continue;
      held |= sides.slave_body == setup::k_several_bodies || sides.master_body == setup::k_several_bodies ||
              carries(spec.contacts[c], sides, one);
      touches |= sides.above + sides.below > 0 &&
                 (sides.slave_body == static_cast<int>(b) || sides.master_body == static_cast<int>(b));
    }
    // A load may press it against what it touches.
    for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions)
      held |= c.on_faces() || c.kind == cases::MechanicalConditionSpec::Kind::body_force;
    if (held || !touches) continue;
    findings.push_back(
        {false, spec.bodies[b].where,
         fmt::format("gravity, along {}, takes '{}' off what it lies on: no surface in contact is below it",
                     (weight.minCoeff() < -0.999 ? "-" : "") + direction_text(t, weight),
                     spec.bodies[b].name),
         "is gravity_direction right? Else a support, or a mould below"});
  }
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  if (!spec.has_mechanics() || spec.dynamics) return;
  // The first stage in full, then what becomes loose in later ones; each body is told once.
  const Translations translations(spec, a, m, a.first_stage());
  std::vector<char> told(spec.bodies.size(), 0);
  loose_groups(spec, translations, "", told, findings);
  falling_bodies(spec, translations, "", told, findings);
  lifted_bodies(spec, a, m, translations, told, findings);
  for (std::size_t i = 1; i < a.stages.size() && a.stages[i].cycle <= 1; ++i) {
    const Translations then(spec, a, m, &a.stages[i]);
    const std::string when = fmt::format(" in the stage '{}'", a.stages[i].stage->name);
    loose_groups(spec, then, when, told, findings);
    falling_bodies(spec, then, when, told, findings);
  }
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_supports() {
  return {.name = "bodies that nothing holds",
          .place = 170,
          .find = &find,
          .rows = {{Topic::mechanics, "nothing holds a body, or several that touch",
                    "along a direction in which none of their supports acts, at the start or in a later "
                    "stage (translations, without inertia)"},
                   {Topic::mechanics, "nothing holds a body against its weight",
                    "neither a support nor a normal or the friction of a contact acts along gravity"},
                   {Topic::mechanics, "gravity moves a body away from its support",
                    "no surface in contact lies below it, nor next to it with friction, and neither a "
                    "support along gravity nor a load acts"}}};
}

}  // namespace solidus::check
