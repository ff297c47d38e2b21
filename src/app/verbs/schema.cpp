/// The verb `schema`.
#include "app/case_arguments.hpp"
#include "app/declared_files.hpp"
#include "app/verb.hpp"
#include "input/key_docs.hpp"

namespace solidus::app {

namespace {

class Schema final : public Verb {
 public:
  explicit Schema(CLI::App& program)
      : Verb(program, "schema", "Print the JSON Schema of the case file, for editors") {
    file_.add_options(command());
  }
  ExitCode run() override {
    const ChosenFile::Declared of = file_.declared();
    print(json_schema(of.keys, of.schema));
    return k_done;
  }

 private:
  ChosenFile file_;
};

}  // namespace

std::unique_ptr<Verb> schema_verb(CLI::App& program) {
  return std::make_unique<Schema>(program);
}

}  // namespace solidus::app
