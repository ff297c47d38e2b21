#include "app/launcher.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <span>
#include <sstream>
#include <utility>

#include "app/case_arguments.hpp"
#include "app/child_process.hpp"
#include "app/descriptors.hpp"
#include "app/forwarded_signals.hpp"
#include "app/launched.hpp"
#include "numbers/index_casts.hpp"
#include "system/free_memory.hpp"
#include "system/input_file.hpp"
#include "system/log.hpp"
#include "system/program_path.hpp"
#include "system/terminal.hpp"

namespace solidus::app {

namespace {

namespace fs = std::filesystem;

using Clock = std::chrono::steady_clock;

/// Writes into a file in memory what the first process takes over: the warnings so far, and the mesh.
void fill(const Descriptor& file, const setup::MadeMesh& mesh) {
  // The order here is the order in which take_over() reads: a number, so many warnings, and the mesh.
  const mesh::PutBytes put = [&](const void* bytes, std::size_t n) {
    mesh::put_all(file.number(), bytes, n);
  };
  const std::vector<std::string> warnings = logging::warnings();
  const std::size_t n_warnings = warnings.size();
  put(&n_warnings, sizeof n_warnings);
  for (const std::string& warning : warnings) mesh::put_text(warning, put);
  setup::put_made_mesh(mesh, put);
  // The receiver shares this place in the file with the sender, and has to find its beginning.
  lseek(file.number(), 0, SEEK_SET);
}

/// mpirun, at work.
class Mpirun {
 public:
  Mpirun() = default;
  ~Mpirun() {
    if (pid_ > 0) end();
  }
  Mpirun(const Mpirun&) = delete;
  Mpirun& operator=(const Mpirun&) = delete;

  /// Returns the number of an error, or zero.
  int start(std::vector<std::string> command, std::vector<std::string> environment);
  /// Hears what it says itself, for at most so long; false when it has closed its output.
  bool hear(int milliseconds);
  const Descriptor& output() const { return output_; }
  /// Asks it to end, with all processes that it has started.
  void end();
  /// Waits for its end, as waitpid(2) tells it.
  int wait();
  /// The text that it has printed, in one line.
  std::string said() const;

 private:
  pid_t pid_ = -1;
  int status_ = 0;
  Descriptor output_;
  std::string text_;
};

int Mpirun::start(std::vector<std::string> command, std::vector<std::string> environment) {
  // One pipe brings the words of mpirun, the other the number of an error if it cannot be started. Both close
  // themselves in the program that is started.
  std::array<int, 2> ends{}, failed{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0 || pipe2(failed.data(), O_CLOEXEC) != 0) return errno;
  output_ = Descriptor(ends[0]);
  const Descriptor writes(ends[1]), told(failed[0]);
  Descriptor tells(failed[1]);
  // Everything that allocates is done while this is one process: after fork() only calls that are safe in a
  // handler of signals are allowed in the child.
  std::vector<char*> argv = pointers_to(command), envp = pointers_to(environment);
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) {
    // Whatever ends this program ends mpirun, and that its processes. It has a group of its own, which no key
    // of the terminal reaches.
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) _exit(1);
    setpgid(0, 0);
    for (const int signal : {SIGPIPE, SIGINT, SIGTERM, SIGUSR1, SIGHUP, SIGQUIT, SIGTSTP})
      std::signal(signal, SIG_DFL);
    const int nothing = ::open("/dev/null", O_RDONLY);
    dup2(nothing, STDIN_FILENO);
    dup2(ends[1], STDOUT_FILENO);
    dup2(ends[1], STDERR_FILENO);
    // A success never returns; a failure sends its number back through the second pipe.
    execvpe(argv[0], argv.data(), envp.data());
    const int error = errno;
    if (::write(failed[1], &error, sizeof error) < 0) _exit(1);
    _exit(1);
  }
  if (pid_ < 0) return errno;
  // The parent's own end has to be closed, or the read below would wait for ever after a success.
  tells = Descriptor();
  int error = 0;
  if (::read(told.number(), &error, sizeof error) == static_cast<ssize_t>(sizeof error)) {
    wait();
    return error;
  }
  return 0;
}

bool Mpirun::hear(int milliseconds) {
  pollfd waiting{output_.number(), POLLIN, 0};
  // A silence is no end: only a pipe that its writer has closed tells that mpirun is through.
  if (::poll(&waiting, 1, milliseconds) <= 0) return true;
  std::array<char, 4096> buffer{};
  const ssize_t n = ::read(output_.number(), buffer.data(), buffer.size());
  if (n < 0 && errno == EINTR) return true;
  if (n <= 0) return false;
  // More text than this is read and dropped, so that mpirun never waits for a full pipe.
  constexpr std::size_t k_kept = 1 << 16;  // bytes
  if (text_.size() < k_kept) text_.append(buffer.data(), as_size(n));
  return true;
}

void Mpirun::end() {
  // First the polite signal, on which mpirun ends its processes; whatever is left after the time is ended by
  // force.
  ::kill(pid_, SIGTERM);
  constexpr std::chrono::seconds k_patience(5);
  const Clock::time_point until = Clock::now() + k_patience;
  while (hear(100) && Clock::now() < until) {
  }
  if (Clock::now() >= until) ::kill(pid_, SIGKILL);
  wait();
}

int Mpirun::wait() {
  // An interrupted wait is repeated, and a process that is waited for already is not waited for again: its
  // number may belong to another one.
  if (pid_ > 0)
    while (waitpid(pid_, &status_, 0) < 0 && errno == EINTR) {
    }
  pid_ = -1;
  return status_;
}

std::string Mpirun::said() const {
  constexpr std::size_t k_length = 40;  // characters; what follows the first lines is advice
  std::string line;
  std::istringstream lines(text_);
  // Lines that only frame the text, and those that are empty, are left out of what the user is told.
  for (std::string part; std::getline(lines, part) && line.size() < k_length;) {
    const std::size_t begin = part.find_first_not_of(' ');
    if (begin == std::string::npos || part.starts_with("----")) continue;
    line += (line.empty() ? "" : " ") + part.substr(begin);
  }
  return line;
}

std::vector<std::string> environment_of_processes(const std::string& meeting) {
  std::vector<std::string> all = kept_environment();
  all.push_back(fmt::format("{}={}", k_launcher_variable, meeting));
  // A user who may run one process as root may run two.
  if (geteuid() == 0)
    for (const char* allow : {"OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"})
      all.emplace_back(allow);
  return all;
}

/// A process that has come to the meeting.
struct Member {
  Descriptor connection;
  pid_t pid = 0;
  int rank = 0;
};

/// Waits until all are there. Returns why not, or an empty text.
std::string gather(int n, const Descriptor& meeting, Mpirun& mpirun, std::vector<Member>& members) {
  constexpr std::chrono::seconds k_patience(60);
  const Clock::time_point until = Clock::now() + k_patience;
  // Three things can happen: a process knocks, mpirun says something or ends, or neither within a tenth of a
  // second. The time is looked at each time round.
  while (static_cast<int>(members.size()) < n) {
    if (Clock::now() > until)
      return fmt::format("it started {} of {} processes within a minute", members.size(), n);
    std::array<pollfd, 2> waiting{{{meeting.number(), POLLIN, 0}, {mpirun.output().number(), POLLIN, 0}}};
    if (::poll(waiting.data(), waiting.size(), 100) <= 0) continue;
    // If mpirun ends here, no further process comes, and its own words are the best reason that can be given.
    if (waiting[1].revents != 0 && !mpirun.hear(0)) {
      const int status = mpirun.wait();
      const std::string said = mpirun.said();
      return fmt::format("exit code {}{}{}", WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
                         said.empty() ? "" : ": ", said);
    }
    if (waiting[0].revents == 0) continue;
    // The system tells the user of each process that connects, so that no stranger gets a hand on the output
    // or the mesh.
    Member member{Descriptor(::accept4(meeting.number(), nullptr, nullptr, SOCK_CLOEXEC))};
    const std::optional<pid_t> pid = process_behind(member.connection);
    if (!pid) continue;
    const std::optional<ReceivedFiles> said = receive_files(member.connection);
    int count = 0;
    // The line holds the rank and the number of processes as MPI tells them; a line of another form is none
    // of ours.
    if (!said || std::sscanf(said->line.c_str(), "%d %d", &member.rank, &count) != 2) continue;
    if (count != n)
      return "those that it starts do not find each other: it is of another MPI than the program";
    member.pid = *pid;
    members.push_back(std::move(member));
  }
  return {};
}

/// The exit code of the run, from how mpirun has ended: with the code of the first process that did not end
/// well, or 128 and the number of the signal that ended one.
ExitCode code_of(int status, const ForwardedSignals& signals, const Mpirun& mpirun) {
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  // A code of this program's own is passed on as it is, since its message has been printed by the process
  // that ended with it.
  for (const ExitCode known : {k_done, k_bad_input, k_cannot_continue, k_our_bug, k_interrupted})
    if (code == known) return known;
  // A signal that the user sent ends this program the same way, so that a shell sees what it expects.
  if (signals.count() > 0 && code == 128 + signals.last()) {
    std::signal(signals.last(), SIG_DFL);
    std::raise(signals.last());
  }
  const std::string why =
      code > 128
          ? fmt::format("one of the processes was ended by signal {} ({}){}", code - 128,
                        strsignal(code - 128),
                        code - 128 == SIGKILL ? ": by the system, where memory ran out, or by a user" : "")
          : fmt::format("the processes ended with code {}: {}", code, mpirun.said());
  std::fputs(
      fmt::format("{} {}\n", painted("solidus:", Colour::red, has_colours(STDERR_FILENO)), printable(why))
          .c_str(),
      stderr);
  return k_cannot_continue;
}

}  // namespace

std::string find_mpirun() {
  std::error_code error;
  // The one next to the program is taken for that of the MPI with which it was built, and goes before any
  // other on the path.
  const fs::path beside = program_path().parent_path() / "mpirun";
  if (fs::exists(beside, error)) return beside.string();
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const fs::path file = fs::path(folder.empty() ? "." : folder) / "mpirun";
        ::access(file.c_str(), X_OK) == 0 && !fs::is_directory(file, error))
      return file.string();
  return {};
}

LaunchOutcome run_on_processes(int n, const std::string& mpirun, std::shared_ptr<setup::MadeMesh> mesh,
                               const std::string& greeting) {
  // All that can fail without a process is done first: then nothing has to be ended when it fails.
  const Meeting meeting = open_meeting();
  Descriptor file(memfd_create("solidus mesh", MFD_CLOEXEC));
  if (!meeting.socket.open() || !file.open())
    return {{}, "the system has no sockets or no files in memory", std::move(mesh)};
  fill(file, *mesh);
  // The mesh lies in the file now. A second copy in this process, which only waits from here on, would cost
  // the others their memory.
  mesh.reset();
  return_free_memory();
  // If the processes do not come up, the mesh is read back from the file and the run goes on alone.
  const auto in_vain = [&](std::string why) -> LaunchOutcome {
    return {{}, std::move(why), std::make_shared<setup::MadeMesh>(take_over(file.number()))};
  };
  // Signals are taken up while there is no process to send them to, and sent on as soon as one is there.
  ForwardedSignals signals;
  Mpirun launcher;
  // The processes share the machine as its scheduler sees fit: binding would put those of two runs onto the
  // same cores.
  std::vector<std::string> command = {mpirun,      "-n",   std::to_string(n),      "--oversubscribe",
                                      "--bind-to", "none", program_path().string()};
  command.insert(command.end(), kept_arguments().begin(), kept_arguments().end());
  if (const int error = launcher.start(command, environment_of_processes(meeting.name)); error != 0)
    return in_vain(std::strerror(error));
  std::vector<Member> members;
  if (std::string failure = gather(n, meeting.socket, launcher, members); !failure.empty())
    return in_vain(std::move(failure));
  print(greeting);
  // From here on the run has begun: its processes are known and signals reach them.
  std::vector<pid_t> pids;
  for (const Member& member : members) pids.push_back(member.pid);
  signals.send_to(pids);
  // The first of them has the mesh, all of them the output.
  const std::array files = {STDOUT_FILENO, STDERR_FILENO, file.number()};
  for (const Member& member : members)
    send_files(member.connection, "welcome", std::span(files).first(member.rank == 0 ? 3 : 2));
  // The memory of the mesh goes when the last process that holds the file closes it.
  file = Descriptor();
  while (launcher.hear(-1)) {
  }
  const int status = launcher.wait();
  signals.send_to({});
  return {code_of(status, signals, launcher), {}, nullptr};
}

}  // namespace solidus::app
