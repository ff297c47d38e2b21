#include "app/process_choice.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "app/case_arguments.hpp"
#include "app/launched.hpp"
#include "app/launcher.hpp"
#include "app/signals.hpp"
#include "cases/case_materials.hpp"
#include "run/process_count.hpp"
#include "run/restart.hpp"
#include "setup/mesh_input.hpp"
#include "system/cores.hpp"
#include "system/errors.hpp"
#include "system/log.hpp"
#include "system/processes.hpp"
#include "system/profile.hpp"

namespace solidus::app {

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* k_variable = "SOLIDUS_PROCESSES";

/// How long the load of the cores is watched at least: the system counts in hundredths of a second.
constexpr std::chrono::milliseconds k_watched(200);
/// The part of a core that others may use while it still counts as free.
constexpr double k_spare = 0.3;

std::optional<int> asked_by_environment() {
  const char* text = std::getenv(k_variable);
  if (text == nullptr || *text == '\0') return std::nullopt;
  const std::string_view given(text);
  int n = 0;
  const auto [end, error] = std::from_chars(given.begin(), given.end(), n);
  // The whole text has to be a number: "4 cores" or "2x" would else be taken as a number that was not meant.
  if (error != std::errc() || end != given.end() || n < 1)
    throw InputError({k_variable}, fmt::format("'{}' is no number of processes", given), "1, 2, …");
  return n;
}

bool any_set(std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(), [](const char* name) { return std::getenv(name); });
}

/// Whether a launcher of MPI has started this process, be it alone.
bool started_by_mpi() {
  return processes::count() > 1 ||
         any_set({"OMPI_COMM_WORLD_SIZE", "PMI_RANK", "PMI_SIZE", "PMIX_RANK", "SLURM_STEP_ID"});
}

/// Whether a batch system has given this job its cores: its own launcher knows them.
bool in_batch_job() {
  return any_set({"SLURM_JOB_ID", "PBS_JOBID", "LSB_JOBID", "PE_HOSTFILE", "COBALT_JOBID"});
}

/// Processor time of this process and of those that have ended below it [s].
double own_seconds() {
  double seconds = 0;
  // The user's and the system's time count both, and so does that of the programs that this one has started.
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage used{};
    getrusage(who, &used);
    for (const timeval& time : {used.ru_utime, used.ru_stime})
      seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return seconds;
}

/// What others leave of the cores, watched from its making on.
class FreeCores {
 public:
  FreeCores() : load_(cores_of(usable_processors())), began_(Clock::now()), own_(own_seconds()) {}
  int count() const {
    // A shorter look would see few ticks of the clock and take a busy core for a free one; time that went
    // into the mesh counts as watched.
    std::this_thread::sleep_until(began_ + k_watched);
    return std::max(static_cast<int>(std::floor(load_.free_cores(own_seconds() - own_) + k_spare)), 1);
  }

 private:
  CoreLoad load_;
  Clock::time_point began_;
  double own_;
};

std::string counted(int n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

/// "2 processes of 2 cores", with a reason where there is one.
std::string line(int n, int cores, std::string_view why = {}) {
  return fmt::format("{} of {}{}{}\n", counted(n, "process", "processes"), counted(cores, "core", "cores"),
                     why.empty() ? "" : ": ", why);
}

/// The mesh of the case.
std::shared_ptr<setup::MadeMesh> mesh_of(const setup::Case& c) {
  const profile::Part part("reading and meshing");
  return std::make_shared<setup::MadeMesh>(setup::make_mesh(c.spec));
}

/// Runs on as many processes as were asked for.
RunStart run_as_asked(int n, int cores, const setup::Case& c, const run::RunOptions& options) {
  // One process is this one; nothing has to be started, and no mpirun need be there.
  if (n == 1) {
    print(line(1, cores, "as asked"));
    return {};
  }
  const std::string what = fmt::format("{} processes were asked for", n);
  const std::string mpirun = find_mpirun();
  if (mpirun.empty())
    throw InputError({}, what + ", and mpirun, which starts them, is missing",
                     "the package openmpi-bin of Debian, or --processes 1");
  // What is wrong with the folder or a material is found before the mesh is made, as on one process.
  run::check_restart(c.spec, options);
  cases::load_materials(c.spec);
  // The user gave a number, so that a failure is an error here, where a choice of the program would fall back
  // to one process.
  LaunchOutcome outcome = run_on_processes(n, mpirun, mesh_of(c), line(n, cores, "as asked"));
  if (!outcome.code)
    throw InputError({}, fmt::format("{}, and '{}' does not start them: {}", what, mpirun, outcome.failure),
                     "`solidus doctor` says what this machine lacks; --processes 1 needs no mpirun");
  return {outcome.code, nullptr};
}

/// Why a run stays on one process, whatever its mesh is; empty where it may be on several.
std::string reason_for_one(const setup::Case& c, int cores, const std::string& mpirun) {
  // The order is that of importance: in a batch job it is the job's limits that hold, whatever else is
  // missing.
  if (in_batch_job()) return "in a batch job, whose own launcher starts several";
  std::error_code error;
  if (!std::filesystem::is_regular_file(c.file, error)) return "a case from a pipe is read once";
  if (cores > 1 && mpirun.empty()) return "mpirun, which starts several, is missing (Debian's openmpi-bin)";
  return {};
}

}  // namespace

int usable_cores() {
  return cores_within(static_cast<int>(cores_of(usable_processors()).size()), processor_quota());
}

RunStart start_run(std::optional<int> asked, const setup::Case& c, const run::RunOptions& options) {
  // A process that the launcher started has its mesh and its number already, and must not start others.
  if (started_by_launcher()) return {{}, mesh_of_launcher()};
  if (started_by_mpi()) {
    if (asked)
      throw InputError({"--processes"}, "mpirun or a batch system has started the processes already",
                       "one of both: `solidus run --processes N`, or `mpirun -n N solidus run`");
    return {};
  }
  const int cores = usable_cores();
  // The command line goes before the environment, and both before the estimate.
  if (!asked) asked = asked_by_environment();
  if (asked) return run_as_asked(*asked, cores, c, options);
  const std::string mpirun = find_mpirun();
  const std::string why = reason_for_one(c, cores, mpirun);
  // Where one process is certain, the mesh is made by the run itself, at its usual place.
  if (cores == 1 || !why.empty()) {
    print(line(1, cores, why));
    return {};
  }
  // The load is watched while the mesh is read or made, which takes as long for large meshes.
  const FreeCores free_cores;
  // Mistakes of the case are told before the mesh is made, which may take minutes.
  run::check_restart(c.spec, options);
  const std::vector<material::Material> materials = cases::load_materials(c.spec);
  RunStart start{{}, mesh_of(c)};
  const run::RunWork work = run::run_work(c.spec, materials, start.mesh->mesh);
  const int paying = run::processes_that_pay(work, cores);
  // Waiting for the load is spared where one process would be best anyway.
  const int n = paying == 1 ? 1 : std::min(paying, free_cores.count());
  // An interruption while the mesh was made ends the run at its beginning, as on one process.
  if (n == 1 || stop_asked()) {
    print(line(1, cores, paying == 1 ? "the case is small" : "other programs use the rest"));
    return start;
  }
  LaunchOutcome outcome = run_on_processes(n, mpirun, std::move(start.mesh), line(n, cores));
  // Without several processes the run is slower and otherwise the same, so that a warning is enough.
  if (!outcome.code) {
    logging::warn("'{}' does not start several processes here: {}", mpirun, outcome.failure);
    print(line(1, cores));
  }
  return {outcome.code, std::move(outcome.mesh)};
}

}  // namespace solidus::app
