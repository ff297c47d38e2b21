/// Shells that cross are united one after the other, from the first that is left, until the union crosses
/// no further one.
#include "mesh/cgal/united_shells.hpp"

#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/intersection.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#if __has_include(<CGAL/Polygon_mesh_processing/intersection_polylines.h>)  // from CGAL 6.2 on
#include <CGAL/Polygon_mesh_processing/intersection_polylines.h>
#endif
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "mesh/cgal/surface.hpp"
#include "mesh/making/casting_geometry.hpp"

namespace solidus::mesh {

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

/// Where two surfaces cross, for messages.
std::string place_of_crossing(const TriangleSurface& a, const TriangleSurface& b) {
  std::vector<std::vector<Kernel::Point_3>> lines;
  try {
    PMP::surface_intersection(a, b, std::back_inserter(lines));
  } catch (const std::exception&) {  // NOLINT: of surfaces that cross themselves; the box tells a place too
  }
  if (!lines.empty() && !lines.front().empty()) return place_text(lines.front().front());
  const CGAL::Bbox_3 box = PMP::bbox(b);
  return place_text({box.xmin(), box.ymin(), box.zmin()});
}

class Union {
 public:
  Union(const ClosedShells& all, const std::string& path) : all_(all), path_(path) {
    for (const Shell& shell : all.shells) {
      surfaces_.push_back(surface_of(all, shell));
      boxes_.push_back(PMP::bbox(surfaces_.back()));
    }
    taken_.resize(all.shells.size());
  }

  ClosedShells make(std::vector<std::string>& notes) {
    ClosedShells united;
    for (std::size_t s = 0; s < surfaces_.size(); ++s) {
      if (taken_[s]) continue;
      const std::string note = gather(s);
      if (!note.empty()) notes.push_back(note);
      append_shells(surfaces_[s], all_.shells[s].name, united);
    }
    nest_shells(united);
    return united;
  }

 private:
  bool cross(std::size_t a, std::size_t b) const {
    return CGAL::do_overlap(boxes_[a], boxes_[b]) && PMP::do_intersect(surfaces_[a], surfaces_[b]);
  }

  /// Unites a shell with all that cross it, and with those that cross the union.
  /// @return a sentence about it; empty where none does
  std::string gather(std::size_t first) {
    std::string place;
    std::size_t count = 1;
    double single = PMP::volume(surfaces_[first]);
    // Each shell that is left is tried against the union so far.
    for (std::size_t s = first + 1; s < surfaces_.size(); ++s) {
      if (taken_[s] || !cross(first, s)) continue;
      if (place.empty()) place = place_of_crossing(surfaces_[first], surfaces_[s]);
      check_pair(first, s);
      single += PMP::volume(surfaces_[s]);
      unite(first, s);
      taken_[s] = true;
      ++count;
      s = first;  // the union may cross shells that its first piece did not
    }
    if (count == 1) return {};
    // The volume that is lost to the union is what the shells had in common.
    const double common = single - PMP::volume(surfaces_[first]);
    return fmt::format(
        "{} closed skins that cross or touch each other, the first two near {}, are united; they had {:.3g} "
        "of "
        "{:.3g} cubic units of the file in common",
        count, place, std::max(common, 0.0), single);
  }

  void check_pair(std::size_t a, std::size_t b) const {
    const Shell &one = all_.shells[a], &other = all_.shells[b];
    const auto refuse = [&](const std::string& what) {
      throw UnusableGeometry({path_}, what + place_of_crossing(surfaces_[a], surfaces_[b]),
                             "bodies that lie clear of each other, or that are one and have one name");
    };
    if (one.name != other.name)
      refuse(fmt::format("the bodies '{}' and '{}' cross each other near ", one.name, other.name));
    if (one.looked_inward != other.looked_inward)
      refuse("a skin that looks inward, of a cavity, crosses one that looks outward near ");
  }

  void unite(std::size_t first, std::size_t next) {
    TriangleSurface result;
    bool valid = false;
    // Where skins cross themselves no union is defined; the message tells where.
    try {
      valid = PMP::corefine_and_compute_union(surfaces_[first], surfaces_[next], result,
                                              PMP::parameters::throw_on_self_intersection(true));
    } catch (const PMP::Corefinement::Self_intersection_exception&) {
      valid = false;
    }
    // The place of the crossing is looked for only where the union has failed.
    if (!valid)
      throw UnusableGeometry({path_},
                             "closed skins cross each other and cannot be united near " +
                                 place_of_crossing(surfaces_[first], surfaces_[next]),
                             "skins that do not cross themselves, or one skin");
    surfaces_[first] = std::move(result);
    boxes_[first] = PMP::bbox(surfaces_[first]);
  }

  const ClosedShells& all_;
  const std::string& path_;
  std::vector<TriangleSurface> surfaces_;
  std::vector<CGAL::Bbox_3> boxes_;
  std::vector<bool> taken_;  ///< is a part of one before
};

}  // namespace

ClosedShells united_shells(ClosedShells all, const std::string& path, std::vector<std::string>& notes) {
  if (all.shells.size() < 2) return all;
  const std::size_t before = notes.size();
  ClosedShells united = Union(all, path).make(notes);
  return notes.size() > before ? united : all;
}

}  // namespace solidus::mesh
