#include "mesh/gmsh/feeder_solids.hpp"

#include <algorithm>
#include <cmath>

namespace solidus::mesh {

namespace {

namespace occ = gmsh::model::occ;

/// Solids that overlap or touch, as one.
int united(int first, int second) {
  gmsh::vectorpair out;
  std::vector<gmsh::vectorpair> map;
  // Solids in one another would be divided at their common faces and give bodies of their own.
  occ::fuse({{3, first}}, {{3, second}}, out, map);
  return out.front().second;
}

/// An upright cylinder between two heights [m].
int upright(const Point& centre, double low, double high, double diameter, double unit) {
  return occ::addCylinder(centre[0] / unit, centre[1] / unit, low / unit, 0, 0, (high - low) / unit,
                          diameter / unit / 2);
}

/// A neck from the axis of a riser to a point of the part, level as far as the point is not below or above
/// the riser.
int neck_to_the_side(const RiserCylinder& r, double unit) {
  const Point& to = *r.neck_to;
  // The neck stays within the height of the riser by half of its own width, or it would stick out at the foot
  // or the top.
  const double half = std::min(0.5 * r.neck_diameter, 0.5 * r.height);
  const double z = std::clamp(to[2], r.foot[2] + half, r.foot[2] + r.height - half);
  return occ::addCylinder(r.foot[0] / unit, r.foot[1] / unit, z / unit, (to[0] - r.foot[0]) / unit,
                          (to[1] - r.foot[1]) / unit, (to[2] - z) / unit, r.neck_diameter / unit / 2);
}

int riser_solid(const RiserCylinder& r, double unit) {
  const double foot = r.foot[2], top = foot + r.height, wide = foot + r.neck_height;
  if (r.neck_to) return united(upright(r.foot, foot, top, r.diameter, unit), neck_to_the_side(r, unit));
  // Without a neck that is narrower than the riser one cylinder is enough; two of the same width would leave
  // a seam.
  if (!(r.neck_height > 0) || !(r.neck_diameter < r.diameter))
    return upright(r.foot, foot, top, r.diameter, unit);
  return united(upright(r.foot, foot, wide, r.neck_diameter, unit),
                upright(r.foot, wide, top, r.diameter, unit));
}

/// Ingate, runner and sprue as one solid.
int gating_solid(const GatingSystem& g, double unit) {
  const double x = g.gate[0] / unit, y = g.gate[1] / unit, floor = g.floor() / unit;
  const double along = std::hypot(g.top[0] - g.gate[0], g.top[1] - g.gate[1]) / unit;
  const double beyond = 0.5 * std::max(g.foot_diameter, g.runner_width) / unit;
  const double length = g.gate_length / unit;
  // Ingate and runner are drawn along x and then turned about the upright line through the gate.
  const int ingate =
      occ::addBox(x, y - 0.5 * g.gate_width / unit, floor, length, g.gate_width / unit, g.gate_height / unit);
  const int runner = occ::addBox(x + length, y - 0.5 * g.runner_width / unit, floor, along + beyond - length,
                                 g.runner_width / unit, g.runner_height / unit);
  occ::rotate({{3, ingate}, {3, runner}}, x, y, floor, 0, 0, 1,
              std::atan2(g.top[1] - g.gate[1], g.top[0] - g.gate[0]));
  // The kernel makes no cone of two equal ends.
  const double high = g.top[2] / unit - floor, foot = g.foot_diameter / unit / 2,
               top = g.top_diameter / unit / 2;
  const int sprue = foot == top
                        ? upright(g.top, g.floor(), g.top[2], g.top_diameter, unit)
                        : occ::addCone(g.top[0] / unit, g.top[1] / unit, floor, 0, 0, high, foot, top);
  return united(united(ingate, runner), sprue);
}

}  // namespace

std::vector<AddedBody> add_feeders(const CastingGeometry& geometry, double unit,
                                   const std::function<int(int)>& kept) {
  std::vector<AddedBody> added;
  // Risers go first, so that they keep the space that they share with sleeves and chills.
  for (const RiserCylinder& r : geometry.risers) added.push_back({r.name, kept(riser_solid(r, unit))});
  for (const GatingSystem& g : geometry.gatings) added.push_back({g.name, kept(gating_solid(g, unit))});
  // The riser keeps the inside of its sleeve.
  for (const RiserCylinder& r : geometry.risers)
    if (r.sleeve > 0)
      added.push_back(
          {r.name + "_sleeve", kept(upright(r.foot, r.foot[2] + r.neck_height, r.foot[2] + r.height,
                                            r.diameter + 2 * r.sleeve, unit))});
  for (const ChillBlock& c : geometry.chills)
    added.push_back({c.name, kept(occ::addBox(c.low[0] / unit, c.low[1] / unit, c.low[2] / unit,
                                              (c.high[0] - c.low[0]) / unit, (c.high[1] - c.low[1]) / unit,
                                              (c.high[2] - c.low[2]) / unit))});
  return added;
}

}  // namespace solidus::mesh
