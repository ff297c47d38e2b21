/// The field files of a run, node by node over its moments.
#include "results/formats/temperature_history.hpp"

#include <limits>
#include <string>
#include <unordered_map>

#include "mesh/files/vtu_pieces.hpp"
#include "numbers/index_casts.hpp"
#include "results/formats/pvd.hpp"
#include "system/errors.hpp"

namespace solidus::results {

namespace {

namespace fs = std::filesystem;
using boost::property_tree::ptree;
using LocalNodes = std::unordered_map<GlobalIndex, Index>;  ///< by the input's number

/// @param part  the file is in a list of parts, and is none itself
void read_file(const fs::path& path, const LocalNodes& local, std::vector<double>& temperature,
               bool part = false) {
  const mesh::VtuFile file(path);
  // A list of parts is read part by part.
  if (file.type() == "PUnstructuredGrid" && !part) {
    for (const fs::path& each : grid_files(file, path)) read_file(each, local, temperature, true);
    return;
  }
  for (const auto& [tag, piece] : children(file, "UnstructuredGrid")) {
    if (tag != "Piece") continue;
    const ptree *numbers = mesh::find_array(piece, "PointData", "node"),
                *values = mesh::find_array(piece, "PointData", "temperature");
    if (numbers == nullptr || values == nullptr)
      file.fail("the file has no temperatures of numbered nodes",
                "fields that hold the temperature: output.fields = [] or with \"temperature\"");
    // Values go to the nodes that this process has, by their numbers.
    const std::size_t n = piece_size(file, piece).points;
    const std::vector<double> node = file.numbers(*numbers, n), value = file.numbers(*values, n);
    for (std::size_t i = 0; i < n; ++i)
      if (const auto found = local.find(mesh::whole_number(node[i])); found != local.end())
        temperature[as_size(found->second)] = value[i];
  }
}

}  // namespace

std::vector<TemperatureMoment> read_temperature_history(const fs::path& collection, const mesh::Mesh& mesh,
                                                        const linear::ActiveSet& active) {
  if (!fs::exists(collection))
    throw InputError({collection.string()}, "the run has left no fields", "[output] with `every` or `times`");
  // Nodes are found by their numbers in the input, as files hold those of all processes.
  LocalNodes local;
  for (Index i = 0; i < mesh.n_nodes(); ++i)
    if (active.node(i)) local.emplace(mesh.input_node[as_size(i)], i);
  // Only parts that are bodies have a number of zero; contact surfaces are left out.
  std::vector<TemperatureMoment> history;
  const PvdCollection all(collection, std::numeric_limits<double>::infinity());
  for (const PvdCollection::Entry& entry : all.entries()) {
    if (entry.part != 0) continue;
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    TemperatureMoment moment{entry.time, std::vector<double>(mesh.x.size(), unknown)};
    const fs::path path = collection.parent_path() / entry.file;
    read_file(path, local, moment.temperature);
    for (const auto& [number, node] : local)
      if (!(moment.temperature[as_size(node)] > 0))
        throw InputError({path.string()}, "the file has no temperature of node " + std::to_string(number));
    history.push_back(std::move(moment));
  }
  // One moment is no history.
  if (history.size() < 2)
    throw InputError({collection.string()}, "the run has left the fields of fewer than two times",
                     "[output] with `every` or `times`");
  return history;
}

}  // namespace solidus::results
