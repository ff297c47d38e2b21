#include "mesh/distribute.hpp"

#include "mesh/global_mesh.hpp"
#include "mesh/subdomains.hpp"
#include "system/common_failure.hpp"
#include "system/processes.hpp"

namespace solidus::mesh {

Mesh distribute(const RawMesh& raw, const std::vector<std::string>& bodies,
                const std::vector<std::string>& replicated, const std::vector<BodyWork>& work) {
  const int rank = processes::rank(), n_processes = processes::count();

  GlobalMesh whole;
  on_first_process([&] { whole = make_global_mesh(raw, bodies, replicated, work, n_processes); });

  if (rank != 0) return unpack_part(processes::receive(0));
  Subdomains parts(raw, whole, bodies);
  for (int p = 1; p < n_processes; ++p) processes::send(parts.pack(p), p);
  return unpack_part(parts.pack(0));
}

Mesh distribute(const RawMesh& raw, const std::vector<std::string>& bodies,
                const std::vector<std::string>& replicated) {
  return distribute(raw, bodies, replicated, {});
}

}  // namespace solidus::mesh
