#include "results/checkpoint/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "mechanics/elements/padding.hpp"
#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "results/checkpoint/checkpoint_contacts.hpp"
#include "results/checkpoint/checkpoint_criteria.hpp"
#include "results/checkpoint/checkpoint_numbers.hpp"
#include "results/checkpoint/checkpoint_tables.hpp"
#include "results/output/output_error.hpp"
#include "system/log.hpp"
#include "system/processes.hpp"

namespace solidus::results {

namespace fs = std::filesystem;

namespace {

/// Characters that stand for a pair in State::steady_gaps.
constexpr char k_steady = 's', k_unsteady = '-';
constexpr char k_creeps = 'c', k_no_creep = '-';
constexpr const char* k_format = "Solidus checkpoint 30";
constexpr const char* k_known = "known";
/// Above absolute zero, and no hotter than a case may ask for [K].
constexpr AllowedValues k_temperatures{std::numeric_limits<double>::min(), 1e6};
/// The time at which a body is lit is infinite until it burns [s].
constexpr AllowedValues k_times_of_ignition{0, std::numeric_limits<double>::infinity()};

std::string block_name(const mesh::Mesh& mesh, std::size_t b) {
  return fmt::format("history/block_{}_{}", b, mesh::name(mesh.blocks[b].shape));
}

// History of the elements this process counts, [element][point][component].
std::vector<double> pack_history(const mesh::ElementBlock& block, const mechanics::BlockHistory& history) {
  const auto per_element = as_size(history.n_points * history.n_components);
  std::vector<double> packed(as_size(block.n_counted) * per_element);
  for (std::size_t e = 0; e < as_size(block.n_counted); ++e)
    for (std::size_t k = 0; k < per_element; ++k)
      packed[e * per_element + k] =
          history.values[(e / k_lanes) * per_element + k][static_cast<int>(e % k_lanes)];
  return packed;
}

using Places = std::unordered_map<std::int64_t, std::size_t>;

template <class Numbers>
Places places_of(const Numbers& numbers) {
  Places places;
  places.reserve(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) places.emplace(numbers[i], i);
  return places;
}

/// Rows that were taken, each of them once.
class Taken {
 public:
  explicit Taken(std::size_t n) : of_(n, 0) {}
  void add(std::size_t row) { n_ += std::exchange(of_[row], char{1}) == 0 ? 1 : 0; }
  bool all() const { return n_ == of_.size(); }

 private:
  std::vector<char> of_;
  std::size_t n_ = 0;
};

/// Visits the nodal fields of a state, const or not, with their names and the values that they may have.
template <class State, class Visit>
void for_each_nodal_field(State& state, const Visit& visit) {
  visit("temperature", state.heat.temperature, k_temperatures);
  visit("enthalpy", state.heat.enthalpy, AllowedValues{});
  visit("lit", state.burning.lit, k_times_of_ignition);
  visit("released", state.burning.released, AllowedValues{});
  visit("displacement", state.mechanics.displacement, AllowedValues{});
  visit("pressure", state.mechanics.pressure, AllowedValues{});
  visit("mechanical_solid_fraction", state.mechanics.solid_fraction, AllowedValues{});
  visit("velocity", state.mechanics.velocity, AllowedValues{});
  visit("acceleration", state.mechanics.acceleration, AllowedValues{});
  visit("net_force", state.mechanics.net_force, AllowedValues{});
  visit("load", state.mechanics.load, AllowedValues{});
}

// Fills a nodal field from a table by the nodes' numbers. Every node this process holds gets its value.
void take_nodes(TableReader& in, const std::string& name, const Places& places, std::vector<double>& field,
                const AllowedValues& allowed = {}) {
  if (!parallel::any_process(!field.empty())) return;
  const std::size_t width = field.size() / std::max<std::size_t>(places.size(), 1);
  Taken taken(places.size());
  in.each("node", name, allowed, [&](std::int64_t number, std::span<const double> row) {
    const auto place = places.find(number);
    if (place == places.end() || row.size() != width) return;
    std::copy(row.begin(), row.end(), field.begin() + static_cast<std::ptrdiff_t>(place->second * width));
    taken.add(place->second);
  });
  in.require(taken.all(), name);
}

void take_history(TableReader& in, const std::string& name, const std::string& values,
                  const mesh::ElementBlock& block, mechanics::BlockHistory& history) {
  const auto per_element = as_size(history.n_points * history.n_components);
  if (per_element == 0) return;
  // Rows are found by the element's number, so that another division into processes can go on.
  const Places places = places_of(block.input_element);
  Taken taken(places.size());
  in.each(name + "/element", values, {}, [&](std::int64_t number, std::span<const double> row) {
    const auto place = places.find(number);
    if (place == places.end() || row.size() != per_element) return;
    const std::size_t e = place->second;
    for (std::size_t k = 0; k < per_element; ++k)
      history.values[(e / k_lanes) * per_element + k].set(static_cast<int>(e % k_lanes), row[k]);
    taken.add(e);
  });
  in.require(taken.all(), values);
  const std::size_t n = places.size();
  // Lanes beyond the last element repeat it, so that their arithmetic is that of an element.
  if (n == 0) return;
  const std::size_t last = (n - 1) / k_lanes;
  for (std::size_t k = 0; k < per_element; ++k)
    mechanics::repeat_last_element(history.values[last * per_element + k], as_index(last), as_index(n));
}

/// Room for the rates of the plastic strain of a block with this history.
mechanics::BlockHistory creep_layout(const mechanics::BlockHistory& history) {
  constexpr int k_tensor = 6;
  mechanics::BlockHistory rates{k_tensor, history.n_points, {}};
  const auto width = as_size(history.n_components);
  rates.values.assign(width > 0 ? history.values.size() / width * k_tensor : 0, Lane(0.0));
  return rates;
}

std::string shot_table(std::size_t iterate, const char* field) {
  return fmt::format("shot_{}_{}", iterate, field);
}

/// Start of the present shot and the ends of the last ones.
void take_shots(TableReader& in, const Places& nodes, const coupling::State& state,
                coupling::ShotHistory& shots) {
  if (in.text("shots") != k_known) return;
  shots.start.resize(state.heat.temperature.size());
  take_nodes(in, "shot_start", nodes, shots.start, k_temperatures);
  constexpr unsigned long k_most = 1000;
  const std::string count = in.text("shot_iterates");
  const unsigned long n = std::strtoul(count.c_str(), nullptr, 10);
  if (n > k_most) in.refuse(fmt::format("its 'shot_iterates' are '{}'", count));
  shots.iterates.resize(n);
  for (std::size_t j = 0; j < shots.iterates.size(); ++j) {
    coupling::ShotIterate& iterate = shots.iterates[j];
    iterate.change.resize(state.heat.temperature.size());
    iterate.heat.resize(state.heat.temperature.size());
    iterate.displacement.resize(state.mechanics.displacement.size());
    take_nodes(in, shot_table(j, "change"), nodes, iterate.change);
    take_nodes(in, shot_table(j, "heat"), nodes, iterate.heat);
    take_nodes(in, shot_table(j, "displacement"), nodes, iterate.displacement);
  }
}

void compare(const fs::path& path, TableReader& in, const Fingerprint& fingerprint) {
  for (const auto& [name, here] : fingerprint) {
    const std::string there = in.text("case/" + name);
    if (there == here) continue;
    throw InputError({path.string(), 0, 0},
                     fmt::format("this checkpoint is of another case: its {} is '{}', that of this case '{}'",
                                 name, there, here),
                     "run without --restart to start again, or choose another folder with -o");
  }
}

/// Rates that adaptive steps and first guesses go on from, as far as the run had them.
void take_rates(TableReader& in, const mesh::Mesh& mesh, const Places& nodes, Checkpoint& c) {
  if (in.text("rates") == k_known) {
    coupling::Rates& rates = c.continuation.rates;
    const bool flows = in.text("flows") == k_known;
    (flows ? rates.heat_flow : rates.temperature).resize(c.state.heat.temperature.size());
    rates.displacement.resize(c.state.mechanics.displacement.size());
    take_nodes(in, flows ? "heat_flow" : "temperature_rate", nodes,
               flows ? rates.heat_flow : rates.temperature);
    take_nodes(in, "displacement_rate", nodes, rates.displacement);
    if (in.text("rates_of_melt") == k_known) {
      rates.coherency.resize(mesh.x.size());
      take_nodes(in, "coherency", nodes, rates.coherency);
    }
  }
  if (in.text("first_guess") == k_known) {
    c.state.displacement_rate.resize(c.state.mechanics.displacement.size());
    take_nodes(in, "rate_of_last_step", nodes, c.state.displacement_rate);
    c.state.pressure_rate.resize(c.state.mechanics.pressure.size());
    take_nodes(in, "pressure_rate_of_last_step", nodes, c.state.pressure_rate);
  }
}

Checkpoint read_file(const fs::path& path, const mesh::Mesh& mesh, const Fingerprint& fingerprint,
                     const coupling::State& layout) {
  TableReader in(path);
  if (in.text("format") != k_format)
    throw OutputError(path.string(), "is no checkpoint that this version of Solidus can read");
  compare(path, in, fingerprint);
  Checkpoint c;
  // The state at the end has the layout of this mesh, into which the file's numbers go.
  c.state = layout;
  set_numbers(in, c);
  c.continuation.control.reason = in.text("reason");
  c.continuation.stage.name = in.text("stage");
  // Nodal fields are found by the numbers of the nodes in the input.
  const Places nodes = places_of(mesh.input_node);
  for_each_nodal_field(c.state,
                       [&](const char* name, std::vector<double>& field, const AllowedValues& allowed) {
                         take_nodes(in, name, nodes, field, allowed);
                       });
  if (c.continuation.stage.number > 0) {
    c.continuation.stage.displacement.resize(c.state.mechanics.displacement.size());
    take_nodes(in, "stage_displacement", nodes, c.continuation.stage.displacement);
  }
  take_rates(in, mesh, nodes, c);
  const std::string steady = in.text("steady_gaps");
  if (!steady.empty() && steady.size() != c.state.contacts.size())
    in.refuse(fmt::format("its 'steady_gaps' are of {} contacts, the case has {}", steady.size(),
                          c.state.contacts.size()));
  c.state.steady_gaps.assign(steady.begin(), steady.end());
  for (char& of_pair : c.state.steady_gaps) of_pair = of_pair == k_steady;
  take_shots(in, nodes, c.state, c.continuation.shots);
  mechanics::MechanicalState& mechanics = c.state.mechanics;
  const std::string creep = in.text("rates_of_creep");
  if (!creep.empty() && creep.size() != mechanics.history.size())
    in.refuse(fmt::format("its 'rates_of_creep' are of {} blocks, the mesh has {}", creep.size(),
                          mechanics.history.size()));
  c.continuation.rates.creep.resize(creep.size());
  // A run that continued with backward Euler has no earlier history: the next step is backward Euler too.
  if (mechanics.before.empty()) mechanics.dt_before = 0;
  // The history of each block's elements is read as far as the time integration needs it.
  for (std::size_t b = 0; b < mechanics.history.size(); ++b) {
    const std::string name = block_name(mesh, b);
    take_history(in, name, name + "/values", mesh.blocks[b], mechanics.history[b]);
    if (mechanics.dt_before > 0)
      take_history(in, name, name + "/before", mesh.blocks[b], mechanics.before[b]);
    if (b < creep.size() && creep[b] == k_creeps)
      take_history(in, name, name + "/creep_rate", mesh.blocks[b],
                   c.continuation.rates.creep[b] = creep_layout(mechanics.history[b]));
    if (!mechanics.stress.empty())
      take_history(in, name, name + "/stress", mesh.blocks[b], mechanics.stress[b]);
  }
  take_contacts(in, c.state.contacts);
  take_criteria(in, mesh, c.state.criteria);
  return c;
}

/// Writes the rows of a field of nodes that this process owns.
void write_nodes(TableWriter& out, const mesh::Mesh& mesh, const std::string& name,
                 const std::vector<double>& field) {
  const std::size_t width = mesh.x.empty() ? 0 : field.size() / mesh.x.size();
  out.rows<double>(name, static_cast<int>(width),
                   std::span(field).first(as_size(mesh.n_owned_nodes) * width));
}

void write_rates(TableWriter& out, const mesh::Mesh& mesh, const coupling::Rates& rates) {
  out.text("rates", rates.known() ? k_known : "unknown");
  if (rates.known()) {
    const bool flows = parallel::any_process(!rates.heat_flow.empty());
    out.text("flows", flows ? k_known : "unknown");
    write_nodes(out, mesh, flows ? "heat_flow" : "temperature_rate",
                flows ? rates.heat_flow : rates.temperature);
    write_nodes(out, mesh, "displacement_rate", rates.displacement);
    const bool melts = parallel::any_process(!rates.coherency.empty());
    out.text("rates_of_melt", melts ? k_known : "unknown");
    if (melts) write_nodes(out, mesh, "coherency", rates.coherency);
  }
}

/// The start of the present shot and the iterates of Anderson's method.
void write_shots(TableWriter& out, const mesh::Mesh& mesh, const coupling::ShotHistory& shots) {
  out.text("shots", parallel::any_process(!shots.start.empty()) ? k_known : "unknown");
  out.text("shot_iterates", std::to_string(shots.iterates.size()));
  write_nodes(out, mesh, "shot_start", shots.start);
  for (std::size_t j = 0; j < shots.iterates.size(); ++j) {
    write_nodes(out, mesh, shot_table(j, "change"), shots.iterates[j].change);
    write_nodes(out, mesh, shot_table(j, "heat"), shots.iterates[j].heat);
    write_nodes(out, mesh, shot_table(j, "displacement"), shots.iterates[j].displacement);
  }
}

/// @param creep  of each block, whether it has rates of creep
void write_histories(TableWriter& out, const mesh::Mesh& mesh, const mechanics::MechanicalState& state,
                     const coupling::Rates& rates, const std::string& creep) {
  for (std::size_t b = 0; b < state.history.size(); ++b) {
    const mesh::ElementBlock& block = mesh.blocks[b];
    const mechanics::BlockHistory& history = state.history[b];
    const std::string name = block_name(mesh, b);
    out.rows<std::int64_t>(name + "/element", 1, block.input_element.part(0, as_size(block.n_counted)));
    const int width = history.n_points * history.n_components;
    out.rows<double>(name + "/values", width, pack_history(block, history));
    if (state.dt_before > 0) out.rows<double>(name + "/before", width, pack_history(block, state.before[b]));
    if (b < creep.size() && creep[b] == k_creeps)
      out.rows<double>(name + "/creep_rate", rates.creep[b].n_points * rates.creep[b].n_components,
                       pack_history(block, rates.creep[b]));
    if (!state.stress.empty()) {
      const mechanics::BlockHistory& stress = state.stress[b];
      out.rows<double>(name + "/stress", stress.n_points * stress.n_components, pack_history(block, stress));
    }
  }
}

}  // namespace

std::pair<bool, bool> CheckpointFolder::there() const {
  std::error_code error;
  int found[2] = {fs::exists(latest(), error) ? 1 : 0, fs::exists(previous(), error) ? 1 : 0};
  processes::broadcast(found);
  return {found[0] != 0, found[1] != 0};
}

void CheckpointFolder::require() const {
  const auto [has_latest, has_previous] = there();
  if (!has_latest && !has_previous)
    throw InputError({root_.string(), 0, 0}, "there is no checkpoint to continue from",
                     "run without --restart first; -o names the folder of the run to continue");
}

void CheckpointFolder::write(const mesh::Mesh& mesh, const Fingerprint& fingerprint,
                             const CheckpointView& c) const {
  // A checkpoint is written next to the one that is there, and takes its place by a rename when it is whole:
  // a run that is killed meanwhile keeps the old one.
  const fs::path part = latest().string() + ".part";
  on_first_process([&] {
    std::error_code error;
    fs::create_directories(root_, error);
    if (error) throw OutputError(root_.string(), "cannot make this folder: " + error.message());
  });
  TableWriter out(part);
  // First what the case was made of, by which a restart knows whether it continues the same case, and the
  // numbers of the step control.
  out.text("format", k_format);
  for (const auto& [name, text] : fingerprint) out.text("case/" + name, text);
  out.text("reason", c.continuation.control.reason);
  out.text("stage", c.continuation.stage.name);
  out.numbers("numbers", numbers_of(c));

  // Nodes are written as rows of owned nodes with their numbers in the input, so that any number of processes
  // can read them.
  const auto owned = as_size(mesh.n_owned_nodes);
  out.rows<std::int64_t>("node", 1, mesh.input_node.part(0, owned));
  const auto nodal = [&](const char* name, const std::vector<double>& field) {
    write_nodes(out, mesh, name, field);
  };
  for_each_nodal_field(c.state, [&](const char* name, const std::vector<double>& field,
                                    const AllowedValues&) { nodal(name, field); });
  if (c.continuation.stage.number > 0) nodal("stage_displacement", c.continuation.stage.displacement);
  out.text("first_guess", parallel::any_process(!c.state.displacement_rate.empty()) ? k_known : "unknown");
  nodal("rate_of_last_step", c.state.displacement_rate);
  nodal("pressure_rate_of_last_step", c.state.pressure_rate);
  std::string steady;
  for (const char of_pair : c.state.steady_gaps) steady += of_pair != 0 ? k_steady : k_unsteady;
  out.text("steady_gaps", steady);
  // Rates of the last step predict the next one. Whether a table exists is decided by all processes together,
  // since some may have no row of it.
  const coupling::Rates& rates = c.continuation.rates;
  write_rates(out, mesh, rates);
  std::string creep;  // the same on every process, also on one without an element of a block
  for (const mechanics::BlockHistory& of_block : rates.creep)
    creep += parallel::any_process(!of_block.values.empty()) ? k_creeps : k_no_creep;
  out.text("rates_of_creep", creep);
  write_shots(out, mesh, c.continuation.shots);
  // Histories of elements go block by block, for counted elements alone.
  write_histories(out, mesh, c.state.mechanics, rates, creep);
  write_contacts(out, c.state.contacts);
  write_criteria(out, mesh, c.state.criteria);
  // The renames are done by one process, after all have written.
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
