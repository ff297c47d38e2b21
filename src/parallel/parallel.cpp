/// Sums by MPI, and messages to the neighbours alone for ghosts.
#include "parallel/parallel.hpp"

#include <petscsys.h>

#include <algorithm>
#include <vector>

#include "numbers/index_casts.hpp"
#include "parallel/neighbours.hpp"

namespace solidus::parallel {

namespace {

double reduce(double value, MPI_Op operation) {
  double result = 0;
  MPI_Allreduce(&value, &result, 1, MPI_DOUBLE, operation, PETSC_COMM_WORLD);
  return result;
}

}  // namespace

double global_sum(double value) {
  return reduce(value, MPI_SUM);
}
double global_max(double value) {
  return reduce(value, MPI_MAX);
}
double global_min(double value) {
  return reduce(value, MPI_MIN);
}

bool any_process(bool value) {
  int mine = value ? 1 : 0, all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_LOR, PETSC_COMM_WORLD);
  return all != 0;
}

struct GhostExchange::Implementation {
  std::vector<Neighbour> neighbours;
  std::vector<char> send_buffer, receive_buffer;
  std::vector<MPI_Request> requests;
  std::size_t n_send = 0, n_receive = 0;
};

GhostExchange::GhostExchange(const mesh::Mesh& mesh)
    : GhostExchange(
          mesh.n_owned_nodes, mesh.first_owned,
          mesh.global_node.part(as_size(mesh.n_owned_nodes), as_size(mesh.n_nodes() - mesh.n_owned_nodes))) {}

GhostExchange::GhostExchange(Index n_owned, GlobalIndex first_owned, std::span<const GlobalIndex> ghosts)
    : n_owned_nodes_(n_owned), implementation_(std::make_unique<Implementation>()) {
  implementation_->neighbours = find_neighbours(n_owned, first_owned, ghosts);
  for (const Neighbour& neighbour : implementation_->neighbours) {
    implementation_->n_send += neighbour.send.size();
    implementation_->n_receive += neighbour.receive.size();
  }
  implementation_->requests.resize(2 * implementation_->neighbours.size());
}

GhostExchange::~GhostExchange() = default;
GhostExchange::GhostExchange(GhostExchange&&) noexcept = default;
GhostExchange& GhostExchange::operator=(GhostExchange&&) noexcept = default;

template <class Number>
void GhostExchange::exchange(std::span<Number> values, int components) const {
  // The buffers are kept between calls, and grow only where more components are exchanged than before.
  Implementation& my = *implementation_;
  if (my.neighbours.empty()) return;
  const std::size_t n_bytes = as_size(components) * sizeof(Number);
  my.send_buffer.resize(my.n_send * n_bytes);
  my.receive_buffer.resize(my.n_receive * n_bytes);
  char* const fields = reinterpret_cast<char*>(values.data());

  // Receives are posted before anything is sent, so that messages find their place; the parts of the buffers
  // follow the order of the neighbours.
  std::size_t request = 0;
  char* to = my.receive_buffer.data();
  for (const auto& neighbour : my.neighbours) {
    const std::size_t n = neighbour.receive.size() * n_bytes;
    MPI_Irecv(to, static_cast<int>(n), MPI_BYTE, neighbour.rank, 0, PETSC_COMM_WORLD,
              &my.requests[request++]);
    to += n;
  }
  // Then the values of own nodes that others hold as ghosts are packed and sent.
  char* from = my.send_buffer.data();
  for (const auto& neighbour : my.neighbours) {
    char* const start = from;
    for (Index node : neighbour.send) from = std::copy_n(fields + as_size(node) * n_bytes, n_bytes, from);
    MPI_Isend(start, static_cast<int>(from - start), MPI_BYTE, neighbour.rank, 0, PETSC_COMM_WORLD,
              &my.requests[request++]);
  }
  MPI_Waitall(static_cast<int>(request), my.requests.data(), MPI_STATUSES_IGNORE);

  // What has come is unpacked into the ghosts, in the order in which their owner lists them.
  const char* in = my.receive_buffer.data();
  for (const auto& neighbour : my.neighbours)
    for (Index node : neighbour.receive) {
      std::copy_n(in, n_bytes, fields + as_size(node) * n_bytes);
      in += n_bytes;
    }
}

template void GhostExchange::exchange(std::span<double>, int) const;
template void GhostExchange::exchange(std::span<float>, int) const;

}  // namespace solidus::parallel
