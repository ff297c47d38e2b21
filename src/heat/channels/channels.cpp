#include "heat/channels/channels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "heat/loads/channel_film.hpp"
#include "heat/loads/load_mean.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"
#include "system/processes.hpp"

namespace solidus::heat {

namespace {

constexpr double k_pi = std::numbers::pi;
/// The resistance between a node and the fluid is no less than this share of that of the film: an excess
/// below zero, by elements that show the wall colder than it is, must not turn it around.
constexpr double k_least_resistance = 0.25;

/// Channels of two stages that share their line, so that its geometry is built once.
bool same_line(const Channel& a, const Channel& b) {
  return a.body == b.body && a.path == b.path && a.diameter == b.diameter;
}

int body_number(const mesh::Mesh& mesh, const Channel& channel) {
  std::string names;
  for (std::size_t b = 0; b < mesh.bodies.size(); ++b) {
    if (mesh.bodies[b].name == channel.body) return static_cast<int>(b);
    names += (names.empty() ? "" : ", ") + mesh.bodies[b].name;
  }
  throw InputError({}, fmt::format("the channel '{}' is in no body '{}'", channel.name, channel.body), names);
}

}  // namespace

void Channels::set(const mesh::Mesh& mesh, AnalysisKind kind, const linear::ActiveSet& active, bool closed,
                   const ThermalConditions& conditions) {
  // A new stage may change flows and inlets. Lines of channels that stay are taken over, because the discrete
  // problem around each of them costs a solution.
  std::vector<One> before = std::exchange(channels_, {});
  order_.clear();
  for (const Channel& channel : conditions.channels) {
    if (!closed)
      throw InputError({}, fmt::format("the channel '{}' needs heat.integration = \"closed\"", channel.name),
                       "the closed rule, which is the default");
    One& one = channels_.emplace_back();
    one.channel = channel;
    one.body = body_number(mesh, channel);
    one.active = active.body(one.body);
    for (const One& old : before)
      if (same_line(old.channel, channel)) one.line = old.line;
    if (!one.line && one.active) {
      one.line =
          std::make_shared<const ChannelLine>(mesh, kind, one.body, channel.path, channel.diameter, closed);
      logging::debug("channel '{}': {} stations in elements of {:.3g} mm", channel.name,
                     one.line->stations().size(), 1e3 * one.line->element_size());
    }
    // A channel that follows another one is marched after it: the reader has put it behind that one.
    for (std::size_t k = 0; k + 1 < channels_.size(); ++k)
      if (channels_[k].channel.name == channel.after) one.before = k + 1;
    const std::size_t n = one.line ? one.line->stations().size() : 0;
    one.fluid = {std::vector<double>(n, 0.0), std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
    one.conductance.assign(one.line ? one.line->shares().size() : 0, 0.0);
    order_.push_back(channels_.size() - 1);
  }
}

void Channels::set_window(const LoadWindow& window) {
  // Upstream channels come first, so that what follows them finds their flow.
  for (const std::size_t k : order_) {
    One& one = channels_[k];
    if (one.before > 0) {  // it has what comes out of the one before
      one.flow = channels_[one.before - 1].flow;
      one.inlet = channels_[one.before - 1].inlet;
      continue;
    }
    // The mean flow, and the mean temperature of what flows.
    const LoadLaw law{LoadLaw::Kind::film, {one.channel.flow, one.channel.inlet}};
    const LoadValues mean = mean_load(window, law);
    one.inlet = law.ambient(mean, one.channel.inlet.value(window.time));
    one.flow = mean[0] * (one.channel.by_volume ? one.channel.fluid.density.value(one.inlet) : 1.0);
  }
}

/// The fluid on its way, from temperatures of the nodes and films of the fluid as it was; the conductances of
/// the shares become those of these.
Channels::Fluid Channels::march(One& one, std::span<const double> temperature,
                                const KirchhoffPotential& conductivity) {
  const Channel& c = one.channel;
  const std::vector<ChannelLine::Station>& stations = one.line->stations();
  const std::vector<ChannelLine::Share>& shares = one.line->shares();
  const std::size_t n = stations.size();
  Fluid next{std::vector<double>(n), std::vector<double>(n, 0.0), std::vector<double>(n, 0.0), 0, one.inlet};
  // Films by the fluid's temperature as it was.
  for (std::size_t s = 0; s < n; ++s) {
    const double fluid = one.fluid.temperature[s];
    const double reynolds = reynolds_number(one.flow, c.diameter, c.fluid.viscosity.value(fluid));
    next.reynolds += reynolds / static_cast<double>(n);
    next.film[s] = nusselt(c.law, c.laminar, reynolds, c.fluid.prandtl(fluid), one.fluid.taken[s] >= 0) *
                   c.fluid.conductivity.value(fluid) / c.diameter;
  }
  // Each station sums the conductances of its nodes, and their temperatures weighted by these.
  std::vector<double> sums(2 * n, 0.0);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const ChannelLine::Share& share = shares[i];
    const double t = temperature[as_size(share.node)];
    const double film = 1 / (next.film[share.station] * k_pi * c.diameter);
    const double resistance =
        std::max(film + share.excess / conductivity.conductivity(t), k_least_resistance * film);
    one.conductance[i] = share.weight * stations[share.station].length / resistance;
    sums[2 * share.station] += one.conductance[i];
    sums[2 * share.station + 1] += one.conductance[i] * t;
  }
  processes::sum(sums);
  // Station after station. Of a channel in a plane of symmetry a share is in the model, and that share of the
  // flow is.
  const double flow = c.share * one.flow;
  for (std::size_t s = 0; s < n; ++s) {
    const double g = sums[2 * s];
    next.temperature[s] = next.outlet;
    if (g == 0) continue;
    const double mean = sums[2 * s + 1] / g, capacity = flow * c.fluid.specific_heat.value(next.outlet);
    next.taken[s] = -capacity * std::expm1(-g / capacity) * (mean - next.outlet);
    next.temperature[s] = mean - next.taken[s] / g;
    next.outlet = c.fluid.heated(next.outlet, next.taken[s] / flow);
  }
  return next;
}

void Channels::march_all(std::span<const double> temperature,
                         std::span<const KirchhoffPotential> potentials) {
  for (const std::size_t k : order_) {
    One& one = channels_[k];
    if (one.before > 0) one.inlet = channels_[one.before - 1].fluid.outlet;
    if (one.flow > 0 && one.active) {
      one.fluid = march(one, temperature, potentials[as_size(one.body)]);
      continue;
    }
    // Nothing flows, nothing is exchanged: what stands in the channel is as warm as its wall.
    std::fill(one.conductance.begin(), one.conductance.end(), 0.0);
    const std::size_t n = one.fluid.temperature.size();
    one.fluid = {std::vector<double>(n, one.inlet), std::vector<double>(n, 0.0), std::vector<double>(n, 0.0),
                 0, one.inlet};
  }
}

void Channels::begin(std::span<const double> temperature, std::span<const KirchhoffPotential> potentials) {
  // The first way has the films of the inlet, the second one those of where the first one led.
  for (One& one : channels_) {
    std::fill(one.fluid.temperature.begin(), one.fluid.temperature.end(), one.inlet);
    std::fill(one.fluid.taken.begin(), one.fluid.taken.end(), 0.0);
    one.tried.clear();
    one.off.clear();
  }
  march_all(temperature, potentials);
  march_all(temperature, potentials);
}

/// Anderson's method of depth one: with the guess x, what followed from it g, f = g − x and the same of the
/// iteration before, the next guess is g − γ (g − g_before), γ the least squares of f − γ (f − f_before).
void Channels::mix(One& one, const std::vector<double>& guess) {
  std::vector<double>& followed = one.fluid.temperature;
  std::vector<double> off(guess.size());
  for (std::size_t s = 0; s < off.size(); ++s) off[s] = followed[s] - guess[s];
  std::vector<double> g = followed;
  if (!one.off.empty()) {
    double above = 0, below = 0;
    for (std::size_t s = 0; s < off.size(); ++s) {
      above += off[s] * (off[s] - one.off[s]);
      below += (off[s] - one.off[s]) * (off[s] - one.off[s]);
    }
    const double gamma = below > 0 ? above / below : 0;
    for (std::size_t s = 0; s < off.size(); ++s) followed[s] -= gamma * (g[s] - one.tried[s]);
  }
  one.tried = std::move(g);
  one.off = std::move(off);
}

bool Channels::follow(std::span<const double> temperature, std::span<const KirchhoffPotential> potentials,
                      double tolerance) {
  // One iteration: march all channels with the present temperatures, compare the fluid with the guess, and
  // mix the next guess where the two differ.
  std::vector<std::vector<double>> guesses;
  for (const One& one : channels_) guesses.push_back(one.fluid.temperature);
  march_all(temperature, potentials);
  double largest = 0;
  for (std::size_t k = 0; k < channels_.size(); ++k)
    for (std::size_t s = 0; s < guesses[k].size(); ++s)
      largest = std::max(largest, std::abs(channels_[k].fluid.temperature[s] - guesses[k][s]));
  if (largest < tolerance) return true;
  for (std::size_t k = 0; k < channels_.size(); ++k) mix(channels_[k], guesses[k]);
  return false;
}

/// Equation (c) of docs/theory/channels.md: each node gives heat by its own temperature, which goes to the
/// fluid of its station.
void Channels::add_residual(std::span<const double> temperature, std::span<double> out, double& moved) {
  for (One& one : channels_) {
    one.power = 0;
    for (std::size_t i = 0; i < one.conductance.size(); ++i) {
      const ChannelLine::Share& share = one.line->shares()[i];
      const auto node = as_size(share.node);
      const double heat = one.conductance[i] * (temperature[node] - one.fluid.temperature[share.station]);
      out[node] += heat;
      one.power -= heat;
      moved += std::abs(heat);
    }
  }
}

/// The exchange is on the diagonal alone: the matrix stays symmetric and of non-negative type.
void Channels::add_tangent(linear::BlockMatrix& matrix) const {
  for (const One& one : channels_)
    for (std::size_t i = 0; i < one.conductance.size(); ++i)
      *matrix.diagonal_block(one.line->shares()[i].node) += one.conductance[i];
}

void Channels::add_supply(std::span<const double> temperature, std::span<double> gain,
                          std::span<double> loss) const {
  for (const One& one : channels_)
    for (std::size_t i = 0; i < one.conductance.size(); ++i) {
      const ChannelLine::Share& share = one.line->shares()[i];
      const auto node = as_size(share.node);
      const double heat = one.conductance[i] * (one.fluid.temperature[share.station] - temperature[node]);
      (heat > 0 ? gain : loss)[node] += std::abs(heat);
    }
}

/// The inlets bound the temperatures that channels can cause.
TemperatureRange Channels::ambient() const {
  TemperatureRange range;
  for (const One& one : channels_) {
    if (!(one.flow > 0) || !one.active) continue;
    range.lowest = std::min(range.lowest, one.inlet);
    range.highest = std::max(range.highest, one.inlet);
  }
  return range;
}

std::vector<NamedPower> Channels::powers() const {
  std::vector<NamedPower> all;
  for (const One& one : channels_) all.push_back({one.channel.name, parallel::global_sum(one.power)});
  return all;
}

void Channels::clear_powers() {
  for (One& one : channels_) one.power = 0;
}

std::vector<ChannelReading> Channels::readings() const {
  std::vector<ChannelReading> all;
  for (const One& one : channels_) {
    ChannelReading& reading = all.emplace_back();
    reading.name = one.channel.name;
    reading.outlet = reading.wall = one.fluid.outlet;
    reading.reynolds = one.fluid.reynolds;
    const std::size_t n = one.fluid.temperature.size();
    // The heat that the fluid has taken up is told by its own enthalpy, and not by what the nodes gave.
    if (one.flow > 0 && n > 0)
      reading.heat = one.channel.share * one.flow *
                     one.channel.fluid.specific_heat.integral(one.inlet, one.fluid.outlet);
    for (std::size_t s = 0; s < n; ++s) {
      const ChannelLine::Station& station = one.line->stations()[s];
      reading.film += one.fluid.film[s] / static_cast<double>(n);
      const double area = k_pi * one.channel.diameter * station.length * station.inside;
      if (!(one.fluid.film[s] * area > 0)) continue;
      const double wall = one.fluid.temperature[s] + one.fluid.taken[s] / (one.fluid.film[s] * area);
      if (wall <= reading.wall && reading.found) continue;
      reading.wall = wall;
      reading.place = station.x;
      reading.found = true;
    }
  }
  return all;
}

std::size_t Channels::bytes() const {
  std::size_t total = 0;
  for (const One& one : channels_)
    if (one.line)
      total += one.line->stations().capacity() * sizeof(ChannelLine::Station) +
               one.line->shares().capacity() * (sizeof(ChannelLine::Share) + sizeof(double));
  return total;
}

}  // namespace solidus::heat
