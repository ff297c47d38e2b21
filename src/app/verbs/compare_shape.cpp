/// The verb `compare-shape`, which Python does.
#include "app/python_tools.hpp"
#include "app/verb.hpp"

namespace solidus::app {

namespace {

class CompareShape final : public Verb {
 public:
  explicit CompareShape(CLI::App& program)
      : Verb(program, "compare-shape", "Compare a measured part with its computed or nominal shape") {
    command().add_option("MEASURED", measured_, "The scan: STL, or points as CSV")->required();
    command()
        .add_option("SHAPE", shape_,
                    "A folder of results, whose last moment is the computed shape, or an STL")
        ->required();
    command().add_flag("--nominal", nominal_, "Of a folder of results the mesh before it deformed");
    command().add_option("--body", body_, "The body of the results; default the casting")->type_name("NAME");
    command()
        .add_option("--unit", unit_, "Unit of length of STL files and of points without one; default mm")
        ->type_name("UNIT");
    command().add_flag("--as-placed", as_placed_,
                       "Without a best fit: both are in one system of coordinates");
    command()
        .add_option("-o,--output", output_, "Folder of what is written; default next to MEASURED")
        ->type_name("FOLDER");
  }
  ExitCode run() override {
    PythonArguments arguments = {measured_, shape_};
    arguments.flag("--nominal", nominal_);
    arguments.flag("--as-placed", as_placed_);
    arguments.add("--body", body_);
    arguments.add("--unit", unit_);
    arguments.add("--output", output_);
    return run_python("compare_shape", arguments.words());
  }

 private:
  std::string measured_, shape_, body_, unit_, output_;
  bool nominal_ = false, as_placed_ = false;
};

}  // namespace

std::unique_ptr<Verb> compare_shape_verb(CLI::App& program) {
  return std::make_unique<CompareShape>(program);
}

}  // namespace solidus::app
