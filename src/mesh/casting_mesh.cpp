// One way to mesh parts and mould, in the reader's process (mesh/casting_geometry.hpp).
#include <gmsh.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "input/keys.hpp"
#include "mesh/casting_geometry.hpp"
#include "mesh/geometry_groups.hpp"
#include "mesh/size_field.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

namespace occ = gmsh::model::occ;

/// A way to mesh.
struct Way {
  const char* what;
  int surfaces = 6, volumes = 1;  ///< Gmsh's numbers of algorithms: frontal, Delaunay
  double healing = 0;             ///< tolerance, of the extent of the parts; 0: none
  double scale = 1;               ///< of all sizes
  int rounds = 1;                 ///< of optimisation
};
constexpr Way k_ways[] = {
    {"as the file is, Delaunay"},
    {"HXT", 6, 10},
    {"elements of 0.9 of the size", 6, 1, 0, 0.9, 4},
    {"healed, elements of 0.8 of the size", 6, 1, 1e-5, 0.8, 4},
    {"healed more, surfaces by MeshAdapt, elements of 0.7 of the size", 1, 1, 1e-4, 0.7, 4},
    {"surfaces by Delaunay, HXT, elements of half the size", 5, 10, 0, 0.5, 4},
    {"healed much, elements of half the size", 6, 1, 1e-3, 0.5, 4}};

using Tags = std::vector<int>;

struct Extent {
  Point low, high;
  double diagonal() const { return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]); }
};

Extent extent_of(const gmsh::vectorpair& entities) {
  constexpr double k_huge = 1e300;
  Extent all{{k_huge, k_huge, k_huge}, {-k_huge, -k_huge, -k_huge}};
  for (const auto& [dimension, tag] : entities) {
    Point low{}, high{};
    occ::getBoundingBox(dimension, tag, low[0], low[1], low[2], high[0], high[1], high[2]);
    for (std::size_t i = 0; i < 3; ++i) {
      all.low[i] = std::min(all.low[i], low[i]);
      all.high[i] = std::max(all.high[i], high[i]);
    }
  }
  return all;
}

gmsh::vectorpair volumes() {
  gmsh::vectorpair all;
  occ::getEntities(all, 3);
  return all;
}

/// The last part of a label, with characters that group names do well with; empty for a label that a kernel
/// made up.
std::string tidy_label(int volume) {
  std::string label;
  gmsh::model::getEntityName(3, volume, label);
  while (!label.empty() && label.back() == '/') label.pop_back();
  label = label.substr(label.find_last_of('/') + 1);
  if (label.starts_with("Open CASCADE") || label == "SOLID" || label == "Solid") return "";
  std::replace_if(
      label.begin(), label.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '-'; }, '_');
  return label;
}

/// A body of the file: its volumes change their numbers on the way.
struct Part {
  std::string name;
  gmsh::vectorpair volumes;
};

class Maker {
 public:
  Maker(const MeshSource& source, const CastingGeometry& geometry)
      : source_(source),
        geometry_(geometry),
        way_(
            k_ways[std::min<std::size_t>(static_cast<std::size_t>(geometry.attempt), std::size(k_ways) - 1)]),
        unit_(source.unit_in_metres) {}

  void make() {
    close_shells();
    if (way_.healing > 0) heal();
    name_parts();
    if (geometry_.symmetry) halve();
    fragment();
    occ::synchronize();
    make_groups();
    mesh();
  }

 private:
  [[noreturn]] void refuse(const std::string& what, const std::string& allowed = {}) const {
    throw InputError({source_.path}, what, allowed);
  }

  /// Shells without a solid are sewn and filled.
  void close_shells() {
    if (!volumes().empty()) return;
    gmsh::vectorpair surfaces, made;
    occ::getEntities(surfaces, 2);
    if (surfaces.empty()) refuse("the geometry has no surfaces");
    const double tolerance = 1e-4 * extent_of(surfaces).diagonal();
    occ::healShapes(made, surfaces, tolerance, true, true, true, true, true);
    occ::remove(surfaces, true);
    occ::synchronize();
    if (volumes().empty())
      refuse("the geometry has surfaces but no solid, and they do not close to one",
             "a file with solids, or closed shells with gaps below 0.01 % of the extent");
  }

  void heal() {
    gmsh::vectorpair made;
    const gmsh::vectorpair before = volumes();
    std::map<int, std::string> labels;
    for (const auto& [dimension, tag] : before) labels[tag] = tidy_label(tag);
    for (const auto& volume : before) {
      gmsh::vectorpair one;
      occ::healShapes(one, {volume}, way_.healing * extent_of({volume}).diagonal(), true, true, true, true,
                      true);
      for (const auto& [dimension, tag] : one)
        if (dimension == 3 && tag != volume.second) healed_label_[tag] = labels[volume.second];
    }
    for (const auto& volume : before)
      if (healed_label_.size() == before.size()) occ::remove({volume}, true);
    occ::synchronize();
    if (volumes().empty()) refuse("healing the geometry left no solid");
  }

  std::string label_of(int volume) const {
    const auto healed = healed_label_.find(volume);
    return healed != healed_label_.end() ? healed->second : tidy_label(volume);
  }

  /// By the groups of the case, by labels, or as body_1, body_2, …
  void name_parts() {
    std::map<std::string, int> labels;
    const gmsh::vectorpair all = volumes();
    for (const auto& [dimension, tag] : all) ++labels[label_of(tag)];
    std::map<std::string, int> used;
    int number = 0;
    for (const auto& volume : all) {
      ++number;
      std::string name;
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
      const auto same =
          std::find_if(parts_.begin(), parts_.end(), [&](const Part& p) { return p.name == name; });
      if (same != parts_.end())
        same->volumes.push_back(volume);
      else
        parts_.push_back({name, {volume}});
    }
    for (const GeometryGroup& group : source_.geometry.groups) {
      if (!group.bodies)
        refuse("the group '" + group.name +
                   "' chooses surfaces by their numbers, which change where parts "
                   "and mould are meshed together",
               "a rule: owner, normal, plane, nearest");
      if (std::none_of(parts_.begin(), parts_.end(), [&](const Part& p) { return p.name == group.name; }))
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
    const auto axis = static_cast<std::size_t>(geometry_.symmetry->axis);
    Extent box = extent_of(volumes());
    const double margin = box.diagonal(), at = geometry_.symmetry->at / unit_;
    if (!(at > box.low[axis] && at < box.high[axis]))
      refuse("the plane of symmetry does not cut the geometry");
    for (std::size_t i = 0; i < 3; ++i) box.low[i] -= margin, box.high[i] += margin;
    box.high[axis] = at;
    for (Part& part : parts_) {
      const int tool = occ::addBox(box.low[0], box.low[1], box.low[2], box.high[0] - box.low[0],
                                   box.high[1] - box.low[1], box.high[2] - box.low[2]);
      gmsh::vectorpair kept;
      std::vector<gmsh::vectorpair> map;
      occ::intersect(part.volumes, {{3, tool}}, kept, map);
      part.volumes.clear();
      for (const auto& entity : kept)
        if (entity.first == 3) part.volumes.push_back(entity);
    }
    std::erase_if(parts_, [](const Part& part) { return part.volumes.empty(); });
  }

  /// Cuts all bodies, riser and mould with each other, so that they share the faces in which they touch.
  void fragment() {
    gmsh::vectorpair objects, tools, out;
    std::vector<gmsh::vectorpair> map;
    std::vector<std::size_t> part_of;  // of each object
    for (std::size_t p = 0; p < parts_.size(); ++p)
      for (const auto& volume : parts_[p].volumes) objects.push_back(volume), part_of.push_back(p);
    int riser = -1, block = -1;
    if (geometry_.riser) {
      const RiserCylinder& r = *geometry_.riser;
      riser = occ::addCylinder(r.foot[0] / unit_, r.foot[1] / unit_, r.foot[2] / unit_, 0, 0,
                               r.height / unit_, r.diameter / unit_ / 2);
      if (geometry_.symmetry) riser = half_of(riser);
      tools.emplace_back(3, riser);
    }
    if (geometry_.mould) {
      block = add_block();
      tools.emplace_back(3, block);
    }
    if (objects.size() + tools.size() < 2) return;
    if (tools.empty()) {
      tools.push_back(objects.back());
      objects.pop_back();
    }
    occ::fragment(objects, tools, out, map);
    std::set<int> taken;
    const auto take = [&](std::size_t input) {
      gmsh::vectorpair pieces;
      for (const auto& piece : map[input])
        if (piece.first == 3 && taken.insert(piece.second).second) pieces.push_back(piece);
      return pieces;
    };
    for (Part& part : parts_) part.volumes.clear();
    for (std::size_t i = 0; i < part_of.size(); ++i) {
      const gmsh::vectorpair pieces = take(i);
      gmsh::vectorpair& all = parts_[part_of[i]].volumes;
      all.insert(all.end(), pieces.begin(), pieces.end());
    }
    std::size_t next = part_of.size();
    if (riser >= 0) parts_.push_back({geometry_.riser->name, take(next++)});
    if (block >= 0) sort_mould(take(next));
    for (const Part& part : parts_)
      if (part.volumes.empty())
        refuse("nothing is left of the body '" + part.name + "' beside the others: they overlap",
               "bodies that touch and do not overlap");
  }

  int half_of(int volume) {
    const auto axis = static_cast<std::size_t>(geometry_.symmetry->axis);
    Extent box = extent_of({{3, volume}});
    for (std::size_t i = 0; i < 3; ++i) {
      const double margin = box.high[i] - box.low[i];
      box.low[i] -= margin, box.high[i] += margin;
    }
    box.high[axis] = geometry_.symmetry->at / unit_;
    const int tool = occ::addBox(box.low[0], box.low[1], box.low[2], box.high[0] - box.low[0],
                                 box.high[1] - box.low[1], box.high[2] - box.low[2]);
    gmsh::vectorpair kept;
    std::vector<gmsh::vectorpair> map;
    occ::intersect({{3, volume}}, {{3, tool}}, kept, map);
    if (kept.empty()) refuse("the riser lies beyond the plane of symmetry");
    return kept.front().second;
  }

  int add_block() {
    gmsh::vectorpair inside = volumes();
    block_ = extent_of(inside);
    // Bounding boxes are a little large, and a face of the mould must lie in that of the part.
    for (std::size_t i = 0; i < 3; ++i) {
      const double low = geometry_.mould->walls[2 * i] / unit_,
                   high = geometry_.mould->walls[2 * i + 1] / unit_;
      block_.low[i] -= low > 0 ? low : -k_slack;
      block_.high[i] += high > 0 ? high : -k_slack;
    }
    if (geometry_.symmetry)
      block_.high[static_cast<std::size_t>(geometry_.symmetry->axis)] = geometry_.symmetry->at / unit_;
    return occ::addBox(block_.low[0], block_.low[1], block_.low[2], block_.high[0] - block_.low[0],
                       block_.high[1] - block_.low[1], block_.high[2] - block_.low[2]);
  }

  /// Pieces of the block that reach one of its walls are mould, others lie in cavities.
  void sort_mould(const gmsh::vectorpair& pieces) {
    Part mould{geometry_.mould->name, {}};
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
    parts_.push_back(mould);
    for (std::size_t c = 0; c < cores.size(); ++c)
      parts_.push_back(
          {geometry_.mould->core + (cores.size() > 1 ? "_" + std::to_string(c + 1) : ""), {cores[c]}});
  }

  void make_groups() {
    for (const Part& part : parts_) {
      Tags tags;
      for (const auto& volume : part.volumes) tags.push_back(volume.second);
      gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, tags), part.name);
    }
    for (const BodySize& s : geometry_.sizes)
      if (std::none_of(parts_.begin(), parts_.end(), [&](const Part& p) { return p.name == s.body; })) {
        std::vector<std::string> names;
        for (const Part& part : parts_) names.push_back(part.name);
        refuse("[[mesh.size]] is of the body '" + s.body + "', which the geometry does not have",
               one_of(names, s.body));
      }
  }

  const BodySize* size_of(const std::string& body) const {
    for (const BodySize& s : geometry_.sizes)
      if (s.body == body) return &s;
    return geometry_.sizes.empty() ? nullptr : &geometry_.sizes.front();
  }

  static Tags boundary_of(int volume) {
    gmsh::vectorpair faces;
    gmsh::model::getBoundary({{3, volume}}, faces, false, false, false);
    Tags tags;
    for (const auto& face : faces) tags.push_back(std::abs(face.second));
    return tags;
  }

  /// The largest size of every entity: the least of the bodies that it belongs to.
  void limit_entities() {
    const auto note = [&](int dimension, int tag, double limit) {
      const auto [place, is_new] = limit_.emplace(std::pair(dimension, tag), limit);
      if (!is_new) place->second = std::min(place->second, limit);
    };
    for (const Part& part : parts_) {
      const BodySize* size = size_of(part.name);
      if (size == nullptr) continue;
      for (const auto& volume : part.volumes) {
        const double limit = way_.scale * size->size / unit_;
        note(3, volume.second, limit);
        growth_[volume.second] = size->growth;
        gmsh::vectorpair faces, curves, points;
        gmsh::model::getBoundary({volume}, faces, false, false, false);
        gmsh::model::getBoundary(faces, curves, false, false, false);
        gmsh::model::getBoundary(curves, points, false, false, false);
        for (const auto& list : {faces, curves, points})
          for (const auto& entity : list) note(entity.first, std::abs(entity.second), limit);
      }
    }
  }

  /// Triangles of the first, coarse mesh of a volume's faces, outward.
  std::vector<std::array<Point, 3>> skin_of(int volume) const {
    std::vector<std::array<Point, 3>> skin;
    std::vector<std::size_t> first{0};  // triangle of each face
    for (const int face : boundary_of(volume)) {
      std::vector<std::size_t> elements, nodes;
      gmsh::model::mesh::getElementsByType(2, elements, nodes, face);
      for (std::size_t k = 0; k + 2 < nodes.size(); k += 3)
        skin.push_back({x_.at(nodes[k]), x_.at(nodes[k + 1]), x_.at(nodes[k + 2])});
      first.push_back(skin.size());
    }
    // Triangles follow the face and not the volume. Of some of each face it is seen whether they look inward.
    for (std::size_t f = 0; f + 1 < first.size(); ++f) {
      constexpr std::size_t k_votes = 5;
      const std::size_t n = first[f + 1] - first[f], stride = 1 + n / k_votes;
      std::size_t inward = 0, votes = 0;
      for (std::size_t t = first[f]; t < first[f + 1]; t += stride, ++votes)
        inward += looks_inward(skin, t) ? 1U : 0U;
      if (2 * inward > votes)
        for (std::size_t t = first[f]; t < first[f + 1]; ++t) std::swap(skin[t][1], skin[t][2]);
    }
    return skin;
  }

  void read_nodes() {
    std::vector<std::size_t> tags;
    std::vector<double> x, parametric;
    gmsh::model::mesh::getNodes(tags, x, parametric);
    x_.clear();
    for (std::size_t i = 0; i < tags.size(); ++i) x_[tags[i]] = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
  }

  /// Measures the thickness of the walls on a first mesh of the surfaces.
  std::vector<SizeSample> samples() {
    std::vector<SizeSample> all;
    read_nodes();
    for (const Part& part : parts_) {
      const BodySize* size = size_of(part.name);
      if (size == nullptr) continue;
      for (const auto& volume : part.volumes) {
        const auto skin = skin_of(volume.second);
        const std::vector<double> thickness =
            size->across > 0 ? wall_thickness(skin) : std::vector<double>(skin.size(), 0.0);
        const double largest = way_.scale * size->size / unit_,
                     smallest = way_.scale * size->smallest / unit_;
        for (std::size_t t = 0; t < skin.size(); ++t)
          all.push_back({skin[t], thickness[t] > 0 ? std::clamp(way_.scale * thickness[t] / size->across,
                                                                smallest, largest)
                                                   : largest});
      }
    }
    sample_narrow_faces(all);
    sample_short_curves(all);
    return all;
  }

  /// On a face that is narrower than an element, of the width 2 area / boundary, elements are as small.
  void sample_narrow_faces(std::vector<SizeSample>& all) const {
    constexpr double k_least =
        0.25;  // of the limit: steps of a hundredth of a part would take most of its nodes
    for (const auto& [entity, limit] : limit_) {
      if (entity.first != 2) continue;
      double area = 0, around = 0;
      occ::getMass(2, entity.second, area);
      gmsh::vectorpair curves;
      gmsh::model::getBoundary({entity}, curves, false, false, false);
      for (const auto& [dimension, tag] : curves) {
        double length = 0;
        occ::getMass(1, std::abs(tag), length);
        around += length;
      }
      const double width = around > 0 ? 2 * area / around : limit;
      if (!(width > 0) || width > limit) continue;
      std::vector<std::size_t> elements, nodes;
      gmsh::model::mesh::getElementsByType(2, elements, nodes, entity.second);
      for (std::size_t k = 0; k + 2 < nodes.size(); k += 3)
        all.push_back(
            {{x_.at(nodes[k]), x_.at(nodes[k + 1]), x_.at(nodes[k + 2])}, std::max(width, k_least * limit)});
    }
  }

  /// Next to a curve that is shorter than an element, elements are as small as the curve: else they are
  /// slivers.
  void sample_short_curves(std::vector<SizeSample>& all) const {
    constexpr double k_least = 0.12;  // of the limit: what is shorter is not worth its elements
    for (const auto& [entity, limit] : limit_) {
      if (entity.first != 1) continue;
      double length = 0;
      occ::getMass(1, entity.second, length);
      if (!(length > 0) || length > limit) continue;
      gmsh::vectorpair ends;
      gmsh::model::getBoundary({entity}, ends, false, false, false);
      for (const auto& [dimension, tag] : ends) {
        std::vector<double> x;
        gmsh::model::getValue(0, std::abs(tag), {}, x);
        const Point p = {x[0], x[1], x[2]};
        all.push_back({{p, p, p}, std::max(length, k_least * limit)});
      }
    }
  }

  void mesh() {
    using gmsh::option::setNumber;
    setNumber("Mesh.MeshSizeFromPoints", 0);
    setNumber("Mesh.MeshSizeFromCurvature", 0);
    setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
    setNumber("Mesh.Algorithm", way_.surfaces);
    setNumber("Mesh.Algorithm3D", way_.volumes);
    setNumber("Mesh.MaxNumThreads3D", 1);
    setNumber("Mesh.OptimizeThreshold", 0.45);
    if (source_.element_order == 2) setNumber("Mesh.SecondOrderIncomplete", 1);
    limit_entities();
    const Extent all = extent_of(volumes());
    double coarse = all.diagonal() / (geometry_.sizes.empty() ? 35 : 20);
    for (const auto& [entity, limit] : limit_)
      if (entity.first == 2) coarse = std::min(coarse, limit);
    coarse = std::max(coarse, parts_extent() / 40);
    try {
      setNumber("Mesh.MeshSizeMin", coarse);
      setNumber("Mesh.MeshSizeMax", coarse);
      gmsh::model::mesh::generate(2);
      const std::vector<SizeSample> sampled = samples();
      std::map<double, SizeField> fields;
      for (const auto& [volume, growth] : growth_)
        if (!fields.contains(growth)) fields.emplace(growth, SizeField(all.low, all.high, sampled, growth));
      const SizeField* least = fields.empty() ? nullptr : &fields.begin()->second;
      gmsh::model::mesh::setSizeCallback([&](int dimension, int tag, double x, double y, double z) {
        const auto limit = limit_.find({dimension, tag});
        double size = limit != limit_.end() ? limit->second : coarse;
        if (least == nullptr) return size;
        const SizeField& field = dimension == 3 ? fields.at(growth_.at(tag)) : *least;
        return std::min(size, field.at({x, y, z}));
      });
      setNumber("Mesh.MeshSizeMin", 0);
      setNumber("Mesh.MeshSizeMax", 1e22);
      gmsh::model::mesh::clear();
      gmsh::model::mesh::generate(3);
      for (int round = 0; round < way_.rounds; ++round) {
        gmsh::model::mesh::optimize("Relocate3D", true);
        gmsh::model::mesh::optimize("", true);
      }
      gmsh::model::mesh::removeSizeCallback();
      gmsh::model::mesh::setOrder(source_.element_order);
    } catch (const std::string& complaint) {
      refuse("Gmsh could not mesh the geometry: " + complaint + place_of_complaints());
    }
    for (const Part& part : parts_)
      for (const auto& volume : part.volumes) {
        std::vector<int> types;
        std::vector<std::vector<std::size_t>> elements, nodes;
        gmsh::model::mesh::getElements(types, elements, nodes, 3, volume.second);
        if (types.empty())
          refuse("Gmsh made no elements in the body '" + part.name + "'" + place_of_complaints());
      }
  }

  double parts_extent() const {
    gmsh::vectorpair parts;
    for (const Part& part : parts_)
      if (!geometry_.mould || part.name != geometry_.mould->name)
        parts.insert(parts.end(), part.volumes.begin(), part.volumes.end());
    return extent_of(parts).diagonal();
  }

  /// "; at fault: face 12 of 'casting' at (1, 2, 3)", by the surfaces that Gmsh names when it complains.
  std::string place_of_complaints() const {
    std::vector<std::string> log;
    gmsh::logger::get(log);
    std::set<int> faces;
    std::string last;
    for (const std::string& line : log) {
      if (!line.starts_with("Error") && !line.starts_with("Warning")) continue;
      if (line.starts_with("Error")) last = line;
      for (std::size_t at = line.find("urface "); at != std::string::npos; at = line.find("urface ", at + 1))
        if (const int tag = std::atoi(line.c_str() + at + 7); tag > 0) faces.insert(tag);
    }
    std::string text;
    std::size_t said = 0;
    for (const int face : faces) {
      constexpr std::size_t k_most = 4;
      if (said == k_most) break;
      std::string owner;
      for (const Part& part : parts_)
        for (const auto& volume : part.volumes) {
          const Tags boundary = boundary_of(volume.second);
          if (std::find(boundary.begin(), boundary.end(), face) != boundary.end() && owner.empty())
            owner = part.name;
        }
      if (owner.empty()) continue;
      Point low{}, high{};
      gmsh::model::getBoundingBox(2, face, low[0], low[1], low[2], high[0], high[1], high[2]);
      char place[160];
      std::snprintf(place, sizeof place, "%s a face of '%s' around (%.4g, %.4g, %.4g), %.3g long",
                    said++ == 0 ? "; at fault:" : ",", owner.c_str(), (low[0] + high[0]) / 2,
                    (low[1] + high[1]) / 2, (low[2] + high[2]) / 2,
                    std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]));
      text += place;
    }
    return (last.empty() ? "" : " (" + last + ")") + text;
  }

  static constexpr double k_slack = 1e-7;  ///< margin of bounding boxes of Gmsh, in units of the file

  const MeshSource& source_;
  const CastingGeometry& geometry_;
  const Way& way_;
  double unit_;
  std::vector<Part> parts_;
  std::map<int, std::string> healed_label_;
  Extent block_{};
  std::map<std::pair<int, int>, double> limit_;  ///< largest size by dimension and number
  std::map<int, double> growth_;                 ///< by volume
  std::map<std::size_t, Point> x_;
};

}  // namespace

int n_meshing_attempts() {
  return static_cast<int>(std::size(k_ways));
}

std::string meshing_attempt(int attempt) {
  return k_ways[static_cast<std::size_t>(attempt)].what;
}

void make_casting_mesh(const MeshSource& source, const CastingGeometry& geometry) {
  Maker(source, geometry).make();
}

}  // namespace solidus::mesh
