/// The verb `new`: from a geometry to a case.
#include <fmt/format.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/case_arguments.hpp"
#include "app/verb.hpp"
#include "input/units.hpp"
#include "new_case/casting_processes.hpp"
#include "new_case/new_case.hpp"

namespace solidus::app {

namespace {

struct NewArguments {
  std::string geometry, alloy, folder, symmetry, riser, gating;
  std::string process = "sand", unit;
  std::vector<std::string> as;  ///< "NAME=role"
  double fineness = 1;
  int shots = 0;      ///< zero: not given
  std::string shell;  ///< thickness, with its unit
  int coats = 0;      ///< zero: not given
  bool fill = false, preview = false;
  std::string gate;  ///< "X,Y,Z" with a unit
};

/// The place of the gate [m]; nothing where none is given. Throws InputError.
std::optional<mesh::Point> gate_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  // Each coordinate may have a unit of its own; those without have that of the last one.
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  const std::size_t unit = parts.back().find_first_not_of("0123456789.+-eE ");
  mesh::Point gate{};
  try {
    if (parts.size() != gate.size() || unit == std::string::npos)
      throw std::invalid_argument(fmt::format("'{}' is no place", text));
    for (std::size_t d = 0; d < gate.size(); ++d) {
      const bool bare = parts[d].find_first_not_of("0123456789.+-eE ") == std::string::npos;
      gate[d] = units::parse_quantity(bare ? parts[d] + " " + parts.back().substr(unit) : parts[d], "m");
    }
  } catch (const std::exception& error) {
    throw InputError({"--gate"}, error.what(), "three coordinates with their unit, \"0, 12, 30 mm\"");
  }
  return gate;
}

/// Thickness of the shell [m]; zero where none is asked for. Throws InputError.
double shell_of(const NewArguments& arguments) {
  if (arguments.shell.empty()) return arguments.coats * new_case::k_coat_of_shell;
  if (arguments.coats > 0)
    throw InputError({"--coats"}, "--shell says how thick the shell is already", "one of the two");
  double thickness = 0;
  try {
    thickness = units::parse_quantity(arguments.shell, "m");
  } catch (const std::exception& error) {
    throw InputError({"--shell"}, error.what(), "a length with its unit, \"8 mm\"");
  }
  if (!(thickness > 0 && thickness <= 0.1))
    throw InputError({"--shell"}, fmt::format("a shell of {:g} mm", 1e3 * thickness),
                     "up to 100 mm; 6 to 10 are usual");
  return thickness;
}

ExitCode new_case(const NewArguments& arguments) {
  // The words of the command line, one by one.
  new_case::NewCaseOptions options;
  options.geometry = arguments.geometry;
  options.process = arguments.process;
  options.alloy = arguments.alloy;
  options.unit = arguments.unit;
  options.symmetry = arguments.symmetry;
  options.as = arguments.as;
  options.folder = arguments.folder;
  options.fineness = arguments.fineness;
  options.shots = arguments.shots;
  options.shell = shell_of(arguments);
  options.gate = gate_of(arguments.gate);
  options.fill = arguments.fill || options.gate;
  options.preview = arguments.preview;
  // Options that only some values make sense of are checked before the geometry is read.
  options.riser = arguments.riser == "auto";
  if (!arguments.riser.empty() && !options.riser) options.feeders = arguments.riser;
  if (std::error_code error; !options.feeders.empty() && !std::filesystem::exists(options.feeders, error))
    throw InputError({"--riser"}, fmt::format("'{}' is no riser, and no file", arguments.riser),
                     "--riser auto, or a file of [[riser]] and [[chill]]");
  options.gating = arguments.gating;
  if (!(options.fineness >= 0.3 && options.fineness <= 5))
    throw InputError({"--fineness"}, fmt::format("{:g} is out of range", options.fineness), "0.3 to 5");
  // All else is chosen by the rules of the process.
  const new_case::NewCaseReport report = new_case::make_new_case(options);
  if (options.preview) {
    print(report.text);
    return k_done;
  }
  print(fmt::format("{}\nWritten to {}. Next: solidus check {}; solidus run --heat-only {}\n", report.text,
                    report.file.string(), report.file.parent_path().string(),
                    report.file.parent_path().string()));
  return k_done;
}

class New final : public Verb {
 public:
  explicit New(CLI::App& program)
      : Verb(program, "new", "Make a case that runs from the geometry of a casting") {
    NewArguments& a = arguments_;
    // The options name first the part, its alloy and process, then all that is added to it, then how the case
    // is made.
    command().add_option("PART", a.geometry, "A STEP, BREP, IGES or STL file, or a mesh")->required();
    command().add_option("--alloy", a.alloy,
                         "What is cast, always needed: an alloy of `solidus materials`, or a file");
    command().add_option("--process", a.process, "sand, shell, gravity_die or high_pressure; default sand");
    command()
        .add_option("--shots", a.shots,
                    "Castings in a row into one die, which stays warm; for gravity_die and high_pressure")
        ->check(CLI::Range(1, 10000))
        ->type_name("N");
    command().add_option("--shell", a.shell, "With --process shell: its thickness, default \"8 mm\"");
    command()
        .add_option("--coats", a.coats, "With --process shell: its thickness as dipped coats of 1.1 mm each")
        ->check(CLI::Range(1, 40))
        ->type_name("N");
    // Risers, gates and parts of the drawing.
    command().add_option("--riser", a.riser,
                         "auto: put risers on the thick places; or a file of [[riser]] and [[chill]]");
    command().add_option("--gating", a.gating, "A file of [[gating]]: sprue, runner and ingate");
    command().add_option("--symmetry", a.symmetry, "x, y or z: keep half of the part, below its middle");
    command()
        .add_option("--as", a.as, "What a body of the file is, NAME=ROLE, for example --as Box_2=chill")
        ->allow_extra_args(false);
    command().add_option("--unit", a.unit,
                         "Unit of length of the file; default what STEP and IGES files say, else mm");
    command().add_option("--fineness", a.fineness,
                         "So many times as many elements along each edge; default 1");
    command().add_flag("--fill", a.fill,
                       "Runs of the case fill the mould first, by OpenFOAM, through a gate that is chosen");
    command()
        .add_option("--gate", a.gate, "As --fill, with the gate at this place of the skin: \"0, 12, 30 mm\"")
        ->type_name("X,Y,Z");
    command().add_flag(
        "--preview", a.preview,
        "Print what would be made (mould, sizes of elements, risers) as JSON, and write nothing");
    command().add_option("-o,--output", a.folder, "Folder for the case; default the file's name, here");
  }
  ExitCode run() override { return new_case(arguments_); }

 private:
  NewArguments arguments_;
};

}  // namespace

std::unique_ptr<Verb> new_case_verb(CLI::App& program) {
  return std::make_unique<New>(program);
}

}  // namespace solidus::app
