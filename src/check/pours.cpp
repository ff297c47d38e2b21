// Poured bodies and the skins that cool them, as a problem in one dimension (check/freezing_estimate.hpp).
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include "build/body_input.hpp"
#include "build/heat_input.hpp"
#include "check/case_measures.hpp"
#include "contact/heat_transfer.hpp"
#include "contact/surface.hpp"
#include "heat/surface_heat.hpp"
#include "parallel/parallel.hpp"

namespace solidus::model {

namespace {

/// The conductance of a face that bodies share, and of a skin whose temperature is prescribed [W/(m² K)].
constexpr double k_no_resistance = 1e6;

/// A part of the skin of a body that something cools, heats or holds.
struct CooledSkin {
  double area = 0;
  double cooling = 0;                ///< at the start, over the run the largest [W/m²]
  std::vector<mesh::Point> points;   ///< on it
  std::string surface;               ///< of the mesh; empty: faces that bodies share
  std::optional<std::size_t> other;  ///< the body on the other side
  double low = 0, high = 0;          ///< temperatures of that body when the metal comes [K]
  std::function<double(double, double, double)> conductance;  ///< to it: MouldSide::conductance
  bool may_open = false;
  std::function<double(double, double)> heat;  ///< without: into the body [W/m²], OpenSide::heat
};

/// Heat by a film, radiation or flux, as a mean over its surface; and a prescribed temperature.
class SurfaceHeat {
 public:
  SurfaceHeat(heat::SurfaceLaw law, std::vector<mesh::Point> points, double end)
      : law_(std::move(law)), n_(std::max<std::size_t>(points.size(), 1)), end_(end) {
    law_.set_points(std::move(points));
    law_.set_time(0);
  }
  double operator()(double temperature, double time) {
    time = std::min(time, end_);  // what comes after the run is as at its end
    if (time != time_) law_.set_time(time_ = time);
    if (!law_.placed()) return law_.at(temperature).q;
    double sum = 0;
    for (std::size_t i = 0; i < n_; ++i) sum += law_.at(temperature, i).q;
    return sum / static_cast<double>(n_);
  }

 private:
  heat::SurfaceLaw law_;
  std::size_t n_;
  double end_, time_ = 0;
};

std::function<double(double, double)> averaged(heat::SurfaceLaw law, const SurfaceMeasures& surface,
                                               double end) {
  auto shared = std::make_shared<SurfaceHeat>(std::move(law), surface.centres, end);
  return [shared](double temperature, double time) { return (*shared)(temperature, time); };
}

/// Returns the parts of the skin of a body that thermal conditions of a stage cool.
std::vector<CooledSkin> conditions_on(std::size_t body, const CaseSpec& spec, const StageRun* stage,
                                      const CaseMeasures& m) {
  std::vector<CooledSkin> skins;
  const heat::ThermalConditions conditions = thermal_conditions(spec, stage);
  const auto add = [&](const std::string& group, const auto& law) {
    for (std::size_t c = 0; c < spec.thermal_conditions.size(); ++c)
      if (spec.thermal_conditions[c].group == group && m.surfaces[c].area > 0 &&
          m.surfaces[c].body == static_cast<int>(body)) {
        CooledSkin skin;
        skin.area = m.surfaces[c].area;
        skin.points = m.surfaces[c].corners;
        skin.surface = group;
        skin.heat = law(m.surfaces[c]);
        skins.push_back(std::move(skin));
        return;
      }
  };
  const double end = spec.time.end.value_or(0);
  const auto by_law = [end](const auto& condition) {
    return
        [&condition, end](const SurfaceMeasures& s) { return averaged(heat::SurfaceLaw(condition), s, end); };
  };
  for (const heat::Film& c : conditions.films) add(c.surface, by_law(c));
  for (const heat::Radiation& c : conditions.radiations) add(c.surface, by_law(c));
  for (const heat::Flux& c : conditions.fluxes) add(c.surface, by_law(c));
  for (const heat::PrescribedTemperature& c : conditions.temperatures)
    if (c.value.uniform())
      add(c.node_set, [&](const SurfaceMeasures&) {
        return [value = c.value](double temperature, double time) {
          return k_no_resistance * (value.value(time) - temperature);
        };
      });
  return skins;
}

/// Conductance h of a contact at a further gap, including radiation across the gap.
std::function<double(double, double, double)> conductance_of(const ContactSpec& contact, const Assembly& a,
                                                             const ContactMeasures& m) {
  const auto law = std::make_shared<contact::HeatTransferLaw>(*contact.heat);
  const bool mechanical = a.mechanics != nullptr;
  const double pressure = mechanical && contact.wet ? contact.atmosphere : 0.0;
  const bool wet = mechanical && contact.wet;
  const double start = wet ? 0.0 : m.mean_start;
  return [law, pressure, start](double gap, double metal, double mould) {
    const double h = law->at(-(start + gap), pressure, (metal + mould) / 2).value;
    return h + law->radiation_factor() * (metal * metal + mould * mould) * (metal + mould);
  };
}

std::vector<CooledSkin> contacts_of(std::size_t body, const CaseSpec& spec, const StageRun* stage,
                                    const Assembly& a, const CaseMeasures& m) {
  std::vector<CooledSkin> skins;
  for (std::size_t c = 0; c < spec.contacts.size(); ++c) {
    const ContactSpec& contact = spec.contacts[c];
    const ContactMeasures& sides = m.contacts[c];
    const double of_slave = share_behind(a.mesh, sides.slave, static_cast<int>(body)),
                 of_master = share_behind(a.mesh, sides.master, static_cast<int>(body));
    const bool slave = of_slave > 0;
    if (!contact.heat || slave == (of_master > 0) || !holds(spec, contact, a.mesh, stage)) continue;
    const int other = slave ? sides.master_body : sides.slave_body;
    CooledSkin skin;
    skin.area = sides.paired * (slave ? of_slave : of_master);
    skin.surface = slave ? sides.slave : sides.master;
    skin.points = measure_surface(a.mesh, skin.surface, spec.analysis.kind).corners;
    const auto conductance = conductance_of(contact, a, sides);
    if (other >= 0) {
      skin.other = static_cast<std::size_t>(other);
      skin.low = a.start[*skin.other].low;
      skin.high = a.start[*skin.other].high;
      skin.conductance = conductance;
      skin.may_open = spec.has_mechanics() && !only_conducts(spec.bodies[body]);
    } else if (const RigidSurfaceSpec* tool = spec.rigid_surface(sides.master);
               tool != nullptr && tool->temperature) {
      skin.heat = [conductance, table = tool->temperature->table](double temperature, double time) {
        const double there = table.value(time);
        return conductance(0, temperature, there) * (there - temperature);
      };
    } else {
      continue;
    }
    skins.push_back(std::move(skin));
  }
  return skins;
}

/// [local node]
std::vector<char> nodes_of(const mesh::Mesh& mesh, std::size_t body) {
  std::vector<char> mine(mesh.x.size(), 0);
  for (const mesh::ElementBlock& block : mesh.blocks)
    if (block.body == static_cast<int>(body))
      for (const Index node : block.nodes) mine[static_cast<std::size_t>(node)] = 1;
  return mine;
}

/// Faces that a body shares with others, which conduct without any resistance.
std::vector<CooledSkin> shared_faces_of(std::size_t body, const Assembly& a, const CaseMeasures& m) {
  std::vector<CooledSkin> skins;
  for (std::size_t other = 0; other < m.bodies.size(); ++other) {
    const double area = m.bodies[body].shared[other];
    if (!(area > 0)) continue;
    CooledSkin skin;
    skin.area = area;
    skin.other = other;
    skin.low = a.start[other].low;
    skin.high = a.start[other].high;
    skin.conductance = [](double, double, double) { return k_no_resistance; };
    const std::vector<char> here = nodes_of(a.mesh, body), there = nodes_of(a.mesh, other);
    std::vector<mesh::Point> points;
    for (std::size_t i = 0; i < static_cast<std::size_t>(a.mesh.n_owned_nodes); ++i)
      if (here[i] != 0 && there[i] != 0) points.push_back(a.mesh.x[i]);
    skin.points = gather(points);
    skins.push_back(std::move(skin));
  }
  return skins;
}

/// The greatest distance of a node of the body from a cloud of points, both thinned out where there are very
/// many.
double depth_below(const mesh::Mesh& mesh, std::size_t body, const std::vector<mesh::Point>& cloud) {
  constexpr std::size_t k_most_nodes = 20000, k_most_points = 50000;
  const std::vector<char> of_body = nodes_of(mesh, body);
  std::vector<std::size_t> nodes;
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.n_owned_nodes); ++i)
    if (of_body[i] != 0) nodes.push_back(i);
  const std::size_t every = 1 + nodes.size() / k_most_nodes, stride = 1 + cloud.size() / k_most_points;
  const auto squared = [&](std::size_t node, std::size_t point) {
    const mesh::Point &x = mesh.x[node], &y = cloud[point];
    const double dx = x[0] - y[0], dy = x[1] - y[1], dz = x[2] - y[2];
    return dx * dx + dy * dy + dz * dz;
  };
  double depth = 0;
  std::size_t hint = 0;  // the point that was near the node before
  for (std::size_t n = 0; n < nodes.size() && !cloud.empty(); n += every) {
    double nearest = squared(nodes[n], hint);
    // A node that is nearer than the deepest so far is not the deepest.
    for (std::size_t i = 0; i < cloud.size() && nearest > depth; i += stride)
      if (const double here = squared(nodes[n], i); here < nearest) nearest = here, hint = i;
    depth = std::max(depth, nearest);
  }
  return std::sqrt(parallel::global_max(depth));
}

/// Largest heat flux into a skin at the start or later in the run, at the temperature of the pour [W/m²].
double cooling_of(const CooledSkin& skin, double start, double end) {
  if (skin.other) return skin.conductance(0, start, skin.low) * (start - skin.low);
  double most = -std::numeric_limits<double>::max();
  for (const double share : {0.0, 0.01, 0.1, 0.3, 1.0}) most = std::max(most, -skin.heat(start, share * end));
  return most;
}

/// Whether a body comes in that is not solid then.
bool comes_in_molten(const Assembly& a, std::size_t body) {
  const material::PhaseChange* freezing = a.materials[body].solidification();
  return freezing != nullptr && a.start[body].high > freezing->fraction.solidus();
}

/// Heat into a body of the mould, a sleeve or a chill, from a larger one that it lies in [W/m²]: that one as
/// a half space, √(k ρ c / (π t)) per kelvin, behind the conductance between both.
std::function<double(double, double)> heat_from_behind(const CooledSkin& skin, const Assembly& a) {
  const material::Material& m = a.materials[*skin.other];
  const double cold = skin.low;
  const double effusivity = std::sqrt(m.conductivity.value(cold) * m.density * m.specific_heat.value(cold));
  return [conductance = skin.conductance, cold, effusivity](double temperature, double time) {
    constexpr double k_pi = 3.14159265358979;
    const double resistance =
        1 / conductance(0, temperature, cold) + std::sqrt(k_pi * std::max(time, 0.0)) / effusivity;
    return (cold - temperature) / resistance;
  };
}

/// Heat into metal through its cooled skins, per its volume [W/m³]; moulds as half spaces.
std::function<double(double, double)> heat_by_volume(std::vector<CooledSkin> skins, double volume,
                                                     const Assembly& a) {
  for (CooledSkin& skin : skins)
    if (skin.other) skin.heat = heat_from_behind(skin, a);
  return [skins = std::move(skins), volume](double temperature, double time) {
    double q = 0;
    for (const CooledSkin& skin : skins) q += skin.area / volume * skin.heat(temperature, time);
    return q;
  };
}

/// Heat into the outside of a mould per area of the casting's cooled skin.
std::function<double(double, double)> outer_heat(std::size_t mould, double cooled_area, double part,
                                                 const CaseSpec& spec, const StageRun* stage,
                                                 const Assembly& a, const CaseMeasures& m) {
  std::vector<CooledSkin> skins = conditions_on(mould, spec, stage, m);
  for (CooledSkin& skin : contacts_of(mould, spec, stage, a, m)) {
    if (!skin.other || comes_in_molten(a, *skin.other) ||
        m.bodies[*skin.other].volume < m.bodies[mould].volume)
      continue;
    skin.heat = heat_from_behind(skin, a);
    skins.push_back(std::move(skin));
  }
  if (skins.empty()) return {};
  return [skins, factor = part / cooled_area](double temperature, double time) {
    double q = 0;
    for (const CooledSkin& skin : skins) q += skin.area * factor * skin.heat(temperature, time);
    return q;
  };
}

/// The stage in which a body comes in; null without stages.
const StageRun* stage_of_pour(const CaseSpec& spec, const Assembly& a, std::size_t body) {
  const auto stage = std::ranges::find_if(
      a.stages, [&](const StageRun& run) { return holds(spec.bodies[body].stages, &run); });
  return stage != a.stages.end() ? &*stage : nullptr;
}

/// When a body comes in [s].
double time_of_pour(const CaseSpec& spec, const Assembly& a, std::size_t body) {
  const StageRun* const stage = stage_of_pour(spec, a, body);
  return stage != nullptr ? stage->start : 0.0;
}

/// A pour and what its estimate was made of.
struct EstimatedPour {
  Pour pour;
  FreezingProblem problem;  ///< of the body alone; complete where the pour has a time
  /// All of them, but for the faces that it shares with other metal that is poured.
  std::vector<CooledSkin> skins;
};

/// Finds the parts of the skin that count as cooled, and the problem in one dimension, without the metal that
/// is poured with the body: the skin that its mould cools is the A of V/A.
/// @param earlier  estimates of what was poured before: a casting that is solid by now takes heat as a mould
///                 does, from its solidus on, which it has reached at least
void estimate_alone(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m,
                    std::span<const EstimatedPour> earlier, EstimatedPour& estimated) {
  Pour& pour = estimated.pour;
  const std::size_t body = pour.body;
  const StageRun* const stage = stage_of_pour(spec, a, body);
  const double start = a.start[body].high, end = spec.time.end.value_or(0);
  std::vector<CooledSkin> skins = contacts_of(body, spec, stage, a, m);
  for (CooledSkin& skin : shared_faces_of(body, a, m)) skins.push_back(std::move(skin));
  for (CooledSkin& skin : conditions_on(body, spec, stage, m)) skins.push_back(std::move(skin));
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
  double most = 0;
  for (CooledSkin& skin : skins) most = std::max(most, skin.cooling = cooling_of(skin, start, end));
  if (!(most > 0)) {
    pour.no_estimate = "nothing cools it";
    return;
  }
  // Skin that loses less than a hundredth of the heat of the rest does not count in V/A.
  constexpr double k_little = 0.03;
  std::vector<mesh::Point> cloud;
  std::vector<char> on_skin(a.mesh.x.size(), 0);
  std::vector<double> facing(m.bodies.size(), 0.0);  // area toward each other body
  for (const CooledSkin& skin : skins) {
    if (skin.other) facing[*skin.other] += skin.area;
    if (skin.cooling < k_little * most) continue;
    pour.cooled_area += skin.area;
    pour.conductance += skin.area * skin.cooling;
    if (skin.surface.empty()) {
      const std::vector<char> there = nodes_of(a.mesh, *skin.other);
      for (std::size_t i = 0; i < there.size(); ++i) on_skin[i] = static_cast<char>(on_skin[i] | there[i]);
    } else if (const auto surface = a.mesh.surfaces.find(skin.surface); surface != a.mesh.surfaces.end()) {
      for (const Index node : surface->second.nodes) on_skin[static_cast<std::size_t>(node)] = 1;
    }
    cloud.insert(cloud.end(), skin.points.begin(), skin.points.end());
  }
  pour.cooled_area = std::min(pour.cooled_area, m.bodies[body].skin);  // two films on one surface
  pour.spanned = share_between(a.mesh, spec.analysis.kind, static_cast<int>(body), on_skin);
  pour.depth = depth_below(a.mesh, body, cloud);
  FreezingProblem& problem = estimated.problem;
  problem.metal = &a.materials[body];
  problem.start = start;
  problem.modulus = m.bodies[body].volume / pour.cooled_area;
  problem.depth = pour.depth;
  double coldest = start;
  for (const CooledSkin& skin : skins) {
    const double share = skin.area / pour.cooled_area;
    if (skin.other) {
      const std::size_t other = *skin.other;
      const double part = skin.area / facing[other];
      coldest = std::min(coldest, skin.low);
      problem.moulds.push_back({share, &a.materials[other], (skin.low + skin.high) / 2,
                                part * m.bodies[other].volume / m.bodies[body].volume, skin.conductance,
                                skin.may_open, outer_heat(other, pour.cooled_area, part, spec, stage, a, m)});
    } else {
      problem.open.push_back({[heat = skin.heat, share](double temperature, double time) {
        return share * heat(temperature, time);
      }});
    }
  }
  const bool against_mould = coldest < start;
  const double drop = against_mould ? start - coldest : std::max(1.0, start - k_zero_celsius - 20);
  pour.conductance /= pour.cooled_area * drop;
  estimated.skins = std::move(skins);
  pour.freezing = estimate_freezing(problem);
  pour.alone_time = pour.freezing.time;
  if (pour.freezing.gave_up)
    pour.no_estimate = "it comes to no end: the conductance jumps where the gap opens";
}

/// Lets metal that shares faces exchange heat: what would freeze later alone, as a riser does, gives heat to
/// what would freeze earlier, and that is liquid where both meet until the estimate of the other says that it
/// is solid there. The slowest come first.
void exchange_heat(const CaseMeasures& m, const Assembly& a, std::vector<EstimatedPour>& all) {
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
    const FreezingEstimate together = estimate_freezing(problem);
    if (!together.time) continue;
    // The estimate together with a slower neighbour, made in an earlier turn, is a lower bound.
    const double before = *slow.freezing.time, least = before > *slow.alone_time ? before : 0.0;
    slow.freezing = together;
    slow.freezing.time = std::max(least, *together.time);
    for (std::size_t j = 0; j < fast.size(); ++j)
      fast[j]->freezing.time = std::max(*fast[j]->freezing.time, together.neighbours[j]);
  }
}

}  // namespace

std::vector<Pour> pours(const CaseSpec& spec, const Assembly& a, const CaseMeasures& m) {
  std::vector<EstimatedPour> all;
  std::vector<std::size_t> bodies;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b)
    if (comes_in_molten(a, b)) bodies.push_back(b);
  std::ranges::stable_sort(bodies, {}, [&](std::size_t b) { return time_of_pour(spec, a, b); });
  for (const std::size_t b : bodies) {
    EstimatedPour estimated;
    Pour& pour = estimated.pour;
    pour.body = b;
    const bool heated =
        std::any_of(spec.thermal_conditions.begin(), spec.thermal_conditions.end(),
                    [&](const auto& c) { return c.in_volume() && c.group == spec.bodies[b].mesh_group(); });
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

}  // namespace solidus::model
