/// The verb `new`: from a geometry to a case.
#include <fmt/format.h>

#include "app/verbs.hpp"
#include "new_case/new_case.hpp"

namespace solidus::app {

ExitCode new_case(const NewArguments& arguments) {
  model::NewCaseOptions options;
  options.geometry = arguments.geometry;
  options.process = arguments.process;
  options.alloy = arguments.alloy;
  options.unit = arguments.unit;
  options.symmetry = arguments.symmetry;
  options.as = arguments.as;
  options.folder = arguments.folder;
  options.fineness = arguments.fineness;
  options.shots = arguments.shots;
  if (!arguments.riser.empty() && arguments.riser != "auto")
    throw InputError({"--riser"}, fmt::format("'{}' is no riser", arguments.riser), "--riser auto");
  options.riser = arguments.riser == "auto";
  if (!(options.fineness >= 0.3 && options.fineness <= 5))
    throw InputError({"--fineness"}, fmt::format("{:g} is out of range", options.fineness), "0.3 to 5");
  const model::NewCaseReport report = model::make_new_case(options);
  print(fmt::format("{}\nWritten to {}. Next: solidus check {}; solidus run --heat-only {}\n", report.text,
                    report.file.string(), report.file.parent_path().string(),
                    report.file.parent_path().string()));
  return k_done;
}

}  // namespace solidus::app
