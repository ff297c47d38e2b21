/// Writes what the flow needs into a folder next to it, and hands over to Python.
#include "app/mould_filling.hpp"

#include <string>

#include "app/python_tools.hpp"
#include "run/filling_input.hpp"
#include "system/errors.hpp"
#include "system/processes.hpp"

namespace solidus::app {

ExitCode fill_mould(const setup::Case& c, const std::filesystem::path& folder,
                    const FillingOptions& options) {
  if (processes::count() > 1)
    throw InputError({}, "a mould is filled by processes that the program starts itself",
                     "`solidus fill` without mpirun first, and its folder as filling.result");
  run::write_filling_input(c, folder / "cavity");
  PythonArguments arguments = {folder.string()};
  if (options.processes) arguments.add("--processes", std::to_string(*options.processes));
  arguments.flag("--restart", options.restart);
  return run_python("fill", arguments.words());
}

}  // namespace solidus::app
