#include "setup/mesh_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cases/feeder_keys.hpp"
#include "input/units.hpp"
#include "setup/section_names.hpp"
#include "system/errors.hpp"

namespace solidus::setup {

namespace {

/// Whether mould, riser, symmetry or sizes by walls are made of a geometry.
bool of_casting(const cases::MeshSpec& m) {
  return !m.sizes.empty() || m.mould || !m.risers.empty() || !m.gatings.empty() || !m.chills.empty() ||
         m.symmetry;
}

/// A slip in a size must not fill the memory.
void check_element_count(const cases::MeshSpec& m, double elements) {
  constexpr double k_most = 1e8;
  if (elements > k_most)
    throw InputError(m.where, fmt::format("the shape '{}' would have {:.2g} elements", *m.shape, elements),
                     fmt::format("at most {:.0e}; larger elements, fewer divisions", k_most));
}

double product(const std::vector<int>& divisions) {
  // The product is a floating number, since that of large divisions would not fit into a whole one.
  double n = 1;
  for (const int d : divisions) n *= d;
  return n;
}

/// A rule for faces chooses surfaces, and its points have three coordinates.
void check_face_rule(const cases::MeshGroupSpec& g) {
  const auto refuse = [&](const std::string& what, const std::string& allowed) {
    throw InputError(g.where, fmt::format("the group '{}' of the mesh: {}", g.name, what), allowed);
  };
  // A rule has the surface from its geometry alone; along with numbers or a label it would be open which of
  // them decides.
  if (g.kind == cases::MeshGroupSpec::Kind::body || !g.numbers.empty() || !g.label.empty())
    refuse("a rule chooses faces of the mesh", "no kind = \"body\", numbers or label with a rule");
  for (const std::vector<double>* point : {&g.normal, &g.plane, &g.nearest})
    if (!point->empty() && point->size() != 3)
      refuse("a rule has a point or direction that is none", "three coordinates");
  // Keys that only make sense together are refused alone, for the half of a rule would choose other faces
  // than were meant.
  if (!g.plane.empty() && g.normal.empty())
    refuse("'plane' is a point of a plane without its normal", "normal = [0, 0, 1] with it");
  if (!g.normal.empty() && !(std::hypot(g.normal[0], g.normal[1], g.normal[2]) > 0))
    refuse("'normal' has no length", "a direction");
}

/// Coats are cut out of a block that is thick enough for all of them.
void check_coats(const cases::MeshSpec& m) {
  if (m.coats.empty()) {
    // Without coats only 'bed' can be wrong, which needs them.
    if (m.mould && m.mould->bed)
      throw InputError(m.mould->where, "'bed' is what lies beyond coats, and there is no [[mesh.coat]]",
                       "[[mesh.coat]], or no 'bed'");
    return;
  }
  const SourceLocation& where = m.coats.front().where;
  if (!m.mould)
    throw InputError(where, "[[mesh.coat]] is cut out of a block of mould, and there is no [mesh.mould]",
                     "[mesh.mould] with walls thicker than all coats together");
  check_names(m.coats, "[[mesh.coat]]");
  // Coats lie on each other, so that the wall has to hold the sum of them. A wall of zero is an open side,
  // where nothing is cut.
  double whole = 0;
  for (const cases::MeshCoatSpec& coat : m.coats) whole += coat.thickness;
  for (const double wall : m.mould->walls)
    if (wall > 0 && wall <= whole)
      throw InputError(m.mould->where,
                       fmt::format("a wall of {:g} mm has no room for coats that are {:g} mm thick together",
                                   1e3 * wall, 1e3 * whole),
                       fmt::format("more than {:g} mm, or 0 where the shell is open", 1e3 * whole));
}

/// The mesh has one source, and its names are told apart.
void check_source(const cases::MeshSpec& m) {
  // Both or neither are the same mistake: there has to be one source.
  if (m.shape.has_value() == m.file.has_value())
    throw InputError(m.where,
                     m.shape ? "[mesh] has both a shape and a file" : "[mesh] has neither a shape nor a file",
                     "shape = \"...\" or file = \"...\"");
  if (!m.unit.empty() && !units::compatible(m.unit, "m"))
    throw InputError(m.where, fmt::format("'{}' is no unit of length", m.unit),
                     "\"mm\", \"m\", \"inch\", ...");
  check_names(m.groups, "[[mesh.group]]");
  check_names(m.layers, "[[mesh.layers]]");
}

/// Sizes, mould, shell, riser and symmetry of a casting.
void check_casting(const cases::MeshSpec& m) {
  // One length is for all sides, and six are for each.
  if (m.mould && m.mould->walls.size() != 1 && m.mould->walls.size() != 6)
    throw InputError(m.mould->where, fmt::format("'walls' has {} lengths", m.mould->walls.size()),
                     "one, or six: lowest and highest x, y and z");
  check_coats(m);
  // Sizes, mould, riser and symmetry make the mesh of a casting from a geometry, and exclude what sizes
  // elements otherwise.
  if (m.way > 0 && !of_casting(m))
    throw InputError(m.where, "'way' is for files that are meshed by the thickness of walls",
                     "[[mesh.size]] for each body, or no 'way'");
  if (of_casting(m) && (m.element_size || m.conforming))
    throw InputError(
        m.where,
        fmt::format("'{}' together with sizes, mould, risers, gating, chills or symmetry of [mesh], which "
                    "make sizes and shared faces themselves",
                    m.element_size ? "element_size" : "conforming"),
        "[[mesh.size]] for each body");
  if (m.size_factor != 1 && (of_casting(m) || m.shape))
    throw InputError(m.where,
                     m.shape ? "'size_factor' is for files, and the mesh is a built-in shape"
                             : "'size_factor' together with sizes of [mesh], which it does not change",
                     m.shape ? "sizes or divisions of the shape" : "[[mesh.size]] for each body");
  // Risers, gating and chills are checked by the rules that a file of feeders obeys too.
  cases::check_feeders(m.risers, m.gatings, m.chills);
}

void check_groups_of(const cases::MeshSpec& m) {
  // A group is chosen in exactly one way.
  for (const cases::MeshGroupSpec& g : m.groups) {
    // A box counts as given when one of its corners is, so that the other one is asked for.
    const bool box = !g.lowest.empty() || !g.highest.empty();
    if (g.by_rule())
      check_face_rule(g);
    else if ((g.numbers.empty() ? 0 : 1) + (g.label.empty() ? 0 : 1) + (box ? 1 : 0) != 1)
      throw InputError(g.where, fmt::format("the group '{}' of the mesh is not chosen in one way", g.name),
                       "numbers, label, or lowest and highest; or owner, normal, plane, nearest");
    if (box && (g.lowest.size() != 3 || g.highest.size() != 3))
      throw InputError(g.where, fmt::format("the box of the group '{}' has no two corners", g.name),
                       "lowest and highest of three coordinates each");
  }
}

/// A built-in shape takes its order from the element, and has only groups by rule.
void check_keys_of_shape(const cases::MeshSpec& m, bool solid) {
  // The order and the groups of a file have no meaning for a shape, and a key that is read and not used would
  // mislead.
  if (m.order != 1)
    throw InputError(
        m.where, "'order' is that of files that hold a geometry; a built-in shape takes it from 'element'",
        "element = \"tri6\", \"quad8\", \"tet10\" or \"hex20\" for the second order");
  const bool rules_alone = std::all_of(m.groups.begin(), m.groups.end(),
                                       [](const cases::MeshGroupSpec& g) { return g.by_rule(); });
  if (!rules_alone || m.conforming)
    throw InputError(m.where,
                     "[[mesh.group]] without a rule and 'conforming' are for files, and the mesh is a "
                     "built-in shape");
  if (of_casting(m))
    throw InputError(m.where,
                     "[[mesh.size]], [mesh.mould], [[mesh.riser]], [[mesh.chill]] and [mesh.symmetry] need a "
                     "file with a geometry, and the mesh is a built-in shape");
  if (!m.constants.empty())
    throw InputError(m.where, "[[mesh.constant]] is for .geo scripts, and the mesh is a built-in shape");
  // Names of elements begin with their shape, which tells the dimension.
  const bool element_3d = m.element.starts_with("tet") || m.element.starts_with("hex");
  if (solid != element_3d)
    throw InputError(m.where,
                     fmt::format("element \"{}\" is not for a {} analysis", m.element,
                                 solid ? "three-dimensional" : "two-dimensional"),
                     solid ? "one of: tet4, tet10, hex8, hex20" : "one of: tri3, tri6, quad4, quad8");
}

void check_cylinder_in_mould(const cases::MeshSpec& m, const cases::AnalysisSpec& analysis) {
  if (!m.cylinder_in_mould) throw InputError(m.where, "the section [mesh.cylinder_in_mould] is missing");
  if (analysis.kind != AnalysisKind::axisymmetric)
    throw InputError(m.where, "the shape cylinder_in_mould is for axisymmetric analyses");
  const cases::CylinderInMouldSpec& c = *m.cylinder_in_mould;
  // A small tolerance lets equal heights pass that differ in the last bit after a change of unit.
  if (c.mould_height < (c.mould_bottom + c.height) * (1 - 1e-12))
    throw InputError(m.where, "the mould is lower than its bottom and the casting together",
                     "mould_height >= mould_bottom + height");
  // The estimate counts squares of each element size on the section of metal and mould.
  const double width = c.radius + c.mould_wall;
  check_element_count(m, c.radius * c.height / (c.element_size * c.element_size) +
                             width * c.mould_height / (c.mould_element_size * c.mould_element_size));
}

void check_blocks(const cases::MeshSpec& m, bool solid) {
  if (*m.shape == "block") {
    if (!m.block) throw InputError(m.where, "the section [mesh.block] is missing");
    const std::size_t dimension = solid ? 3 : 2;
    // An origin may be left out, which is the corner at zero.
    const bool origin_fits = m.block->origin.empty() || m.block->origin.size() == dimension;
    if (m.block->size.size() != dimension || m.block->divisions.size() != dimension || !origin_fits)
      throw InputError(m.where, "[mesh.block] does not fit the analysis",
                       fmt::format("{} lengths and {} divisions", dimension, dimension));
    check_element_count(m, product(m.block->divisions));
  }
  if (*m.shape == "two_blocks") {
    if (!m.two_blocks) throw InputError(m.where, "the section [mesh.two_blocks] is missing");
    const cases::TwoBlocksSpec& t = *m.two_blocks;
    const std::size_t dimension = solid ? 3 : 2;
    for (const std::size_t n :
         {t.lower.size(), t.upper.size(), t.lower_divisions.size(), t.upper_divisions.size()})
      if (n != dimension)
        throw InputError(m.where, "[mesh.two_blocks] does not fit the analysis",
                         fmt::format("{} lengths and {} divisions for each block", dimension, dimension));
    check_element_count(m, product(t.lower_divisions) + product(t.upper_divisions));
  }
}

}  // namespace

void check_mesh(const cases::MeshSpec& m, const cases::AnalysisSpec& analysis) {
  check_source(m);
  check_casting(m);
  check_groups_of(m);
  // Files have their own checks when they are read; the rest here is about shapes.
  if (!m.shape) return;
  // The order of these checks is that of their causes: an element of the wrong dimension is told first, and
  // not as divisions that do not fit.
  const bool solid = analysis.kind == AnalysisKind::solid;
  check_keys_of_shape(m, solid);
  if (*m.shape == "cylinder_in_mould") check_cylinder_in_mould(m, analysis);
  check_blocks(m, solid);
}

}  // namespace solidus::setup
