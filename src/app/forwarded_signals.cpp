#include "app/forwarded_signals.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>

namespace solidus::app {

namespace {

constexpr std::size_t k_most = 1024;  // processes
constexpr std::array k_forwarded = {SIGINT, SIGTERM, SIGUSR1, SIGHUP, SIGQUIT, SIGTSTP};

// A handler of signals may read these alone.
std::array<std::atomic<pid_t>, k_most> receivers;
std::atomic<std::size_t> n_receivers = 0;
std::atomic<int> last_signal = 0, n_signals = 0;

std::array<struct sigaction, k_forwarded.size()> before;

void send_all(int signal) {
  // Only calls and variables that a handler may use appear here; neither memory nor the log is touched.
  for (std::size_t i = 0; i < n_receivers; ++i) ::kill(receivers[i], signal);
}

extern "C" void forward_signal(int signal) {
  // The program that is interrupted may be about to read its error number.
  const int kept = errno;
  if (signal == SIGTSTP) {
    // The others stop first; this program goes on here when it is continued.
    send_all(SIGSTOP);
    ::kill(::getpid(), SIGSTOP);
    send_all(SIGCONT);
  } else {
    last_signal = signal;
    ++n_signals;
    send_all(signal);
  }
  errno = kept;
}

}  // namespace

ForwardedSignals::ForwardedSignals() {
  // The counts begin again with each object, or a signal of an earlier run would be sent to a later one.
  n_receivers = 0;
  last_signal = n_signals = 0;
  struct sigaction action {};
  action.sa_handler = forward_signal;
  action.sa_flags = SA_RESTART;
  for (std::size_t i = 0; i < k_forwarded.size(); ++i) {
    // A signal that the caller ignores, as nohup does, stays ignored here and below.
    sigaction(k_forwarded[i], nullptr, &before[i]);
    if (before[i].sa_handler != SIG_IGN) sigaction(k_forwarded[i], &action, nullptr);
  }
}

ForwardedSignals::~ForwardedSignals() {
  for (std::size_t i = 0; i < k_forwarded.size(); ++i) sigaction(k_forwarded[i], &before[i], nullptr);
}

void ForwardedSignals::send_to(std::span<const pid_t> processes) {
  // The receivers are written first and their number last, so that a handler that comes in between sees
  // complete entries alone.
  const std::size_t n = std::min(processes.size(), k_most);
  for (std::size_t i = 0; i < n; ++i) receivers[i] = processes[i];
  n_receivers = n;
  // A signal that came while the processes were starting reaches them now.
  if (last_signal != 0) send_all(last_signal);
}

int ForwardedSignals::last() const {
  return last_signal;
}
int ForwardedSignals::count() const {
  return n_signals;
}

}  // namespace solidus::app
