/// A case is its layers, its keys, its paths and its checks, in this order.
#include "setup/case_file.hpp"

#include <fmt/format.h>

#include "cases/case_keys.hpp"
#include "cases/overrides.hpp"
#include "cases/physics_switch.hpp"
#include "cases/roles.hpp"
#include "cases/source_law.hpp"
#include "cases/stage_input.hpp"
#include "input/keys.hpp"
#include "setup/case_layers.hpp"
#include "setup/jet_input.hpp"
#include "system/log.hpp"
#include "system/version.hpp"

namespace solidus::setup {

namespace {

namespace fs = std::filesystem;

/// A material given as a file rather than by its name in the library.
bool names_a_file(const std::string& material) {
  return material.ends_with(".toml") || material.find('/') != std::string::npos;
}

void resolve(Value& path) {
  const SourceLocation where = path.where;
  path = Value(resolved_path(path));
  path.where = where;
}

/// Files of quantities that vary from place to place: { file = "points.csv" }.
void resolve_places(Value& section) {
  if (!section.is_table()) return;
  const auto resolve_one = [](Value& quantity) {
    if (!quantity.is_table()) return;
    if (Value* file = quantity.find("file"); file && file->is_text()) resolve(*file);
  };
  for (auto& entry : section.entries()) {
    resolve_one(entry.value);
    if (entry.value.is_list())
      for (Value& component : entry.value.items()) resolve_one(component);
  }
}

void resolve_paths(Value& document) {
  // Paths count from the folder of the file that names them.
  if (Value* mesh = document.find("mesh"); mesh && mesh->is_table())
    if (Value* file = mesh->find("file"); file && file->is_text()) resolve(*file);
  if (Value* filling = document.find("filling"); filling && filling->is_table())
    if (Value* result = filling->find("result"); result && result->is_text()) resolve(*result);
  for (const char* kind : {"thermal_condition", "mechanical_condition", "source", "deposition", "channel"})
    if (Value* conditions = document.find(kind); conditions && conditions->is_list())
      for (Value& condition : conditions->items()) resolve_places(condition);
  Value* bodies = document.find("body");
  if (!bodies || !bodies->is_list()) return;
  for (Value& body : bodies->items()) {
    resolve_places(body);
    if (Value* stress = body.find("initial_stress")) resolve_places(*stress);
    Value* material = body.find("material");
    if (material && material->is_text() && names_a_file(material->text())) resolve(*material);
  }
}

}  // namespace

std::string Case::toml() const {
  return fmt::format("# Solidus {}, from {}{}\n{}", program_version(),
                     fs::absolute(file).lexically_normal().string(), variant.empty() ? "" : ":" + variant,
                     to_toml(document));
}

Case load_case(const std::filesystem::path& path, const std::vector<std::string>& overrides,
               std::optional<cases::Physics> physics) {
  Case result;
  const CaseName name = case_named(path);
  // Layers of files, then the command line, which has the last word; only the complete document is read and
  // checked.
  result.file = name.file;
  result.variant = name.variant;
  Value document = load_layers(name);
  for (const std::string& assignment : overrides) cases::apply_override(document, assignment);
  // A change of physics takes out what the other kind does not know, and says so.
  if (physics)
    if (const std::string left_out = cases::switch_physics(document, *physics); !left_out.empty())
      logging::info("heat alone, without {}", left_out);
  // Paths are relative to the file that names them, which is known only until layers are merged.
  resolve_paths(document);
  result.document = cases::case_keys().info().completed(document, "");
  cases::case_keys().assign(result.spec, result.document);
  // Stages first, since conditions refer to them; then checks, then what follows from the whole.
  cases::resolve_stages(result.spec);
  add_jets(result.spec);
  cases::set_powers(result.spec);
  check_case(result.spec);
  cases::vary_conditions(result.spec);
  cases::decide_physics(result.spec);
  return result;
}

}  // namespace solidus::setup
