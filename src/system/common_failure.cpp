#include "system/common_failure.hpp"

#include <mpi.h>

#include <exception>
#include <new>
#include <stdexcept>

#include "system/errors.hpp"

namespace solidus {

namespace {

enum Kind : int { k_input, k_memory, k_internal };

/// An exception of this process, and how it is told to the others.
struct Failure {
  std::exception_ptr error;
  int kind = k_internal;
  std::string message;
};

Failure failure_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const InputError& error) {
    return {std::current_exception(), k_input, error.what()};
  } catch (const std::bad_alloc& error) {
    return {std::current_exception(), k_memory, error.what()};
  } catch (const std::exception& error) {
    return {std::current_exception(), k_internal, error.what()};
  } catch (...) {
    return {std::current_exception(), k_internal, "an exception of a library"};
  }
  return {};
}

}  // namespace

void run_collectively(const std::function<void()>& work, const ThrowInputError& throw_input_error) {
  Failure failure = failure_of(work);
  const MPI_Comm comm = MPI_COMM_WORLD;
  int rank = 0, size = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  int failing = failure.error ? rank : size;
  MPI_Allreduce(MPI_IN_PLACE, &failing, 1, MPI_INT, MPI_MIN, comm);
  if (failing == size) return;

  int told[2] = {failure.kind, static_cast<int>(failure.message.size())};
  MPI_Bcast(told, 2, MPI_INT, failing, comm);
  std::string message = failure.message;
  message.resize(static_cast<std::size_t>(told[1]));
  MPI_Bcast(message.data(), told[1], MPI_CHAR, failing, comm);
  if (failure.error) std::rethrow_exception(failure.error);
  if (told[0] == k_memory) throw std::bad_alloc();
  if (told[0] == k_internal) throw std::runtime_error(message);
  if (throw_input_error) throw_input_error(message);
  throw InputError({}, message);
}

void on_first_process(const std::function<void()>& work, const ThrowInputError& throw_input_error) {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  run_collectively(
      [&] {
        if (rank == 0) work();
      },
      throw_input_error);
}

}  // namespace solidus
