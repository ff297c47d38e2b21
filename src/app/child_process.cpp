#include "app/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

#include "numbers/index_casts.hpp"

extern char** environ;

namespace solidus::app {

namespace {

std::vector<std::string>& environment() {
  static std::vector<std::string> kept;
  return kept;
}

std::vector<std::string>& arguments() {
  static std::vector<std::string> kept;
  return kept;
}

/// Reads until the other end is closed. Returns whether that happened in time.
bool take_all(int from, double seconds, std::string& text) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (true) {
    const double left = std::chrono::duration<double>(end - std::chrono::steady_clock::now()).count();
    if (left <= 0) return false;
    pollfd waiting{from, POLLIN, 0};
    if (::poll(&waiting, 1, static_cast<int>(1000 * left) + 1) <= 0) continue;
    std::array<char, 4096> buffer{};
    const ssize_t n = ::read(from, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return true;
    text.append(buffer.data(), as_size(n));
  }
}

/// Starts it as the first of a group of processes of its own, so that all of them can be ended.
/// @return zero, or the number of an error
int start(std::vector<std::string>& command, int output, pid_t& child) {
  // Arguments and environment as the call of the system takes them.
  std::vector<std::string> inherited = environment();
  std::vector<char*> argv = pointers_to(command), envp = pointers_to(inherited);
  posix_spawn_file_actions_t actions;
  // It reads nothing, and both of its outputs go into the pipe.
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
  // Signals that this program ignores would be ignored by the child too.
  sigset_t by_default;
  sigemptyset(&by_default);
  sigaddset(&by_default, SIGPIPE);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigdefault(&attributes, &by_default);
  // Group zero is one of its own, named by the child's number.
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  const int error = posix_spawnp(&child, argv[0], &actions, &attributes, argv.data(), envp.data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace

void keep_environment() {
  environment().clear();
  for (char** entry = environ; *entry != nullptr; ++entry) environment().emplace_back(*entry);
}

const std::vector<std::string>& kept_environment() {
  return environment();
}

void keep_arguments(int argc, char** argv) {
  arguments().assign(argv + 1, argv + argc);
}

const std::vector<std::string>& kept_arguments() {
  return arguments();
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> list;
  for (std::string& text : texts) list.push_back(text.data());
  list.push_back(nullptr);
  return list;
}

ChildOutcome run_and_listen(std::vector<std::string> command, double seconds) {
  ChildOutcome outcome;
  // The reading end stays here; both are closed for every other child.
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    outcome.failure = std::strerror(errno);
    return outcome;
  }
  pid_t child = 0;
  const int error = start(command, ends[1], child);
  // Without this the end of the output would never come.
  ::close(ends[1]);
  if (error != 0) {
    outcome.failure = std::strerror(error);
    // Reads until the child closes its end. If the time is over before, its whole group of processes is
    // ended; the child is waited for in both cases.
  } else {
    if (!take_all(ends[0], seconds, outcome.said)) {
      outcome.failure = fmt::format("it took longer than {:.0f} s", seconds);
      ::kill(-child, SIGKILL);
    }
    // A child that was killed by a signal is told by the name of that.
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status) && outcome.failure.empty()) outcome.failure = strsignal(WTERMSIG(status));
  }
  ::close(ends[0]);
  return outcome;
}

}  // namespace solidus::app
