/// The depth of the layers follows from how far heat gets into a body while the metal freezes.
#include "new_case/draft_layers.hpp"

#include <algorithm>
#include <cmath>

#include "cases/case_materials.hpp"
#include "material/cards/library.hpp"
#include "new_case/rounding.hpp"

namespace solidus::new_case {

namespace {

/// Diffusivity of a body half way between its start and the solidus of the metal [m²/s].
double diffusivity(const DraftBody& body, double solidus) {
  const material::Material m = material::find_material(body.material, cases::material_folders(), {body.name});
  constexpr double k_celsius = 273.15;
  const double hot = 0.5 * (body.start + k_celsius + solidus);
  return m.conductivity.value(hot) / (m.density * m.specific_heat.value(hot));
}

}  // namespace

bool has_layers(cases::Role role) {
  return role == cases::Role::mould || role == cases::Role::core || role == cases::Role::sleeve ||
         role == cases::Role::insulation;
}

std::vector<DraftLayers> choose_layers(const Draft& draft, const std::vector<HeatedWall>& walls,
                                       const std::vector<PouredTime>& times, double fineness) {
  // With capacities at the nodes a wall takes up too much heat, by the sum of h³ u'' / 12 over elements of
  // the thickness h, and u'' of the temperature is large from the wall to 2 sqrt(a t): layers go deep and
  // grow little (docs/decisions/0057-layers-on-all-that-is-poured.md). More than twenty the key does not
  // take.
  constexpr double k_number = 7, k_growth = 1.2, k_depth = 1.4, k_most = 20;
  constexpr double k_of_body = 0.7;  // of a thin body's volume over its heated skin
  // Heat is through a thin shell at once, and its temperature nearly linear: few layers, with room behind.
  constexpr double k_number_in_shell = 4, k_of_shell = 0.6;
  const double finer = std::max(1.0, fineness);
  std::vector<DraftLayers> layers;
  for (const HeatedWall& wall : walls) {
    const auto body = std::ranges::find(draft.bodies, wall.body, &DraftBody::name);
    const auto time = std::ranges::find(times, wall.poured, &PouredTime::body);
    if (body == draft.bodies.end() || time == times.end() || !(time->freezing > 0)) continue;
    DraftLayers& one = layers.emplace_back();
    one.name = wall.body + "_on_" + wall.poured;
    one.surface = wall.surface;
    one.body = body->group;
    // All heated walls of a body draw on the same volume, so that a thin core is not filled from two sides.
    double heated = 0;
    for (const HeatedWall& other : walls)
      if (other.body == wall.body) heated += other.area;
    double depth = k_depth * std::sqrt(diffusivity(*body, time->solidus) * time->freezing);
    if (heated > 0) depth = std::min(depth, k_of_body * wall.volume / heated);
    const bool in_shell =
        draft.shell && wall.body == draft.shell->name && k_of_shell * draft.shell->thickness < depth;
    if (in_shell) depth = k_of_shell * draft.shell->thickness;
    one.number =
        static_cast<int>(std::lround(std::min(k_most, (in_shell ? k_number_in_shell : k_number) * finer)));
    one.growth = std::round(1e3 * std::pow(k_growth, 1 / finer)) / 1e3;
    // With growth q and number n the first thickness is depth (q − 1) / (qⁿ − 1); finer layers grow as much
    // over the same depth.
    one.first = two_digits(depth * (one.growth - 1) / (std::pow(one.growth, one.number) - 1));
  }
  return layers;
}

}  // namespace solidus::new_case
