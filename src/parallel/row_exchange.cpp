/// Lengths first, then the rows themselves, to and from the neighbours.
#include "parallel/row_exchange.hpp"

#include <mpi.h>
#include <petscsys.h>

#include "numbers/index_casts.hpp"

namespace solidus::parallel {

void RowExchange::add_to_owners(std::span<float> values, int components) const {
  if (neighbours_.empty()) return;
  const auto n = as_size(components);
  // The way is the reverse of an update of ghosts: what is received there is sent here. First the sizes of
  // both buffers are counted.
  std::size_t n_in = 0, n_out = 0, request = 0;
  for (const Neighbour& neighbour : neighbours_) {
    n_in += neighbour.send.size() * n;
    n_out += neighbour.receive.size() * n;
  }
  std::vector<MPI_Request> requests(2 * neighbours_.size());
  // `out` never grows beyond what is reserved, because messages under way point into it.
  std::vector<float> out, in(n_in);
  out.reserve(n_out);
  float* to = in.data();
  for (const auto& neighbour : neighbours_) {
    const std::size_t count = neighbour.send.size() * n;
    MPI_Irecv(to, static_cast<int>(count), MPI_FLOAT, neighbour.rank, 0, PETSC_COMM_WORLD,
              &requests[request++]);
    to += count;
  }
  for (const auto& neighbour : neighbours_) {
    const float* const start = out.data() + out.size();
    for (const Index node : neighbour.receive) {
      const auto value = values.begin() + static_cast<std::ptrdiff_t>(node) * components;
      out.insert(out.end(), value, value + components);
    }
    MPI_Isend(start, static_cast<int>(neighbour.receive.size() * n), MPI_FLOAT, neighbour.rank, 0,
              PETSC_COMM_WORLD, &requests[request++]);
  }
  MPI_Waitall(static_cast<int>(request), requests.data(), MPI_STATUSES_IGNORE);
  const float* from = in.data();
  // Contributions are added neighbour by neighbour in their order, not as they arrive, so that the sum has
  // the same bits in every run.
  for (const auto& neighbour : neighbours_)
    for (const Index node : neighbour.send)
      for (std::size_t k = 0; k < n; ++k) values[as_size(node) * n + k] += *from++;
}

void RowExchange::exchange(bool to_owners, const Pack& pack, const Unpack& unpack) const {
  const std::vector<Neighbour>& neighbours = neighbours_;
  std::vector<MPI_Request> requests(2 * neighbours.size());
  // The message to each neighbour holds the length of every row, and the row.
  std::vector<std::vector<double>> out(neighbours.size()), in(neighbours.size());
  std::vector<int> n_out(neighbours.size()), n_in(neighbours.size());
  std::size_t request = 0;
  // Lengths are exchanged first, so that each process knows how much it receives.
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    for (const Index node : to_owners ? neighbours[k].receive : neighbours[k].send) {
      const std::size_t place = out[k].size();
      out[k].push_back(0);
      pack(node, out[k]);
      out[k][place] = static_cast<double>(out[k].size() - place - 1);
    }
    n_out[k] = static_cast<int>(out[k].size());
    MPI_Irecv(&n_in[k], 1, MPI_INT, neighbours[k].rank, 1, PETSC_COMM_WORLD, &requests[request++]);
    MPI_Isend(&n_out[k], 1, MPI_INT, neighbours[k].rank, 1, PETSC_COMM_WORLD, &requests[request++]);
  }
  MPI_Waitall(static_cast<int>(request), requests.data(), MPI_STATUSES_IGNORE);
  request = 0;
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    in[k].resize(as_size(n_in[k]));
    MPI_Irecv(in[k].data(), n_in[k], MPI_DOUBLE, neighbours[k].rank, 2, PETSC_COMM_WORLD,
              &requests[request++]);
    MPI_Isend(out[k].data(), n_out[k], MPI_DOUBLE, neighbours[k].rank, 2, PETSC_COMM_WORLD,
              &requests[request++]);
  }
  MPI_Waitall(static_cast<int>(request), requests.data(), MPI_STATUSES_IGNORE);
  // Rows are taken out in the order of the nodes, which both sides have alike.
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    std::size_t place = 0;
    for (const Index node : to_owners ? neighbours[k].send : neighbours[k].receive) {
      const auto length = static_cast<std::size_t>(in[k][place]);
      unpack(node, std::span<const double>(in[k]).subspan(place + 1, length));
      place += 1 + length;
    }
  }
}

}  // namespace solidus::parallel
