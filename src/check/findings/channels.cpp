/// Findings of cooling channels: those that leave their body, laminar flow, walls thinner than the channel,
/// and water that warms up much.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "check/finding_family.hpp"
#include "heat/channels/channel_line.hpp"
#include "heat/loads/channel_film.hpp"
#include "heat/loads/channel_fluid.hpp"
#include "mesh/body_faces.hpp"
#include "mesh/element_search.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "setup/channel_input.hpp"

namespace solidus::check {

namespace {

constexpr double k_outside = 0.02;  // of the length of a channel
constexpr double k_much = 10;       // by which the fluid warms up [K]
constexpr double k_wall = 0.5;      // of the diameter: metal between the channel and the skin

std::string at(const Position& x) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) mm", 1e3 * x[0], 1e3 * x[1], 1e3 * x[2]);
}

/// One channel of a case in its mesh.
struct Subject {
  const cases::CaseSpec& spec;
  const cases::ChannelSpec& channel;
  const mesh::Mesh& mesh;
  int body = 0;
  const heat::ChannelLine& line;
};

/// A channel that runs through nothing is an error, one that does for a part of its way a finding.
void outside(const Subject& s, Findings& findings) {
  double whole = 0, inside = 0;
  const heat::ChannelLine::Station* first = nullptr;
  for (const heat::ChannelLine::Station& station : s.line.stations()) {
    // Half of its wall is enough in a plane of symmetry.
    const double here = std::min(1.0, station.inside / s.channel.share);
    whole += station.length;
    inside += here * station.length;
    if (here < 1 - k_outside && first == nullptr) first = &station;
  }
  if (first == nullptr || inside > (1 - k_outside) * whole) return;
  findings.push_back(
      {inside == 0, s.channel.where,
       fmt::format("{:.0f} % of the wall of the channel '{}' lies outside of '{}', the first at {}: nothing "
                   "is cooled there",
                   100 * (1 - inside / whole), s.channel.name, s.channel.body, at(first->x)),
       "a path in the metal, in its unit of length; share = 0.5 in a plane of symmetry"});
}

/// Flow at the inlet at the start: laminar, or so little that its heat capacity is used up.
void flow(const Subject& s, Findings& findings) {
  const cases::ChannelSpec& c = s.channel;
  if (!c.inlet || c.inlet->place != nullptr) return;
  const Function& given = c.flow ? *c.flow : *c.mass_flow;
  const heat::ChannelFluid fluid = c.fluid == cases::ChannelSpec::Fluid::water
                                       ? heat::water()
                                       : heat::ChannelFluid{c.density.table, c.specific_heat.table,
                                                            c.conductivity.table, c.viscosity.table};
  const double inlet = c.inlet->table.min_value(), most = given.table.max_value();
  const double mass = most * (c.flow ? fluid.density.value(inlet) : 1.0);
  if (!(mass > 0)) return;
  const double reynolds = heat::reynolds_number(mass, c.diameter, fluid.viscosity.value(inlet));
  if (reynolds < heat::k_laminar_reynolds)
    findings.push_back({false, c.where,
                        fmt::format("the flow in the channel '{}' is laminar, Re = {:.0f}: it cools little",
                                    c.name, reynolds),
                        fmt::format("{:.2g} kg/s or more make it turbulent", mass * 4000 / reynolds)});
  // With the temperature of the body at the start the most that the fluid can warm up by.
  const auto body =
      std::ranges::find_if(s.spec.bodies, [&](const cases::BodySpec& b) { return b.mesh_group() == c.body; });
  if (body == s.spec.bodies.end() || body->initial_temperature.place != nullptr) return;
  double length = 0;
  for (const heat::ChannelLine::Station& station : s.line.stations()) length += station.length;
  const double hot = body->initial_temperature.table.value(0);
  const double film = heat::nusselt(c.law, c.laminar, reynolds, fluid.prandtl(inlet), hot > inlet) *
                      fluid.conductivity.value(inlet) / c.diameter;
  const double units =
      film * std::numbers::pi * c.diameter * length / (mass * fluid.specific_heat.value(inlet));
  const double warmed = -std::expm1(-units) * (hot - inlet);
  if (std::abs(warmed) > k_much)
    findings.push_back(
        {false, c.where,
         fmt::format("what flows in the channel '{}' changes its temperature by up to {:.0f} K on its way "
                     "through a body of {:.0f} degC: its end cools otherwise than its begin",
                     c.name, std::abs(warmed), hot - k_zero_celsius),
         "a larger flow, or shorter channels beside each other"});
}

/// The least distance of the middle of the channel from the skin of the body, but for its ends, where it
/// comes in and goes out.
void walls(const Subject& s, Findings& findings) {
  if (s.channel.share < 1 || s.mesh.dimension != 3) return;
  const std::vector<heat::ChannelLine::Station>& stations = s.line.stations();
  double least = HUGE_VAL;
  Position place{};
  mesh::each_body_face(s.mesh, [&](const mesh::BodyFace& face, std::span<const mesh::BodyFace>) {
    if (face.body != s.body) return;
    Position middle{};
    for (const Index node : face.vertices())
      for (std::size_t k = 0; k < 3; ++k) middle[k] += s.mesh.x[as_size(node)][k] / face.n_vertices;
    for (const heat::ChannelLine::Station& station : stations) {
      const auto away = [&](const Position& x) {
        return std::hypot(station.x[0] - x[0], station.x[1] - x[1], station.x[2] - x[2]);
      };
      if (away(stations.front().x) < 2 * s.channel.diameter ||
          away(stations.back().x) < 2 * s.channel.diameter)
        continue;
      if (away(middle) >= least) continue;
      least = away(middle);
      place = station.x;
    }
  });
  const double over_all = parallel::global_min(least);
  const double metal = over_all - 0.5 * s.channel.diameter;
  if (!(metal < k_wall * s.channel.diameter)) return;
  // The process that has found it says where.
  for (double& x : place) x = parallel::global_max(least == over_all ? x : -HUGE_VAL);
  findings.push_back(
      {false, s.channel.where,
       fmt::format("at {} the channel '{}' has {:.2g} mm of metal between its wall and the skin "
                   "of '{}', less than half its diameter",
                   at(place), s.channel.name, 1e3 * std::max(metal, 0.0), s.channel.body),
       "one to two diameters"});
}

void find(const cases::CaseSpec& spec, const setup::Assembly& a, const CaseMeasures&, Findings& findings) {
  for (const cases::ChannelSpec& c : spec.channels) {
    const auto body =
        std::ranges::find_if(a.mesh.bodies, [&](const mesh::Body& b) { return b.name == c.body; });
    if (body == a.mesh.bodies.end()) continue;
    const auto number = static_cast<int>(body - a.mesh.bodies.begin());
    const heat::ChannelLine line(a.mesh, spec.analysis.kind, number, setup::channel_path(c, spec.dimension()),
                                 c.diameter, true);
    const Subject subject{spec, c, a.mesh, number, line};
    outside(subject, findings);
    if (c.after.empty()) flow(subject, findings);
    walls(subject, findings);
  }
}

}  // namespace

FindingFamily findings_channels() {
  return {.name = "cooling channels",
          .place = 286,
          .find = &find,
          .rows = {{Topic::conditions, "a channel outside of its body",
                    fmt::format("{} or more of its wall; all of it is an error", percent(k_outside))},
                   {Topic::conditions, "laminar flow in a channel",
                    fmt::format("Re below {} at its inlet", number(heat::k_laminar_reynolds))},
                   {Topic::conditions, "a channel near the skin of its body",
                    fmt::format("less than {} diameters of metal, in space", number(k_wall))},
                   {Topic::conditions, "a fluid that warms up much",
                    fmt::format("by more than {} K in a body that stays as hot as at the start",
                                number(k_much))}}};
}

}  // namespace solidus::check
