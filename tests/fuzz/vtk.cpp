/// Any bytes as a file of VTK: as a field of another run, as the temperatures that a run has left, and as
/// what becomes a file of VTKHDF.
#include "input.hpp"
#include "parallel/petsc_session.hpp"
#include "results/formats/pvd.hpp"
#include "results/formats/temperature_history.hpp"
#include "results/formats/vtkhdf.hpp"
#include "results/formats/vtu_reader.hpp"
#include "results/output/output_error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace solidus;
  const auto file = fuzz::as_file("a.vtu", data, size);
  const auto collection = fuzz::folder() / "fields.pvd";
  // Which nodes have elements is asked of all processes.
  static const bool listed = petsc::start({}) && [&] {
    results::PvdCollection(collection).add({{0.0, 0, "a.vtu"}, {1.0, 0, "a.vtu"}});
    return true;
  }();
  mesh::Mesh mesh;
  for (Index i = 1; i <= 9; ++i) {
    mesh.x.push_back({});
    mesh.input_node.push_back(i);
  }
  mesh.n_owned_nodes = static_cast<Index>(mesh.x.size());
  fuzz::answer([&] { results::read_temperature_history(collection, mesh, linear::ActiveSet(mesh)); });
  fuzz::answer([&] { results::read_vtu(file, "temperature", 0, 0.001, {}); });
  return fuzz::answer([&] {
    try {
      results::read_vtu(file, "temperature", -1, 0.001, {});
      if (listed) results::write_vtkhdf(collection, fuzz::folder() / "all.vtkhdf");
    } catch (const results::OutputError&) {  // an array that HDF5 does not take
    }
  });
}
