/// Sections of the summary in a fixed order; what a run does not have is left out.
#include "results/summary.hpp"

#include <sys/resource.h>

#include <array>

#include "parallel/parallel.hpp"
#include "results/output/json_document.hpp"
#include "results/output/output_file.hpp"
#include "results/output/quantity_json.hpp"
#include "system/processes.hpp"
#include "system/version.hpp"

namespace solidus::results {

namespace {

template <class T>
Json object(const std::vector<std::pair<std::string, T>>& members) {
  Json json;
  for (const auto& [name, value] : members) json.add(name, value);
  return json;
}

// Values by their names; places [m] next to those that have one.
Json findings(const std::vector<criteria::CriterionResult>& found) {
  Json json;
  for (const criteria::CriterionResult& f : found) {
    const std::string name = f.name + (f.unit == "1" ? "" : "[" + f.unit + "]");
    json.add(name, f.value);
    if (f.somewhere) json.add(f.name + "_at[m]", Json::Array(f.where.begin(), f.where.end()));
  }
  return json;
}

/// An object with one member for each element of `list`, named by its `key`.
template <class T>
Json by_name(const std::vector<T>& list, std::string T::*key, Json (*members)(const T&)) {
  Json json;
  for (const T& element : list) json.add(element.*key, members(element));
  return json;
}

/// The viscosity that the program has chosen for a melt, and what it was measured against.
Json melt_members(const ChosenMelt& melt) {
  Json json;
  json.add("viscosity[Pa s]", melt.modulus * melt.time)
      .add("modulus[Pa]", melt.modulus)
      .add("measured_against", melt.against)
      .add("relaxation_time[s]", melt.time);
  return json;
}

/// Where and when liquid metal had left its wall.
Json left_wall_members(const LeftWall& wall) {
  Json json;
  json.add("largest_gap[m]", wall.gap)
      .add("largest_area[m2]", wall.area)
      .add("from[s]", wall.from)
      .add("to[s]", wall.to);
  return json;
}

/// Steps that were accepted although augmentations had not converged, with the largest penetration.
Json unsettled_members(const UnsettledAugmentations& found) {
  Json json;
  json.add("steps", found.steps).add("largest_penetration_over_face", found.penetration);
  return json;
}

GlobalIndex sum(Index counted) {
  return static_cast<GlobalIndex>(parallel::global_sum(counted));
}

}  // namespace

MeshCounts count(const mesh::Mesh& mesh) {
  using mesh::Shape;
  constexpr std::array k_shapes = {Shape::line2, Shape::line3, Shape::tri3,  Shape::tri6, Shape::quad4,
                                   Shape::quad8, Shape::tet4,  Shape::tet10, Shape::hex8, Shape::hex20};
  // Each element is counted by the process that owns it.
  const auto counted = [&](const auto& belongs) {
    Index n = 0;
    for (const mesh::ElementBlock& block : mesh.blocks)
      if (belongs(block)) n += block.n_counted;
    return sum(n);
  };
  MeshCounts counts;
  counts.nodes = mesh.n_global_nodes;
  for (const Shape shape : k_shapes)
    if (const GlobalIndex n = counted([&](const mesh::ElementBlock& b) { return b.shape == shape; }); n > 0)
      counts.elements_of_shape.emplace_back(mesh::name(shape), n);
  for (std::size_t body = 0; body < mesh.bodies.size(); ++body)
    counts.elements_of_body.emplace_back(mesh.bodies[body].name, counted([&](const mesh::ElementBlock& b) {
                                           return b.body == static_cast<int>(body);
                                         }));
  return counts;
}

/// The largest resident memory of this process so far, and its maximum and sum over all processes.
PeakMemory peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const double bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);  // Linux counts in kilobytes
  double first = bytes;
  processes::broadcast(std::span(&first, 1));
  return {parallel::global_max(bytes), first, parallel::global_sum(bytes)};
}

std::string summary_json(const Summary& s) {
  // summary.json in the order that a reader looks for: what ran, how it ended, effort, last values, criteria,
  // fields and answers. What a run does not have is left out.
  Json::Array warnings(s.warnings.begin(), s.warnings.end());
  Json mesh;
  mesh.add("nodes", s.mesh.nodes)
      .add("elements", object(s.mesh.elements_of_shape))
      .add("bodies", object(s.mesh.elements_of_body));
  Json memory;
  memory.add("largest_process", s.memory.largest)
      .add("first_process", s.memory.first)
      .add("all_processes", s.memory.sum);
  Json balance;
  balance.add("largest_over_mean", object(s.balance.largest_over_mean))
      .add("elements_computed_again", s.balance.computed_again);
  Json profile = object(s.profile);
  profile.add("total", s.profile_total);
  Json json;
  json.add("solidus", program_version())
      .add("case", s.case_file)
      .add("variant", s.variant)
      .add("title", s.title)
      .add("outcome", s.outcome)
      .add("processes", s.processes)
      .add("mesh", std::move(mesh))
      .add("steps", s.steps)
      .add("rejected_steps", s.rejected)
      .add("shortened_steps", s.shortened)
      .add("end_time[s]", s.end_time)
      .add("seconds", object(s.seconds))
      .add("profile[s]", std::move(profile))
      .add("peak_memory[bytes]", std::move(memory))
      .add("balance", std::move(balance))
      .add("tables[bytes]", object(s.table_bytes));
  if (s.relative_energy_defect) json.add("relative_energy_defect", *s.relative_energy_defect);
  json.add("final", object(s.final_values)).add("criteria", findings(s.criteria));
  Json fields;
  for (const quantities::Quantity* field : s.fields)
    fields.add(std::string(field->name), results::json(*field));
  json.add("fields", std::move(fields));
  if (s.answers) json.add("answers", results::json(*s.answers));
  if (!s.melt.empty()) json.add("melt", by_name(s.melt, &ChosenMelt::body, melt_members));
  if (!s.left_walls.empty())
    json.add("liquid_metal_left_its_wall", by_name(s.left_walls, &LeftWall::contact, left_wall_members));
  // The second key is the name of versions up to 0.2, for scripts that read it.
  if (!s.unsettled.empty())
    for (const char* key : {"augmentations_that_did_not_converge", "turns_that_did_not_settle"})
      json.add(key, by_name(s.unsettled, &UnsettledAugmentations::contact, unsettled_members));
  if (s.overview) json.add("understood", results::json(*s.overview));
  json.add("warnings", std::move(warnings));
  return json.text();
}

void write_summary(const std::filesystem::path& path, const Summary& summary) {
  write_file(path, summary_json(summary));
}

}  // namespace solidus::results
