/// Entities are chosen by number, label or place for each group of the case; those that are left get names
/// of their own.
#include "mesh/gmsh/geometry_groups.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "input/keys.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

/// Returns the part of a label after its last slash: "Shapes/crankshaft/web" is "web". Empty for those that
/// Gmsh's kernel makes up.
std::string short_label(int dimension, int tag) {
  std::string label;
  gmsh::model::getEntityName(dimension, tag, label);
  label = label.substr(label.find_last_of('/') + 1);
  return label.starts_with("Open CASCADE") || label == "COMPOUND" ? "" : label;
}

std::vector<int> entities(int dimension) {
  gmsh::vectorpair pairs;
  gmsh::model::getEntities(pairs, dimension);
  std::vector<int> tags;
  for (const auto& [d, tag] : pairs) tags.push_back(tag);
  return tags;
}

bool has_group(int dimension, int tag) {
  std::vector<int> groups;
  gmsh::model::getPhysicalGroupsForEntity(dimension, tag, groups);
  return !groups.empty();
}

void add_group(int dimension, const std::vector<int>& tags, const std::string& name) {
  gmsh::model::setPhysicalName(dimension, gmsh::model::addPhysicalGroup(dimension, tags), name);
}

std::array<Point, 2> bounding_box(int dimension, int tag) {
  std::array<Point, 2> box{};
  gmsh::model::getBoundingBox(dimension, tag, box[0][0], box[0][1], box[0][2], box[1][0], box[1][1],
                              box[1][2]);
  return box;
}

/// Finds the entities of a group, by whichever of number, label or box it has.
class Choice {
 public:
  Choice(const std::string& path, double unit) : path_(path), unit_(unit) {
    const std::array<Point, 2> all = bounding_box(-1, -1);
    for (std::size_t i = 0; i < 3; ++i) slack_ = std::max(slack_, k_slack * (all[1][i] - all[0][i]));
  }

  std::vector<int> tags(const GeometryGroup& group, int dimension) const {
    if (!group.numbers.empty()) return by_number(group, dimension);
    return group.label.empty() ? by_box(group, dimension) : by_label(group, dimension);
  }

 private:
  static constexpr double k_slack = 1e-6;  ///< of the model: Gmsh's bounding boxes are a little large

  [[noreturn]] void refuse(const GeometryGroup& group, const std::string& what,
                           const std::string& allowed) const {
    throw InputError({path_}, "the group '" + group.name + "': " + what, allowed);
  }
  static std::string kind(const GeometryGroup& group) { return group.bodies ? "body" : "surface"; }

  std::vector<int> by_number(const GeometryGroup& group, int dimension) const {
    const std::vector<int> there = entities(dimension);
    for (const int number : group.numbers)
      if (std::find(there.begin(), there.end(), number) == there.end())
        refuse(group, "the geometry has no " + kind(group) + " " + std::to_string(number),
               there.empty() ? "" : std::to_string(there.front()) + " to " + std::to_string(there.back()));
    return group.numbers;
  }

  /// A label fits as a whole or by its last part; labels of the file are listed where none fits.
  std::vector<int> by_label(const GeometryGroup& group, int dimension) const {
    std::vector<int> found;
    std::set<std::string> labels;
    for (const int tag : entities(dimension)) {
      std::string whole;
      gmsh::model::getEntityName(dimension, tag, whole);
      const std::string label = short_label(dimension, tag);
      if (!label.empty()) labels.insert(label);
      if (label == group.label || whole == group.label) found.push_back(tag);
    }
    if (found.empty())
      refuse(group, "no " + kind(group) + " of the geometry is labelled '" + group.label + "'",
             labels.empty() ? "numbers or a box: the file has no labels"
                            : one_of({labels.begin(), labels.end()}, group.label));
    return found;
  }

  /// Entities whose whole bounding box lies in that of the group, with room for the slack of Gmsh's boxes.
  std::vector<int> by_box(const GeometryGroup& group, int dimension) const {
    std::vector<int> found;
    for (const int tag : entities(dimension)) {
      const std::array<Point, 2> box = bounding_box(dimension, tag);
      bool inside = true;
      for (std::size_t i = 0; i < 3; ++i)
        inside = inside && box[0][i] >= (*group.box)[0][i] / unit_ - slack_ &&
                 box[1][i] <= (*group.box)[1][i] / unit_ + slack_;
      if (inside) found.push_back(tag);
    }
    if (found.empty())
      refuse(group, "no " + kind(group) + " of the geometry lies in the box",
             "a larger box; `solidus mesh-info` shows the extent of the geometry");
    return found;
  }

  const std::string& path_;
  double unit_, slack_ = 0;
};

/// Names for the entities that belong to no group.
void name_the_rest(int full) {
  std::map<std::string, int> labels;
  for (const int tag : entities(full)) ++labels[short_label(full, tag)];
  for (const int tag : entities(full)) {
    const std::string label = short_label(full, tag);
    const bool unique = !label.empty() && labels.at(label) == 1;
    if (!has_group(full, tag)) add_group(full, {tag}, unique ? label : "body_" + std::to_string(tag));
  }
  for (const int tag : entities(full - 1))
    if (!has_group(full - 1, tag)) add_group(full - 1, {tag}, "surface_" + std::to_string(tag));
}

}  // namespace

void make_geometry_groups(const std::string& path, const GeometryChoice& choice, double unit_in_metres,
                          bool from_cad) {
  // Faces in one place become one, so that bodies share their nodes.
  if (choice.conforming) {
    gmsh::model::occ::removeAllDuplicates();
    gmsh::model::occ::synchronize();
  }
  // Bodies are entities of the full dimension, surfaces of one below; an entity is in one body at most.
  const int full = entities(3).empty() ? 2 : 3;
  const Choice choose(path, unit_in_metres);
  // Each group chooses its entities; a body belongs to one group only.
  for (const GeometryGroup& group : choice.groups) {
    const int dimension = group.bodies ? full : full - 1;
    const std::vector<int> tags = choose.tags(group, dimension);
    for (const int tag : tags)
      if (group.bodies && has_group(dimension, tag))
        throw InputError({path}, "the body " + std::to_string(tag) + " is in two groups, one of them '" +
                                     group.name + "'");
    add_group(dimension, tags, group.name);
  }
  if (from_cad) name_the_rest(full);
}

}  // namespace solidus::mesh
