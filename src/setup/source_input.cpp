/// A source is a distribution per watt, which its path moves, times its power.
#include "setup/source_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "numbers/index_casts.hpp"
#include "numbers/time_events.hpp"
#include "setup/section_names.hpp"

namespace solidus::setup {

namespace {

using Shape = heat::TravellingShape;

Position place(const std::vector<double>& x) {
  Position position{};
  std::copy_n(x.begin(), std::min<std::size_t>(x.size(), 3), position.begin());
  return position;
}

[[noreturn]] void refuse(const cases::SourceSpec& s, const std::string& what, const std::string& allowed) {
  throw InputError(s.where, fmt::format("the source '{}' {}", s.name, what), allowed);
}

void check_shape(const cases::SourceSpec& s) {
  // Each kind has sizes that nothing else can stand for.
  const auto need = [&](const std::optional<double>& size, const char* name) {
    if (!size) refuse(s, fmt::format("has no '{}'", name), fmt::format("{} = \"3 mm\"", name));
  };
  if (s.kind == Shape::Kind::double_ellipsoid)
    need(s.width, "width"), need(s.depth, "depth"), need(s.front, "front");
  else
    need(s.radius, "radius");
  if (s.kind == Shape::Kind::cylinder || s.kind == Shape::Kind::line) need(s.depth, "depth");
  if (s.direction.empty()) return;
  const Position d = place(s.direction);
  if (s.direction.size() < 2 || s.direction.size() > 3 || !(std::hypot(d[0], d[1], d[2]) > 0))
    refuse(s, "has no 'direction' of two or three components that lead anywhere", "direction = [0, 0, -1]");
}

}  // namespace

void check_path(const cases::PathSpec& path, const std::string& owner, const SourceLocation& where,
                int dimension) {
  const auto fail = [&](const char* what, const std::string& allowed) {
    throw InputError(where, fmt::format("{} {}", owner, what), allowed);
  };
  // Either a file or a line.
  const auto least = as_size(dimension);
  const bool line = !path.from.empty() || !path.to.empty() || path.speed;
  if (path.file.empty() != line)
    fail(line ? "has a file and a line for its path" : "has no path",
         "path = { file = \"path.csv\" }, or path = { from = [...], to = [...], speed = \"5 mm/s\" }");
  if (line &&
      (!path.speed || path.from.size() != path.to.size() || path.from.size() < least || path.from.size() > 3))
    fail("has no complete line for its path",
         fmt::format("from and to with {} coordinates each, and speed", dimension == 3 ? "3" : "2 or 3"));
  if (line && place(path.from) == place(path.to))
    fail("has a path without a length", "from and to that differ");
  // The file is read here too, so that its mistakes are found before a mesh is made.
  travel_path(path, dimension, where);  // its file
}

/// Refuses analyses in which a travelling source has no meaning, names that two columns would share, and
/// incomplete shapes and paths.
void check_sources(const cases::CaseSpec& spec) {
  check_names(spec.sources, "[[source]]");
  for (const cases::SourceSpec& s : spec.sources) {
    if (!spec.has_heat())
      refuse(s, "heats, and there is no heat in this analysis", "physics = \"heat\" or \"thermomechanical\"");
    if (spec.time.steady) refuse(s, "travels, and a steady analysis has no time for it", "steady = false");
    if (spec.analysis.kind == AnalysisKind::axisymmetric)
      refuse(s, "travels, and would be a ring in an axisymmetric analysis",
             "kind = \"solid\" in [analysis]; a [[thermal_condition]] with `moving` for rings");
    for (const cases::ThermalConditionSpec& c : spec.thermal_conditions)
      if (c.name == s.name)
        refuse(s, "has the name of a [[thermal_condition]]",
               "a name of its own: history.csv has both by name");
    if (s.groups.empty()) refuse(s, "heats nothing", "group = \"plate\"");
    check_shape(s);
    check_path(s.path, "the source '" + s.name + "'", s.where, spec.dimension());
  }
}

/// A line is a path of two points, at the end of which the source is off.
TravelPath travel_path(const cases::PathSpec& p, int dimension, const SourceLocation& where) {
  if (!p.file.empty()) return read_travel_path(p.file, dimension, p.start, where);
  const Position a = place(p.from), b = place(p.to);
  const double way = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  return TravelPath({{p.start, a, 1}, {p.start + way / *p.speed, b, 0}});
}

heat::TravellingShape travelling_shape(const cases::SourceSpec& s, int dimension) {
  heat::TravellingShape shape;
  shape.kind = s.kind;
  shape.radius = s.radius.value_or(0);
  shape.width = s.width.value_or(0);
  shape.depth = s.depth.value_or(0);
  shape.front = s.front.value_or(0);
  shape.rear = s.rear.value_or(shape.front);
  // Without a share the density has no jump between front and rear: each gets the power of its length.
  shape.front_share =
      s.front_share.value_or(shape.front > 0 ? shape.front / (shape.front + shape.rear) : 0.5);
  // The beam comes from above where no direction is given.
  shape.direction = {};
  shape.direction[as_size(dimension) - 1] = -1;
  if (s.direction.empty()) return shape;
  shape.direction = place(s.direction);
  const double length = std::hypot(shape.direction[0], shape.direction[1], shape.direction[2]);
  for (double& d : shape.direction) d /= length;
  return shape;
}

void add_sources(const cases::CaseSpec& spec, heat::ThermalConditions& conditions) {
  for (const cases::SourceSpec& s : spec.sources) {
    // The distribution carries the efficiency, since the factor of a condition is one function of time.
    const auto path = std::make_shared<const TravelPath>(travel_path(s.path, spec.dimension(), s.where));
    const PlaceFunction heat(std::make_shared<heat::TravellingHeat>(
        path, travelling_shape(s, spec.dimension()), s.efficiency.table, s.step_share));
    const PlaceFunction power(s.power.table);
    for (const std::string& group : s.groups) {
      if (s.on_surface())
        conditions.fluxes.push_back({s.name, group, heat, power});
      else
        conditions.sources.push_back({s.name, group, heat, power});
    }
  }
}

/// Times at which steps have to end: where the source is switched, and corners of its path.
std::vector<double> source_times(const cases::SourceSpec& source, int dimension, double from, double to) {
  constexpr double k_turn = 0.05;  // of the heading, or of the speed as a share
  const TravelPath path = travel_path(source.path, dimension, source.where);
  std::vector<double> times = path.switches();
  // Corners: where the way before and behind a point differ in direction or speed.
  const std::vector<TravelPoint>& p = path.points();
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    double change = 0, before = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double in = (p[i].x[k] - p[i - 1].x[k]) / (p[i].time - p[i - 1].time),
                   out = (p[i + 1].x[k] - p[i].x[k]) / (p[i + 1].time - p[i].time);
      change = std::max(change, std::abs(out - in));
      before = std::max({before, std::abs(in), std::abs(out)});
    }
    if (change > k_turn * before) times.push_back(p[i].time);
  }
  std::erase_if(times, [&](double t) { return t <= from || t >= to; });
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace solidus::setup
