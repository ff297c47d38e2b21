#include "results/output_error.hpp"

#include <mpi.h>
#include <petscsys.h>

#include <exception>

namespace solidus::results {

OutputError::OutputError(const std::string& path, const std::string& what, const std::string& advice)
    : InputError(SourceLocation{path, 0, 0}, what, advice) {}

NotFiniteError::NotFiniteError(const std::string& field, const std::string& where)
    : std::runtime_error(field + " is not finite" + (where.empty() ? "" : " at " + where) +
                         "; it is not written to the results") {}

void together(const std::function<void()>& work) {
  std::exception_ptr error;
  std::string message;
  try {
    work();
  } catch (const std::exception& caught) {
    error = std::current_exception();
    message = caught.what();
  }
  const MPI_Comm comm = PETSC_COMM_WORLD;
  int rank = 0, size = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &size);
  int failing = error ? rank : size;
  MPI_Allreduce(MPI_IN_PLACE, &failing, 1, MPI_INT, MPI_MIN, comm);
  if (failing == size) return;

  int length = static_cast<int>(message.size());
  MPI_Bcast(&length, 1, MPI_INT, failing, comm);
  std::string first = message;
  first.resize(static_cast<std::size_t>(length));
  MPI_Bcast(first.data(), length, MPI_CHAR, failing, comm);
  if (error) std::rethrow_exception(error);
  throw OutputError({}, first);
}

void on_first_process(const std::function<void()>& work) {
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  together([&] {
    if (rank == 0) work();
  });
}

}  // namespace solidus::results
