#include "app/signals.hpp"

#include <csignal>
#include <initializer_list>

namespace solidus::app {

namespace {

volatile std::sig_atomic_t asked = 0;

extern "C" void ask_to_stop(int) {
  asked = 1;
}

}  // namespace

void listen_to_signals() {
  struct sigaction action {};
  action.sa_handler = ask_to_stop;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGHUP, SIGQUIT}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    // `nohup` and shells that start jobs in the background ignore some on purpose.
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  // Once more may come before the run has ended: each is a write to whoever has gone.
  action.sa_flags = SA_RESTART;
  sigaction(SIGPIPE, &action, nullptr);
  // A file beyond the limit of the shell (`ulimit -f`) is an error of its write, as on a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
}

bool stop_asked() {
  return asked != 0;
}

}  // namespace solidus::app
