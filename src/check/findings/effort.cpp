// Findings on the effort of a run: memory, time, files.
#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

#include "check/finding_family.hpp"

namespace solidus::check {

namespace {

constexpr double k_day = 86400, k_most_days = 30;  // [s], [days]
constexpr double k_most_outputs = 5000;

/// The memory of the machine [bytes]; zero where the system does not tell.
double machine_memory() {
  const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGE_SIZE);
  return pages > 0 && size > 0 ? static_cast<double>(pages) * static_cast<double>(size) : 0.0;
}

void find(const cases::CaseSpec& spec, const setup::Assembly&, const CaseMeasures& m, Findings& findings) {
  const Effort& effort = m.effort;
  const double memory = machine_memory();
  // Memory against that of this machine, time against a month, outputs against what a disk and a reader can
  // take.
  if (memory > 0 && effort.bytes > memory)
    findings.push_back({false, spec.mesh.where,
                        fmt::format("the run may take {:.3g} GB of memory; this machine has {:.3g} GB",
                                    1e-9 * effort.bytes, 1e-9 * memory),
                        "larger elements, or processes on several machines"});
  if (effort.seconds > k_most_days * k_day)
    findings.push_back({false, spec.time.where,
                        fmt::format("the run may take {:.0f} days, for {}{:.3g} steps",
                                    effort.seconds / k_day, effort.steps_known ? "" : "some ", effort.steps),
                        "longer steps, time.adaptive, larger elements, or more processes"});
  if (spec.output.every && spec.time.end && *spec.time.end / *spec.output.every > k_most_outputs)
    findings.push_back({false, spec.time.where,
                        fmt::format("output.every asks for {:.0f} outputs of all fields",
                                    *spec.time.end / *spec.output.every),
                        "some tens; probes and history.csv have every step"});
}

}  // namespace

// The place of the family among the others, its search, and the rows of the reference page, whose numbers are
// the thresholds that the search compares with.
FindingFamily findings_effort() {
  return {.name = "effort",
          .place = 320,
          .find = &find,
          .rows = {{Topic::effort, "memory, time, files",
                    fmt::format("more than the machine has; more than {} days; more than {} outputs",
                                number(k_most_days), number(k_most_outputs))}}};
}

}  // namespace solidus::check
