/// Verbs and options are copied into plain data.
#include "app/command_tree.hpp"

#include <CLI/CLI.hpp>

namespace solidus::app {

namespace {

OptionInfo option_info(const CLI::Option& option) {
  OptionInfo info;
  for (const std::string& name : option.get_snames()) info.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) info.names.push_back("--" + name);
  const bool flag = option.get_items_expected_max() == 0;
  if (info.names.empty())
    info.value = option.get_single_name();
  else if (!flag)
    info.value = option.get_type_name();
  info.doc = option.get_description();
  info.required = option.get_required();
  info.many = option.get_items_expected_max() > 1;
  return info;
}

std::vector<OptionInfo> options_of(const CLI::App& app) {
  std::vector<OptionInfo> all;
  for (const CLI::Option* option : app.get_options()) all.push_back(option_info(*option));
  return all;
}

std::vector<VerbInfo> verbs_of(const CLI::App& app, const std::string& above) {
  std::vector<VerbInfo> all;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    const std::string name = above + verb->get_name();
    all.push_back({name, verb->get_description(), options_of(*verb), verbs_of(*verb, name + " ")});
  }
  return all;
}

}  // namespace

CommandTree command_tree(const CLI::App& program) {
  CommandTree tree;
  tree.doc = program.get_description();
  tree.footer = program.get_footer();
  tree.options = options_of(program);
  tree.verbs = verbs_of(program, "");
  return tree;
}

}  // namespace solidus::app
