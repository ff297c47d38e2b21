/// Process 0 cuts the mesh and sends each part; the others only receive their own.
#include "mesh/parts/distribute.hpp"

#include "mesh/parts/global_mesh.hpp"
#include "mesh/parts/subdomains.hpp"
#include "system/common_failure.hpp"
#include "system/processes.hpp"

namespace solidus::mesh {

namespace {

/// Process 0 sends the others their parts; returns that of this process, packed.
std::vector<char> own_part(const RawMesh& raw, const std::vector<std::string>& bodies,
                           const std::vector<std::string>& replicated, const std::vector<BodyWork>& work) {
  const int rank = processes::rank(), n_processes = processes::count();

  GlobalMesh whole;
  on_first_process([&] { whole = make_global_mesh(raw, bodies, replicated, work, n_processes); });

  if (rank != 0) return processes::receive(0);
  Subdomains parts(raw, whole, bodies);
  for (int p = 1; p < n_processes; ++p) processes::send(parts.pack(p), p);
  return parts.pack(0);
}

}  // namespace

Mesh distribute(const RawMesh& raw, const std::vector<std::string>& bodies,
                const std::vector<std::string>& replicated, const std::vector<BodyWork>& work) {
  return unpack_part(own_part(raw, bodies, replicated, work));
}

Mesh distribute(RawMesh&& raw, const std::vector<std::string>& bodies,
                const std::vector<std::string>& replicated, const std::vector<BodyWork>& work) {
  const std::vector<char> part = own_part(raw, bodies, replicated, work);
  raw = {};
  return unpack_part(part);
}

Mesh distribute(const RawMesh& raw, const std::vector<std::string>& bodies,
                const std::vector<std::string>& replicated) {
  return distribute(raw, bodies, replicated, {});
}

}  // namespace solidus::mesh
