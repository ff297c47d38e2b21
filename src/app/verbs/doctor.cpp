/// Tells what a machine lacks: each thing that runs need is tried, as a run would use it.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

#include "app/case_arguments.hpp"
#include "app/child_process.hpp"
#include "app/process_choice.hpp"
#include "app/python_tools.hpp"
#include "app/verb.hpp"
#include "cases/case_materials.hpp"
#include "material/cards/library.hpp"
#include "mesh/raw_mesh.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"
#include "system/program_path.hpp"
#include "system/temporary_folder.hpp"
#include "system/terminal.hpp"
#include "system/version.hpp"

namespace solidus::app {

namespace {

namespace fs = std::filesystem;

/// A thing that was tried, with its outcome.
struct Finding {
  enum class Kind { works, optional_missing, missing };
  std::string subject;
  Kind kind = Kind::works;
  std::string text;  ///< of what is missing: what it is for and what to do
};

using Kind = Finding::Kind;

Finding look_at_machine() {
  const double memory =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  return {"machine", Kind::works, fmt::format("{} cores, {:.1f} GB of memory", usable_cores(), memory / 1e9)};
}

Finding look_for_materials() {
  const std::size_t n = material::material_names(cases::material_folders()).size();
  if (n > 0) return {"materials", Kind::works, fmt::format("{} cards", n)};
  return {"materials", Kind::missing,
          fmt::format("there is no library near '{}'; SOLIDUS_MATERIALS=FOLDER names one elsewhere",
                      program_path().string())};
}

/// A folder for temporary files that is removed again.
class TemporaryFolder {
 public:
  /// Makes it in an existing folder. Throws std::filesystem::filesystem_error where that cannot be done.
  explicit TemporaryFolder(const fs::path& in) : path_((in / "solidus_doctor_XXXXXX").string()) {
    if (mkdtemp(path_.data()) == nullptr)
      throw fs::filesystem_error("a temporary folder", path_,
                                 std::error_code(errno, std::generic_category()));
  }
  ~TemporaryFolder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  fs::path path() const { return path_; }

 private:
  std::string path_;
};

constexpr std::string_view k_no_gmsh = "not in this build";

/// Reads a square: one that Gmsh meshes where it is there, else two triangles. Without a folder for the file
/// that it would read, nothing is known about the reader, which runs need no such folder for.
Finding try_reader() {
  const bool gmsh = SOLIDUS_GMSH_VERSION != k_no_gmsh;
  const std::string temporary = writable_temporary_folder();
  if (temporary.empty())
    return {"meshes", Kind::optional_missing,
            fmt::format("not tried: no folder for temporary files can be written, neither '{}' nor another; "
                        "TMPDIR=FOLDER names one",
                        temporary_folder())};
  try {
    // The smallest mesh that either reader takes, in a folder that is deleted again.
    const TemporaryFolder folder(temporary);
    const std::string file = (folder.path() / (gmsh ? "square.geo" : "square.inp")).string();
    std::ofstream(file) << (gmsh ? "Point(1) = {0, 0, 0};\nl[] = Extrude {1, 0, 0} { Point{1}; };\n"
                                   "s[] = Extrude {0, 1, 0} { Curve{l[1]}; };\nMesh.MeshSizeMax = 0.5;\n"
                                 : "*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n4, 0, 1\n"
                                   "*ELEMENT, TYPE=CPE3, ELSET=square\n1, 1, 2, 3\n2, 1, 3, 4\n");
    mesh::read_mesh(mesh::MeshSource{file});
    return {"meshes", Kind::works,
            gmsh ? "read, and geometries meshed by Gmsh " SOLIDUS_GMSH_VERSION
                 : "read; geometries are refused, this build is without Gmsh"};
  } catch (const InputError& error) {
    return {"meshes", Kind::missing, error.what()};
  } catch (const fs::filesystem_error& error) {
    return {"meshes", Kind::missing,
            fmt::format("a file was to be read from '{}': {}; TMPDIR=FOLDER names another folder",
                        error.path1().string(), error.code().message())};
  }
}

Finding look_at_present_folder() {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  if (error)
    return {"results", Kind::optional_missing,
            fmt::format("the present folder: {}: change to another one", error.message())};
  if (access(here.c_str(), W_OK | X_OK) == 0)
    return {"results", Kind::works, fmt::format("'{}' takes them", here.string())};
  return {
      "results", Kind::optional_missing,
      fmt::format("'{}' may not be written to: run with -o FOLDER, or from another folder", here.string())};
}

/// Why a program did not do what was asked, in one line.
std::string reason(const ChildOutcome& outcome) {
  if (!outcome.failure.empty()) return outcome.failure;
  constexpr std::size_t k_characters_of_a_reason = 40;  // characters; what follows the first lines is advice
  std::string text;
  std::istringstream said(outcome.said);
  for (std::string part; std::getline(said, part) && text.size() < k_characters_of_a_reason;) {
    if (part.empty() || part.starts_with("----")) continue;
    if (!text.empty()) text += ' ';
    text += part.substr(part.find_first_not_of(' '));
  }
  return fmt::format("exit code {}: {}", outcome.code, text);
}

/// The advice where mpirun does not start processes, or is not there.
std::string advice(const fs::path& launcher, bool there) {
  std::string text;
  if (geteuid() == 0 && std::getenv("OMPI_ALLOW_RUN_AS_ROOT") == nullptr)
    text = "root has to allow it: OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1";
  if (there && access(temporary_folder().c_str(), W_OK | X_OK) != 0)
    text +=
        fmt::format("{}'{}' cannot be written: TMPDIR=FOLDER names another folder for its temporary files",
                    text.empty() ? "" : "; ", temporary_folder());
  if (!text.empty()) return text;
  return launcher.has_parent_path() ? "TMPDIR=FOLDER names another folder for its temporary files"
                                    : "it is in the package openmpi-bin of Debian";
}

/// Two processes of one run print its versions once; two that do not find each other print them twice.
/// The mpirun next to the program, which an archive brings, is taken before that of PATH.
Finding try_two_processes() {
  const fs::path beside = program_path().parent_path() / "mpirun";
  const fs::path launcher = fs::exists(beside) ? beside : "mpirun";
  constexpr double k_patience = 60;  // [s]
  const ChildOutcome outcome = run_and_listen({launcher.string(), "-n", "2", "--oversubscribe", "--bind-to",
                                               "none", program_path().string(), "version"},
                                              k_patience);
  const std::string beginning = "Solidus " + program_version();
  const std::size_t first = outcome.said.find(beginning);
  const bool works = outcome.code == 0 && first != std::string::npos;
  if (works && outcome.said.find(beginning, first + 1) == std::string::npos)
    return {"processes", Kind::works, fmt::format("'{}' -n 2 solidus run CASE", launcher.string())};
  return {"processes", Kind::optional_missing,
          works ? fmt::format("those that '{}' starts do not find each other: it is of another MPI than the "
                              "program; runs on one process work",
                              launcher.string())
                : fmt::format("'{}' does not start them ({}); runs on one process work; {}",
                              launcher.string(), reason(outcome), advice(launcher, outcome.failure.empty()))};
}

Finding try_python() {
  // The modules that the pictures need are imported, with the time that a cold disk may take.
  const std::string python = python_program();
  constexpr double k_patience = 60;  // [s]
  const ChildOutcome outcome =
      run_and_listen({python, "-c",
                      "import sys, numpy, matplotlib; "
                      "print(f'Python {sys.version.split()[0]}, numpy {numpy.__version__}, matplotlib "
                      "{matplotlib.__version__}', end='')"},
                     k_patience);
  // matplotlib tells before it what it warns of, as of a home that cannot be written.
  if (outcome.code == 0) return {"pictures", Kind::works, outcome.said.substr(outcome.said.rfind('\n') + 1)};
  return {"pictures", Kind::optional_missing,
          fmt::format("plot, compare, study, uncertain and calibrate need '{}' with numpy and matplotlib "
                      "({}); run, new and "
                      "report work without; Debian: python3-matplotlib; SOLIDUS_PYTHON=PROGRAM names another",
                      python, reason(outcome))};
}

std::string line(const Finding& finding, bool colours) {
  const std::string_view word = finding.kind == Kind::works              ? "works"
                                : finding.kind == Kind::optional_missing ? "lacks"
                                                                         : "fails";
  const Colour colour = finding.kind == Kind::works ? Colour::green : Colour::red;
  return fmt::format("{}  {:<10} {}\n", painted(word, colour, colours), finding.subject, finding.text);
}

/// Tries what runs need of the machine (reader of meshes, materials, room for results, several processes,
/// Python for pictures) and prints a line for each. k_bad_input where no run is possible.
ExitCode examine() {
  if (processes::count() > 1) throw InputError({}, "this verb runs on one process", "solidus without mpirun");
  const bool colours = has_colours(STDOUT_FILENO);
  print(fmt::format("Solidus {}, {}\n", program_version(), program_path().string()));
  bool ready = true;
  for (const auto& look : {look_at_machine, look_for_materials, try_reader, look_at_present_folder,
                           try_two_processes, try_python}) {
    const Finding finding = look();
    print(line(finding, colours));
    ready = ready && finding.kind != Kind::missing;
  }
  print(ready ? "Cases can be run here.\n" : "Cases cannot be run here: see what fails.\n");
  return ready ? k_done : k_bad_input;
}

class Doctor final : public Verb {
 public:
  explicit Doctor(CLI::App& program)
      : Verb(program, "doctor", "Say what this machine lacks for runs, several processes and pictures") {}
  ExitCode run() override { return examine(); }
};

}  // namespace

std::unique_ptr<Verb> doctor_verb(CLI::App& program) {
  return std::make_unique<Doctor>(program);
}

}  // namespace solidus::app
