/// PETSc starts MPI, with settings of the environment that make the start of a single process quick and
/// that are taken back afterwards.
#include "parallel/petsc_session.hpp"

#include <petscsys.h>

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "system/errors.hpp"
#include "system/processes.hpp"
#include "system/temporary_folder.hpp"

namespace solidus::petsc {

namespace {

/// A variable of the environment for as long as this lives.
class PassingVariable {
 public:
  enum class There { stays, is_replaced };
  /// @param value  null: the variable is not there
  /// @param there  what becomes of a value that the variable has already
  PassingVariable(const char* name, const char* value, There there = There::stays) : name_(name) {
    const char* before = std::getenv(name);
    ours_ = before == nullptr || there == There::is_replaced;
    if (before != nullptr) before_ = before;
    if (!ours_) return;
    if (value != nullptr)
      setenv(name, value, 1);
    else
      unsetenv(name);
  }
  ~PassingVariable() {
    if (!ours_) return;
    if (before_)
      setenv(name_, before_->c_str(), 1);
    else
      unsetenv(name_);
  }
  PassingVariable(const PassingVariable&) = delete;
  PassingVariable& operator=(const PassingVariable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
  bool ours_;
};

/// Whether mpirun or another launcher has started this process, before MPI can tell.
bool launched() {
  constexpr const char* k_ranks[] = {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"};
  return std::any_of(std::begin(k_ranks), std::end(k_ranks), [](const char* r) { return std::getenv(r); });
}

/// Settings with which one process alone starts Open MPI: to look for the daemon (orted) that could start
/// further processes, for plugins that reach them and for the caches, disks, networks and graphics devices of
/// the machine takes longer than all the rest of the start. A list that begins with ^ names what is left out,
/// so that it may name plugins that another version of Open MPI does not have. What names a part of Open MPI
/// 4 (ess, orte, state, errmgr, schizo) is not read by Open MPI 5, which needs no daemon for one process.
constexpr std::pair<const char*, const char*> k_alone[] = {
    {"OMPI_MCA_ess_singleton_isolated", "1"},
    // Without the daemon all such processes would make and remove one and the same folder for temporary
    // files, and now and then one would end because another had just removed it.
    {"OMPI_MCA_orte_create_session_dirs", "0"},
    {"OMPI_MCA_pml", "ob1"},
    {"OMPI_MCA_btl", "self"},
    {"OMPI_MCA_coll", "^sm,tuned,monitoring,adapt,sync,inter,han"},
    {"OMPI_MCA_osc", "^ucx,rdma,monitoring"},
    {"OMPI_MCA_op", "^avx"},
    {"OMPI_MCA_shmem", "^sysv,posix"},
    {"OMPI_MCA_state", "^orted,hnp,novm,tool"},
    {"OMPI_MCA_errmgr", "^default_orted,default_hnp,default_tool"},
    {"OMPI_MCA_schizo", "^slurm,jsm,flux"},
    {"HWLOC_SYNTHETIC", "core:1 pu:1"},
    {"HWLOC_PLUGINS_BLACKLIST",
     "hwloc_opencl.so,hwloc_gl.so,hwloc_cuda.so,hwloc_nvml.so,hwloc_rsmi.so,"
     "hwloc_pci.so,hwloc_xml_libxml.so"},
};

/// By these Open MPI takes a process that a job of Slurm has started for one of several that srun has
/// started, and ends it where it finds no others: one process alone starts without them.
constexpr const char* k_of_a_job[] = {"SLURM_NODELIST", "SLURM_STEPID", "SLURM_STEP_ID"};

/// Throws InputError where srun has started several copies of the program that cannot find each other: each
/// would run the whole case, into the same folder.
void require_connected_steps() {
  const char* tasks = std::getenv("SLURM_STEP_NUM_TASKS");
  if (tasks == nullptr || std::string_view(tasks) == "1") return;
  throw InputError({}, std::string("srun has started ") + tasks + " processes that cannot find each other",
                   "`srun --mpi=pmix solidus run …` (`srun --mpi=list` says whether there is pmix), or "
                   "`mpirun solidus run …` in the job");
}

/// Settings for several processes of one machine, which reach each other through its memory. Open MPI 5 would
/// try the network all the same, and each process would print that it finds no "reachable pairing" between
/// the interfaces of the machine and those of the same machine. Of the others Debian's settings leave out
/// these as well, which this list takes the place of.
constexpr std::pair<const char*, const char*> k_on_one_machine[] = {
    {"OMPI_MCA_btl", "^tcp,uct,openib,ofi"},
};

bool waits_yield = false;

#if defined(OMPI_MAJOR_VERSION) && OMPI_MAJOR_VERSION >= 5
constexpr bool k_needs_temporary_folder = true;
#else
constexpr bool k_needs_temporary_folder = false;
#endif

/// Lets one process alone start where the usual folder for temporary files cannot be written: Open MPI 5
/// makes one of its own there, and ends the process with a page of text where it cannot. Throws InputError
/// where no folder can be written.
void choose_temporary_folder(std::deque<PassingVariable>& settings) {
  if (!k_needs_temporary_folder) return;
  const std::string folder = writable_temporary_folder();
  if (folder.empty())
    throw InputError(
        {}, "MPI needs a folder for temporary files, and " + temporary_folder() + " cannot be written",
        "TMPDIR names another one");
  if (folder != temporary_folder())
    settings.emplace_back("TMPDIR", folder.c_str(), PassingVariable::There::is_replaced);
}

bool initialize(int* n, char*** list) {
  std::deque<PassingVariable> settings;
  if (!launched()) {
    require_connected_steps();
    for (const auto& [name, value] : k_alone) settings.emplace_back(name, value);
    for (const char* name : k_of_a_job)
      settings.emplace_back(name, nullptr, PassingVariable::There::is_replaced);
    choose_temporary_folder(settings);
  } else if (all_on_one_machine()) {
    for (const auto& [name, value] : k_on_one_machine) settings.emplace_back(name, value);
    if (waits_yield) settings.emplace_back("OMPI_MCA_mpi_yield_when_idle", "1");
  }
  return PetscInitialize(n, list, nullptr, nullptr) == 0;
}

}  // namespace

bool all_on_one_machine() {
  const char* all = std::getenv("OMPI_COMM_WORLD_SIZE");
  const char* here = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
  return all != nullptr && here != nullptr && std::string_view(all) == here;
}

void yield_in_waits() {
  waits_yield = true;
}

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
