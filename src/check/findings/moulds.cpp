// Findings on the sizes of moulds: moulds of coating, walls of metres, thin walls of sand, and those that a
// condition holds cold.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "cases/roles.hpp"
#include "check/finding_family.hpp"
#include "input/units.hpp"
#include "mesh/locate.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::check {

namespace {

constexpr double k_thickest = 5e-3;           // of a coating [m]
constexpr double k_times = 4, k_least = 0.5;  // a wall, of the largest side of what is poured; [m]
constexpr double k_sand = 3;                  // conducts less [W/(m K)]
constexpr double k_coldest = 333.15;          // of the outside of sand [K]

/// Whether the name of a body's material tells that it is sand.
bool is_sand(const cases::BodySpec& body) {
  return std::filesystem::path(body.material).stem().string().find("sand") != std::string::npos;
}

/// Coatings and washes are layers, which interfaces carry as a conductance; a body of one is thin.
void thick_coatings(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const cases::BodySpec& body = spec.bodies[b];
    const std::string file = std::filesystem::path(body.material).stem().string();
    const bool coating = file.find("wash") != std::string::npos || file.find("coating") != std::string::npos;
    if (!coating || !(m.bodies[b].skin > 0)) continue;
    const double thickness = 2 * m.bodies[b].volume / m.bodies[b].skin;
    if (thickness < k_thickest) continue;
    findings.push_back(
        {false, body.where,
         fmt::format("the body '{}' is of '{}' and {:.3g} mm thick in the mean (2 V/A)", body.name,
                     body.material, 1e3 * thickness),
         "coatings and washes are 0.1 to 2 mm thick; a mould is of sand, ceramics or metal, and "
         "a coating on it belongs to the [[contact]] or [[interface]]"});
  }
}

/// Heat of a casting does not reach the outside of such walls while it freezes.
void walls_of_metres(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  if (m.pours.empty()) return;
  // The box around all that is poured, whose longest side is the measure.
  mesh::Point low, high;
  low.fill(std::numeric_limits<double>::max());
  high.fill(std::numeric_limits<double>::lowest());
  double size = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    for (const Pour& pour : m.pours) {
      low[d] = std::min(low[d], m.bodies[pour.body].low[d]);
      high[d] = std::max(high[d], m.bodies[pour.body].high[d]);
    }
    size = std::max(size, high[d] - low[d]);
  }
  // How far each other body reaches beyond that box, on the side where it reaches farthest.
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    if (m.is_poured(b)) continue;
    double reach = 0;
    for (std::size_t d = 0; d < 3; ++d)
      reach = std::max({reach, low[d] - m.bodies[b].low[d], m.bodies[b].high[d] - high[d]});
    if (reach < k_times * size || reach < k_least) continue;
    findings.push_back(
        {false, spec.bodies[b].where,
         fmt::format("the body '{}' reaches {:.3g} m beyond what is poured, which is {:.3g} m large",
                     spec.bodies[b].name, reach, size),
         "walls of moulds are a twentieth of the casting to all of it; is their unit right?"});
  }
}

/// The distance of a surface from the nearest body that is poured, over some of its faces [m]. Collective.
double distance_from_melt(const setup::Assembly& a, const CaseMeasures& m,
                          const setup::SurfaceMeasures& surface) {
  constexpr std::size_t k_faces = 24;
  double least = std::numeric_limits<double>::max();
  const std::size_t stride = std::max<std::size_t>(1, surface.centres.size() / k_faces);
  for (std::size_t i = 0; i < surface.centres.size(); i += stride)
    for (const Pour& pour : m.pours)
      least = std::min(least, mesh::locate(a.mesh, surface.centres[i], static_cast<int>(pour.body)).distance);
  return least;
}

/// Nothing keeps the outside of sand as cold as a room once heat has come through to it. Behind a wall that
/// is thicker than that the condition has no effect, and a mould of metal may have channels. Collective.
void cold_sand(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
               Findings& findings) {
  // The slowest casting decides how far heat comes.
  double freezing = 0;
  for (const Pour& pour : m.pours) freezing = std::max(freezing, pour.freezing.time.value_or(0));
  if (!(freezing > 0)) return;
  for (std::size_t t = 0; t < spec.thermal_conditions.size(); ++t) {
    const cases::ThermalConditionSpec& c = spec.thermal_conditions[t];
    // Held temperatures of one number, at all times, near that of a room.
    if (c.kind != cases::ThermalConditionSpec::Kind::temperature || !is_number(c.temperature) ||
        !c.stages.empty() || c.temperature.table.value(0) > k_coldest || m.surfaces[t].body < 0)
      continue;
    const auto b = as_size(m.surfaces[t].body);
    const material::Material& of = a.materials[b];
    const double start = a.start[b].low, k = of.conductivity.value(start);
    if (m.is_poured(b) || k >= k_sand) continue;
    // The depth that heat reaches in that time, by the similarity solution of a half space.
    const double reached = 2 * std::sqrt(k / (of.density * of.specific_heat.value(start)) * freezing);
    const double wall = distance_from_melt(a, m, m.surfaces[t]);
    if (wall >= reached) continue;
    findings.push_back(
        {false, c.where,
         fmt::format(
             "'{}' holds '{}' at {:.0f} degC, {:.3g} mm from the melt: it conducts as sand does, and heat "
             "gets {:.3g} mm far until the casting is solid",
             c.name, spec.bodies[b].name, units::to_display(c.temperature.table.value(0), "K", "degC"),
             1e3 * wall, 1e3 * reached),
         "sand is in air: a film of 5 to 20 W/m2/K and radiation"});
  }
}

/// Moulds of sand that together are thinner than heat goes deep while the casting freezes: their outside then
/// decides. Ceramic shells are thin, and are in air.
void thin_sand(const cases::CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  double reach = 0, metal = 0, volume = 0;
  // Metal that the mould must take the heat of: the depth is that of the slowest, the area that of
  // all.
  for (const Pour& pour : m.pours) {
    if (pour.freezing.time) reach = std::max(reach, pour.freezing.mould_reach);
    metal += pour.cooled_area;
  }
  const cases::BodySpec* first = nullptr;
  // Volume of mould over area of metal is its mean thickness.
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    if (m.is_poured(b) || spec.bodies[b].role != cases::Role::mould) continue;
    volume += m.bodies[b].volume;
    if (first == nullptr && is_sand(spec.bodies[b])) first = &spec.bodies[b];
  }
  if (first == nullptr || !(metal > 0) || volume / metal >= reach) return;
  findings.push_back(
      {false, first->where,
       fmt::format(
           "the mould '{}' of '{}' is {:.3g} mm thick in the mean around what is poured, and heat goes "
           "{:.3g} mm deep until that is solid",
           first->name, first->material, 1e3 * volume / metal, 1e3 * reach),
       "walls of sand of 30 mm and more, five times as thick as heat goes deep; is their unit right?"});
}

/// Sand that deforms as a body that never yields holds its casting back as no sand does: it crushes.
void elastic_sand(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                  Findings& findings) {
  if (!spec.has_mechanics() || m.pours.empty()) return;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    const cases::BodySpec& body = spec.bodies[b];
    const material::Material& of = a.materials[b];
    if (m.is_poured(b) || cases::only_conducts(body) || !is_sand(body) || of.flow || of.external != nullptr)
      continue;
    findings.push_back(
        {false, body.where,
         fmt::format("the sand '{}' of '{}' deforms with a young_modulus of {:.3g} MPa and never yields",
                     body.name, body.material, 1e-6 * of.young_modulus.max_value()),
         "sand crushes: a card with [granular] (green_sand_yielding), or physics = \"heat\" for the body"});
  }
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m, Findings& findings) {
  if (!spec.has_heat()) return;
  thick_coatings(spec, m, findings);
  walls_of_metres(spec, m, findings);
  cold_sand(spec, a, m, findings);
  thin_sand(spec, m, findings);
  elastic_sand(spec, a, m, findings);
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_moulds() {
  return {
      .name = "moulds",
      .place = 250,
      .find = &find,
      .rows = {
          {Topic::pour, "a body of coating",
           fmt::format(
               "its material has `wash` or `coating` in its name, and its thickness, 2 V/A, is {} mm or more",
               number(1e3 * k_thickest))},
          {Topic::pour, "walls of metres",
           fmt::format(
               "a body extends beyond the poured metal by {} times its largest side and by {} m or more",
               number(k_times), number(k_least))},
          {Topic::pour, "thin sand that is held cold",
           fmt::format(
               "a body that conducts less than {} W/m/K is held below {:.0f} °C at all times, nearer to the "
               "melt than 2 √(αt), α its thermal diffusivity and t the estimated time to freeze",
               number(k_sand), k_coldest - k_zero_celsius)},
          {Topic::pour, "thin sand",
           "a body with the role of a mould and `sand` in its material's name, whose volume over the cooled "
           "surface is less than the depth to which heat penetrates until the casting is solid"},
          {Topic::pour, "sand that never yields",
           "a body that deforms, with `sand` in its material's name, is elastic: its material has "
           "`young_modulus` and neither `[granular]` nor `[plasticity]`"}}};
}

}  // namespace solidus::check
