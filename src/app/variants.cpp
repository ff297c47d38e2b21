/// The verb `variants`: lists the variants of a case.
#include <fmt/format.h>

#include <algorithm>

#include "app/verbs.hpp"
#include "build/case_layers.hpp"

namespace solidus::app {

ExitCode list_variants(const std::string& path) {
  const model::CaseName name = model::case_named(path);
  const std::vector<model::VariantInfo> variants = model::variants_beside(name.file);
  if (variants.empty()) {
    print(fmt::format("{} has no variants: there is no variants.toml beside it.\n", name.file.string()));
    return k_done;
  }
  std::size_t widest = 0;
  for (const model::VariantInfo& variant : variants) widest = std::max(widest, variant.name.size());
  std::string out;
  for (const model::VariantInfo& variant : variants)
    out += variant.title.empty() ? variant.name + "\n"
                                 : fmt::format("{:<{}}  {}\n", variant.name, widest, variant.title);
  print(out);
  return k_done;
}

}  // namespace solidus::app
