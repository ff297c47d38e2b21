#include "mesh/distribute.hpp"

#include <mpi.h>
#include <petscsys.h>

#include <algorithm>

#include "mesh/parts.hpp"
#include "mesh/whole.hpp"
#include "system/common_failure.hpp"

namespace solidus::mesh {

namespace {

// MPI counts are ints: large buffers travel in pieces.
constexpr std::size_t k_piece = std::size_t{1} << 30;

void send(const std::vector<char>& buffer, int to) {
  unsigned long long size = buffer.size();
  MPI_Send(&size, 1, MPI_UNSIGNED_LONG_LONG, to, 0, PETSC_COMM_WORLD);
  for (std::size_t at = 0; at < buffer.size(); at += k_piece)
    MPI_Send(buffer.data() + at, static_cast<int>(std::min(k_piece, buffer.size() - at)), MPI_CHAR, to, 1,
             PETSC_COMM_WORLD);
}

std::vector<char> receive() {
  unsigned long long size = 0;
  MPI_Recv(&size, 1, MPI_UNSIGNED_LONG_LONG, 0, 0, PETSC_COMM_WORLD, MPI_STATUS_IGNORE);
  std::vector<char> buffer(size);
  for (std::size_t at = 0; at < buffer.size(); at += k_piece)
    MPI_Recv(buffer.data() + at, static_cast<int>(std::min(k_piece, buffer.size() - at)), MPI_CHAR, 0, 1,
             PETSC_COMM_WORLD, MPI_STATUS_IGNORE);
  return buffer;
}

}  // namespace

Mesh distribute(const RawMesh& raw, const std::vector<std::string>& bodies,
                const std::vector<std::string>& replicated, const std::vector<BodyWork>& work) {
  int rank = 0, n_processes = 1;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &n_processes);

  Whole whole;
  on_first_process([&] { whole = make_whole(raw, bodies, replicated, work, n_processes); });

  if (rank != 0) return unpack_part(receive());
  Parts parts(raw, whole, bodies);
  for (int p = 1; p < n_processes; ++p) send(parts.pack(p), p);
  return unpack_part(parts.pack(0));
}

Mesh distribute(const RawMesh& raw, const std::vector<std::string>& bodies,
                const std::vector<std::string>& replicated) {
  return distribute(raw, bodies, replicated, {});
}

}  // namespace solidus::mesh
