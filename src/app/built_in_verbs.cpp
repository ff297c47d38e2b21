/// The verbs that every program has, in the order of the help.
#include "app/verb.hpp"

namespace solidus::app {

std::unique_ptr<Verb> run_verb(CLI::App& program);
std::unique_ptr<Verb> check_verb(CLI::App& program);
std::unique_ptr<Verb> resolve_verb(CLI::App& program);
std::unique_ptr<Verb> variants_verb(CLI::App& program);
std::unique_ptr<Verb> explain_verb(CLI::App& program);
std::unique_ptr<Verb> schema_verb(CLI::App& program);
std::unique_ptr<Verb> point_verb(CLI::App& program);
std::unique_ptr<Verb> mesh_info_verb(CLI::App& program);
std::unique_ptr<Verb> materials_verb(CLI::App& program);
std::unique_ptr<Verb> export_verb(CLI::App& program);
std::unique_ptr<Verb> new_case_verb(CLI::App& program);
std::unique_ptr<Verb> open_verb(CLI::App& program);
std::unique_ptr<Verb> report_verb(CLI::App& program);
std::unique_ptr<Verb> version_verb(CLI::App& program);
std::unique_ptr<Verb> doctor_verb(CLI::App& program);
std::unique_ptr<Verb> plot_verb(CLI::App& program);
std::unique_ptr<Verb> compare_verb(CLI::App& program);
std::unique_ptr<Verb> study_verb(CLI::App& program);
std::unique_ptr<Verb> uncertain_verb(CLI::App& program);
std::unique_ptr<Verb> calibrate_verb(CLI::App& program);
std::unique_ptr<Verb> design_verb(CLI::App& program);
std::unique_ptr<Verb> fill_verb(CLI::App& program);
std::unique_ptr<Verb> pattern_verb(CLI::App& program);
std::unique_ptr<Verb> compare_shape_verb(CLI::App& program);
std::unique_ptr<Verb> mcp_verb(CLI::App& program);
std::unique_ptr<Verb> init_editor_verb(CLI::App& program);
std::unique_ptr<Verb> completion_verb(CLI::App& program);
std::unique_ptr<Verb> man_verb(CLI::App& program);
std::unique_ptr<Verb> help_verb(CLI::App& program);

std::vector<MakeVerb>& verbs() {
  static std::vector<MakeVerb> all = {
      &run_verb,         &check_verb,      &resolve_verb,   &variants_verb,      &explain_verb,
      &schema_verb,      &point_verb,      &mesh_info_verb, &materials_verb,     &export_verb,
      &new_case_verb,    &open_verb,       &report_verb,    &version_verb,       &doctor_verb,
      &plot_verb,        &compare_verb,    &study_verb,     &uncertain_verb,     &calibrate_verb,
      &design_verb,      &fill_verb,       &pattern_verb,   &compare_shape_verb, &mcp_verb,
      &init_editor_verb, &completion_verb, &man_verb,       &help_verb};
  return all;
}

}  // namespace solidus::app
