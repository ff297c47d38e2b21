#include "parallel/petsc_session.hpp"

#include <petscsys.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>

#include "system/processes.hpp"

namespace solidus::petsc {

namespace {

/// A variable of the environment for as long as this lives; one that is there already stays as it is.
class PassingVariable {
 public:
  PassingVariable(const char* name, const char* value) : name_(name), ours_(std::getenv(name) == nullptr) {
    if (ours_) setenv(name, value, 0);
  }
  ~PassingVariable() {
    if (ours_) unsetenv(name_);
  }
  PassingVariable(const PassingVariable&) = delete;
  PassingVariable& operator=(const PassingVariable&) = delete;

 private:
  const char* name_;
  bool ours_;
};

/// Whether mpirun or another launcher has started this process, before MPI can tell.
bool launched() {
  constexpr const char* k_ranks[] = {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"};
  return std::any_of(std::begin(k_ranks), std::end(k_ranks), [](const char* r) { return std::getenv(r); });
}

bool initialize(int* n, char*** list) {
  if (launched()) return PetscInitialize(n, list, nullptr, nullptr) == 0;
  // One process alone needs little of Open MPI: no daemon (orted) that could start further ones, no search
  // for InfiniPath, OpenCL and graphics devices. That search takes longer than all the rest of the start.
  const PassingVariable no_daemon("OMPI_MCA_ess_singleton_isolated", "1");
  // Without the daemon all such processes would make and remove one and the same folder for temporary files,
  // and now and then one would end because another had just removed it.
  const PassingVariable no_folder("OMPI_MCA_orte_create_session_dirs", "0");
  const PassingVariable no_network("OMPI_MCA_pml", "ob1"), itself("OMPI_MCA_btl", "self");
  const PassingVariable no_devices("HWLOC_PLUGINS_BLACKLIST",
                                   "hwloc_opencl.so,hwloc_gl.so,hwloc_cuda.so,hwloc_nvml.so,hwloc_rsmi.so");
  return PetscInitialize(n, list, nullptr, nullptr) == 0;
}

}  // namespace

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
  return initialize(&n, &list);
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
