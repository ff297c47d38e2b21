/// The case is run again with longer steps and with larger elements; differences of answers become errors
/// by the ratio of the sizes.
#include "run/error_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/nearby_case.hpp"
#include "mesh/files/file_format.hpp"
#include "results/answers/answer_comparison.hpp"
#include "results/output/output_error.hpp"
#include "results/progress.hpp"
#include "system/log.hpp"
#include "system/processes.hpp"

namespace solidus::run {

namespace {

/// Further runs that differ from the run by less than this tell nothing: such differences are chance.
constexpr double k_least_ratio = 1.2;

/// A further run would repeat the messages of the run.
class Quiet {
 public:
  Quiet() : level_(logging::level()) { logging::set_level(logging::Level::silent); }
  ~Quiet() { logging::set_level(level_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  logging::Level level_;
};

/// A comparison that is to be made.
struct Wanted {
  results::ErrorPart part;
  const char* name;    ///< for people
  const char* folder;  ///< below sure/
  cases::NearbyCase how;
};

/// The number of elements of all that is cast, which the answers are of: a mould often has more of them,
/// which sizes change less. Of all bodies where nothing is cast.
double elements_of_castings(const results::Summary& summary) {
  double sum = 0;
  const std::vector<results::CastAnswer>& castings = summary.answers->castings;
  for (const auto& body : summary.mesh.elements_of_body)
    if (castings.empty() || std::ranges::any_of(castings, [&](const results::CastAnswer& cast) {
          return cast.cast.name == body.first;
        }))
      sum += static_cast<double>(body.second);
  return sum;
}

/// How much finer a run was than a further one.
double ratio(results::ErrorPart part, AnalysisKind kind, const results::Summary& run,
             const results::Summary& beside) {
  if (part == results::ErrorPart::step)
    return static_cast<double>(run.steps) / static_cast<double>(beside.steps);
  const double elements = elements_of_castings(run) / elements_of_castings(beside);
  return std::pow(elements, 1.0 / (kind == AnalysisKind::solid ? 3.0 : 2.0));
}

/// Whether the mesh is made from a geometry.
bool is_drawn(const cases::MeshSpec& m) {
  return m.file && mesh::is_geometry(mesh::file_format(*m.file).holds);
}

/// The summary of a further run, or why there is none.
struct Beside {
  std::optional<results::Summary> summary;
  std::string why_not;
};

Beside run_one(const Wanted& wanted, const RunOptions& options, const LoadBeside& load) {
  // The other run writes into a folder of its own, says nothing and starts from the beginning.
  RunOptions beside = options;
  beside.folder = options.folder / "sure" / wanted.folder;
  beside.progress = nullptr;
  beside.terminal = beside.restart = beside.profile = false;
  const Quiet quiet;
  // An input that cannot be made coarser is no error of the case: the reason goes to the message.
  try {
    Session session(load(wanted.how.overrides), beside);
    const RunResult result = session.run();
    if (!result.finished) return {{}, result.reason};
    return {*session.summary(), {}};
  } catch (const InputError& error) {
    return {{}, error.what()};
  }
}

}  // namespace

ErrorRuns run_beside(const setup::Case& c, results::Summary summary, double displacement_error,
                     const RunOptions& options, const LoadBeside& load,
                     const std::function<void(const std::string&)>& say) {
  ErrorRuns made{std::move(summary), true};
  // Two further runs, with longer steps and with larger elements, tell by how much its answers
  // are off. A comparison that cannot be made leaves the estimate, and says why.
  const Wanted wanted[] = {{results::ErrorPart::step, "longer steps", "longer_steps",
                            cases::longer_steps(c.spec, displacement_error)},
                           {results::ErrorPart::mesh, "larger elements", "larger_elements",
                            cases::coarser_mesh(c.spec, is_drawn(c.spec.mesh))}};
  for (const Wanted& comparison : wanted) {
    const auto leave = [&](const std::string& why) {
      made.complete = false;
      say(fmt::format("no comparison with {}: {}; the estimate is kept", comparison.name, why));
    };
    // A comparison that would mean nothing is not run.
    if (!comparison.how.why_not.empty()) {
      leave(comparison.how.why_not);
      continue;
    }
    // The user may stop between the runs.
    if (options.stop_asked && options.stop_asked()) {
      leave("stopped as asked");
      continue;
    }
    const double start = processes::wall_time();
    const Beside beside = run_one(comparison, options, load);
    if (!beside.summary || !beside.summary->answers) {
      leave(beside.why_not);
      continue;
    }
    // The ratio says how much coarser the other run really was; the steps or elements that came out may
    // differ from those asked for.
    const double finer = ratio(comparison.part, c.spec.analysis.kind, made.summary, *beside.summary);
    if (!(finer > k_least_ratio)) {
      leave(fmt::format("it differs by a factor of {:.3g} only", finer));
      continue;
    }
    // The answers' errors follow from the difference and the ratio.
    compare_errors(comparison.part, finer, *beside.summary->answers, beside.summary->criteria,
                   *made.summary.answers, made.summary.criteria);
    say(fmt::format("compared with {}, a factor of {:.3g}, in {}", comparison.name, finer,
                    results::duration_text(processes::wall_time() - start)));
  }
  results::on_first_process([&] { results::write_summary(options.folder / "summary.json", made.summary); });
  return made;
}

}  // namespace solidus::run
