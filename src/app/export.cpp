/// The verb `export`: the end of a run as the start of a structural analysis, or its fields in one file.
#include "run/structural_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "app/verbs.hpp"
#include "results/med.hpp"
#include "results/report/report_page.hpp"
#include "results/vtkhdf.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"

namespace solidus::app {

namespace {

ExitCode export_fields(const ExportArguments& arguments) {
  if (arguments.deformed || arguments.temperature_history)
    throw InputError({}, "--deformed and --temperature-history are for --calculix and --abaqus",
                     "displacements are among the fields: Warp By Vector in ParaView");
  if (processes::count() > 1) throw InputError({}, "the export works on one process", "without mpirun");
  const std::filesystem::path folder = arguments.folder;
  if (!std::filesystem::exists(folder / "fields.pvd"))
    throw InputError({arguments.folder}, "the folder has no fields.pvd", "the folder of a run's results");
  const std::string& file = arguments.vtkhdf.empty() ? arguments.med : arguments.vtkhdf;
  const auto say = [&](const auto& report) {
    print(fmt::format("{}: {} fields at {} times, {} points and {} cells\n", file, report.fields,
                      report.times, report.points, report.cells));
  };
  if (!arguments.vtkhdf.empty()) {
    say(results::write_vtkhdf(folder / "fields.pvd", file));
    return k_done;
  }
  std::vector<std::string> bodies;
  for (const report::BodyMaterial& body : report::body_materials(folder)) bodies.push_back(body.body);
  say(results::write_med(folder / "fields.pvd", bodies, file));
  return k_done;
}

}  // namespace

ExitCode export_state(const ExportArguments& arguments) {
  const auto formats = {&arguments.abaqus, &arguments.calculix, &arguments.vtkhdf, &arguments.med};
  if (std::count_if(formats.begin(), formats.end(), [](const auto* file) { return !file->empty(); }) != 1)
    throw InputError({}, "export needs one format and the file to write",
                     "--calculix FILE, --abaqus FILE, --vtkhdf FILE or --med FILE");
  if (!arguments.vtkhdf.empty() || !arguments.med.empty()) return export_fields(arguments);
  const bool abaqus = !arguments.abaqus.empty();
  model::ExportOptions options;
  options.folder = arguments.folder;
  options.file = abaqus ? arguments.abaqus : arguments.calculix;
  options.dialect = abaqus ? results::Dialect::abaqus : results::Dialect::calculix;
  options.deformed = arguments.deformed;
  options.temperature_history = arguments.temperature_history;
  model::Case c = model::load_case(arguments.folder);
  c.spec.mesh.trust_script = arguments.trust_script;
  const model::ExportReport report = model::export_state(c, options);
  if (options.temperature_history) {
    print(fmt::format("{}: {} elements, temperatures at {} times to t = {:g} s\n", options.file.string(),
                      report.elements, report.times, report.time));
    return k_done;
  }
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
