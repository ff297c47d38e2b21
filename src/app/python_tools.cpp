/// The interpreter is found, given the paths of the modules, and run with the verb's arguments.
#include "app/python_tools.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>

#include "app/child_process.hpp"
#include "app/places.hpp"
#include "app/process_choice.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"
#include "system/program_path.hpp"

namespace solidus::app {

namespace {

namespace fs = std::filesystem;

/// The code of a module whose computation could not go on; 2 is that of a command line that Python cannot
/// parse.
constexpr int k_python_cannot_continue = 22;

/// Returns the folder of the Python modules.
fs::path modules() {
  const auto holds_modules = [](const fs::path& folder) {
    std::error_code error;
    return fs::is_directory(folder / "solidus_plots", error);
  };
  if (const fs::path installed = shared_folder() / "python"; holds_modules(installed)) return installed;
  if (const fs::path sources = SOLIDUS_SOURCES; !sources.empty() && holds_modules(sources / "python"))
    return sources / "python";
  throw InputError({}, "the Python modules of Solidus are not where the program was installed",
                   "`cmake --install`, which brings them, or the folder python/ of the sources");
}

volatile std::sig_atomic_t child_to_tell = 0;  ///< the child that is waited for

extern "C" void hand_on(int signal) {
  if (child_to_tell > 0) kill(child_to_tell, signal);
}

/// Handlers of signals while a child is waited for. Ctrl-C reaches the child too, which may have runs to stop
/// first: it is ignored here. The end of a batch job reaches this program alone, and is handed on to the
/// child.
class SignalsOfChild {
 public:
  SignalsOfChild() {
    struct sigaction action {};
    action.sa_handler = SIG_IGN;
    sigaction(SIGINT, &action, &interrupt_);
    action.sa_handler = hand_on;
    action.sa_flags = SA_RESTART;
    sigaction(SIGTERM, &action, &terminate_);
  }
  ~SignalsOfChild() {
    child_to_tell = 0;
    sigaction(SIGINT, &interrupt_, nullptr);
    sigaction(SIGTERM, &terminate_, nullptr);
  }
  SignalsOfChild(const SignalsOfChild&) = delete;
  SignalsOfChild& operator=(const SignalsOfChild&) = delete;

 private:
  struct sigaction interrupt_ {
  }, terminate_{};
};

/// Starts a program, which has signals as they are by default, and waits for its end. Returns its status as
/// waitpid() does, or nothing where waiting failed. Throws InputError where it cannot be started.
std::optional<int> status_of(const std::string& program, char* const* argv, char* const* envp) {
  // The handlers of before come back afterwards, since a run may follow.
  const SignalsOfChild signals;
  sigset_t by_default;
  sigemptyset(&by_default);
  for (const int signal : {SIGINT, SIGPIPE, SIGTERM}) sigaddset(&by_default, signal);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigdefault(&attributes, &by_default);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t child = 0;
  const int error = posix_spawnp(&child, program.c_str(), nullptr, &attributes, argv, envp);
  posix_spawnattr_destroy(&attributes);
  if (error != 0)
    throw InputError({}, fmt::format("'{}' cannot be started: {}", program, std::strerror(error)),
                     "a Python with numpy and matplotlib; SOLIDUS_PYTHON names another one");
  child_to_tell = child;
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return {};
  return status;
}

}  // namespace

std::string python_program() {
  const char* chosen = std::getenv("SOLIDUS_PYTHON");
  return chosen != nullptr && *chosen != '\0' ? chosen : "/usr/bin/python3";
}

ExitCode run_python(const std::string& module, const std::vector<std::string>& arguments) {
  if (processes::count() > 1) throw InputError({}, "this verb runs on one process", "solidus without mpirun");
  const std::string python = python_program();
  std::vector<std::string> command = {python, "-m"};
  // The verbs of solidus_plots tell in one sentence what a Python lacks; a module of another package is used
  // for itself.
  if (module.find('.') == std::string::npos) command.emplace_back("solidus_plots.verb");
  command.push_back(module);
  command.insert(command.end(), arguments.begin(), arguments.end());
  // The environment as it was at the start, with three variables of our own.
  std::vector<std::string> inherited;
  std::string path = modules().string();
  for (const std::string& entry : kept_environment()) {
    if (entry.starts_with("PYTHONPATH="))
      path += ":" + entry.substr(std::strlen("PYTHONPATH="));
    else
      inherited.push_back(entry);
  }
  // Python would otherwise take modules from the present folder, which may be a stranger's.
  inherited.emplace_back("PYTHONSAFEPATH=1");
  inherited.push_back("PYTHONPATH=" + path);
  inherited.push_back("SOLIDUS_PROGRAM=" + program_path().string());
  inherited.push_back("SOLIDUS_CORES=" + std::to_string(usable_cores()));
  std::vector<char*> argv = pointers_to(command), envp = pointers_to(inherited);
  // Its exit code becomes that of the program.
  const std::optional<int> ended = status_of(python, argv.data(), envp.data());
  if (!ended) return k_our_bug;
  const int status = *ended;
  // A child that has no answer of its own to the signal leaves it to this program.
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM) raise(SIGTERM);
  if (WIFSIGNALED(status)) return WTERMSIG(status) == SIGINT ? k_interrupted : k_cannot_continue;
  switch (WEXITSTATUS(status)) {
    case 0:
      return k_done;
    case k_interrupted:
      return k_interrupted;
    case k_python_cannot_continue:
      return k_cannot_continue;
    default:
      return k_bad_input;
  }
}

}  // namespace solidus::app
