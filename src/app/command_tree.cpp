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

}  // namespace

CommandTree command_tree(const CLI::App& program) {
  CommandTree tree;
  tree.doc = program.get_description();
  tree.footer = program.get_footer();
  tree.options = options_of(program);
  for (const CLI::App* verb : program.get_subcommands([](const CLI::App*) { return true; }))
    tree.verbs.push_back({verb->get_name(), verb->get_description(), options_of(*verb)});
  return tree;
}

}  // namespace solidus::app
