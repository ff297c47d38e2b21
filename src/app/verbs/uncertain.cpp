/// The verb `uncertain`: lists the uncertain parameters of a case with their spreads, as JSON; what follows
/// from them Python computes.
#include <array>

#include "app/case_arguments.hpp"
#include "app/places.hpp"
#include "app/python_tools.hpp"
#include "app/verb.hpp"
#include "results/output/json_document.hpp"
#include "run/session.hpp"

namespace solidus::app {

namespace {

using check::UncertainParameter;
using results::Json;

const char* text(UncertainParameter::Origin origin) {
  constexpr std::array<const char*, 3> k_texts = {"stated", "estimate", "usual"};
  return k_texts.at(static_cast<std::size_t>(origin));
}

const char* text(UncertainParameter::Group group) {
  constexpr std::array<const char*, 5> k_texts = {"casting", "mould", "interface", "start", "surroundings"};
  return k_texts.at(static_cast<std::size_t>(group));
}

Json json(const UncertainParameter& p) {
  Json::Array places;
  // The keys to be set for a change of this parameter, with their present values.
  for (const UncertainParameter::Place& place : p.places) {
    Json at;
    at.add("key", place.key).add("value", place.value);
    places.push_back(std::move(at));
  }
  Json json;
  json.add("label", p.label)
      .add("quantity", p.quantity)
      .add("of", p.of)
      .add("group", text(p.group))
      .add("mechanical", p.mechanical)
      .add("places", std::move(places));
  // A spread is one of three: a share, a factor or a shift.
  if (p.spread.relative) json.add("relative", *p.spread.relative);
  if (p.spread.factor) json.add("factor", *p.spread.factor);
  if (p.spread.shift) json.add("shift[K]", *p.spread.shift);
  return json.add("spread", material::spread_text(p.spread))
      .add("origin", text(p.origin))
      .add("source", p.spread.source);
}

/// Prints as JSON what of a case is uncertain, and by how much; checks the case as `check` does.
ExitCode list_uncertain(const CaseArguments& arguments) {
  const setup::Case c = load_case(arguments);
  const run::CheckedRun checked = run::check_run(c);
  Json::Array parameters, fixed;
  for (const UncertainParameter& p : checked.uncertain.list) parameters.push_back(json(p));
  for (const std::string& what : checked.uncertain.fixed) fixed.emplace_back(what);
  Json document;
  document.add("title", c.spec.title)
      .add("parameters", std::move(parameters))
      .add("not_varied", std::move(fixed));
  print(document.text() + "\n");
  return k_done;
}

class Uncertain final : public Verb {
 public:
  explicit Uncertain(CLI::App& program)
      : Verb(program, "uncertain", "Print how far the answers of a case may be off because its data are") {
    CaseArguments& c = case_;
    add_case(command(), c);
    command().add_flag("--heat-only", c.heat_only, "Compute heat alone");
    command().add_flag("--trust-geo", c.trust_script, "Run .geo scripts whatever they say, as of run");
    command()
        .add_option("-o,--output", output_, "Folder of all runs; default results/CASE/uncertain")
        ->type_name("FOLDER");
    command().add_option("-j,--jobs", jobs_, "Runs at a time; default one a core")->type_name("NUMBER");
    command().add_option("--runs", runs_, "Runs at most; default 20")->type_name("NUMBER");
    command().add_flag("--one-sided", one_sided_, "Move no parameter to the lower end of its range");
    command()
        .add_option("--samples", samples_, "So many runs of a Latin hypercube instead of one a parameter")
        ->type_name("NUMBER");
    command().add_option("--seed", seed_, "Of the samples; default 1")->type_name("NUMBER");
    command().add_flag("--restart", restart_, "Keep the runs that have ended");
    command().add_flag("--dry-run", dry_run_, "Print what is uncertain and run nothing");
    command().add_flag("--parameters", parameters_, "Print what is uncertain as JSON and run nothing");
  }
  ExitCode run() override {
    if (parameters_) return list_uncertain(case_);
    // The runs are driven by the Python part; only options that were given are passed on.
    PythonArguments arguments = {case_.path};
    for (const std::string& assignment : case_.set) arguments.add("--set", assignment);
    if (output_.empty()) arguments.add("--results-root", results_root().string());
    arguments.add("--output", output_);
    arguments.add("--jobs", jobs_);
    arguments.add("--runs", runs_);
    arguments.add("--samples", samples_);
    arguments.add("--seed", seed_);
    arguments.flag("--heat-only", case_.heat_only);
    arguments.flag("--trust-geo", case_.trust_script);
    arguments.flag("--one-sided", one_sided_);
    arguments.flag("--restart", restart_);
    arguments.flag("--dry-run", dry_run_);
    return run_python("uncertain", arguments.words());
  }

 private:
  CaseArguments case_;
  std::string output_, jobs_, runs_, samples_, seed_;
  bool one_sided_ = false, restart_ = false, dry_run_ = false, parameters_ = false;
};

}  // namespace

std::unique_ptr<Verb> uncertain_verb(CLI::App& program) {
  return std::make_unique<Uncertain>(program);
}

}  // namespace solidus::app
