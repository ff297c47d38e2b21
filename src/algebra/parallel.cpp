#include "algebra/parallel.hpp"

#include <petscsys.h>

#include <algorithm>
#include <cassert>
#include <numeric>
#include <vector>

namespace solidus::algebra {

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
  struct Neighbour {
    int rank;
    std::vector<Index> send;     // owned nodes that the neighbour has as ghosts
    std::vector<Index> receive;  // ghosts that the neighbour owns, in the order it sends them
  };
  std::vector<Neighbour> neighbours;
  std::vector<char> send_buffer, receive_buffer;
  std::vector<MPI_Request> requests;
  std::size_t n_send = 0, n_receive = 0;
};

GhostExchange::GhostExchange(const mesh::Mesh& mesh)
    : GhostExchange(mesh.n_owned_nodes, mesh.first_owned,
                    std::span(mesh.global_node).subspan(static_cast<std::size_t>(mesh.n_owned_nodes))) {}

GhostExchange::GhostExchange(Index n_owned, GlobalIndex first_owned, std::span<const GlobalIndex> ghosts)
    : n_owned_nodes_(n_owned), implementation_(std::make_unique<Implementation>()) {
  const MPI_Comm comm = PETSC_COMM_WORLD;
  int size = 1;
  MPI_Comm_size(comm, &size);
  if (size == 1) return;

  std::vector<GlobalIndex> first(static_cast<std::size_t>(size));
  MPI_Allgather(&first_owned, 1, MPI_INT64_T, first.data(), 1, MPI_INT64_T, comm);

  // Ghosts by owner, then tell every owner which of its nodes are wanted.
  std::vector<std::vector<Index>> wanted(static_cast<std::size_t>(size));
  for (std::size_t i = 0; i < ghosts.size(); ++i) {
    // A process without nodes shares its start with the next one: the last start not above the node is the
    // owner's.
    const auto owner = std::upper_bound(first.begin(), first.end(), ghosts[i]);
    wanted[static_cast<std::size_t>(owner - first.begin() - 1)].push_back(n_owned + static_cast<Index>(i));
  }
  std::vector<int> n_wanted(wanted.size()), n_asked(wanted.size());
  std::transform(wanted.begin(), wanted.end(), n_wanted.begin(),
                 [](const auto& w) { return static_cast<int>(w.size()); });
  MPI_Alltoall(n_wanted.data(), 1, MPI_INT, n_asked.data(), 1, MPI_INT, comm);

  const auto starts = [](const std::vector<int>& counts) {
    std::vector<int> start(counts.size());
    std::exclusive_scan(counts.begin(), counts.end(), start.begin(), 0);
    return start;
  };
  const std::vector<int> start_wanted = starts(n_wanted), start_asked = starts(n_asked);
  std::vector<GlobalIndex> ask, asked(static_cast<std::size_t>(start_asked.back() + n_asked.back()));
  for (const auto& nodes : wanted)
    for (Index node : nodes) ask.push_back(ghosts[static_cast<std::size_t>(node - n_owned)]);
  MPI_Alltoallv(ask.data(), n_wanted.data(), start_wanted.data(), MPI_INT64_T, asked.data(), n_asked.data(),
                start_asked.data(), MPI_INT64_T, comm);

  for (int rank = 0; rank < size; ++rank) {
    const auto p = static_cast<std::size_t>(rank);
    if (n_wanted[p] == 0 && n_asked[p] == 0) continue;
    Implementation::Neighbour neighbour{rank, {}, std::move(wanted[p])};
    for (int i = 0; i < n_asked[p]; ++i) {
      const GlobalIndex local = asked[static_cast<std::size_t>(start_asked[p] + i)] - first_owned;
      assert(local >= 0 && local < n_owned);
      neighbour.send.push_back(static_cast<Index>(local));
    }
    implementation_->n_send += neighbour.send.size();
    implementation_->n_receive += neighbour.receive.size();
    implementation_->neighbours.push_back(std::move(neighbour));
  }
  implementation_->requests.resize(2 * implementation_->neighbours.size());
}

GhostExchange::~GhostExchange() = default;
GhostExchange::GhostExchange(GhostExchange&&) noexcept = default;
GhostExchange& GhostExchange::operator=(GhostExchange&&) noexcept = default;

template <class Number>
void GhostExchange::exchange(std::span<Number> values, int components) const {
  Implementation& my = *implementation_;
  if (my.neighbours.empty()) return;
  const std::size_t n_bytes = static_cast<std::size_t>(components) * sizeof(Number);
  my.send_buffer.resize(my.n_send * n_bytes);
  my.receive_buffer.resize(my.n_receive * n_bytes);
  char* const fields = reinterpret_cast<char*>(values.data());

  std::size_t request = 0;
  char* to = my.receive_buffer.data();
  for (const auto& neighbour : my.neighbours) {
    const std::size_t n = neighbour.receive.size() * n_bytes;
    MPI_Irecv(to, static_cast<int>(n), MPI_BYTE, neighbour.rank, 0, PETSC_COMM_WORLD,
              &my.requests[request++]);
    to += n;
  }
  char* from = my.send_buffer.data();
  for (const auto& neighbour : my.neighbours) {
    char* const start = from;
    for (Index node : neighbour.send)
      from = std::copy_n(fields + static_cast<std::size_t>(node) * n_bytes, n_bytes, from);
    MPI_Isend(start, static_cast<int>(from - start), MPI_BYTE, neighbour.rank, 0, PETSC_COMM_WORLD,
              &my.requests[request++]);
  }
  MPI_Waitall(static_cast<int>(request), my.requests.data(), MPI_STATUSES_IGNORE);

  const char* in = my.receive_buffer.data();
  for (const auto& neighbour : my.neighbours)
    for (Index node : neighbour.receive) {
      std::copy_n(in, n_bytes, fields + static_cast<std::size_t>(node) * n_bytes);
      in += n_bytes;
    }
}

template void GhostExchange::exchange(std::span<double>, int) const;
template void GhostExchange::exchange(std::span<float>, int) const;

}  // namespace solidus::algebra
