// Findings on the effort of a run: memory, time, files.
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

#include "check/findings.hpp"

namespace solidus::model {

namespace {

/// The memory of the machine [bytes]; zero where the system does not tell.
double machine_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGE_SIZE);
  return pages > 0 && size > 0 ? static_cast<double>(pages) * static_cast<double>(size) : 0.0;
}

}  // namespace

void find_in_effort(const CaseSpec& spec, const CaseMeasures& m, Findings& findings) {
  const Effort& effort = m.effort;
  const double memory = machine_memory();
  // Memory against that of this machine, time against a month, outputs against what a disk and a reader can
  // take.
  if (memory > 0 && effort.bytes > memory)
    findings.push_back({false, spec.mesh.where,
                        fmt::format("the run may take {:.3g} GB of memory; this machine has {:.3g} GB",
                                    1e-9 * effort.bytes, 1e-9 * memory),
                        "larger elements, or processes on several machines"});
  if (effort.seconds > 30 * 86400.0)
    findings.push_back({false, spec.time.where,
                        fmt::format("the run may take {:.0f} days, for {}{:.3g} steps",
                                    effort.seconds / 86400, effort.steps_known ? "" : "some ", effort.steps),
                        "longer steps, time.adaptive, larger elements, or more processes"});
  if (spec.output.every && spec.time.end && *spec.time.end / *spec.output.every > 5000)
    findings.push_back({false, spec.time.where,
                        fmt::format("output.every asks for {:.0f} outputs of all fields",
                                    *spec.time.end / *spec.output.every),
                        "some tens; probes and history.csv have every step"});
}

}  // namespace solidus::model
