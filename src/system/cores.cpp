#include "system/cores.hpp"

#include <sched.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>

#include "numbers/index_casts.hpp"

namespace solidus {

namespace fs = std::filesystem;

namespace {

/// The first line of a small file; empty where there is none.
std::string line_of(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

/// What a group of version 2 may use: "200000 100000" are microseconds in a period, "max" is no limit.
std::optional<double> quota_2(const fs::path& group) {
  std::istringstream in(line_of(group / "cpu.max"));
  std::string quota;
  double period = 0;
  // A file that cannot be read gives an empty line, which is no limit either.
  if (!(in >> quota >> period) || quota == "max" || !(period > 0)) return std::nullopt;
  const double time = std::strtod(quota.c_str(), nullptr);
  // The share of time is a number of processors: 1.5 are one and a half.
  return time > 0 ? std::optional(time / period) : std::nullopt;
}

/// The same of version 1, where -1 is no limit.
std::optional<double> quota_1(const fs::path& group) {
  const double time = std::strtod(line_of(group / "cpu.cfs_quota_us").c_str(), nullptr);
  const double period = std::strtod(line_of(group / "cpu.cfs_period_us").c_str(), nullptr);
  return time > 0 && period > 0 ? std::optional(time / period) : std::nullopt;
}

/// The least quota of a group and of those around it, up to where the groups are mounted. A container often
/// sees the path of its group on the host, which is not there: what is mounted is its own group then.
template <class Quota>
std::optional<double> least_quota(const fs::path& mounted, fs::path group, Quota&& quota) {
  std::optional<double> least;
  // Groups are walked from the inside out, because each of them may be the tighter one.
  while (true) {
    if (const std::optional<double> here = quota(mounted / group))
      least = std::min(least.value_or(*here), *here);
    if (group.empty()) return least;
    group = group.parent_path();
  }
}

}  // namespace

std::vector<int> usable_processors() {
  // Machines may have more processors than the usual set has room for.
  for (std::size_t room = 1024; room <= (std::size_t{1} << 20); room *= 4) {
    cpu_set_t* const set = CPU_ALLOC(room);
    if (set == nullptr) break;
    std::vector<int> processors;
    // The call fails where the set is too small for the machine; the next room is four times as large.
    const bool told = sched_getaffinity(0, CPU_ALLOC_SIZE(room), set) == 0;
    for (std::size_t p = 0; told && p < room; ++p)
      if (CPU_ISSET_S(p, CPU_ALLOC_SIZE(room), set)) processors.push_back(static_cast<int>(p));
    CPU_FREE(set);
    if (told && !processors.empty()) return processors;
  }
  // Where the system tells nothing, one processor is what is certain to be there.
  return {0};
}

std::vector<Core> cores_of(std::span<const int> processors, const fs::path& sys) {
  // Siblings name each other, with the same text.
  std::map<std::string, std::size_t> known;
  std::vector<Core> cores;
  // Two processors of one core share its arithmetic units, so that a process on each gains little: cores are
  // what is counted.
  for (const int processor : processors) {
    const fs::path topology = sys / "devices/system/cpu" / ("cpu" + std::to_string(processor)) / "topology";
    std::string siblings = line_of(topology / "thread_siblings_list");
    // Without a topology, as in some virtual machines, each processor stands for a core.
    if (siblings.empty()) siblings = "alone " + std::to_string(processor);
    const auto [found, is_new] = known.emplace(siblings, cores.size());
    if (is_new) cores.emplace_back();
    cores[found->second].push_back(processor);
  }
  return cores;
}

std::optional<double> processor_quota(const fs::path& proc, const fs::path& sys) {
  std::optional<double> least;
  const auto take = [&](std::optional<double> quota) {
    if (quota) least = std::min(least.value_or(*quota), *quota);
  };
  // Lines are "0::/path" of version 2 and "4:cpu,cpuacct:/path" of version 1.
  std::ifstream groups(proc / "self/cgroup");
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    // A line of another form is left out: the file may gain lines with a later system.
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const fs::path group = fs::path(line.substr(second + 1)).relative_path();
    const fs::path mounted = sys / "fs/cgroup";
    // The group of version 2 has no controllers in its line; of version 1 only that of the processor has a
    // quota.
    if (controllers.empty()) {
      take(least_quota(mounted, group, quota_2));
      continue;
    }
    if (("," + controllers + ",").find(",cpu,") == std::string::npos) continue;
    // The folder has the name of all controllers together on some systems, and of this one alone on others.
    for (const std::string& name : {controllers, std::string("cpu")})
      take(least_quota(mounted / name, group, quota_1));
  }
  return least;
}

int cores_within(int n, std::optional<double> quota) {
  if (!quota) return std::max(n, 1);
  // A quota that is a hair below a whole number by rounding counts as that number, and less than one is one.
  return std::clamp(static_cast<int>(std::floor(*quota + 1e-6)), 1, std::max(n, 1));
}

CoreLoad::CoreLoad(std::vector<Core> cores, fs::path proc)
    : cores_(std::move(cores)), proc_(std::move(proc)), at_start_(read()) {}

std::vector<CoreLoad::Ticks> CoreLoad::read() const {
  std::vector<Ticks> all;
  std::ifstream stat(proc_ / "stat");
  for (std::string line; std::getline(stat, line) && line.starts_with("cpu");) {
    std::istringstream in(line.substr(3));
    std::size_t processor = 0;
    // The line of all processors together has a blank after the name, and is left out.
    if (line[3] == ' ' || !(in >> processor)) continue;
    // user, nice, system, idle, waiting for a disk, two kinds of interrupts, stolen by other machines
    std::array<double, 8> ticks{};
    for (double& count : ticks) in >> count;
    Ticks sum;
    for (const double count : ticks) sum.all += count;
    // Programs with a low priority give way, and waiting for a disk leaves a core free.
    sum.busy = sum.all - ticks[1] - ticks[3] - ticks[4];
    if (all.size() <= processor) all.resize(processor + 1);
    all[processor] = sum;
  }
  return all;
}

double CoreLoad::free_cores(double own_seconds) const {
  const std::vector<Ticks> now = read();
  const auto n = static_cast<double>(cores_.size());
  double busy = 0, longest = 0;
  for (const Core& core : cores_) {
    double of_core = 0;
    for (const int processor : core) {
      const auto p = as_size(processor);
      // A processor of which nothing is known, now or at the start, makes the look worthless: all cores count
      // as free then.
      if (p >= now.size() || p >= at_start_.size()) return n;
      const double time = now[p].all - at_start_[p].all;
      if (time > 0) of_core += std::clamp((now[p].busy - at_start_[p].busy) / time, 0.0, 1.0);
      longest = std::max(longest, time);
    }
    // Siblings that are both busy keep one core busy, no more.
    busy += std::min(of_core, 1.0);
  }
  // No tick has passed, and nothing can be said of the load.
  if (!(longest > 0)) return n;
  // The time that this program itself has used counts as free, because it will not use it along with the
  // processes that it starts.
  constexpr double k_ticks_a_second = 100;  // USER_HZ, whatever the kernel's own clock is
  return std::clamp(n - busy + own_seconds * k_ticks_a_second / longest, 0.0, n);
}

}  // namespace solidus
