/// The processes of a run and what they tell each other: sums, extremes, broadcasts. One process is a run
/// without a launcher; every function works there too.
///
/// All functions but running(), rank(), count() and wall_time() are collective: every process calls them, in
/// the same order.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace solidus::processes {

/// Whether MPI has started and not ended: before and after, nothing else may be called.
bool running();
/// Sets the communicator of all processes of the run by its number in Fortran (MPI_Comm_c2f), which needs no
/// header of MPI. Without this call it is MPI_COMM_WORLD.
void use_communicator(int fortran_number);
/// The number of the communicator in Fortran, for files that hand the communicator to a library.
int communicator();

int rank();
int count();
/// Returns the seconds since some moment in the past; two of them make a duration.
double wall_time();

/// Waits until all processes have come here, no longer than so many seconds; whether they have.
bool all_arrive(double seconds);
/// Ends all processes at once with an exit code. Not collective.
void abort(int code);
/// Sends bytes to another process, which receives them. Not collective.
void send(std::span<const char> bytes, int to);
std::vector<char> receive(int from);

/// Replaces each number by its sum over all processes.
void sum(std::span<double> numbers);
void sum(std::span<std::int64_t> numbers);
void sum(std::span<std::uint64_t> numbers);
/// Replaces each number by the largest of all processes, or by the least.
void largest(std::span<double> numbers);
void largest(std::span<int> numbers);
void least(std::span<std::int64_t> numbers);
int least(int number);
/// Returns the sum over the processes before this one, zero on the first.
std::int64_t sum_before(std::int64_t mine);

/// The process that has the largest number; the lowest of several.
struct Largest {
  double value;
  int rank;
};
Largest find_largest(double mine);

/// Replaces what a process holds by what the process `from` holds. Spans have the same length everywhere.
void broadcast(std::span<double> numbers, int from = 0);
void broadcast(std::span<int> numbers, int from = 0);
void broadcast(std::string& text, int from = 0);
void broadcast(std::vector<char>& bytes, int from = 0);

/// Returns the numbers of all processes, one behind the other in the order of their ranks.
std::vector<double> gather(std::span<const double> mine);
std::vector<std::int64_t> gather(std::int64_t mine);
/// The same on process 0, nothing on the others.
std::vector<double> gather_on_first(std::span<const double> mine);

}  // namespace solidus::processes
