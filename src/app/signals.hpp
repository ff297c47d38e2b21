/// Signals that end a run at the end of its step.
#pragma once

namespace solidus::app {

/// Ctrl-C, `kill` and what a batch system sends before the time is up (SIGINT, SIGTERM, SIGUSR1) end the run
/// at the end of its step; the second time they end it at once. From the first line of the program on:
/// starting MPI and reading a mesh take their time too.
void listen_to_signals();
/// Whether one has come.
bool stop_asked();

}  // namespace solidus::app
