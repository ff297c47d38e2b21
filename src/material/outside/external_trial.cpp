/// A fork of the process runs the trial and reports by a pipe; the parent waits for its end or for the time
/// to be over.
#include "material/outside/external_trial.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "numbers/index_casts.hpp"

namespace solidus::material {

namespace {

constexpr int k_came_to_an_end = 0, k_ended_itself = 1;

/// Ends the copy where a library calls exit() or Fortran's STOP, before the program's own handlers run in it.
void leave(int /*status*/, void* /*unused*/) {
  _exit(k_ended_itself);
}

[[noreturn]] void run_in_copy(const Trial& trial, int notes) {
  // In the copy signals kill as they would without the program's own handlers.
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM}) std::signal(signal, SIG_DFL);
  for (const int signal : {SIGINT, SIGHUP, SIGUSR1}) std::signal(signal, SIG_IGN);  // the program decides
  on_exit(leave, nullptr);
  // Notes go through the pipe before each part, so that the last one tells where it ended.
  const auto note = [notes](const std::string& part) {
    const std::string line = part + "\n";
    [[maybe_unused]] const ssize_t written = ::write(notes, line.data(), line.size());
  };
  try {
    trial(note);
  } catch (const std::exception&) {  // NOLINT: the program meets it itself
  }
  _exit(k_came_to_an_end);
}

std::string last_line(const std::string& notes) {
  if (notes.size() < 2) return "starting";
  const std::size_t before = notes.rfind('\n', notes.size() - 2);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return notes.substr(begin, notes.size() - 1 - begin);
}

}  // namespace

std::string fault_of(const Trial& trial, double seconds) {
  // A law from outside may crash, end the process or never return. So a copy of the process tries it, and
  // tells by a pipe what it is doing.
  int ends[2];
  if (::pipe(ends) != 0) return fmt::format("no pipe to a trial: {}", std::strerror(errno));
  const pid_t copy = ::fork();
  if (copy < 0) {
    const std::string reason = std::strerror(errno);
    ::close(ends[0]);
    ::close(ends[1]);
    return "no process for a trial: " + reason;
  }
  // The copy runs the trial and never comes back here.
  if (copy == 0) {
    ::close(ends[0]);
    run_in_copy(trial, ends[1]);
  }
  ::close(ends[1]);

  // The parent reads the notes until the copy ends or the time is over.
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  std::string notes;
  bool late = false;
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    if (left <= 0) {
      late = true;
      break;
    }
    pollfd from{ends[0], POLLIN, 0};
    const int ready = ::poll(&from, 1, static_cast<int>(left));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) continue;
    char some[512];
    const ssize_t n = ::read(ends[0], some, sizeof some);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;  // it has ended
    notes.append(some, as_size(n));
  }
  // A copy that is late is killed. How it ended says what the fault is; the last note says what it was doing.
  ::close(ends[0]);
  if (late) ::kill(copy, SIGKILL);
  int status = 0;
  while (::waitpid(copy, &status, 0) < 0 && errno == EINTR) {
  }
  if (late) return fmt::format("it came to no end within {:g} s while {}", seconds, last_line(notes));
  if (WIFSIGNALED(status))
    return fmt::format("it crashed (signal {}, {}) while {}", WTERMSIG(status), strsignal(WTERMSIG(status)),
                       last_line(notes));
  if (WIFEXITED(status) && WEXITSTATUS(status) != k_came_to_an_end)
    return fmt::format("it ended the process while {}", last_line(notes));
  return {};
}

}  // namespace solidus::material
