/// The verb `export`: the end of a run as the start of a structural analysis.
#include "model/export.hpp"

#include <fmt/format.h>

#include "app/verbs.hpp"

namespace solidus::app {

ExitCode export_state(const ExportArguments& arguments) {
  if (arguments.abaqus.empty() == arguments.calculix.empty())
    throw InputError({}, "export needs the format and the file to write", "--calculix FILE or --abaqus FILE");
  const bool abaqus = !arguments.abaqus.empty();
  model::ExportOptions options;
  options.folder = arguments.folder;
  options.file = abaqus ? arguments.abaqus : arguments.calculix;
  options.dialect = abaqus ? results::Dialect::abaqus : results::Dialect::calculix;
  options.deformed = arguments.deformed;
  model::Case c = model::load_case(arguments.folder);
  c.spec.mesh.trust_script = arguments.trust_script;
  const model::ExportReport report = model::export_state(c, options);
  print(fmt::format(
      "{}: {} elements at t = {:g} s; equilibrium at the final temperature moved nodes by up to {:.3g} m\n",
      options.file.string(), report.elements, report.time, report.adjusted));
  if (report.supports > 0)
    print(fmt::format(
        "  only contact held a part: {} further degrees of freedom hold its rigid motions in the file\n",
        report.supports));
  return k_done;
}

}  // namespace solidus::app
