/// Collectives of MPI behind plain functions, in pieces where counts would overflow an int.
#include "system/processes.hpp"

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <thread>

#include "numbers/index_casts.hpp"

namespace solidus::processes {

namespace {

/// The communicator of all calls: that of the world, or the one a Python program hands over.
MPI_Comm& all_processes() {
  static MPI_Comm all = MPI_COMM_WORLD;
  return all;
}

template <class T>
void reduce(std::span<T> numbers, MPI_Datatype type, MPI_Op operation) {
  MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), type, operation,
                all_processes());
}

// MPI counts are ints: large buffers travel in pieces.
constexpr std::size_t k_piece = std::size_t{1} << 30;

/// Brings the bytes of one process to all; they may have any number.
template <class Bytes>
void broadcast_bytes(Bytes& bytes, int from) {
  auto size = static_cast<std::int64_t>(bytes.size());
  MPI_Bcast(&size, 1, MPI_INT64_T, from, all_processes());
  bytes.resize(as_size(size));
  MPI_Bcast(bytes.data(), static_cast<int>(size), MPI_CHAR, from, all_processes());
}

/// The number of entries of each process, and where they begin in the list of all.
struct Pieces {
  std::vector<int> counts, starts;

  explicit Pieces(std::size_t mine) : counts(as_size(count())), starts(counts.size()) {
    const auto n = static_cast<int>(mine);
    MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, all_processes());
    std::exclusive_scan(counts.begin(), counts.end(), starts.begin(), 0);
  }
  std::size_t total() const { return as_size(starts.back() + counts.back()); }
};

}  // namespace

bool running() {
  int initialized = 0, finalized = 0;
  MPI_Initialized(&initialized);
  MPI_Finalized(&finalized);
  return initialized != 0 && finalized == 0;
}
void use_communicator(int fortran_number) {
  all_processes() = MPI_Comm_f2c(fortran_number);
}
int communicator() {
  return MPI_Comm_c2f(all_processes());
}

int rank() {
  int rank = 0;
  MPI_Comm_rank(all_processes(), &rank);
  return rank;
}
int count() {
  int count = 1;
  MPI_Comm_size(all_processes(), &count);
  return count;
}
double wall_time() {
  return MPI_Wtime();
}

/// A barrier with a limit of time: a process that failed alone must not leave the others waiting for ever.
bool all_arrive(double seconds) {
  MPI_Request everybody = MPI_REQUEST_NULL;
  MPI_Ibarrier(all_processes(), &everybody);
  const double end = wall_time() + seconds;
  int here = 0;
  while (!here && wall_time() < end) {
    MPI_Test(&everybody, &here, MPI_STATUS_IGNORE);
    if (!here) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return here != 0;
}
void abort(int code) {
  MPI_Abort(all_processes(), code);
}
/// Sends the size first, then the bytes in pieces.
void send(std::span<const char> bytes, int to) {
  unsigned long long size = bytes.size();
  MPI_Send(&size, 1, MPI_UNSIGNED_LONG_LONG, to, 0, all_processes());
  for (std::size_t at = 0; at < bytes.size(); at += k_piece)
    MPI_Send(bytes.data() + at, static_cast<int>(std::min(k_piece, bytes.size() - at)), MPI_CHAR, to, 1,
             all_processes());
}
std::vector<char> receive(int from) {
  unsigned long long size = 0;
  MPI_Recv(&size, 1, MPI_UNSIGNED_LONG_LONG, from, 0, all_processes(), MPI_STATUS_IGNORE);
  std::vector<char> bytes(size);
  for (std::size_t at = 0; at < bytes.size(); at += k_piece)
    MPI_Recv(bytes.data() + at, static_cast<int>(std::min(k_piece, bytes.size() - at)), MPI_CHAR, from, 1,
             all_processes(), MPI_STATUS_IGNORE);
  return bytes;
}

void sum(std::span<double> numbers) {
  reduce(numbers, MPI_DOUBLE, MPI_SUM);
}
void sum(std::span<std::int64_t> numbers) {
  reduce(numbers, MPI_INT64_T, MPI_SUM);
}
void sum(std::span<std::uint64_t> numbers) {
  reduce(numbers, MPI_UINT64_T, MPI_SUM);
}
void largest(std::span<double> numbers) {
  reduce(numbers, MPI_DOUBLE, MPI_MAX);
}
void largest(std::span<int> numbers) {
  reduce(numbers, MPI_INT, MPI_MAX);
}
void least(std::span<std::int64_t> numbers) {
  reduce(numbers, MPI_INT64_T, MPI_MIN);
}
int least(int number) {
  reduce(std::span(&number, 1), MPI_INT, MPI_MIN);
  return number;
}

std::int64_t sum_before(std::int64_t mine) {
  std::int64_t before = 0;
  MPI_Exscan(&mine, &before, 1, MPI_INT64_T, MPI_SUM, all_processes());
  return rank() == 0 ? 0 : before;  // where MPI leaves it undefined
}

/// The largest number and the process that has it; the lowest of several.
Largest find_largest(double mine) {
  Largest own{mine, rank()}, all{};
  MPI_Allreduce(&own, &all, 1, MPI_DOUBLE_INT, MPI_MAXLOC, all_processes());
  return all;
}

void broadcast(std::span<double> numbers, int from) {
  MPI_Bcast(numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, from, all_processes());
}
void broadcast(std::span<int> numbers, int from) {
  MPI_Bcast(numbers.data(), static_cast<int>(numbers.size()), MPI_INT, from, all_processes());
}
void broadcast(std::string& text, int from) {
  broadcast_bytes(text, from);
}
void broadcast(std::vector<char>& bytes, int from) {
  broadcast_bytes(bytes, from);
}

std::vector<double> gather(std::span<const double> mine) {
  const Pieces pieces(mine.size());
  std::vector<double> all(pieces.total());
  MPI_Allgatherv(mine.data(), static_cast<int>(mine.size()), MPI_DOUBLE, all.data(), pieces.counts.data(),
                 pieces.starts.data(), MPI_DOUBLE, all_processes());
  return all;
}
std::vector<std::int64_t> gather(std::int64_t mine) {
  std::vector<std::int64_t> all(as_size(count()));
  MPI_Allgather(&mine, 1, MPI_INT64_T, all.data(), 1, MPI_INT64_T, all_processes());
  return all;
}
/// As gather(), on the first process alone: the others get nothing.
std::vector<double> gather_on_first(std::span<const double> mine) {
  const Pieces pieces(mine.size());
  std::vector<double> all(rank() == 0 ? pieces.total() : 0);
  MPI_Gatherv(mine.data(), static_cast<int>(mine.size()), MPI_DOUBLE, all.data(), pieces.counts.data(),
              pieces.starts.data(), MPI_DOUBLE, 0, all_processes());
  return all;
}

}  // namespace solidus::processes
