// Findings on bodies that supports keep from moving, but not from turning.
#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "check/finding_family.hpp"
#include "numbers/index_casts.hpp"
#include "numbers/symmetric_eigen.hpp"
#include "parallel/parallel.hpp"
#include "setup/body_input.hpp"
#include "setup/mechanics_input.hpp"

namespace solidus::check {

namespace {

/// An eigenvalue below this share of the largest one is that of a motion that no support holds.
constexpr double k_nothing = 1e-9;

/// Bodies that contacts and common nodes join count as one rigid body: the first body of each group, and
/// whether something that does not move holds it, a tool or a body that only conducts heat.
struct Groups {
  std::vector<int> of_body;
  std::vector<char> held;  ///< [first body]
};

Groups joined_bodies(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m) {
  // Bodies that touch or share nodes move together, as long as they deform. A body that touches one that does
  // not move is held by it.
  Groups groups;
  groups.of_body.resize(spec.bodies.size());
  groups.held.assign(spec.bodies.size(), 0);
  std::iota(groups.of_body.begin(), groups.of_body.end(), 0);
  const auto moves = [&](int body) {
    const cases::BodySpec& of = spec.bodies[as_size(body)];
    return !cases::only_conducts(of) && cases::holds(of.stages, a.first_stage());
  };
  std::vector<char> held(spec.bodies.size(), 0);
  const auto join = [&](int one, int other) {
    for (const auto& [body, partner] : {std::pair(one, other), std::pair(other, one)})
      if (body >= 0 && (partner < 0 || !moves(partner))) held[as_size(body)] = 1;
    if (one < 0 || other < 0 || !moves(one) || !moves(other)) return;
    const int low = std::min(groups.of_body[as_size(one)], groups.of_body[as_size(other)]),
              high = std::max(groups.of_body[as_size(one)], groups.of_body[as_size(other)]);
    std::replace(groups.of_body.begin(), groups.of_body.end(), high, low);
  };
  // Contacts of the first stage join their bodies. A contact with several bodies on one side says too little,
  // and then all count as held.
  for (std::size_t c = 0; c < spec.contacts.size(); ++c)
    if (setup::holds(spec, spec.contacts[c], a.mesh, a.first_stage())) {
      join(m.contacts[c].slave_body, m.contacts[c].master_body);
      const bool several = m.contacts[c].slave_body == setup::k_several_bodies ||
                           m.contacts[c].master_body == setup::k_several_bodies;
      if (several) std::fill(held.begin(), held.end(), char{1});  // no finding is better than a wrong one
    }
  // Shared nodes join bodies, too. A group is held if one of its bodies is.
  for (std::size_t b = 0; b < m.bodies.size(); ++b)
    for (std::size_t other = 0; other < b; ++other)
      if (m.bodies[b].shared_nodes[other] > 0) join(static_cast<int>(b), static_cast<int>(other));
  for (std::size_t b = 0; b < held.size(); ++b)
    if (held[b] != 0 || !moves(static_cast<int>(b))) groups.held[as_size(groups.of_body[b])] = 1;
  return groups;
}

/// The motions of a rigid body, translations and rotations about the origin of `mesh` scaled by `size`, that
/// its supports hold: the sum of r rᵀ over the held components of nodes, r their part in each motion.
/// Collective.
class RigidMotions {
 public:
  RigidMotions(const mesh::Mesh& mesh, const mesh::Point& centre, double size)
      : mesh_(mesh), centre_(centre[0], centre[1], centre[2]), size_(size), n_(mesh.dimension == 3 ? 6 : 3) {
    form_.setZero(n_, n_);
  }
  void hold(Index node, int axis) {
    // A held node takes from the rigid motions what moves it along that axis: translation, and rotation by
    // its arm.
    const mesh::Point& x = mesh_.x[as_size(node)];
    const Eigen::Vector3d arm = (Eigen::Vector3d(x[0], x[1], x[2]) - centre_) / size_;
    const Eigen::Vector3d turn = arm.cross(Eigen::Vector3d::Unit(axis));
    Eigen::VectorXd r = Eigen::VectorXd::Zero(n_);
    r[axis] = 1;
    if (n_ == 6)
      r.tail(3) = turn;
    else
      r[2] = turn.z();
    form_ += r * r.transpose();
  }
  void sum() {
    for (double& entry : form_.reshaped()) entry = parallel::global_sum(entry);
  }
  /// Whether all translations are held, and some rotation is not.
  bool turns() const {
    const Eigen::MatrixXd translations = form_.topLeftCorner(mesh_.dimension, mesh_.dimension);
    return !is_loose(translations) && is_loose(form_);
  }

 private:
  static bool is_loose(const Eigen::MatrixXd& form) {
    const SymmetricEigen modes =
        symmetric_eigen({form.data(), form.data() + form.size()}, as_size(form.rows()));
    return modes.values.front() < k_nothing * modes.values.back() || !(modes.values.back() > 0);
  }
  const mesh::Mesh& mesh_;
  Eigen::Vector3d centre_;
  double size_;
  int n_;
  Eigen::MatrixXd form_;
};

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  // A group that nothing else holds turns if its supports hold no more than a point or a line. Inertia
  // resists turning, and around an axis there is none.
  if (!spec.has_mechanics() || spec.dynamics || spec.analysis.kind == AnalysisKind::axisymmetric) return;
  const Groups groups = joined_bodies(spec, a, m);
  // Groups that shared nodes and contacts join move as one, and the first body speaks for its
  // group.
  for (std::size_t first = 0; first < spec.bodies.size(); ++first) {
    if (groups.of_body[first] != static_cast<int>(first) || groups.held[first] != 0) continue;
    // Rotations are about the middle of the body and scaled by its size, so that they compare with
    // translations.
    const BodyMeasures& body = m.bodies[first];
    mesh::Point centre{};
    double size = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      centre[d] = 0.5 * (body.low[d] + body.high[d]);
      size = std::max(size, body.high[d] - body.low[d]);
    }
    // The directions that are held at nodes of the group are summed up in the matrix of its rigid motions.
    std::vector<char> of_group(a.mesh.x.size(), 0);
    for (const mesh::ElementBlock& block : a.mesh.blocks)
      if (groups.of_body[as_size(block.body)] == static_cast<int>(first))
        for (const Index node : block.nodes) of_group[as_size(node)] = 1;
    RigidMotions motions(a.mesh, centre, size);
    for (const cases::MechanicalConditionSpec& c : spec.mechanical_conditions) {
      const auto nodes = a.mesh.node_sets.find(c.group);
      if (c.kind != cases::MechanicalConditionSpec::Kind::displacement || nodes == a.mesh.node_sets.end() ||
          !cases::holds(c.stages, a.first_stage()))
        continue;
      // Nodes count once, on the process that owns them.
      for (const Index node : nodes->second) {
        if (node >= a.mesh.n_owned_nodes || of_group[as_size(node)] == 0) continue;
        if (c.ux) motions.hold(node, 0);
        if (c.uy) motions.hold(node, 1);
        if (c.uz && a.mesh.dimension == 3) motions.hold(node, 2);
      }
    }
    // After the sum all processes have the same matrix: a rotation of next to no stiffness in it is
    // free.
    motions.sum();
    if (!motions.turns()) continue;
    findings.push_back(
        {false, spec.bodies[first].where,
         fmt::format("nothing keeps '{}' from turning: its supports hold a point or a line of it",
                     spec.bodies[first].name),
         "supports on three planes (in the plane on two lines), or on nodes that do not lie on one line"});
  }
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_rotation() {
  return {
      .name = "bodies that can turn",
      .place = 180,
      .find = &find,
      .rows = {
          {Topic::mechanics, "nothing keeps a body from turning",
           "its supports hold only a point or a line of it (named nodes; bodies in contact count as one)"}}};
}

}  // namespace solidus::check
