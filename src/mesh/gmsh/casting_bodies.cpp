// Makes the bodies of a casting, its risers and its mould out of a geometry (mesh/gmsh/casting_parts.hpp).
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <map>
#include <set>

#include "mesh/gmsh/casting_parts.hpp"
#include "mesh/gmsh/closed_solids.hpp"
#include "mesh/gmsh/feeder_solids.hpp"
#include "mesh/gmsh/geometry_groups.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

namespace occ = gmsh::model::occ;

/// The last part of a label, with characters that group names do well with; empty for a label that a kernel
/// made up.
std::string tidy_label(int volume) {
  std::string label;
  gmsh::model::getEntityName(3, volume, label);
  while (!label.empty() && label.back() == '/') label.pop_back();
  label = label.substr(label.find_last_of('/') + 1);
  if (label.starts_with("Open CASCADE") || label == "SOLID" || label == "Solid" || label == "COMPOUND" ||
      label == "the product name" || label == "Rhino Product")
    return "";  // what programs write that know no name
  std::replace_if(
      label.begin(), label.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '-'; }, '_');
  return label;
}

class PartMaker {
 public:
  PartMaker(const MeshSource& source, const CastingGeometry& geometry, double healing)
      : source_(source), geometry_(geometry), healing_(healing), unit_(source.unit_in_metres) {}

  CastingParts make() {
    close_to_solids(source_);
    if (healing_ > 0) heal();
    name_parts();
    if (geometry_.symmetry) halve();
    fragment();
    occ::synchronize();
    return {std::move(parts_), std::move(overlap_)};
  }

 private:
  [[noreturn]] void refuse(const std::string& what, const std::string& allowed = {}) const {
    throw UnusableGeometry({source_.path}, what, allowed);
  }

  /// Heals each body by a tolerance of its own. Gmsh 4.8 adds the healed body and keeps the old one, which is
  /// removed here; later versions put it in the place of the old one, and list all other bodies with it.
  void heal() {
    // Each body is healed by a tolerance of its own size: one for all would heal small bodies away.
    const gmsh::vectorpair old = all_volumes();
    gmsh::vectorpair replaced;
    for (const auto& volume : old) {
      const std::string label = tidy_label(volume.second);
      const gmsh::vectorpair before = all_volumes();
      gmsh::vectorpair healed;
      occ::healShapes(healed, {volume}, healing_ * extent_of({volume}).diagonal(), true, true, true, true,
                      true);
      bool added = false;
      for (const auto& body : all_volumes())
        if (std::find(before.begin(), before.end(), body) == before.end()) {
          healed_label_[body.second] = label;
          added = true;
        }
      if (added) replaced.push_back(volume);
    }
    // The old bodies are removed once all have been healed.
    for (const auto& body : all_volumes())
      if (std::find(replaced.begin(), replaced.end(), body) != replaced.end()) occ::remove({body}, true);
    occ::synchronize();
    if (all_volumes().size() < old.size())
      throw InputError({source_.path}, "healing the geometry left no solid of one of its bodies");
  }

  std::string label_of(int volume) const {
    const auto healed = healed_label_.find(volume);
    return healed != healed_label_.end() ? healed->second : tidy_label(volume);
  }

  /// By the groups of the case, by labels, or as body_1, body_2, …
  void name_parts() {
    std::map<std::string, int> labels;
    // Groups of the case name volumes by number, label or place; else labels do, numbered where several
    // volumes have one.
    const gmsh::vectorpair all = all_volumes();
    for (const auto& [dimension, tag] : all) ++labels[label_of(tag)];
    std::map<std::string, int> used;
    int number = 0;
    for (const auto& volume : all) {
      ++number;
      std::string name;
      // A group of the case goes before a label of the file.
      for (const GeometryGroup& group : source_.geometry.groups)
        if (group.bodies && (std::count(group.numbers.begin(), group.numbers.end(), number) > 0 ||
                             (!group.label.empty() && group.label == label_of(volume.second)) ||
                             (group.box && lies_in(*group.box, volume))))
          name = group.name;
      const std::string label = label_of(volume.second);
      if (name.empty())
        name = label.empty()           ? "body_" + std::to_string(number)
               : labels.at(label) == 1 ? label
                                       : label + "_" + std::to_string(++used[label]);
      // Volumes of one name are one body.
      const auto same =
          std::find_if(parts_.begin(), parts_.end(), [&](const BodyVolumes& p) { return p.name == name; });
      if (same != parts_.end())
        same->volumes.push_back(volume);
      else
        parts_.push_back({name, {volume}});
    }
    // Groups that name no volume, or surfaces, are errors.
    for (const GeometryGroup& group : source_.geometry.groups) {
      if (!group.bodies)
        refuse("the group '" + group.name +
                   "' chooses surfaces by their numbers, which change where parts "
                   "and mould are meshed together",
               "a rule: owner, normal, plane, nearest");
      if (std::none_of(parts_.begin(), parts_.end(),
                       [&](const BodyVolumes& p) { return p.name == group.name; }))
        refuse("no body of the geometry fits the group '" + group.name + "'",
               "numbers 1 to " + std::to_string(number) + ", or a label of the file");
    }
  }

  bool lies_in(const std::array<Point, 2>& box, const std::pair<int, int>& volume) const {
    const Extent extent = extent_of({volume});
    const double slack = 1e-6 * extent.diagonal();
    for (std::size_t i = 0; i < 3; ++i)
      if (extent.low[i] < box[0][i] / unit_ - slack || extent.high[i] > box[1][i] / unit_ + slack)
        return false;
    return true;
  }

  void halve() {
    const auto axis = as_size(geometry_.symmetry->axis);
    // A box that reaches from outside to the plane is what is kept of each body.
    Extent box = extent_of(all_volumes());
    const double margin = box.diagonal(), at = geometry_.symmetry->at / unit_;
    if (!(at > box.low[axis] && at < box.high[axis]))
      refuse("the plane of symmetry does not cut the geometry");
    for (std::size_t i = 0; i < 3; ++i) box.low[i] -= margin, box.high[i] += margin;
    // What is kept lies below the plane.
    box.high[axis] = at;
    for (BodyVolumes& part : parts_) {
      const int tool = occ::addBox(box.low[0], box.low[1], box.low[2], box.high[0] - box.low[0],
                                   box.high[1] - box.low[1], box.high[2] - box.low[2]);
      gmsh::vectorpair kept;
      std::vector<gmsh::vectorpair> map;
      occ::intersect(part.volumes, {{3, tool}}, kept, map);
      part.volumes.clear();
      for (const auto& entity : kept)
        if (entity.first == 3) part.volumes.push_back(entity);
    }
    // A body on the other side of the plane is gone.
    std::erase_if(parts_, [](const BodyVolumes& part) { return part.volumes.empty(); });
  }

  /// Cuts all bodies, what is added to them and the mould with each other, so that they share the faces in
  /// which they touch.
  void fragment() {
    gmsh::vectorpair objects, tools, out;
    std::vector<gmsh::vectorpair> map;
    std::vector<std::size_t> part_of;  // of each object
    // Parts come first in the list, so that they keep what overlaps with what is added.
    for (std::size_t p = 0; p < parts_.size(); ++p)
      for (const auto& volume : parts_[p].volumes) objects.push_back(volume), part_of.push_back(p);
    // Risers, gating, chills and the block are made in the unit of the geometry.
    const std::vector<AddedBody> added =
        add_feeders(geometry_, unit_, [&](int volume) { return kept_half(volume); });
    for (const auto& [name, volume] : added) tools.emplace_back(3, volume);
    int block = -1;
    if (geometry_.mould) {
      block = add_block();
      tools.emplace_back(3, block);
    }
    if (objects.size() + tools.size() < 2) return;
    if (tools.empty()) {
      tools.push_back(objects.back());
      objects.pop_back();
    }
    // Each piece belongs to the first of those that it comes from.
    occ::fragment(objects, tools, out, map);
    // Overlaps are told before pieces are given away.
    note_overlaps(map, part_of);
    std::set<int> taken;
    const auto take = [&](std::size_t input) {
      gmsh::vectorpair pieces;
      for (const auto& piece : map[input])
        if (piece.first == 3 && taken.insert(piece.second).second) pieces.push_back(piece);
      return pieces;
    };
    // Pieces go to the first body that asks for them: parts, then the riser, then the mould.
    for (BodyVolumes& part : parts_) part.volumes.clear();
    for (std::size_t i = 0; i < part_of.size(); ++i) {
      const gmsh::vectorpair pieces = take(i);
      gmsh::vectorpair& all = parts_[part_of[i]].volumes;
      all.insert(all.end(), pieces.begin(), pieces.end());
    }
    const std::size_t n_parts = parts_.size();
    std::size_t next = part_of.size();
    for (const AddedBody& one : added) parts_.push_back({one.name, take(next++)});
    if (block >= 0) sort_mould(take(next));
    // A body without a piece lies within another one.
    for (std::size_t p = 0; p < parts_.size(); ++p)
      if (parts_[p].volumes.empty())
        refuse(
            "nothing is left of the body '" + parts_[p].name + "' next to the others: they overlap",
            p >= n_parts && p < n_parts + added.size()
                ? "the place of [[mesh.riser]], [[mesh.gating]] or [[mesh.chill]] outside of the parts; is "
                  "the unit of the file right?"
                : "bodies that touch and do not overlap");
  }

  /// @param pieces   of each volume of the file
  /// @param part_of  the body of each, of those that are of a body
  void note_overlaps(const std::vector<gmsh::vectorpair>& pieces, const std::vector<std::size_t>& part_of) {
    constexpr double k_cm3 = 1e6, k_sliver = 1e-4;  // of the smaller body: neighbours whose faces do not fit
    const std::size_t n = std::min(pieces.size(), part_of.size());
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j) {
        if (part_of[i] == part_of[j]) continue;
        const double of_i = volume_of(pieces[i]), of_j = volume_of(pieces[j]);
        gmsh::vectorpair both;
        for (const auto& piece : pieces[i])
          if (std::count(pieces[j].begin(), pieces[j].end(), piece) > 0) both.push_back(piece);
        const double common = volume_of(both), smaller = std::min(of_i, of_j);
        if (common < k_sliver * smaller || common > (1 - k_sliver) * smaller) continue;
        char text[32];
        std::snprintf(text, sizeof text, "%.3g", common * unit_ * unit_ * unit_ * k_cm3);
        overlap_ += (overlap_.empty() ? "'" : ", '") + parts_[part_of[i]].name + "' and '" +
                    parts_[part_of[j]].name + "' have " + text + " cm3 in common";
      }
  }

  static double volume_of(const gmsh::vectorpair& pieces) {
    double sum = 0, one = 0;
    for (const auto& [dimension, tag] : pieces)
      if (dimension == 3) occ::getMass(3, tag, one), sum += one;
    return sum;
  }

  /// What of a volume lies in the half that is kept; all of it without symmetry.
  int kept_half(int volume) {
    if (!geometry_.symmetry) return volume;
    const auto axis = as_size(geometry_.symmetry->axis);
    occ::synchronize();
    Extent box = extent_of({{3, volume}});
    for (std::size_t i = 0; i < 3; ++i) {
      const double margin = box.high[i] - box.low[i];
      box.low[i] -= margin, box.high[i] += margin;
    }
    box.high[axis] = geometry_.symmetry->at / unit_;
    if (!(box.high[axis] > box.low[axis]))
      refuse("a riser, gating or chill lies beyond the plane of symmetry");
    const int tool = occ::addBox(box.low[0], box.low[1], box.low[2], box.high[0] - box.low[0],
                                 box.high[1] - box.low[1], box.high[2] - box.low[2]);
    gmsh::vectorpair kept;
    std::vector<gmsh::vectorpair> map;
    occ::intersect({{3, volume}}, {{3, tool}}, kept, map);
    if (kept.empty()) refuse("a riser, gating or chill lies beyond the plane of symmetry");
    return kept.front().second;
  }

  int add_block() {
    gmsh::vectorpair inside = all_volumes();
    block_ = extent_of(inside);
    // Bounding boxes are a little large, and a face of the mould must lie in that of the part.
    for (std::size_t i = 0; i < 3; ++i) {
      const double low = geometry_.mould->walls[2 * i] / unit_,
                   high = geometry_.mould->walls[2 * i + 1] / unit_;
      block_.low[i] -= low > 0 ? low : -k_slack;
      block_.high[i] += high > 0 ? high : -k_slack;
    }
    if (geometry_.symmetry) block_.high[as_size(geometry_.symmetry->axis)] = geometry_.symmetry->at / unit_;
    return occ::addBox(block_.low[0], block_.low[1], block_.low[2], block_.high[0] - block_.low[0],
                       block_.high[1] - block_.low[1], block_.high[2] - block_.low[2]);
  }

  /// Pieces of the block that reach one of its walls are mould, others lie in cavities.
  void sort_mould(const gmsh::vectorpair& pieces) {
    // Where a wall has no thickness the mould ends with the parts, so that this side tells nothing.
    BodyVolumes mould{geometry_.mould->name, {}};
    gmsh::vectorpair cores;
    const double slack = 1e-5 * block_.diagonal();
    for (const auto& piece : pieces) {
      const Extent box = extent_of({piece});
      bool outside = false;
      for (std::size_t i = 0; i < 3; ++i) {
        outside = outside || (geometry_.mould->walls[2 * i] > 0 && box.low[i] < block_.low[i] + slack);
        outside = outside || (geometry_.mould->walls[2 * i + 1] > 0 && box.high[i] > block_.high[i] - slack);
      }
      (outside ? mould.volumes : cores).push_back(piece);
    }
    // Cores get a number each where there are several.
    parts_.push_back(mould);
    for (std::size_t c = 0; c < cores.size(); ++c)
      parts_.push_back(
          {geometry_.mould->core + (cores.size() > 1 ? "_" + std::to_string(c + 1) : ""), {cores[c]}});
  }

  static constexpr double k_slack = 1e-7;  ///< margin of bounding boxes of Gmsh, in units of the file

  const MeshSource& source_;
  const CastingGeometry& geometry_;
  double healing_, unit_;
  std::vector<BodyVolumes> parts_;
  std::string overlap_;
  std::map<int, std::string> healed_label_;
  Extent block_{};
};

}  // namespace

CastingParts make_parts(const MeshSource& source, const CastingGeometry& geometry, double healing) {
  return PartMaker(source, geometry, healing).make();
}

}  // namespace solidus::mesh
