#include "new_case/preview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "numbers/index_casts.hpp"

namespace solidus::new_case {

namespace {

/// The box around parts and all that is put onto them.
struct Box {
  mesh::Point low{}, high{};

  void add(const mesh::Point& centre, double aside, double down, double up) {
    const mesh::Point below{centre[0] - aside, centre[1] - aside, centre[2] - down},
        above{centre[0] + aside, centre[1] + aside, centre[2] + up};
    for (std::size_t i = 0; i < 3; ++i)
      low[i] = std::min(low[i], below[i]), high[i] = std::max(high[i], above[i]);
  }
};

Box box_of(const Draft& draft, const PartMeasures& part) {
  Box box{part.low, part.high};
  for (const DraftRiser& r : draft.risers) box.add(r.foot, 0.5 * r.diameter + r.sleeve, 0, r.height);
  for (const mesh::GatingSystem& g : draft.gatings) {
    const double down = g.top[2] - g.floor();
    box.add(g.top, 0.5 * std::max({g.top_diameter, g.foot_diameter, g.runner_width}), down, 0);
    box.add(g.gate, 0.5 * g.gate_width, 0.5 * g.gate_height, 0.5 * g.gate_height);
  }
  for (const DraftChill& c : draft.chills)
    for (std::size_t i = 0; i < 3; ++i)
      box.low[i] = std::min(box.low[i], c.lowest[i]), box.high[i] = std::max(box.high[i], c.highest[i]);
  // Half of a part ends at its plane of symmetry.
  if (draft.symmetry) box.high[as_size(draft.symmetry->axis)] = draft.symmetry->at;
  return box;
}

std::string place(const mesh::Point& x) {
  return fmt::format("[{:.9g}, {:.9g}, {:.9g}]", x[0], x[1], x[2]);
}

}  // namespace

std::string preview_text(const Draft& draft, const PartMeasures& part) {
  Box box = box_of(draft, part);
  std::string walls = "null";
  if (draft.mould) {
    const auto& w = draft.mould->walls;
    walls =
        fmt::format("[{:.9g}, {:.9g}, {:.9g}, {:.9g}, {:.9g}, {:.9g}]", w[0], w[1], w[2], w[3], w[4], w[5]);
    for (std::size_t i = 0; i < 3; ++i) box.low[i] -= w[2 * i], box.high[i] += w[2 * i + 1];
  }
  // The page draws the cylinder of a riser alone.
  std::string risers;
  for (const DraftRiser& r : draft.risers)
    risers += fmt::format("{}{{\"foot\": {}, \"diameter\": {:.9g}, \"height\": {:.9g}}}",
                          risers.empty() ? "" : ", ", place(r.foot), r.diameter, r.height);
  return fmt::format(
      "{{\"low\": {}, \"high\": {}, \"walls\": {}, \"shell\": {:.9g}, \"size\": {:.9g}, \"smallest\": "
      "{:.9g}, "
      "\"mould_size\": {:.9g}, \"risers\": [{}]}}\n",
      place(box.low), place(box.high), walls, draft.shell ? draft.shell->thickness : 0, draft.size,
      draft.smallest, draft.mould_size, risers);
}

}  // namespace solidus::new_case
