/// The verb: read the arguments, measure, choose, refine, write, report.
#include "new_case/new_case.hpp"

#include <fmt/format.h>

#include "cases/case_materials.hpp"
#include "cases/roles.hpp"
#include "input/keys.hpp"
#include "material/cards/library.hpp"
#include "new_case/casting_processes.hpp"
#include "new_case/draft_choice.hpp"
#include "new_case/draft_refinement.hpp"
#include "new_case/feeder_solids.hpp"
#include "new_case/feeders_file.hpp"
#include "new_case/new_case_report.hpp"
#include "new_case/part_measures.hpp"
#include "new_case/preview.hpp"
#include "system/processes.hpp"

namespace solidus::new_case {

namespace {

/// The alloy of the options, which are checked as far as no geometry is needed for it. Throws InputError.
material::Material alloy_of(const NewCaseOptions& options, const CastingProcess& process) {
  // Options that need no geometry are checked first, in the order in which they are documented.
  if (processes::count() > 1) throw InputError({}, "`solidus new` works on one process", "no mpirun");
  if (std::error_code error; !std::filesystem::exists(options.geometry, error))
    throw InputError({options.geometry.string()}, "there is no such file",
                     "the geometry of a casting: STEP, IGES, BREP, STL or a mesh");
  if (options.alloy.empty())
    throw InputError({"--alloy"}, "what is cast?", "--alloy NAME, of those that `solidus materials` lists");
  material::Material alloy = material::find_material(options.alloy, cases::material_folders(), {"--alloy"});
  if (alloy.solidification() == nullptr)
    throw InputError({"--alloy"}, fmt::format("'{}' does not solidify", options.alloy),
                     "an alloy; `solidus materials` lists them");
  if (!options.symmetry.empty() && options.symmetry != "x" && options.symmetry != "y" &&
      options.symmetry != "z")
    throw InputError({"--symmetry"}, fmt::format("'{}' is no axis", options.symmetry), "x, y or z");
  if ((options.riser || !options.feeders.empty() || !options.gating.empty()) && options.symmetry == "z")
    throw InputError({"--symmetry"}, "with a riser or a sprue on top nothing is symmetric in z",
                     "x or y, or no --riser and no --gating");
  if (!options.feeders.empty()) read_feeders(options.feeders);
  if (!options.gating.empty()) read_gating(options.gating);
  if (options.shots > 0 && process.mould != cases::Role::die)
    throw InputError({"--shots"},
                     fmt::format("the mould of the process '{}' is lost with its casting", process.name),
                     "--process gravity_die or high_pressure, or no --shots");
  if (options.fill && options.process == "high_pressure")
    throw InputError({"--fill"}, "the speed of a shot is not known to the program",
                     "sand, shell or gravity_die; or a section [filling] with its time in the case");
  if (options.shell > 0 && process.shell <= 0)
    throw InputError({"--shell"}, fmt::format("the process '{}' has no shell", process.name),
                     "--process shell, or no --shell and --coats");
  return alloy;
}

}  // namespace

NewCaseReport make_new_case(const NewCaseOptions& options) {
  const CastingProcess& process = process_named(options.process);
  const material::Material alloy = alloy_of(options, process);
  const std::filesystem::path folder =
      options.folder.empty() ? std::filesystem::path(options.geometry.stem().string()) : options.folder;
  // A case that is there is never overwritten.
  if (!options.preview && std::filesystem::exists(folder / "case.toml"))
    throw InputError({(folder / "case.toml").string()}, "there is a case already",
                     "another folder: -o FOLDER");
  // What the part is, what is chosen for it, and what an estimate makes of that.
  const PartMeasures part = measure_part(options);
  Draft draft = choose_draft(options, process, alloy, part);
  if (options.preview) return {{}, preview_text(draft, part)};
  draft.folder = folder;
  if (options.fill) draft.filling = {options.gate};
  write_draft(draft);
  const DraftEstimate estimate =
      refine_draft(draft, process, alloy, options.fineness, part.time_of_direct_ways);
  write_feeder_solids(draft, draft.folder / "risers.step");
  return {draft.folder / "case.toml", report_text(draft, part, estimate, options)};
}

}  // namespace solidus::new_case
