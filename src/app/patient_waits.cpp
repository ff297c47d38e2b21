/// The program's `sched_yield`: a process that waits for another one sleeps between looks.
///
/// Open MPI's waits, those of PETSc and of MUMPS among them, look again and again whether a message has come.
/// Where another program takes one of the cores, or processes are more than cores, a wait so keeps the core
/// from the very process that it waits for, and every exchange lasts a slice of the scheduler's time. Open
/// MPI calls sched_yield() between looks if it is asked to (petsc::yield_in_waits()), which hands the core to
/// whoever else wants it for a whole slice. Here the wait looks on for as long as most messages take, and
/// sleeps then, longer the longer it has waited: who sleeps gives the core away and gets it back as it wakes.
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <ctime>

#include "app/patient_waits.hpp"

namespace solidus::app {

namespace {

using Nanoseconds = std::int64_t;

/// Looks that follow each other sooner than this are of one wait. MUMPS looks for messages at every front
/// that it works on, some microseconds apart, and does not wait then: with longer intervals small castings
/// slow down.
constexpr Nanoseconds k_one_wait = 1'000;
/// So long a wait looks without sleeping: messages between processes that are even take 1 to 20 µs.
constexpr Nanoseconds k_looks = 50'000;
/// It sleeps for this part of what it has waited already, so that it ends late by no more than that part.
constexpr Nanoseconds k_part = 4;
constexpr Nanoseconds k_longest_sleep = 500'000;

bool patient = false;

/// What Linux understands by the attributes of the scheduler, version 0 (sched_setattr(2)).
struct SchedulerAttributes {
  std::uint32_t size = sizeof(SchedulerAttributes), policy = SCHED_OTHER;
  std::uint64_t flags = 0;
  std::int32_t nice = 0;
  std::uint32_t priority = 0;
  std::uint64_t slice = 0, deadline = 0, period = 0;
};

Nanoseconds now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * 1'000'000'000 + time.tv_nsec;
}

/// A look that found nothing.
void look_in_vain() {
  // Each thread has waits of its own. Nothing tells that a wait ends, so that a pause between two looks is
  // taken for the end.
  static thread_local Nanoseconds begun = 0, last = 0;
  const Nanoseconds time = now();
  if (time - last > k_one_wait) begun = time;
  last = time;
  const Nanoseconds waited = time - begun;
  // Most messages arrive within this time, and a sleep would make them late.
  if (waited < k_looks) return;
  const timespec sleep{0, static_cast<long>(std::min(waited / k_part, k_longest_sleep))};
  nanosleep(&sleep, nullptr);
  // The sleep is part of the wait: without this its length would pass for a pause, and the next look would
  // begin a new wait.
  last = now();
}

/// Asks for short slices of the cores: a process that wakes then need not wait until another program's slice,
/// which is longer, has ended. Linux before 6.12 takes the request and heeds it not.
void ask_for_short_slices() {
#ifdef SYS_sched_setattr
  // Processes under another policy, such as that of a real-time job, have slices that are not ours to change.
  if (sched_getscheduler(0) != SCHED_OTHER) return;
  SchedulerAttributes wanted;
  if (syscall(SYS_sched_getattr, 0, &wanted, sizeof wanted, 0) != 0) return;  // keeps what `nice` has set
  constexpr std::uint64_t k_shortest_slice = 100'000;                         // [ns]
  wanted.slice = k_shortest_slice;
  syscall(SYS_sched_setattr, 0, &wanted, 0);
#endif
}

}  // namespace

void wait_patiently() {
  patient = true;
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);  // [ns]: sleeps end when they are to
  ask_for_short_slices();
}

}  // namespace solidus::app

extern "C" __attribute__((visibility("default"))) int sched_yield() noexcept {
  // Until the program asks for patience this is the call of the system, as for every other caller of it.
  if (!solidus::app::patient) return static_cast<int>(syscall(SYS_sched_yield));
  solidus::app::look_in_vain();
  return 0;
}
