/// A case is checked: everything that a run does before it computes.
#include "cases/case_materials.hpp"
#include "check/case_overview.hpp"
#include "check/findings.hpp"
#include "run/recording.hpp"
#include "run/session.hpp"
#include "setup/assembly.hpp"
#include "setup/mesh_input.hpp"

namespace solidus::run {

CheckedRun check_run(setup::Case c) {
  setup::Assembly a;
  a.materials = cases::load_materials(c.spec);
  // Everything that a run builds is built, so that its errors come now and not in the run.
  a.mesh = setup::load_mesh(c.spec);
  setup::build(c.spec, a);
  // Findings tell everything before the first error stops the check.
  const check::CaseMeasures measures = check::measure(c.spec, a);
  check::report(check::findings(c.spec, a, measures));
  setup::require_sound_mesh(c.spec);
  // Outputs and every stage are tried as well: a group that is missing in stage three is told now.
  results::check_output(a.mesh, a.phases, recorder_options(c, {}, a));
  for (std::size_t i = 0; i < a.stages.size(); ++i)
    if (a.stages[i].cycle <= 1) setup::apply(c.spec, i, {}, nullptr, a);
  CheckedRun checked{counts(c.spec, a.mesh),
                     check::overview(c.spec, a, measures),
                     {},
                     check::uncertain_parameters(c.spec, a, measures)};
  // Estimates of the coupling only where the audit of stability applies.
  if (a.phases.audits_stability())
    checked.couplings = check::coupling_estimates(c.spec, a.materials, a.mesh, a.start);
  return checked;
}

}  // namespace solidus::run
