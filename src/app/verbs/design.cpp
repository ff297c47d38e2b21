/// The verb `design`, which Python does.
#include "app/places.hpp"
#include "app/python_tools.hpp"
#include "app/verb.hpp"

namespace solidus::app {

namespace {

class Design final : public Verb {
 public:
  explicit Design(CLI::App& program)
      : Verb(program, "design", "Find the risers with the least metal for a part, by runs of heat alone") {
    command().add_option("PART", part_, "A STEP, BREP or IGES file, or a case made of one")->required();
    command().add_option("--alloy", alloy_, "What is cast: an alloy of `solidus materials`, or a file");
    command().add_option("--process", process_, "sand, shell or gravity_die; default sand");
    command().add_option("--symmetry", symmetry_, "x or y: compute half of the part, below its middle");
    command()
        .add_option("--as", as_, "What a body of the file is, NAME=ROLE, for example --as Box_2=chill")
        ->allow_extra_args(false);
    command().add_option("--unit", unit_, "Unit of length of the file, as of `new`");
    command().add_flag("--no-sleeves", no_sleeves_, "Risers without sleeves alone");
    command()
        .add_option("--pores", pores_, "Pores that a place of the part may have; default 1")
        ->type_name("PERCENT");
    command()
        .add_option("--holes", holes_,
                    "Pipe, cavities and sinks that the part may have, of its volume; default 0.01")
        ->type_name("PERCENT");
    command()
        .add_option("--fineness", fineness_, "Of the mesh of the search, as of `new`; default 0.5")
        ->type_name("NUMBER");
    command().add_option("--runs", runs_, "Runs at most; default 25")->type_name("NUMBER");
    command().add_option("-j,--jobs", jobs_, "Runs at a time; default one a core")->type_name("NUMBER");
    command()
        .add_option("-o,--output", output_, "Folder of all runs; default results/PART/design")
        ->type_name("FOLDER");
    command().add_flag("--restart", restart_, "Keep the runs that have ended");
  }
  ExitCode run() override {
    PythonArguments arguments = {part_};
    if (output_.empty()) arguments.add("--results-root", results_root().string());
    arguments.add("--output", output_);
    arguments.add("--alloy", alloy_);
    arguments.add("--process", process_);
    arguments.add("--symmetry", symmetry_);
    for (const std::string& one : as_) arguments.add("--as", one);
    arguments.add("--unit", unit_);
    arguments.add("--pores", pores_);
    arguments.add("--holes", holes_);
    arguments.add("--fineness", fineness_);
    arguments.add("--runs", runs_);
    arguments.add("--jobs", jobs_);
    arguments.flag("--no-sleeves", no_sleeves_);
    arguments.flag("--restart", restart_);
    return run_python("design", arguments.words());
  }

 private:
  std::string part_, alloy_, process_, symmetry_, unit_, pores_, holes_, fineness_, runs_, jobs_, output_;
  std::vector<std::string> as_;
  bool no_sleeves_ = false, restart_ = false;
};

}  // namespace

std::unique_ptr<Verb> design_verb(CLI::App& program) {
  return std::make_unique<Design>(program);
}

}  // namespace solidus::app
