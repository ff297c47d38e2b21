/// Signals that a program hands on to the processes that work for it.
#pragma once

#include <sys/types.h>

#include <span>

namespace solidus::app {

/// While it lives, the signals that end a run (app/signals.hpp) go on to some processes, and so do those that
/// stop and continue it at the terminal. Signals that this program was started to ignore stay ignored. One at
/// a time.
class ForwardedSignals {
 public:
  ForwardedSignals();
  ~ForwardedSignals();
  ForwardedSignals(const ForwardedSignals&) = delete;
  ForwardedSignals& operator=(const ForwardedSignals&) = delete;

  /// The processes are there; a signal that has come before goes to them now.
  void send_to(std::span<const pid_t> processes);
  /// The last signal that came and how often one has come.
  int last() const;
  int count() const;
};

}  // namespace solidus::app
