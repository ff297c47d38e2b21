/// The verb `pattern`: the shape of a pattern whose casting has the shape of the drawing. The mesh and the
/// case are written here, Python runs and corrects them.
#include <filesystem>
#include <set>
#include <string>

#include "app/case_arguments.hpp"
#include "app/places.hpp"
#include "app/python_tools.hpp"
#include "app/verb.hpp"
#include "mesh/files/gmsh_mesh_writer.hpp"
#include "results/output/output_file.hpp"
#include "results/output/run_folder.hpp"
#include "setup/case_file.hpp"
#include "setup/mesh_input.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"

namespace solidus::app {

namespace {

namespace fs = std::filesystem;

/// Writes the mesh of the drawing with the groups of the case, and the resolved case.
void write_drawing(const setup::Case& c, const fs::path& folder) {
  const setup::MadeMesh made = setup::make_mesh(c.spec);
  // Surfaces that interfaces have found are found again in every run, and so is what faces no other body.
  std::set<std::string> found;
  for (const setup::FoundInterface& interface : made.interfaces) {
    found.insert(interface.surface_a);
    found.insert(interface.surface_b);
  }
  if (!c.spec.interfaces.empty())
    for (const cases::BodySpec& body : c.spec.bodies) found.insert(body.name + "_free");
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw results::OutputError(folder.string(), "cannot make this folder: " + error.message(),
                               "-o names another one");
  results::write_file(folder / "drawing.msh", mesh::gmsh_mesh_text(made.mesh, found));
  results::write_file(folder / "drawing.toml", c.toml());
}

class Pattern final : public Verb {
 public:
  explicit Pattern(CLI::App& program)
      : Verb(program, "pattern", "Find the pattern whose casting has the shape of the drawing") {
    add_case(command(), case_);
    command()
        .add_option("-o,--output", output_,
                    "Folder of all that is made; default results/CASE/VARIANT/pattern")
        ->type_name("FOLDER");
    command()
        .add_option("--tolerance", tolerance_,
                    "How near the casting comes to the drawing, such as '0.05 mm'; default a ten-thousandth "
                    "of the part's length")
        ->type_name("LENGTH");
    command()
        .add_option("--runs", runs_, "Runs at most; default 5")
        ->type_name("NUMBER")
        ->check(CLI::Range(1, 50));
    command()
        .add_option("--body", body_, "The body that is to have the shape; default the castings")
        ->type_name("NAME");
    command().add_flag("--restart", restart_, "Keep the runs that have ended");
    add_trust(command(), case_.trust_script);
  }
  ExitCode run() override {
    if (processes::count() > 1)
      throw InputError({}, "this verb starts its runs itself", "solidus without mpirun");
    const setup::Case c = load_case(case_);
    if (!c.spec.has_mechanics())
      throw InputError({case_.path, 0, 0}, "the case computes heat alone: nothing deforms",
                       "analysis.physics = \"thermomechanical\"");
    // The runs read the mesh from a file, which does not tell the plane from what is free.
    if (c.spec.mesh.symmetry && !c.spec.interfaces.empty())
      throw InputError({case_.path, 0, 0},
                       "the part is cut at a plane of symmetry, and its faces are found by [[interface]]",
                       "the whole part, or [[contact]] with groups of the mesh");
    const fs::path folder = output_.empty()
                                ? results_root() / results::default_run_folder(c.file, c.variant) / "pattern"
                                : fs::path(output_);
    write_drawing(c, folder);
    PythonArguments arguments = {folder.string()};
    arguments.add("--tolerance", tolerance_);
    arguments.add("--runs", runs_ > 0 ? std::to_string(runs_) : "");
    arguments.add("--body", body_);
    arguments.flag("--restart", restart_);
    return run_python("pattern", arguments.words());
  }

 private:
  CaseArguments case_;
  std::string output_, tolerance_, body_;
  int runs_ = 0;
  bool restart_ = false;
};

}  // namespace

std::unique_ptr<Verb> pattern_verb(CLI::App& program) {
  return std::make_unique<Pattern>(program);
}

}  // namespace solidus::app
