/// Lines of the report, from what was measured to what is doubtful.
#include "new_case/new_case_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numbers>
#include <optional>
#include <set>

#include "cases/roles.hpp"
#include "mesh/making/casting_geometry.hpp"
#include "new_case/casting_processes.hpp"
#include "new_case/rounding.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::new_case {

namespace {

/// "98.8 cm3 in a box of 100 x 54 x 71 mm": by which one tells bodies without names apart.
std::string size_text(const mesh::BodyExtent& extent) {
  const auto side = [&](std::size_t i) { return 1e3 * (extent.high[i] - extent.low[i]); };
  const double volume = 1e6 * extent.volume;
  const std::string digits = volume < 1000 ? fmt::format("{:.3g}", volume) : fmt::format("{:.0f}", volume);
  return fmt::format("{} cm3 in a box of {:.4g} x {:.4g} x {:.4g} mm", digits, side(0), side(1), side(2));
}

/// A note where the parts are so large or so small that their unit is in doubt; empty where they are not.
std::string doubtful_unit_text(const NewCaseOptions& options, const PartMeasures& part) {
  constexpr double k_large = 5, k_small = 6e-3;
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) largest = std::max(largest, part.high[i] - part.low[i]);
  if (largest <= k_large && largest >= k_small) return "";
  const std::string size =
      largest > 1 ? fmt::format("{:.3g} m", largest) : fmt::format("{:.3g} mm", 1e3 * largest);
  if (part.file_unit)
    return fmt::format("\n  note        {} large, for lengths in {}, as the file says itself", size,
                       part.file_unit->name);
  return fmt::format("\n  note        {} large, for lengths of the file in {}: --unit takes another unit",
                     size, options.unit.empty() ? "mm" : options.unit);
}

/// A note where walls have less than two elements through them; empty where they have.
std::string thin_walls_text(const Draft& draft, const PartMeasures& part) {
  constexpr double k_most = 5;  // what --fineness allows
  const double finer = rounded_up(2 * draft.smallest / part.thickness_at(0.1), 0.1);
  if (finer < 1.2) return "";
  return fmt::format(
      "\n  note        thin walls have one element through them{}",
      finer > k_most
          ? std::string()
          : fmt::format(
                ": enough for when and where it freezes last, not for temperatures within the wall, of "
                "which `check` warns; --fineness {:.2g} gives two",
                finer));
}

/// A note where several bodies are castings because neither their names nor `--as` say what they are: a core
/// of a file without names would be poured. Empty where there is one casting, or all are known.
std::string unknown_bodies_text(const Draft& draft, const std::vector<std::string>& as) {
  int castings = 0;
  std::string unknown, last;
  for (const DraftBody& body : draft.bodies) {
    if (body.role != cases::Role::casting) continue;
    ++castings;
    const auto said = [&](const std::string& text) { return text.starts_with(body.group + "="); };
    if (cases::role_in_name(body.group) || std::ranges::any_of(as, said)) continue;
    unknown += (unknown.empty() ? "" : ", ") + body.name;
    last = body.group;
  }
  if (castings < 2 || unknown.empty()) return "";
  return fmt::format(
      "\n  note        no name says what these are, so they are poured: {}; else, for example: --as {}=core",
      unknown, last);
}

/// Distance of a riser from the plane of symmetry [m]; none where there is no plane.
std::optional<double> beside_plane(const Draft& draft, const DraftRiser& riser) {
  if (!draft.symmetry) return {};
  return draft.symmetry->at - riser.foot[as_size(draft.symmetry->axis)];
}

/// A note where half of the part has its first riser next to the plane: the whole part then has two such.
/// Empty where not.
std::string twin_riser_text(const Draft& draft) {
  const double beside = draft.risers.empty() ? 0 : beside_plane(draft, draft.risers.front()).value_or(0);
  if (beside == 0) return "";
  return fmt::format(
      "\n  note        the part is thickest {:.3g} mm off the plane of symmetry: there is a riser on each "
      "half, with metal for that half",
      1e3 * beside);
}

/// A note for each riser that stands on a handle or a bridge above the thickest place, which freezes first.
/// Empty where metal leads straight up.
std::string hollow_text(const Draft& draft) {
  std::string text;
  for (const DraftRiser& riser : draft.risers)
    if (riser.hollow)
      text += fmt::format(
          "\n  note        '{}' stands on metal above the thickest place, with {:.3g} mm of mould between "
          "them: it feeds that place only until the metal next to it has frozen; turn the part, or place a "
          "riser by hand",
          riser.name, 1e3 * *riser.hollow);
  for (const std::string& note : draft.riser_notes) text += "\n  note        " + note;
  return text;
}

/// The risers with the places that they were chosen for, the gating and the chills.
std::string feeders_text(const Draft& draft) {
  std::string text;
  for (const DraftRiser& riser : draft.risers) {
    text += fmt::format("\n  {:<10}  {:.3g} mm wide, {:.3g} mm high", riser.name, 1e3 * riser.diameter,
                        1e3 * riser.height);
    if (riser.sleeve > 0) text += fmt::format(", in a sleeve of {:.3g} mm", 1e3 * riser.sleeve);
    if (beside_plane(draft, riser) == 0.0) text += ", halved by the plane of symmetry on which it stands";
    if (riser.hot_spot)
      text += fmt::format(", for the place at ({:.4g}, {:.4g}, {:.4g}) mm with a modulus of {:.3g} mm",
                          1e3 * (*riser.hot_spot)[0], 1e3 * (*riser.hot_spot)[1], 1e3 * (*riser.hot_spot)[2],
                          1e3 * riser.modulus);
  }
  for (const mesh::GatingSystem& gating : draft.gatings) {
    const double sprue = std::numbers::pi / 4 * gating.foot_diameter * gating.foot_diameter;
    text += fmt::format(
        "\n  {:<10}  areas of sprue, runner and ingate 1 : {:.2g} : {:.2g}, the sprue {:.3g} mm2 at its foot",
        gating.name, gating.runner_width * gating.runner_height / sprue,
        gating.gate_width * gating.gate_height / sprue, 1e6 * sprue);
  }
  for (const DraftChill& chill : draft.chills)
    text += fmt::format(
        "\n  {:<10}  {:.3g} x {:.3g} x {:.3g} mm", chill.name, 1e3 * (chill.highest[0] - chill.lowest[0]),
        1e3 * (chill.highest[1] - chill.lowest[1]), 1e3 * (chill.highest[2] - chill.lowest[2]));
  return text;
}

/// A note where no way of meshing gave sound elements; empty where one did.
std::string poor_mesh_text(const DraftEstimate& estimate) {
  if (estimate.least_quality >= mesh::k_sound_quality) return "";
  return fmt::format(
      "\n  note        the least quality of elements is {:.2g} ({} is sound), the worst {}: results there "
      "are "
      "rough",
      estimate.least_quality, mesh::k_sound_quality, estimate.worst_element);
}

/// A note where bodies of the geometry overlap; empty where none do.
std::string overlap_text(const DraftEstimate& estimate) {
  if (estimate.overlap.empty()) return "";
  return fmt::format(
      "\n  note        bodies of the geometry overlap: {}; the first of each two keeps it. Bodies that "
      "belong "
      "together touch: cut one out of the other",
      estimate.overlap);
}

/// The channels of a die; empty where its drawing has none.
std::string channels_text(const Draft& draft, const std::string& die) {
  std::set<std::string> widths;
  int number = 0;
  double speed = 0;
  // Widths are collected as text, so that equal ones are named once.
  for (const DieChannel& c : draft.channels) {
    if (c.die != die) continue;
    widths.insert(fmt::format("{:.3g}", 1e3 * c.diameter));
    speed = std::max(speed, speed_of_water(c.diameter));
    ++number;
  }
  if (number == 0) return "";
  return fmt::format(
      "\n  channels    {} bore{} of {} mm in {}, with water at 30 degC and {}{:.2g} m/s, and the outside of "
      "the "
      "die cooled by air alone: estimates. A hole that is no channel: delete its [[thermal_condition]] "
      "water_in_{}_channel_…",
      number, number > 1 ? "s" : "", fmt::join(widths, ", "), die, speed > 1 && number > 1 ? "1 to " : "",
      speed, die);
}

/// Mould, mesh and time to freeze, which an estimate has given.
std::string estimate_text(const Draft& draft, const DraftEstimate& estimate) {
  std::string out;
  if (draft.mould) {
    const std::string open = draft.mould->walls[5] == 0 ? ", open at the top, where the metal ends" : "";
    out += draft.shell ? fmt::format("\n  {:<10}  {:.3g} mm thick, on all of the skin{}", draft.shell->name,
                                     1e3 * draft.shell->thickness, open)
                       : fmt::format("\n  {:<10}  walls of {:.3g} mm{}", draft.mould->name,
                                     1e3 * *std::ranges::max_element(draft.mould->walls), open);
  }
  out += fmt::format("\n  mesh        {:.0f} nodes, {:.0f} of them in metal; {}", estimate.nodes,
                     estimate.metal_nodes,
                     draft.meshed ? std::string("elements as the file has them")
                                  : fmt::format("edges of {:.3g} to {:.3g} mm there",
                                                1e3 * estimate.shortest_edge, 1e3 * estimate.longest_edge));
  if (estimate.freezing > 0)
    out += fmt::format(
        "\n  freezes     in about {:g} s by an estimate of one dimension; {}", two_digits(estimate.freezing),
        draft.shots
            ? fmt::format("it leaves the die after {:g} s, {} times",
                          draft.shots->pour + draft.shots->solidify + draft.shots->open, draft.shots->number)
            : fmt::format("the run ends when it has, at {:g} s at the latest", draft.end));
  return out;
}

}  // namespace

std::string report_text(const Draft& draft, const PartMeasures& part, const DraftEstimate& estimate,
                        const NewCaseOptions& options) {
  // What `solidus new` says at its end, line by line: alloy, bodies, walls, hot spots, riser, symmetry,
  // mould, mesh, freezing, and then notes on what may be wrong.
  std::string out = fmt::format("{}: {} at {:.0f} degC, process {}", draft.geometry.filename().string(),
                                draft.alloy, draft.pouring, draft.process);
  if (part.file_unit) out += fmt::format("\n  unit        {}, as the file says", part.file_unit->name);
  // Bodies with their size, as far as they are drawn.
  for (const DraftBody& body : draft.bodies) {
    out += fmt::format("\n  {:<10}  {} of {}, {:.0f} degC", cases::name(body.role), body.name, body.material,
                       body.start);
    const auto measured = std::ranges::find(part.bodies, body.group, &setup::GeometryBody::name);
    if (measured != part.bodies.end()) out += ", " + size_text(measured->extent);
  }
  out += fmt::format(
      "\n  walls       {:.3g} mm (a tenth is thinner) to {:.3g} mm (a tenth is thicker), V/A {:.3g} mm",
      1e3 * part.thickness_at(0.1), 1e3 * part.thickness_at(0.9), 1e3 * part.volume / part.area);
  // Hot spots by the spheres that fit into them.
  for (const mesh::InscribedSphere& s : draft.hot_spots)
    out += fmt::format("\n  hot spot    a sphere of {:.3g} mm at ({:.4g}, {:.4g}, {:.4g}) mm", 2e3 * s.radius,
                       1e3 * s.centre[0], 1e3 * s.centre[1], 1e3 * s.centre[2]);
  out += feeders_text(draft);
  if (draft.symmetry)
    out += fmt::format("\n  symmetry    the half below {} = {:.4g} mm is computed",
                       "xyz"[draft.symmetry->axis], 1e3 * draft.symmetry->at);
  out += estimate_text(draft, estimate);
  if (draft.shots && draft.shots->cooling > draft.film)
    out +=
        fmt::format("\n  cooling     {:g} W/m2/K outside the die take what the castings bring, an estimate",
                    draft.shots->cooling);
  for (const DraftBody& die : draft.bodies) out += channels_text(draft, die.name);
  out += overlap_text(estimate);
  // Notes last, from overlaps to thin walls.
  for (const std::string& note : estimate.skin_notes) out += "\n  note        " + note;
  out += poor_mesh_text(estimate);
  out += twin_riser_text(draft);
  out += hollow_text(draft);
  out += doubtful_unit_text(options, part);
  out += unknown_bodies_text(draft, options.as);
  if (!draft.meshed) out += thin_walls_text(draft, part);
  return out;
}

}  // namespace solidus::new_case
