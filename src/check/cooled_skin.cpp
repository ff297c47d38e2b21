/// What lies beyond each face is found by contacts, shared faces and conditions; areas are then summed by
/// it.
#include "check/cooled_skin.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "contact/interface/heat_transfer.hpp"
#include "heat/loads/surface_heat.hpp"
#include "numbers/index_casts.hpp"
#include "setup/body_input.hpp"
#include "setup/heat_input.hpp"

namespace solidus::check {

namespace {

/// The conductance of a face that bodies share, and of a skin whose temperature is prescribed [W/(m² K)].
constexpr double k_no_resistance = 1e6;

/// Heat by a film, radiation or flux, as a mean over its surface; and a prescribed temperature.
class SurfaceHeat {
 public:
  SurfaceHeat(heat::SurfaceLaw law, std::vector<mesh::Point> points, double end)
      : law_(std::move(law)), n_(std::max<std::size_t>(points.size(), 1)), end_(end) {
    law_.set_points(std::move(points));
    law_.set_window(LoadWindow::at(0));
  }
  double operator()(double temperature, double time) {
    time = std::min(time, end_);  // what comes after the run is as at its end
    if (time != time_) law_.set_window(LoadWindow::at(time_ = time));
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

std::function<double(double, double)> averaged(heat::SurfaceLaw law, const setup::SurfaceMeasures& surface,
                                               double end) {
  auto shared = std::make_shared<SurfaceHeat>(std::move(law), surface.centres, end);
  return [shared](double temperature, double time) { return (*shared)(temperature, time); };
}

/// Returns the parts of the skin of a body that thermal conditions of a stage cool.
std::vector<CooledSkin> conditions_on(std::size_t body, const Surroundings& in) {
  const cases::CaseSpec& spec = in.spec;
  const CaseMeasures& m = in.m;
  std::vector<CooledSkin> skins;
  // Only the conditions that hold in the stage cool, and each in the form that the run itself uses.
  const heat::ThermalConditions conditions = setup::thermal_conditions(spec, in.stage);
  // The measures of a surface are those of the condition that names it.
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
  // Conditions that depend on the place are averaged over their surface, for the estimate knows one
  // temperature of the skin.
  const double end = spec.time.end.value_or(0);
  const auto by_law = [end](const auto& condition) {
    return [&condition, end](const setup::SurfaceMeasures& s) {
      return averaged(heat::SurfaceLaw(condition), s, end);
    };
  };
  for (const heat::Film& c : conditions.films) add(c.surface, by_law(c));
  // Surfaces that see each other count as if they saw their surroundings alone: this is an estimate.
  for (const heat::Radiation& c : conditions.radiations)
    add(c.surface, [&c, end](const setup::SurfaceMeasures& s) {
      heat::Radiation alone = c;
      alone.enclosed = false;
      return averaged(heat::SurfaceLaw(alone), s, end);
    });
  for (const heat::Flux& c : conditions.fluxes) add(c.surface, by_law(c));
  // A prescribed temperature is a film without resistance.
  for (const heat::PrescribedTemperature& c : conditions.temperatures)
    if (c.value.uniform())
      add(c.node_set, [&](const setup::SurfaceMeasures&) {
        return [value = c.value](double temperature, double time) {
          return k_no_resistance * (value.value(time) - temperature);
        };
      });
  return skins;
}

/// Conductance h of a contact at a further gap, including radiation across the gap.
std::function<double(double, double, double)> conductance_of(const cases::ContactSpec& contact,
                                                             const setup::Assembly& a,
                                                             const setup::ContactMeasures& m) {
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

std::vector<CooledSkin> contacts_of(std::size_t body, const Surroundings& in) {
  // The skins through which contacts cool a body: area, points, and the heat that passes at given
  // temperatures. A contact with the body on both sides takes nothing from it.
  const cases::CaseSpec& spec = in.spec;
  const setup::Assembly& a = in.a;
  std::vector<CooledSkin> skins;
  for (std::size_t c = 0; c < spec.contacts.size(); ++c) {
    const cases::ContactSpec& contact = spec.contacts[c];
    const setup::ContactMeasures& sides = in.m.contacts[c];
    const double of_slave = setup::share_behind(a.mesh, sides.slave, static_cast<int>(body)),
                 of_master = setup::share_behind(a.mesh, sides.master, static_cast<int>(body));
    const bool slave = of_slave > 0;
    if (!contact.heat || slave == (of_master > 0) || !setup::holds(spec, contact, a.mesh, in.stage)) continue;
    const int other = slave ? sides.master_body : sides.slave_body;
    CooledSkin skin;
    skin.area = sides.paired * (slave ? of_slave : of_master);
    skin.surface = slave ? sides.slave : sides.master;
    skin.points = setup::measure_surface(a.mesh, skin.surface, spec.analysis.kind).corners;
    const auto conductance = conductance_of(contact, a, sides);
    // Another body is warmed by what it takes; its temperatures at the start bound the estimate.
    if (other >= 0) {
      skin.other = as_size(other);
      skin.low = a.start[*skin.other].low;
      skin.high = a.start[*skin.other].high;
      skin.conductance = conductance;
      skin.may_open = spec.has_mechanics() && !cases::only_conducts(spec.bodies[body]);
      // A tool with a temperature takes heat without getting warmer. Without one it takes none.
    } else if (const cases::RigidSurfaceSpec* tool = spec.rigid_surface(sides.master);
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

/// Faces that a body shares with others, which conduct without any resistance.
std::vector<CooledSkin> shared_faces_of(std::size_t body, const Surroundings& in) {
  const setup::Assembly& a = in.a;
  const CaseMeasures& m = in.m;
  std::vector<CooledSkin> skins;
  // Bodies with common faces are soldered: the skin is as cold as the other one is there.
  for (std::size_t other = 0; other < m.bodies.size(); ++other) {
    const double area = m.bodies[body].shared[other];
    if (!(area > 0)) continue;
    CooledSkin skin;
    skin.area = area;
    skin.other = other;
    skin.low = a.start[other].low;
    skin.high = a.start[other].high;
    skin.conductance = [](double, double, double) { return k_no_resistance; };
    // Points of the skin are the nodes that both bodies have, from the owners alone.
    const std::vector<char> here = nodes_of(a.mesh, body), there = nodes_of(a.mesh, other);
    std::vector<mesh::Point> points;
    for (std::size_t i = 0; i < as_size(a.mesh.n_owned_nodes); ++i)
      if (here[i] != 0 && there[i] != 0) points.push_back(a.mesh.x[i]);
    skin.points = setup::gather(points);
    skins.push_back(std::move(skin));
  }
  return skins;
}

/// Heat into a body of the mould, a sleeve or a chill, from a larger one that it lies in [W/m²]: that one as
/// a half space, √(k ρ c / (π t)) per kelvin, behind the conductance between both.
std::function<double(double, double)> heat_from_behind(const CooledSkin& skin, const setup::Assembly& a) {
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

}  // namespace

std::vector<CooledSkin> skins_of(std::size_t body, const Surroundings& in) {
  std::vector<CooledSkin> skins = contacts_of(body, in);
  for (CooledSkin& skin : shared_faces_of(body, in)) skins.push_back(std::move(skin));
  for (CooledSkin& skin : conditions_on(body, in)) skins.push_back(std::move(skin));
  return skins;
}

std::vector<char> nodes_of(const mesh::Mesh& mesh, std::size_t body) {
  std::vector<char> mine(mesh.x.size(), 0);
  for (const mesh::ElementBlock& block : mesh.blocks)
    if (block.body == static_cast<int>(body))
      for (const Index node : block.nodes) mine[as_size(node)] = 1;
  return mine;
}

double cooling_of(const CooledSkin& skin, double start, double end) {
  if (skin.other) return skin.conductance(0, start, skin.low) * (start - skin.low);
  double most = -std::numeric_limits<double>::max();
  for (const double share : {0.0, 0.01, 0.1, 0.3, 1.0}) most = std::max(most, -skin.heat(start, share * end));
  return most;
}

bool comes_in_molten(const setup::Assembly& a, std::size_t body) {
  const material::PhaseChange* freezing = a.materials[body].solidification();
  return freezing != nullptr && a.start[body].high > freezing->fraction.solidus();
}

std::function<double(double, double)> heat_by_volume(std::vector<CooledSkin> skins, double volume,
                                                     const setup::Assembly& a) {
  for (CooledSkin& skin : skins)
    if (skin.other) skin.heat = heat_from_behind(skin, a);
  return [skins = std::move(skins), volume](double temperature, double time) {
    double q = 0;
    for (const CooledSkin& skin : skins) q += skin.area / volume * skin.heat(temperature, time);
    return q;
  };
}

std::function<double(double, double)> outer_heat(std::size_t mould, double cooled_area, double part,
                                                 const Surroundings& in) {
  const setup::Assembly& a = in.a;
  const CaseMeasures& m = in.m;
  // Outer conditions of the mould, and contacts with larger bodies behind it that are not poured.
  std::vector<CooledSkin> skins = conditions_on(mould, in);
  for (CooledSkin& skin : contacts_of(mould, in)) {
    if (!skin.other || comes_in_molten(a, *skin.other) ||
        m.bodies[*skin.other].volume < m.bodies[mould].volume)
      continue;
    skin.heat = heat_from_behind(skin, a);
    skins.push_back(std::move(skin));
  }
  // Without anything behind it the mould is taken as endless, which the caller does where it gets
  // no function.
  if (skins.empty()) return {};
  // Their heat flux relates to the area of the metal, of which this is one part.
  return [skins, factor = part / cooled_area](double temperature, double time) {
    double q = 0;
    for (const CooledSkin& skin : skins) q += skin.area * factor * skin.heat(temperature, time);
    return q;
  };
}

}  // namespace solidus::check
