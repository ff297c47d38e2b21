#include "parallel/petsc_session.hpp"

#include <petscsys.h>

#include "system/processes.hpp"

namespace solidus::petsc {

bool start(const std::vector<std::string>& options) {
  if (running()) {  // another part of the program has started it
    processes::use_communicator(MPI_Comm_c2f(PETSC_COMM_WORLD));
    return true;
  }
  static std::vector<std::string> words = {"solidus", "-skip_petscrc", "-no_signal_handler"};
  static std::vector<char*> pointers;  // PETSc keeps both
  words.insert(words.end(), options.begin(), options.end());
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  int n = static_cast<int>(words.size());
  char** list = pointers.data();
  return PetscInitialize(&n, &list, nullptr, nullptr) == 0;
}

void use_communicator(int fortran_number) {
  PETSC_COMM_WORLD = MPI_Comm_f2c(fortran_number);
  processes::use_communicator(fortran_number);
}

bool running() {
  PetscBool started = PETSC_FALSE, ended = PETSC_FALSE;
  PetscInitialized(&started);
  PetscFinalized(&ended);
  return started && !ended;
}

void end() {
  if (running()) PetscFinalize();
}

}  // namespace solidus::petsc
