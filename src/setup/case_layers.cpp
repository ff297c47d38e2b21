/// Files are laid over each other from the innermost include outward; variants come last.
#include "setup/case_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "cases/overrides.hpp"
#include "input/keys.hpp"
#include "mesh/files/file_format.hpp"
#include "system/errors.hpp"

namespace solidus::setup {

namespace {

namespace fs = std::filesystem;

constexpr const char* k_variants_file = "variants.toml";

fs::path variants_file(const fs::path& case_file) {
  return case_file.parent_path() / k_variants_file;
}

bool is_there(const fs::path& path) {
  std::error_code error;  // a name that no system takes names no file
  return fs::exists(path, error);
}

std::vector<std::string> names_in(const Value& table) {
  std::vector<std::string> names;
  for (const Value::Entry& entry : table.entries()) names.push_back(entry.key);
  return names;
}

/// The table `variant` or `part` of a file of variants; a value without entries where it has none.
const Value& tables_of(const Value& file, const std::string& kind) {
  static const Value k_none;
  const Value* tables = file.find(kind);
  if (tables == nullptr) return k_none;
  if (!tables->is_table())
    throw InputError(tables->where, fmt::format("'{}' is {}", kind, tables->describe()),
                     fmt::format("sections [{}.NAME]", kind));
  for (const Value::Entry& entry : tables->entries())
    if (!entry.value.is_table())
      throw InputError(entry.value.where,
                       fmt::format("'{}.{}' is {}", kind, entry.key, entry.value.describe()),
                       "a section, or a table {...} in one line");
  return *tables;
}

/// The nearest of the names and all of them, or the verb that lists them where they are many.
std::string meant(const std::vector<std::string>& names, const CaseName& wanted) {
  constexpr std::size_t k_many = 20;
  if (names.size() <= k_many) return one_of(names, wanted.variant);
  const std::string near = nearest_name(wanted.variant, names);
  return (near.empty() ? "" : fmt::format("did you mean '{}'? ", near)) +
         fmt::format("`solidus variants {}` lists {}", wanted.file.string(), names.size());
}

Value load_variants(const fs::path& case_file) {
  Value file = load_document(variants_file(case_file));
  for (const Value::Entry& entry : file.entries())
    if (entry.key != "variant" && entry.key != "part")
      throw InputError(entry.where, fmt::format("a file of variants has no key '{}'", entry.key),
                       one_of({"variant", "part"}, entry.key));
  return file;
}

/// The files and sections on the way to the one that is read, each included by the one before, and how many
/// there were.
class Layers {
 public:
  Value file(const fs::path& path) {
    std::error_code error;
    const Chain chain(*this, fs::weakly_canonical(path, error).string());
    return merged(load_document(path), nullptr);
  }
  /// A variant with the case.toml that it lies over.
  Value variant(const CaseName& name) {
    // A variant needs the folder's file of variants, and a section of its name in it.
    const fs::path from = variants_file(name.file);
    if (!is_there(from))
      throw InputError(
          {name.file.string() + ":" + name.variant},
          fmt::format("there is no variant '{}': the folder has no {}", name.variant, k_variants_file),
          "a case file, or a folder that holds one");
    const Value variants = load_variants(name.file);
    const Value& tables = tables_of(variants, "variant");
    const Value* section = tables.find(name.variant);
    if (section == nullptr)
      throw InputError({from.string()}, fmt::format("there is no variant '{}'", name.variant),
                       meant(names_in(tables), name));
    // Laid over its base, with the chain of names that tells a circle.
    Value base = file(name.file);
    const Chain chain(*this, ":" + name.variant);
    cases::lay_over(base, merged(*section, &variants));
    return base;
  }

 private:
  static constexpr std::size_t k_deepest = 16;
  static constexpr int k_most = 200;

  /// A link of the chain as long as it lives.
  class Chain {
   public:
    Chain(Layers& layers, std::string link) : layers_(layers) { layers.chain_.push_back(std::move(link)); }
    ~Chain() { layers_.chain_.pop_back(); }
    Chain(const Chain&) = delete;
    Chain& operator=(const Chain&) = delete;

   private:
    Layers& layers_;
  };

  /// A document over what it includes.
  /// @param variants  the file of variants that it is in, whose sections `include = ":NAME"` names; or
  ///                  null
  Value merged(Value document, const Value* variants) {
    const Value* include = document.find("include");
    if (!include) return document;
    Value base;
    for (const Value& item : include->is_list() ? include->items() : Value::List{*include})
      cases::lay_over(base, included(item, variants));
    std::erase_if(document.entries(), [](const Value::Entry& e) { return e.key == "include"; });
    cases::lay_over(base, document);
    base.where = document.where;
    return base;
  }

  /// @param include one path of the key `include`
  Value included(const Value& include, const Value* variants) {
    if (!include.is_text())
      throw InputError(include.where, "'include' is " + include.describe(),
                       "the path of a case file, in quotes, or a list of such paths");
    if (variants != nullptr && include.text().starts_with(":")) return section(include, *variants);
    const fs::path other = resolved_path(include);
    std::error_code error;
    refuse_circle(include, fs::weakly_canonical(other, error).string());
    if (!is_there(other))
      throw InputError(include.where, fmt::format("the included file '{}' does not exist", other.string()));
    return file(other);
  }

  /// A part, or another variant, of the same file.
  Value section(const Value& include, const Value& variants) {
    const std::string name = include.text().substr(1);
    const Value &parts = tables_of(variants, "part"), &others = tables_of(variants, "variant");
    const Value* found = parts.find(name);
    if (found == nullptr) found = others.find(name);
    if (found == nullptr) {
      std::vector<std::string> names = names_in(parts);
      for (std::string& other : names_in(others)) names.push_back(std::move(other));
      throw InputError(include.where, fmt::format("there is no part '{}' in this file", name),
                       one_of(names, name));
    }
    refuse_circle(include, include.text());
    const Chain chain(*this, include.text());
    return merged(*found, &variants);
  }

  void refuse_circle(const Value& include, const std::string& link) {
    if (std::find(chain_.begin(), chain_.end(), link) != chain_.end())
      throw InputError(include.where, fmt::format("'{}' is included by itself", include.text()));
    if (chain_.size() >= k_deepest || ++n_files_ > k_most)
      throw InputError(include.where, "too many files include each other",
                       fmt::format("at most {} in a chain and {} in all", k_deepest, k_most));
  }

  std::vector<std::string> chain_;
  int n_files_ = 0;
};

/// Suggests names for a path that is not there: cases next to it, or variants of its folder, with
/// nearly its name.
std::string near_case(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  if (is_there(folder / k_variants_file))
    for (const VariantInfo& variant : variants_beside(folder / "case.toml"))
      if (variant.name == path.stem())
        return fmt::format("did you mean the variant '{}:{}'?", folder.string(), variant.name);
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
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
  if (!is_there(path)) throw InputError({path.string()}, "there is no such file or folder", near_case(path));
  if (mesh::is_mesh_name(path.string()) && fs::is_regular_file(path, error))
    throw InputError({path.string()}, "this is a geometry or a mesh, not a case",
                     "a case file; `solidus new` makes one from a geometry");
  if (!fs::is_directory(path, error)) return path;
  if (!is_there(path / "case.toml"))
    throw InputError({path.string()}, "the folder has no case.toml",
                     "a case file, or a folder that holds one");
  return path / "case.toml";
}

}  // namespace

std::string resolved_path(const Value& value) {
  const fs::path path = value.text();
  const bool command_line = value.where.file.starts_with("--set");
  const fs::path folder = command_line ? fs::current_path() : fs::path(value.where.file).parent_path();
  return fs::absolute(path.is_absolute() ? path : folder / path).lexically_normal().string();
}

CaseName case_named(const fs::path& path) {
  const std::string text = path.string();
  const std::size_t colon = text.rfind(':');
  if (is_there(path) || colon == std::string::npos || colon + 1 == text.size())
    return {case_file_of(path), {}};
  const fs::path before = colon == 0 ? fs::path(".") : fs::path(text.substr(0, colon));
  return {case_file_of(before), text.substr(colon + 1)};
}

Value load_layers(const CaseName& name) {
  Layers layers;
  return name.variant.empty() ? layers.file(name.file) : layers.variant(name);
}

std::vector<VariantInfo> variants_beside(const fs::path& case_file) {
  std::vector<VariantInfo> variants;
  if (!is_there(variants_file(case_file))) return variants;
  const Value file = load_variants(case_file);
  for (const Value::Entry& entry : tables_of(file, "variant").entries()) {
    const Value* title = entry.value.find("title");
    variants.push_back({entry.key, title != nullptr && title->is_text() ? title->text() : std::string()});
  }
  return variants;
}

}  // namespace solidus::setup
