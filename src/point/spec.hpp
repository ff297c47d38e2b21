/// The keys of a point file, as read and in SI.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "input/keys.hpp"
#include "point/material_point.hpp"

namespace solidus::point {

/// The keys that name components: strains = { xx = 0.01 }.
struct ComponentValues {
  std::optional<double> xx, yy, zz, xy, yz, xz;
  std::optional<double> of(int component) const;
};

enum class SegmentKind { uniaxial, biaxial, plane_strain, shear, constrained, components, repeat };
enum class Hold { nothing, strain, stress };

/// [[segment]]
struct SegmentSpec {
  SegmentKind kind = SegmentKind::uniaxial;
  std::optional<double> strain, strain_rate, stress, stress_rate;
  Hold hold = Hold::nothing;
  ComponentValues strains, strain_rates, stresses, stress_rates;
  std::vector<std::string> hold_strain;
  std::optional<double> temperature, temperature_rate, duration, first_step;
  int steps = 0;
  int last = 0, times = 0;  ///< of kind repeat
  SourceLocation where;
};

/// [[curve]]: the loading once more, with something changed.
struct CurveSpec {
  std::string name, label;
  std::optional<std::string> material, measured;
  std::optional<double> temperature, strain_rate, stress;
  SourceLocation where;
};

/// [[picture]]
struct PictureSpec {
  std::string file, title, x;
  std::vector<std::string> y, logarithmic;
  SourceLocation where;
};

struct PointSpec {
  std::string title, material;
  double temperature = 0;
  std::optional<double> strain_reference;
  PointIntegration integration = PointIntegration::backward_euler;
  Thermal thermal = Thermal::prescribed;
  std::vector<SegmentSpec> segments;
  std::vector<CurveSpec> curves;
  std::vector<PictureSpec> pictures;
  SourceLocation where;
};

/// The declaration of the keys, for reading, `explain --point`, the schema and the manual.
const Section<PointSpec>& point_section();

}  // namespace solidus::point
