/// Bodies whose elements cannot bend as they should.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "cases/roles.hpp"
#include "check/finding_family.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"

namespace solidus::check {

namespace {

constexpr double k_slender = 10, k_most = 0.5;  // extent over thickness; elements from skin to skin

bool of_first_order(const mesh::Mesh& mesh, int body) {
  return std::ranges::none_of(mesh.blocks, [&](const mesh::ElementBlock& block) {
    return block.body == body && mesh::node_count(block.shape) > mesh::vertex_count(block.shape);
  });
}

/// The largest extent of a body over its thickness, twice its volume over its skin.
double slenderness(const BodyMeasures& body) {
  double extent = 0;
  for (std::size_t k = 0; k < 3; ++k) extent = std::max(extent, body.high[k] - body.low[k]);
  return body.volume > 0 ? extent * body.skin / (2 * body.volume) : 0.0;
}

/// The nodes on the skin of a body, [local node]. A face with an owned node has all its elements here, so
/// that it is on the skin where one of them has it; ghosts learn it from their owners.
std::vector<char> skin_nodes(const mesh::Mesh& mesh, int body) {
  using Key = std::array<Index, 4>;
  // A face that one element alone has lies on the skin; the key is its sorted vertices, which both
  // elements of an inner face share.
  std::map<Key, int> faces;
  for (const mesh::ElementBlock& block : mesh.blocks) {
    if (block.body != body) continue;
    const auto n = as_size(mesh::vertex_count(mesh::face_shape(block.shape)));
    for (Index e = 0; e < block.size(); ++e)
      for (int f = 0; f < mesh::face_count(block.shape); ++f) {
        Key key{-1, -1, -1, -1};
        std::ranges::transform(mesh::face_nodes(block.shape, f).first(n), key.begin(),
                               [&](int local) { return block.element(e)[local]; });
        std::ranges::sort(key);
        ++faces[key];
      }
  }
  // Marks as numbers, so that the exchange of ghosts can carry them; unused places of the key are
  // negative.
  std::vector<double> on_skin(mesh.x.size(), 0.0);
  for (const auto& [key, elements] : faces)
    if (elements == 1)
      for (const Index node : key)
        if (node >= 0 && node < mesh.n_owned_nodes) on_skin[as_size(node)] = 1;
  parallel::GhostExchange(mesh).update(on_skin, 1);
  return {on_skin.begin(), on_skin.end()};
}

/// A plate or a strip of one element of first order through its thickness bends with a third (tetrahedra) to
/// four fifths (hexahedra) of its deflection, and its stress is even through the thickness.
void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  // A strip of a disc or of a tube is one element high, and nothing bends there.
  if (!a.mechanics || spec.analysis.kind == AnalysisKind::axisymmetric) return;
  for (std::size_t b = 0; b < m.bodies.size(); ++b) {
    const auto body = static_cast<int>(b);
    const bool told = std::ranges::any_of(
        m.pours, [&](const Pour& pour) { return pour.body == b && pour.spanned > k_most; });
    if (told || cases::only_conducts(spec.bodies[b]) || !(slenderness(m.bodies[b]) > k_slender) ||
        !of_first_order(a.mesh, body))
      continue;
    const double share = share_between(a.mesh, spec.analysis.kind, body, skin_nodes(a.mesh, body));
    if (share > k_most)
      findings.push_back(
          {false, spec.mesh.where,
           fmt::format(
               "{:.0f} % of the thin body '{}' are elements of first order that reach from skin to skin: "
               "they bend too stiffly, tetrahedra to a third and hexahedra to four fifths of what they "
               "should",
               100 * share, spec.bodies[b].name),
           a.materials[b].solidification() != nullptr
               ? "two or more elements through a wall that bends; those of second order neither open pores "
                 "nor "
                 "feed"
               : "elements of second order (mesh.order = 2), or four through a wall that bends"});
  }
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_bending() {
  return {
      .name = "bending",
      .place = 150,
      .find = &find,
      .rows = {{Topic::mesh, "a thin body that bends with one element",
                fmt::format(
                    "more than {} of a body that deforms, {} times as long as thick, are elements of first "
                    "order that reach from one surface to the other; at the end of a run a line names bodies "
                    "of first order whose stress jumps by more than half of its size from element to element",
                    percent(k_most), number(k_slender))}}};
}

}  // namespace solidus::check
