/// Cores of the machine: those that this process may use, and what others use of them.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace solidus {

/// A physical core, by the numbers of its processors that may be used: with simultaneous multithreading a
/// core is several processors of Linux, which share its arithmetic.
using Core = std::vector<int>;

/// The processors of Linux on which this process may run (sched_getaffinity(2)), in rising order.
std::vector<int> usable_processors();

/// Sorts processors into cores, by /sys/devices/system/cpu/cpuN/topology; one of which nothing is known there
/// counts as a core.
/// @param sys  where /sys is
std::vector<Core> cores_of(std::span<const int> processors, const std::filesystem::path& sys = "/sys");

/// The share of processors that control groups leave to this process, of versions 1 and 2, those around its
/// own included: 1.5 are one and a half. Absent: no limit.
/// @param proc, sys  where /proc and /sys are
std::optional<double> processor_quota(const std::filesystem::path& proc = "/proc",
                                      const std::filesystem::path& sys = "/sys");

/// The number of whole cores that a quota leaves of `n`; at least one.
int cores_within(int n, std::optional<double> quota);

/// Watches how much of some cores others use, from its making on.
class CoreLoad {
 public:
  /// @param proc  where /proc is
  explicit CoreLoad(std::vector<Core> cores, std::filesystem::path proc = "/proc");

  /// The cores that no other program uses, on average since the making: all of them where /proc/stat tells
  /// nothing. What runs at a lower priority (nice) does not count, since it gives way by itself.
  /// @param own_seconds  processor time that this process and its children have taken since then
  double free_cores(double own_seconds) const;
  int n_cores() const { return static_cast<int>(cores_.size()); }

 private:
  struct Ticks {
    double all = 0, busy = 0;
  };
  std::vector<Ticks> read() const;  ///< [processor]; empty: nothing is told

  std::vector<Core> cores_;
  std::filesystem::path proc_;
  std::vector<Ticks> at_start_;
};

}  // namespace solidus
