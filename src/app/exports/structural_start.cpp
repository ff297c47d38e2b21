#include "app/exports/structural_start.hpp"

#include <fmt/format.h>

#include "run/structural_export.hpp"

namespace solidus::app {

std::string write_structural_start(const ExportRequest& request,
                                   std::string (*deck)(const results::StructuralDeck&)) {
  const run::ExportOptions options{.folder = request.folder,
                                   .file = request.file,
                                   .deck = deck,
                                   .deformed = request.deformed,
                                   .temperature_history = request.temperature_history};
  // The run's own copy of its case is read, so that a case that was changed since does no harm.
  setup::Case c = setup::load_case(request.folder);
  c.spec.mesh.trust_script = request.trust_script;
  const run::ExportReport report = run::export_state(c, options);
  // Histories are told by their times; a state by how far it was from equilibrium at its final
  // temperature.
  if (options.temperature_history)
    return fmt::format("{}: {} elements, temperatures at {} times to t = {:g} s\n", options.file.string(),
                       report.elements, report.times, report.time);
  std::string text = fmt::format(
      "{}: {} elements at t = {:g} s; equilibrium at the final temperature moved nodes by up to {:.3g} m\n",
      options.file.string(), report.elements, report.time, report.adjusted);
  // Directions that only contact held are fixed in the file, where there is no contact.
  if (report.supports > 0)
    text += fmt::format(
        "  only contact held a part: {} further degrees of freedom hold its rigid motions in the file\n",
        report.supports);
  return text;
}

}  // namespace solidus::app
