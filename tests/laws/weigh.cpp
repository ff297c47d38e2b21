/// A verb that no file of the sources names: what the bodies of a case weigh.
#include <fmt/format.h>

#include "app/case_arguments.hpp"
#include "app/verb.hpp"
#include "results/overview.hpp"
#include "run/session.hpp"

namespace solidus::app {
namespace {

class Weigh final : public Verb {
 public:
  explicit Weigh(CLI::App& program) : Verb(program, "weigh", "Print what the bodies of a case weigh") {
    add_case(command(), arguments_);
    command().add_option("--unit", unit_, "g or kg; default kg")->check(CLI::IsMember({"g", "kg"}));
  }
  ExitCode run() override {
    const double in_kilograms = unit_ == "g" ? 1000 : 1;
    const run::CheckedRun checked = run::check_run(load_case(arguments_));
    for (const results::BodyOverview& body : checked.overview.bodies)
      print(fmt::format("{} {:.6g} {}\n", body.name, in_kilograms * body.mass, unit_));
    return k_done;
  }

 private:
  CaseArguments arguments_;
  std::string unit_ = "kg";
};

const AddVerb<Weigh> k_weigh;

}  // namespace
}  // namespace solidus::app
