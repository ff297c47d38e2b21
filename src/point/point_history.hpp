/// Computes the history of a material point under a loading.
#pragma once

#include <string>
#include <vector>

#include "point/loading.hpp"
#include "point/material_point.hpp"
#include "point/record.hpp"

namespace solidus::point {

struct Program {
  MaterialPoint::Options options;
  std::vector<Segment> segments;
};

struct History {
  std::vector<MaterialPointRecord> records;  ///< the start and every step
  bool finished = true;
  std::string reason;  ///< why it stopped, with the state there and advice
};

/// Marches through all segments. A step that does not converge is halved, ten times at most. Throws
/// InputError for a segment that takes no time.
History run(const material::Material& material, const Program& program);

}  // namespace solidus::point
