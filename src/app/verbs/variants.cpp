/// The verb `variants`: lists the variants of a case.
#include <fmt/format.h>

#include <algorithm>

#include "app/case_arguments.hpp"
#include "app/verb.hpp"
#include "setup/case_layers.hpp"

namespace solidus::app {

namespace {

ExitCode list_variants(const std::string& path) {
  const setup::CaseName name = setup::case_named(path);
  const std::vector<setup::VariantInfo> variants = setup::variants_beside(name.file);
  if (variants.empty()) {
    print(fmt::format("{} has no variants: there is no variants.toml next to it.\n", name.file.string()));
    return k_done;
  }
  // Names in a column as wide as the longest, with the titles behind them.
  std::size_t widest = 0;
  for (const setup::VariantInfo& variant : variants) widest = std::max(widest, variant.name.size());
  std::string out;
  for (const setup::VariantInfo& variant : variants)
    out += variant.title.empty() ? variant.name + "\n"
                                 : fmt::format("{:<{}}  {}\n", variant.name, widest, variant.title);
  print(out);
  return k_done;
}

class Variants final : public Verb {
 public:
  explicit Variants(CLI::App& program)
      : Verb(program, "variants", "List the variants of a case, which run as CASE:VARIANT") {
    command().add_option("CASE", path_, "A case file, or a folder with a case.toml")->required();
  }
  ExitCode run() override { return list_variants(path_); }

 private:
  std::string path_;
};

}  // namespace

std::unique_ptr<Verb> variants_verb(CLI::App& program) {
  return std::make_unique<Variants>(program);
}

}  // namespace solidus::app
