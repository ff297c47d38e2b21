/// Keys, overrides and paths of a point file, then the curves that it asks for.
#include "point/point_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "material/cards/library.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::point {

namespace {

namespace fs = std::filesystem;

ComponentRamp strain_ramp(std::optional<double> target, std::optional<double> rate) {
  return {{target, rate}, Control::strain};
}
ComponentRamp stress_ramp(std::optional<double> target, std::optional<double> rate) {
  return {{target, rate}, Control::stress};
}

/// The ramp of the loaded component of a test.
ComponentRamp loaded_ramp(const SegmentSpec& s) {
  const bool strain = s.strain || s.strain_rate, stress = s.stress || s.stress_rate;
  const int given = int{strain} + int{stress} + int{s.hold != Hold::nothing};
  if (given != 1)
    throw InputError(s.where,
                     given == 0 ? "the segment does not say what happens to the loaded component"
                                : "the segment says more than one thing about the loaded component",
                     "either strain and/or strain_rate, or stress and/or stress_rate, or hold");
  if (strain) return strain_ramp(s.strain, s.strain_rate);
  if (stress) return stress_ramp(s.stress, s.stress_rate);
  return {{}, s.hold == Hold::strain ? Control::strain : Control::stress};
}

std::array<ComponentRamp, 6> loaded_components(const SegmentSpec& s) {
  std::array<ComponentRamp, 6> ramps;
  ramps.fill(stress_ramp(0.0, {}));
  const ComponentRamp loaded = loaded_ramp(s);
  ramps[s.kind == SegmentKind::shear ? 3 : 0] = loaded;
  if (s.kind == SegmentKind::biaxial) {
    ramps[1] = loaded;
    if (loaded.target && loaded.rate) ramps[1].rate.reset();  // one of the two gives the duration
  }
  if (s.kind == SegmentKind::plane_strain) ramps[2] = strain_ramp({}, {});
  return ramps;
}

std::array<ComponentRamp, 6> named_components(const SegmentSpec& s) {
  std::array<ComponentRamp, 6> ramps;
  // Of each component one thing may be said; what is not named keeps its stress.
  for (int i = 0; i < 6; ++i) {
    const std::string name = k_component_names[i];
    const bool held = std::find(s.hold_strain.begin(), s.hold_strain.end(), name) != s.hold_strain.end();
    // A component may have its strain, its stress, or neither prescribed.
    const bool strain = s.strains.of(i) || s.strain_rates.of(i);
    const bool stress = s.stresses.of(i) || s.stress_rates.of(i);
    if (int{held} + int{strain} + int{stress} > 1)
      throw InputError(s.where, fmt::format("the segment says more than one thing about {}", name),
                       "its strain, its stress, or hold_strain");
    if (strain || held)
      ramps[as_size(i)] = strain_ramp(s.strains.of(i), s.strain_rates.of(i));
    else
      ramps[as_size(i)] = stress_ramp(s.stresses.of(i), s.stress_rates.of(i));
  }
  return ramps;
}

Segment make_segment(const SegmentSpec& s) {
  Segment segment;
  if (s.kind == SegmentKind::components)
    segment.components = named_components(s);
  else if (s.kind == SegmentKind::constrained)
    segment.components.fill(strain_ramp({}, {}));
  else
    segment.components = loaded_components(s);
  segment.temperature = {s.temperature, s.temperature_rate};
  segment.duration = s.duration;
  segment.steps = s.steps;
  segment.first_step = s.first_step;
  segment.where = s.where;
  check_duration(segment);
  return segment;
}

std::vector<Segment> make_segments(std::vector<SegmentSpec> specs, const CurveSpec& curve) {
  std::vector<Segment> segments;
  // A repetition copies the segments before it; the curve may change the rate and the stress of each.
  for (SegmentSpec& s : specs) {
    if (s.kind == SegmentKind::repeat) {
      // The last segments again, as often as asked for.
      const auto last = as_size(s.last);
      if (last > segments.size())
        throw InputError(s.where, fmt::format("the last {} segments are to be repeated, and there are {}",
                                              s.last, segments.size()));
      const std::vector<Segment> cycle(segments.end() - s.last, segments.end());
      for (int i = 0; i < s.times; ++i) segments.insert(segments.end(), cycle.begin(), cycle.end());
      continue;
    }
    // A curve may replace the rate or the stress of all segments that have one.
    if (curve.strain_rate && s.strain_rate) s.strain_rate = curve.strain_rate;
    if (curve.stress && s.stress) s.stress = curve.stress;
    segments.push_back(make_segment(s));
  }
  return segments;
}

bool allowed_in_file_names(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         std::string_view("._+-").find(c) != std::string_view::npos;
}

void check_file_name(const std::string& name, const SourceLocation& where) {
  if (name.empty() || name.front() == '.' || !std::all_of(name.begin(), name.end(), allowed_in_file_names))
    throw InputError(where, fmt::format("'{}' cannot be the name of a file", name),
                     "letters, digits and . _ + -");
}

void check_overrides(const CurveSpec& curve, const std::vector<SegmentSpec>& segments) {
  const auto used = [&](auto member) {
    return std::any_of(segments.begin(), segments.end(),
                       [&](const SegmentSpec& s) { return (s.*member).has_value(); });
  };
  const auto check = [&](bool given, bool takes_effect, const char* key) {
    if (given && !takes_effect)
      throw InputError(curve.where, fmt::format("the curve's {} changes nothing: no segment has one", key));
  };
  check(curve.strain_rate.has_value(), used(&SegmentSpec::strain_rate), "strain_rate");
  check(curve.stress.has_value(), used(&SegmentSpec::stress), "stress");
}

/// The temperature of an adiabatic point is an answer.
void refuse_temperatures(const std::vector<SegmentSpec>& segments) {
  for (const SegmentSpec& s : segments)
    if (s.temperature || s.temperature_rate)
      throw InputError(s.where, "the segment sets a temperature, and thermal = \"adiabatic\"",
                       "segments without temperature and temperature_rate");
}

Curve make_curve(const PointSpec& spec, const CurveSpec& curve, std::span<const fs::path> library) {
  // What a curve does not change is that of the case.
  const SourceLocation& where = curve.where.file.empty() ? spec.where : curve.where;
  check_overrides(curve, spec.segments);
  Curve result{curve.name, curve.label.empty() ? curve.name : curve.label, {}, {}, std::nullopt};
  // The material of the curve, or that of the case, with the place of whichever names it.
  result.material = material::find_material(curve.material.value_or(spec.material), library,
                                            curve.material ? curve.where : spec.where);
  if (!result.material.mechanical())
    throw InputError(where, fmt::format("the material '{}' has no elastic properties", result.material.name),
                     "young_modulus, poisson_ratio and expansion");
  const double temperature = curve.temperature.value_or(spec.temperature);
  result.program.options = {temperature, spec.strain_reference.value_or(temperature), spec.integration,
                            spec.thermal};
  if (spec.thermal == Thermal::adiabatic) refuse_temperatures(spec.segments);
  result.program.segments = make_segments(spec.segments, curve);
  if (curve.measured) result.measured = read_measured(*curve.measured, curve.where);
  return result;
}

void check_picture(const PictureSpec& picture) {
  check_file_name(picture.file, picture.where);
  // Columns by their names, and all of one axis in one unit.
  std::vector<std::string> names;
  for (const RecordColumn& column : columns()) names.push_back(column.name);
  const auto find = [&](const std::string& name) {
    const RecordColumn* column = find_column(name);
    if (column == nullptr)
      throw InputError(picture.where, fmt::format("the history has no column '{}'", name),
                       one_of(names, name));
    return column;
  };
  find(picture.x);
  if (picture.y.empty()) throw InputError(picture.where, "the picture shows nothing: 'y' is empty");
  for (const std::string& name : picture.y)
    if (find(name)->unit != find(picture.y.front())->unit)
      throw InputError(picture.where,
                       fmt::format("'{}' and '{}' are of different units", picture.y.front(), name));
}

/// Files are named as seen from the file that names them.
void resolve_path(Value* value) {
  if (value == nullptr || !value->is_text()) return;
  const fs::path path = value->text();
  const bool command_line = value->where.file.starts_with("--set");
  const fs::path folder = command_line ? fs::current_path() : fs::path(value->where.file).parent_path();
  const SourceLocation where = value->where;
  *value = Value(fs::absolute(folder / path).lexically_normal().string());
  value->where = where;
}

void resolve_material(Value& table) {
  Value* material = table.find("material");
  if (material != nullptr && material->is_text() && material->text().ends_with(".toml"))
    resolve_path(material);
}

void resolve_paths(Value& document) {
  resolve_material(document);
  Value* curves = document.find("curve");
  if (curves == nullptr || !curves->is_list()) return;
  for (Value& curve : curves->items()) {
    if (!curve.is_table()) continue;
    resolve_material(curve);
    resolve_path(curve.find("measured"));
  }
}

}  // namespace

PointCase make_point_case(Value document, std::span<const fs::path> library) {
  resolve_paths(document);
  PointCase result;
  result.document = point_section().info().completed(document, "");
  // Keys first, with defaults, then the values of them.
  PointSpec spec;
  point_section().assign(spec, result.document);
  result.title = spec.title;
  if (spec.segments.empty()) throw InputError(spec.where, "there is no loading", "at least one [[segment]]");
  if (spec.curves.empty()) spec.curves.emplace_back().name = "history";
  std::set<std::string> names;
  // Curves and pictures become files, so that their names are unique.
  for (const CurveSpec& curve : spec.curves) {
    check_file_name(curve.name, curve.where);
    if (!names.insert(curve.name).second)
      throw InputError(curve.where, fmt::format("there are two curves named '{}'", curve.name));
    result.curves.push_back(make_curve(spec, curve, library));
  }
  std::set<std::string> files = {"overview"};
  for (const PictureSpec& picture : spec.pictures) {
    check_picture(picture);
    if (!files.insert(picture.file).second)
      throw InputError(picture.where, fmt::format("there are two pictures named '{}'", picture.file),
                       "another name; 'overview' is always drawn");
  }
  result.pictures = std::move(spec.pictures);
  return result;
}

}  // namespace solidus::point
