/// The verb `export`: the end of a run as the start of a structural analysis, or its fields in one file.
#include "run/structural_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "app/case_arguments.hpp"
#include "app/verb.hpp"
#include "results/formats/med.hpp"
#include "results/formats/vtkhdf.hpp"
#include "results/report/report_page.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"

namespace solidus::app {

namespace {

struct ExportArguments {
  std::string folder;                         ///< of a run
  std::string calculix, abaqus, vtkhdf, med;  ///< file to write, exactly one of them
  bool deformed = false;                      ///< coordinates with the displacement
  bool temperature_history = false;           ///< the temperatures of all times as a load
  bool trust_script = false;                  ///< as of CaseArguments
};

ExitCode export_fields(const ExportArguments& arguments) {
  // Options of the other formats mean nothing here; the folder must be one of a run with fields.
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

ExitCode export_state(const ExportArguments& arguments) {
  // One format at a time: fields over time (VTKHDF, MED), or the state at the end as the start of an
  // analysis.
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
  // The case is read from the run's folder, with the mesh that the run had.
  model::Case c = model::load_case(arguments.folder);
  c.spec.mesh.trust_script = arguments.trust_script;
  const model::ExportReport report = model::export_state(c, options);
  if (options.temperature_history) {
    print(fmt::format("{}: {} elements, temperatures at {} times to t = {:g} s\n", options.file.string(),
                      report.elements, report.times, report.time));
    return k_done;
  }
  // The report says how far nodes moved to be in balance, and what holds bodies that only contact held.
  print(fmt::format(
      "{}: {} elements at t = {:g} s; equilibrium at the final temperature moved nodes by up to {:.3g} m\n",
      options.file.string(), report.elements, report.time, report.adjusted));
  if (report.supports > 0)
    print(fmt::format(
        "  only contact held a part: {} further degrees of freedom hold its rigid motions in the file\n",
        report.supports));
  return k_done;
}

class Export final : public Verb {
 public:
  explicit Export(CLI::App& program)
      : Verb(program, "export",
             "Write what a run left for another program: its end as the "
             "start of a structural analysis, or its fields") {
    ExportArguments& a = arguments_;
    command().add_option("FOLDER", a.folder, "Folder of the run's results")->required();
    command()
        .add_option("--calculix", a.calculix, "File for CalculiX: stress at every point")
        ->type_name("FILE");
    command().add_option("--abaqus", a.abaqus, "File for Abaqus: stress of the elements")->type_name("FILE");
    command()
        .add_option("--vtkhdf", a.vtkhdf, "One file with the fields of all times, for ParaView 5.12 or newer")
        ->type_name("FILE");
    command()
        .add_option("--med", a.med, "One file with the fields of all times, for Salome and code_aster")
        ->type_name("FILE");
    command().add_flag("--deformed", a.deformed, "Deformed instead of nominal coordinates");
    command().add_flag("--temperature-history", a.temperature_history,
                       "With --calculix or --abaqus: the temperatures of all times as the load, no stress");
    add_trust(command(), a.trust_script);
    add_trust_laws(command());
  }
  ExitCode run() override { return export_state(arguments_); }

 private:
  ExportArguments arguments_;
};

}  // namespace

std::unique_ptr<Verb> export_verb(CLI::App& program) {
  return std::make_unique<Export>(program);
}

}  // namespace solidus::app
