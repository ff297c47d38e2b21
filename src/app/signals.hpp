/// Signals that end a run at the end of its step.
#pragma once

namespace solidus::app {

/// Ctrl-C, `kill`, a terminal that closes and what a batch system sends before the time is up (SIGINT,
/// SIGTERM, SIGHUP, SIGQUIT, SIGUSR1) end the run at the end of its step; the second time they end it at
/// once. So does an output that closes (SIGPIPE). Signals that the program was started to ignore stay
/// ignored. From the first line of the program on: starting MPI and reading a mesh take their time too.
void listen_to_signals();
/// Whether one has come.
bool stop_asked();
/// Whether it was Ctrl-C, on this process.
bool interrupted();

}  // namespace solidus::app
