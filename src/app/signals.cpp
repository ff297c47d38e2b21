/// Signals set a flag that the run looks at; a second one ends the program at once.
#include "app/signals.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <initializer_list>
#include <string_view>

namespace solidus::app {

namespace {

volatile std::sig_atomic_t asked = 0;
volatile std::sig_atomic_t by_keyboard = 0;  ///< with SIGINT
volatile std::sig_atomic_t speaks = 0;       ///< this is process 0

extern "C" void ask_to_stop(int signal) {
  asked = 1;
  if (signal == SIGINT) by_keyboard = 1;
  if (speaks == 0 || signal == SIGPIPE) return;
  static constexpr char k_text[] =
      "\ninfo: asked to stop: the run ends with a checkpoint as soon as its step or a factorisation in it "
      "allows; "
      "asked again, it ends at once, and the checkpoint before stays\n";
  if (::write(STDERR_FILENO, k_text, sizeof k_text - 1) < 0) return;  // the reader has gone
}

/// Whether this is the first process of its launcher, before MPI can tell.
bool is_first_process() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK", "SLURM_PROCID"})
    if (const char* rank = std::getenv(name)) return std::string_view(rank) == "0";
  return true;
}

}  // namespace

void listen_to_signals() {
  speaks = is_first_process() ? 1 : 0;
  struct sigaction action {};
  action.sa_handler = ask_to_stop;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGHUP, SIGQUIT}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    // `nohup` and shells that start jobs in the background ignore some on purpose.
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  // Further signals may come before the run has ended: each is a write to a reader that has gone.
  action.sa_flags = SA_RESTART;
  sigaction(SIGPIPE, &action, nullptr);
  // A file beyond the limit of the shell (`ulimit -f`) is an error of its write, as on a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
}

bool stop_asked() {
  return asked != 0;
}

bool interrupted() {
  return by_keyboard != 0;
}

}  // namespace solidus::app
