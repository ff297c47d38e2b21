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
  for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) sigaction(signal, &action, nullptr);
}

bool stop_asked() {
  return asked != 0;
}

}  // namespace solidus::app
