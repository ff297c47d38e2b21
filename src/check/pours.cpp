// Poured bodies and the skins that cool them, as a problem in one dimension (check/freezing_estimate.hpp).
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "check/case_measures.hpp"
#include "check/cooled_skin.hpp"
#include "check/deepest.hpp"
#include "check/local_shape.hpp"
#include "check/plate_estimate.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::check {

namespace {

/// The stage in which a body comes in; null without stages.
const cases::StageRun* stage_of_pour(const cases::CaseSpec& spec, const setup::Assembly& a,
                                     std::size_t body) {
  const auto stage = std::ranges::find_if(
      a.stages, [&](const cases::StageRun& run) { return cases::holds(spec.bodies[body].stages, &run); });
  return stage != a.stages.end() ? &*stage : nullptr;
}

/// When a body comes in [s].
double time_of_pour(const cases::CaseSpec& spec, const setup::Assembly& a, std::size_t body) {
  const cases::StageRun* const stage = stage_of_pour(spec, a, body);
  return stage != nullptr ? stage->start : 0.0;
}

/// A pour and what its estimate was made of.
struct EstimatedPour {
  Pour pour;
  FreezingProblem problem;  ///< of the body alone; complete where the pour has a time
  /// All of them, but for the faces that it shares with other metal that is poured.
  std::vector<CooledSkin> skins;
  double of_thickest = 1;  ///< time by the thickest place over that by the whole casting
};

/// Metal that counts for a place lies within its depth and this times √(α t) of the time to freeze: fitted to
/// runs (docs/guide/findings.md).
constexpr double k_reach = 1.25;
/// Radius over the depth of the ball that tells whether the place is round itself.
constexpr double k_near = 1.5;

/// Adds a mould behind a part of the skin.
/// @param share  of the cooled skin
/// @param part   of the mould's volume
/// @param area   cooled skin [m²]
/// @param metal  volume of it [m³]
void add_mould(const Surroundings& in, const CooledSkin& skin, double share, double part, double area,
               double metal, FreezingProblem& problem) {
  const std::size_t other = *skin.other;
  problem.moulds.push_back({share, &in.a.materials[other], (skin.low + skin.high) / 2,
                            part * in.m.bodies[other].volume / metal, skin.conductance, skin.may_open,
                            outer_heat(other, area, part, in)});
}

/// Adds surroundings beyond a part of the skin.
void add_film(const CooledSkin& skin, double share, FreezingProblem& problem) {
  problem.open.push_back({[heat = skin.heat, share](double temperature, double time) {
    return share * heat(temperature, time);
  }});
}

/// The problem of a place of a casting: metal, skin and moulds around it. Absent: no skin is near.
/// @param least  heat of a skin that counts in V/A [W/m²]
std::optional<FreezingProblem> around_place(const Surroundings& in, const EstimatedPour& estimated,
                                            const PlaceInMetal& place, double least) {
  const Pour& pour = estimated.pour;
  std::vector<SkinPlace> places;
  for (const CooledSkin& skin : estimated.skins) places.push_back({skin.surface, skin.other});
  const LocalShape shape = measure_around(in.a.mesh, in.spec.analysis.kind, pour.body, place, places);
  // A part of a surface may have no partner, and two films may act on one surface.
  const auto area_of = [&](std::size_t s) {
    return shape.all[s] > 0 ? shape.area[s] * estimated.skins[s].area / shape.all[s] : 0.0;
  };
  double area = 0, whole = 0;
  for (std::size_t s = 0; s < estimated.skins.size(); ++s)
    if (estimated.skins[s].cooling >= least) area += area_of(s), whole += estimated.skins[s].area;
  if (!(area > 0) || !(shape.volume > 0)) return std::nullopt;
  area *= pour.cooled_area / whole;
  FreezingProblem problem;
  problem.metal = estimated.problem.metal;
  problem.start = estimated.problem.start;
  problem.modulus = shape.volume / area;
  problem.depth = pour.depth;
  for (std::size_t s = 0; s < estimated.skins.size(); ++s) {
    const CooledSkin& skin = estimated.skins[s];
    const double share = area_of(s) / area;
    if (!(share > 0)) continue;
    if (!skin.other) {
      add_film(skin, share, problem);
      continue;
    }
    const double mould = in.m.bodies[*skin.other].volume;
    for (const MouldLayer& layer : shape.layers[s])
      add_mould(in, skin, share * layer.area / shape.area[s], layer.volume / mould, area, shape.volume,
                problem);
    if (shape.layers[s].empty())  // its elements are larger than the place
      add_mould(in, skin, share, area_of(s) / in.m.bodies[*skin.other].skin, area, shape.volume, problem);
  }
  return problem;
}

/// Replaces the estimate of the casting as a whole by that of its thickest place, with the metal that heat
/// reaches from there within that time: where the mould governs that is all of it, where it is quick, as
/// between dies, what is near. Of several places as thick the last one to be solid.
void by_thickest_place(const Surroundings& in, const std::vector<mesh::Point>& places, double least,
                       EstimatedPour& estimated) {
  Pour& pour = estimated.pour;
  if (!(pour.depth > 0) || !pour.freezing.time) return;
  const material::Material& metal = *estimated.problem.metal;
  const double solidus = metal.solidification()->fraction.solidus();
  const double diffusivity =
      metal.conductivity.value(solidus) / (metal.density * metal.specific_heat.value(solidus));
  const double whole = *pour.freezing.time;
  const double spread = pour.freezing.mould_reach;
  double last = 0;
  for (const mesh::Point& place : places) {
    const auto nearby = around_place(in, estimated, {place, pour.depth, k_near * pour.depth, spread}, least);
    double time = whole;
    FreezingEstimate there;
    double modulus = 0;
    for (int round = 0; round < 2; ++round) {
      const double reach = k_reach * std::sqrt(diffusivity * time);
      auto problem = around_place(in, estimated, {place, pour.depth, pour.depth + reach, spread}, least);
      if (!problem) break;
      if (nearby) problem->roundness = pour.depth / nearby->modulus;
      FreezingEstimate found = estimate_freezing(*problem);
      if (!found.time) break;
      time = std::sqrt(time * *found.time);
      modulus = problem->modulus;
      there = std::move(found);
    }
    if (!there.time || *there.time <= last) continue;
    last = *there.time;
    pour.local_modulus = modulus;
    estimated.of_thickest = last / whole;
    pour.freezing = std::move(there);
  }
}

/// The parts of the skin of a body, without those at metal that comes in molten, unless this is solid by now.
/// @param earlier  as estimate_alone() has them
std::vector<CooledSkin> skins_without_melt(const cases::CaseSpec& spec, const setup::Assembly& a,
                                           std::span<const EstimatedPour> earlier, std::size_t body,
                                           const Surroundings& around) {
  std::vector<CooledSkin> skins = skins_of(body, around);
  const auto solid_by_now = [&](std::size_t other) {
    return std::ranges::any_of(earlier, [&](const EstimatedPour& one) {
      return one.pour.body == other && one.pour.freezing.time &&
             time_of_pour(spec, a, other) + *one.pour.freezing.time <= time_of_pour(spec, a, body);
    });
  };
  std::erase_if(skins, [&](const CooledSkin& s) {
    return s.other && comes_in_molten(a, *s.other) && !solid_by_now(*s.other);
  });
  for (CooledSkin& skin : skins)
    if (skin.other && comes_in_molten(a, *skin.other))
      skin.low = skin.high = a.materials[*skin.other].solidification()->fraction.solidus();
  return skins;
}

/// Marks the nodes of a skin: those of its surface, or of the other body.
void mark_nodes(const mesh::Mesh& mesh, const CooledSkin& skin, std::span<char> marked) {
  if (skin.surface.empty()) {
    const std::vector<char> there = nodes_of(mesh, *skin.other);
    for (std::size_t i = 0; i < there.size(); ++i) marked[i] = static_cast<char>(marked[i] | there[i]);
  } else if (const auto surface = mesh.surfaces.find(skin.surface); surface != mesh.surfaces.end()) {
    for (const Index node : surface->second.nodes) marked[as_size(node)] = 1;
  }
}

/// Finds the parts of the skin that count as cooled, and the problem in one dimension, without the metal that
/// is poured with the body: the skin that its mould cools is the A of V/A.
/// @param earlier  estimates of what was poured before: a casting that is solid by now takes heat as a mould
///                 does, from its solidus on, which it has reached at least
void estimate_alone(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m,
                    std::span<const EstimatedPour> earlier, EstimatedPour& estimated) {
  Pour& pour = estimated.pour;
  const std::size_t body = pour.body;
  const double start = a.start[body].high, end = spec.time.end.value_or(0);
  const Surroundings around{spec, stage_of_pour(spec, a, body), a, m};
  std::vector<CooledSkin> skins = skins_without_melt(spec, a, earlier, body, around);
  double most = 0;
  for (CooledSkin& skin : skins) most = std::max(most, skin.cooling = cooling_of(skin, start, end));
  if (!(most > 0)) {
    pour.no_estimate = "nothing cools it";
    return;
  }
  // Skin that loses less than a hundredth of the heat of the rest does not count in V/A.
  constexpr double k_least_share_of_cooling = 0.03;
  std::vector<mesh::Point> cloud;
  std::vector<char> on_skin(a.mesh.x.size(), 0);
  std::vector<double> facing(m.bodies.size(), 0.0);  // area toward each other body
  for (const CooledSkin& skin : skins) {
    if (skin.other) facing[*skin.other] += skin.area;
    if (skin.cooling < k_least_share_of_cooling * most) continue;
    pour.cooled_area += skin.area;
    pour.conductance += skin.area * skin.cooling;
    mark_nodes(a.mesh, skin, on_skin);
    cloud.insert(cloud.end(), skin.points.begin(), skin.points.end());
  }
  pour.cooled_area = std::min(pour.cooled_area, m.bodies[body].skin);  // two films on one surface
  pour.spanned = share_between(a.mesh, spec.analysis.kind, static_cast<int>(body), on_skin);
  const Deepest deepest = deepest_below(a.mesh, body, cloud);
  pour.depth = deepest.depth;
  FreezingProblem& problem = estimated.problem;
  problem.metal = &a.materials[body];
  problem.start = start;
  problem.modulus = m.bodies[body].volume / pour.cooled_area;
  problem.depth = pour.depth;
  double coldest = start;
  for (const CooledSkin& skin : skins) {
    const double share = skin.area / pour.cooled_area;
    if (skin.other) {
      const double part = skin.area / facing[*skin.other];
      coldest = std::min(coldest, skin.low);
      add_mould(around, skin, share, part, pour.cooled_area, m.bodies[body].volume, problem);
    } else {
      add_film(skin, share, problem);
    }
  }
  const bool against_mould = coldest < start;
  const double drop = against_mould ? start - coldest : std::max(1.0, start - k_zero_celsius - 20);
  pour.conductance /= pour.cooled_area * drop;
  estimated.skins = std::move(skins);
  pour.freezing = estimate_freezing(problem);
  by_thickest_place(around, deepest.places, k_least_share_of_cooling * most, estimated);
  pour.alone_time = pour.freezing.time;
  // The skin of a mould that has taken heat while it filled is warm, and says nothing of how long plates
  // take.
  if (!spec.filling) pour.plates = plate_times(problem);
  if (pour.freezing.gave_up)
    pour.no_estimate = "it comes to no end: the conductance jumps where the gap opens";
}

/// Lets metal that shares faces exchange heat: what would freeze later alone, as a riser does, gives heat to
/// what would freeze earlier, and that is liquid where both meet until the estimate of the other says that it
/// is solid there. The slowest come first.
void exchange_heat(const CaseMeasures& m, const setup::Assembly& a, std::vector<EstimatedPour>& all) {
  std::vector<EstimatedPour*> by_time;
  for (EstimatedPour& one : all)
    if (one.pour.alone_time) by_time.push_back(&one);
  std::ranges::stable_sort(by_time, [](const EstimatedPour* one, const EstimatedPour* other) {
    return *one->pour.alone_time > *other->pour.alone_time;
  });
  for (std::size_t i = 0; i < by_time.size(); ++i) {
    Pour& slow = by_time[i]->pour;
    const BodyMeasures& body = m.bodies[slow.body];
    FreezingProblem problem = by_time[i]->problem;
    std::vector<Pour*> fast;
    for (std::size_t j = i + 1; j < by_time.size(); ++j) {
      EstimatedPour& other = *by_time[j];
      const double shared = body.shared[other.pour.body], volume = m.bodies[other.pour.body].volume;
      if (!(shared > 0)) continue;
      problem.neighbours.push_back({&a.materials[other.pour.body], a.start[other.pour.body].high,
                                    shared / slow.cooled_area, volume / body.volume,
                                    heat_by_volume(other.skins, volume, a)});
      fast.push_back(&other.pour);
    }
    if (fast.empty()) continue;
    FreezingEstimate together = estimate_freezing(problem);
    if (!together.time) continue;
    *together.time *= by_time[i]->of_thickest;
    for (double& neighbour : together.neighbours) neighbour *= by_time[i]->of_thickest;
    // The estimate together with a slower neighbour, made in an earlier pass, is a lower bound.
    const double before = *slow.freezing.time, least = before > *slow.alone_time ? before : 0.0;
    slow.freezing = together;
    slow.freezing.time = std::max(least, *together.time);
    for (std::size_t j = 0; j < fast.size(); ++j)
      fast[j]->freezing.time = std::max(*fast[j]->freezing.time, together.neighbours[j]);
  }
}

}  // namespace

std::vector<Pour> pours(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures& m) {
  std::vector<EstimatedPour> all;
  std::vector<std::size_t> bodies;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    if (comes_in_molten(a, b)) bodies.push_back(b);
  // In order of pouring: a casting that is solid when the next one comes in takes heat from it as a mould
  // does.
  std::ranges::stable_sort(bodies, {}, [&](std::size_t b) { return time_of_pour(spec, a, b); });
  for (const std::size_t b : bodies) {
    EstimatedPour estimated;
    Pour& pour = estimated.pour;
    pour.body = b;
    const bool heated =
        std::any_of(spec.thermal_conditions.begin(), spec.thermal_conditions.end(),
                    [&](const auto& c) { return c.in_volume() && c.group == spec.bodies[b].mesh_group(); }) ||
        std::ranges::any_of(spec.sources, [&](const cases::SourceSpec& s) {
          return std::ranges::find(s.groups, spec.bodies[b].mesh_group()) != s.groups.end();
        });
    if (heated)
      pour.no_estimate = "a source heats it";
    else if (spec.time.steady)
      pour.no_estimate = "the analysis is steady";
    else
      estimate_alone(spec, a, m, all, estimated);
    all.push_back(std::move(estimated));
  }
  std::ranges::sort(all, {}, [](const EstimatedPour& one) { return one.pour.body; });
  exchange_heat(m, a, all);
  std::vector<Pour> list;
  for (EstimatedPour& estimated : all) list.push_back(std::move(estimated.pour));
  return list;
}

}  // namespace solidus::check
