#include "results/checkpoint.hpp"

#include <fmt/format.h>
#include <petscsys.h>

#include <algorithm>
#include <system_error>
#include <unordered_map>

#include "algebra/parallel.hpp"
#include "base/log.hpp"
#include "results/checkpoint_tables.hpp"
#include "results/output_error.hpp"

namespace solidus::results {

namespace fs = std::filesystem;

namespace {

constexpr const char* k_format = "Solidus checkpoint 2";

std::string block_name(const mesh::Mesh& mesh, std::size_t b) {
  return fmt::format("history/block_{}_{}", b, mesh::name(mesh.blocks[b].shape));
}

// Everything that is not a field, in a fixed order.
std::vector<double> numbers_of(const Checkpoint& c) {
  const coupling::Continuation& k = c.continuation;
  const coupling::StepOptions& o = k.options;
  const coupling::EnergyAudit& e = c.energy;
  return {c.state.time,
          static_cast<double>(k.steps),
          k.size,
          static_cast<double>(c.rejected),
          o.step,
          o.adaptive ? 1.0 : 0.0,
          o.min_step,
          o.max_step,
          o.growth,
          o.cut,
          static_cast<double>(o.easy_iterations),
          e.stored_heat,
          e.structural,
          e.contact,
          e.work,
          e.heat_in,
          e.heat_exchanged,
          e.viscous_dissipation,
          e.plastic_dissipation,
          e.plastic_work,
          c.state.mechanics.dt_before};
}

constexpr std::size_t k_numbers = 21;

void set_numbers(const std::vector<double>& n, Checkpoint& c) {
  c.state.time = n[0];
  c.continuation.steps = static_cast<int>(n[1]);
  c.continuation.size = n[2];
  c.rejected = static_cast<int>(n[3]);
  c.continuation.options = {n[4], n[5] != 0.0, n[6], n[7], n[8], n[9], static_cast<int>(n[10])};
  c.energy = {n[11], n[12], n[13], n[14], n[15], n[16], n[17], n[18], n[19]};
  c.state.mechanics.dt_before = n[20];
}

// History of the elements this process counts, [element][point][component].
std::vector<double> pack_history(const mesh::Block& block, const mechanics::BlockHistory& history) {
  const auto per_element = static_cast<std::size_t>(history.n_points * history.n_components);
  std::vector<double> packed(static_cast<std::size_t>(block.n_counted) * per_element);
  for (std::size_t e = 0; e < static_cast<std::size_t>(block.n_counted); ++e)
    for (std::size_t k = 0; k < per_element; ++k)
      packed[e * per_element + k] =
          history.values[(e / k_lanes) * per_element + k][static_cast<int>(e % k_lanes)];
  return packed;
}

using Places = std::unordered_map<std::int64_t, std::size_t>;

Places places_of(const std::vector<GlobalIndex>& numbers) {
  Places places;
  places.reserve(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) places.emplace(numbers[i], i);
  return places;
}

// Fills a nodal field from a table by the nodes' numbers. Every node this process holds gets its value.
void take_nodes(TableReader& in, const std::string& name, const Places& places, std::vector<double>& field) {
  if (!algebra::any_process(!field.empty())) return;
  const std::size_t width = field.size() / std::max<std::size_t>(places.size(), 1);
  std::size_t taken = 0;
  in.each("node", name, [&](std::int64_t number, std::span<const double> row) {
    const auto place = places.find(number);
    if (place == places.end() || row.size() != width) return;
    std::copy(row.begin(), row.end(), field.begin() + static_cast<std::ptrdiff_t>(place->second * width));
    ++taken;
  });
  in.require(taken == places.size(), name);
}

void take_history(TableReader& in, const std::string& name, const std::string& values,
                  const mesh::Block& block, mechanics::BlockHistory& history) {
  const auto per_element = static_cast<std::size_t>(history.n_points * history.n_components);
  if (per_element == 0) return;
  const Places places = places_of(block.input_element);
  std::size_t taken = 0;
  in.each(name + "/element", values, [&](std::int64_t number, std::span<const double> row) {
    const auto place = places.find(number);
    if (place == places.end() || row.size() != per_element) return;
    const std::size_t e = place->second;
    for (std::size_t k = 0; k < per_element; ++k)
      history.values[(e / k_lanes) * per_element + k].set(static_cast<int>(e % k_lanes), row[k]);
    ++taken;
  });
  in.require(taken == block.input_element.size(), values);
}

void compare(const fs::path& path, TableReader& in, const Fingerprint& fingerprint) {
  for (const auto& [name, here] : fingerprint) {
    const std::string there = in.text("case/" + name);
    if (there == here) continue;
    throw InputError({path.string(), 0, 0},
                     fmt::format("this checkpoint is of another case: its {} is '{}', that of this case '{}'",
                                 name, there, here),
                     "run without --restart to begin anew, or choose another folder with -o");
  }
}

Checkpoint read_file(const fs::path& path, const mesh::Mesh& mesh, const Fingerprint& fingerprint,
                     const coupling::State& layout) {
  TableReader in(path);
  if (in.text("format") != k_format)
    throw OutputError(path.string(), "is no checkpoint that this version of Solidus can read");
  compare(path, in, fingerprint);
  Checkpoint c;
  c.state = layout;
  set_numbers(in.numbers("numbers", k_numbers), c);
  c.continuation.reason = in.text("reason");
  const Places nodes = places_of(mesh.input_node);
  take_nodes(in, "temperature", nodes, c.state.heat.temperature);
  take_nodes(in, "enthalpy", nodes, c.state.heat.enthalpy);
  take_nodes(in, "displacement", nodes, c.state.mechanics.displacement);
  mechanics::MechanicalState& mechanics = c.state.mechanics;
  // A run that went on with backward Euler left no history before the last: the next step is one too.
  if (mechanics.before.empty()) mechanics.dt_before = 0;
  for (std::size_t b = 0; b < mechanics.history.size(); ++b) {
    const std::string name = block_name(mesh, b);
    take_history(in, name, name + "/values", mesh.blocks[b], mechanics.history[b]);
    if (mechanics.dt_before > 0)
      take_history(in, name, name + "/before", mesh.blocks[b], mechanics.before[b]);
  }
  return c;
}

}  // namespace

std::pair<bool, bool> CheckpointFolder::there() const {
  std::error_code error;
  int found[2] = {fs::exists(latest(), error) ? 1 : 0, fs::exists(previous(), error) ? 1 : 0};
  MPI_Bcast(found, 2, MPI_INT, 0, PETSC_COMM_WORLD);
  return {found[0] != 0, found[1] != 0};
}

void CheckpointFolder::require() const {
  const auto [has_latest, has_previous] = there();
  if (!has_latest && !has_previous)
    throw InputError({root_.string(), 0, 0}, "there is no checkpoint to continue from",
                     "run without --restart first; -o names the folder of the run to continue");
}

void CheckpointFolder::write(const mesh::Mesh& mesh, const Fingerprint& fingerprint,
                             const Checkpoint& c) const {
  const fs::path part = latest().string() + ".part";
  on_first_process([&] {
    std::error_code error;
    fs::create_directories(root_, error);
    if (error) throw OutputError(root_.string(), "cannot make this folder: " + error.message());
  });
  TableWriter out(part);
  out.text("format", k_format);
  for (const auto& [name, text] : fingerprint) out.text("case/" + name, text);
  out.text("reason", c.continuation.reason);
  out.numbers("numbers", numbers_of(c));

  const auto owned = static_cast<std::size_t>(mesh.n_owned_nodes);
  out.rows<std::int64_t>("node", 1, std::span(mesh.input_node).first(owned));
  const auto nodal = [&](const char* name, const std::vector<double>& field) {
    const std::size_t width = mesh.x.empty() ? 0 : field.size() / mesh.x.size();
    out.rows<double>(name, static_cast<int>(width), std::span(field).first(owned * width));
  };
  nodal("temperature", c.state.heat.temperature);
  nodal("enthalpy", c.state.heat.enthalpy);
  nodal("displacement", c.state.mechanics.displacement);
  for (std::size_t b = 0; b < c.state.mechanics.history.size(); ++b) {
    const mesh::Block& block = mesh.blocks[b];
    const mechanics::BlockHistory& history = c.state.mechanics.history[b];
    const std::string name = block_name(mesh, b);
    out.rows<std::int64_t>(name + "/element", 1,
                           std::span(block.input_element).first(static_cast<std::size_t>(block.n_counted)));
    const int width = history.n_points * history.n_components;
    out.rows<double>(name + "/values", width, pack_history(block, history));
    if (c.state.mechanics.dt_before > 0)
      out.rows<double>(name + "/before", width, pack_history(block, c.state.mechanics.before[b]));
  }
  out.finish([&] {
    std::error_code error;
    if (fs::exists(latest(), error)) fs::rename(latest(), previous(), error);
    fs::rename(part, latest(), error);
    if (error) throw OutputError(latest().string(), "cannot write: " + error.message());
  });
}

Checkpoint CheckpointFolder::read(const mesh::Mesh& mesh, const Fingerprint& fingerprint,
                                  const coupling::State& layout) const {
  require();
  const auto [has_latest, has_previous] = there();
  if (!has_latest) {
    logging::warn("{} is missing; continuing from {}", latest().string(), previous().string());
    return read_file(previous(), mesh, fingerprint, layout);
  }
  try {
    return read_file(latest(), mesh, fingerprint, layout);
  } catch (const OutputError& damaged) {
    if (!has_previous) throw;
    logging::warn("{}; continuing from {}", damaged.what(), previous().string());
  }
  return read_file(previous(), mesh, fingerprint, layout);
}

}  // namespace solidus::results
