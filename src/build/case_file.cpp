#include "build/case_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "case/case_keys.hpp"
#include "case/overrides.hpp"
#include "case/physics_switch.hpp"
#include "case/roles.hpp"
#include "case/stage_input.hpp"
#include "input/keys.hpp"
#include "mesh/file_format.hpp"
#include "system/log.hpp"
#include "system/version.hpp"

namespace solidus::model {

namespace {

namespace fs = std::filesystem;

/// A path of the user seen from the file it is written in; on the command line, from the present folder.
std::string resolved_path(const Value& value) {
  const fs::path path = value.text();
  const bool command_line = value.where.file.starts_with("--set");
  const fs::path folder = command_line ? fs::current_path() : fs::path(value.where.file).parent_path();
  return fs::absolute(path.is_absolute() ? path : folder / path).lexically_normal().string();
}

/// The files on the way to the one that is read, each included by the one before, and how many there were.
struct Includes {
  static constexpr std::size_t k_deepest = 16;
  static constexpr int k_most = 200;
  std::vector<fs::path> chain;
  int n_files = 0;
};

Value load_with_includes(const fs::path& path, Includes& includes);

/// @param include one path of the key `include`
Value load_included(const Value& include, Includes& includes) {
  if (!include.is_text())
    throw InputError(include.where, "'include' is " + include.describe(),
                     "the path of a case file, in quotes, or a list of such paths");
  const fs::path other = resolved_path(include);
  const std::vector<fs::path>& chain = includes.chain;
  std::error_code error;  // a name that no system takes names no file
  if (std::find(chain.begin(), chain.end(), fs::weakly_canonical(other, error)) != chain.end())
    throw InputError(include.where, fmt::format("'{}' is included by itself", include.text()));
  if (!fs::exists(other, error))
    throw InputError(include.where, fmt::format("the included file '{}' does not exist", other.string()));
  if (chain.size() >= Includes::k_deepest || ++includes.n_files > Includes::k_most)
    throw InputError(
        include.where, "too many files include each other",
        fmt::format("at most {} in a chain and {} in all", Includes::k_deepest, Includes::k_most));
  return load_with_includes(other, includes);
}

Value load_with_includes(const fs::path& path, Includes& includes) {
  Value document = load_document(path);
  const Value* include = document.find("include");
  if (!include) return document;
  std::error_code error;
  includes.chain.push_back(fs::weakly_canonical(path, error));
  Value base;
  for (const Value& item : include->is_list() ? include->items() : Value::List{*include})
    lay_over(base, load_included(item, includes));
  includes.chain.pop_back();
  std::erase_if(document.entries(), [](const Value::Entry& e) { return e.key == "include"; });
  lay_over(base, document);
  base.where = document.where;
  return base;
}

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
  for (auto& entry : section.entries())
    if (entry.value.is_table())
      if (Value* file = entry.value.find("file"); file && file->is_text()) resolve(*file);
}

void resolve_paths(Value& document) {
  if (Value* mesh = document.find("mesh"); mesh && mesh->is_table())
    if (Value* file = mesh->find("file"); file && file->is_text()) resolve(*file);
  if (Value* conditions = document.find("thermal_condition"); conditions && conditions->is_list())
    for (Value& condition : conditions->items()) resolve_places(condition);
  Value* bodies = document.find("body");
  if (!bodies || !bodies->is_list()) return;
  for (Value& body : bodies->items()) {
    resolve_places(body);
    Value* material = body.find("material");
    if (material && material->is_text() && names_a_file(material->text())) resolve(*material);
  }
}

/// What may have been meant by a path that is not there: cases beside it with nearly its name.
std::string near_case(const fs::path& path) {
  std::error_code error;
  std::vector<std::string> names;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(path.has_parent_path() ? path.parent_path() : fs::path("."), error))
    if (entry.path().extension() == ".toml" || fs::exists(entry.path() / "case.toml", error))
      names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  const std::string near = nearest_name(path.filename().string(), names);
  return near.empty() ? "a case file, or a folder that holds a case.toml"
                      : fmt::format("did you mean '{}'?", (path.parent_path() / near).string());
}

/// The file of a case that is asked for by its name, or by that of its folder.
fs::path case_file_of(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error))
    throw InputError({path.string()}, "there is no such file or folder", near_case(path));
  if (mesh::is_mesh_name(path.string()) && fs::is_regular_file(path, error))
    throw InputError({path.string()}, "this is a geometry or a mesh, not a case",
                     "a case file; `solidus new` makes one from a geometry");
  if (!fs::is_directory(path, error)) return path;
  if (!fs::exists(path / "case.toml", error))
    throw InputError({path.string()}, "the folder has no case.toml",
                     "a case file, or a folder that holds one");
  return path / "case.toml";
}

}  // namespace

std::string Case::toml() const {
  return fmt::format("# Solidus {}, from {}\n{}", program_version(),
                     fs::absolute(file).lexically_normal().string(), to_toml(document));
}

Case load_case(const std::filesystem::path& path, const std::vector<std::string>& overrides,
               std::optional<Physics> physics) {
  Case result;
  result.file = case_file_of(path);
  Includes includes;
  Value document = load_with_includes(result.file, includes);
  for (const std::string& assignment : overrides) apply_override(document, assignment);
  if (physics)
    if (const std::string left_out = switch_physics(document, *physics); !left_out.empty())
      logging::info("heat alone, without {}", left_out);
  resolve_paths(document);
  result.document = case_keys().info().completed(document, "");
  case_keys().assign(result.spec, result.document);
  resolve_stages(result.spec);
  check_case(result.spec);
  decide_physics(result.spec);
  return result;
}

}  // namespace solidus::model
