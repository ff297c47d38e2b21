/// The verb `init-editor`: writes the files by which an editor checks and completes the files of a folder.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/case_arguments.hpp"
#include "app/verb.hpp"
#include "cases/case_keys.hpp"
#include "input/key_docs.hpp"
#include "material/cards/library.hpp"
#include "point/spec.hpp"
#include "results/output/output_file.hpp"
#include "system/errors.hpp"

namespace solidus::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* k_marker = "# Written by `solidus init-editor`";

/// Even Better TOML (VS Code), Taplo's server (Neovim, Helix, Zed, Emacs) and `taplo check` read this file.
std::string taplo_rules(const fs::path& folder) {
  // Paths of patterns and schemas are those of the tool's working folder unless they are absolute.
  const std::string root = fs::canonical(folder).string();
  std::string text = std::string(k_marker) + ": schemas of the files below this folder.\n";
  // One rule for each kind of file, told by its name or by the folder that it is in.
  const auto rule = [&](const char* comment, const std::vector<std::string>& include,
                        const std::vector<std::string>& exclude, const char* schema) {
    const auto list = [&](const std::vector<std::string>& patterns) {
      std::string items;
      for (const std::string& pattern : patterns)
        items += (items.empty() ? "" : ", ") + fmt::format("\"**/{}\"", pattern);
      return items;
    };
    text += fmt::format("\n# {}\n[[rule]]\ninclude = [{}]\n", comment, list(include));
    if (!exclude.empty()) text += fmt::format("exclude = [{}]\n", list(exclude));
    text += fmt::format("[rule.schema]\npath = \"file://{}/.solidus/{}.schema.json\"\nenabled = true\n", root,
                        schema);
  };
  rule("Material files: in a folder named materials", {"materials/*.toml"}, {}, "material");
  rule("Point files: in a folder named point, or point.toml", {"point/*.toml", "point.toml"}, {}, "point");
  rule("Variants of a case: variants.toml", {"variants.toml"}, {}, "variants");
  rule("Cases: everything else", {"*.toml"},
       {"materials/*.toml", "point/*.toml", "point.toml", "variants.toml", "plots.toml", "study.toml",
        "calibrate.toml", ".taplo.toml", "taplo.toml", "pyproject.toml"},
       "case");
  return text;
}

/// A file of variants holds sections of a case under names of their own.
constexpr const char* k_variants_schema = R"({
  "$schema": "http://json-schema.org/draft-07/schema#",
  "title": "Variants of a Solidus case",
  "type": "object",
  "additionalProperties": false,
  "properties": {
    "part": {
      "description": "What several variants share: [part.NAME], included as \":NAME\"",
      "type": "object",
      "additionalProperties": { "$ref": "case.schema.json" }
    },
    "variant": {
      "description": "[variant.NAME], laid over the case.toml next to this file and run as CASE:NAME",
      "type": "object",
      "additionalProperties": { "$ref": "case.schema.json" }
    }
  }
}
)";

bool ours(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  return std::getline(in, line) && line.starts_with(k_marker);
}

/// Makes a folder with those above it. Throws results::OutputError where that cannot be done.
void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw results::OutputError(folder.string(), "cannot make this folder: " + error.message(),
                               "the folder of your cases is named behind the verb");
}

/// Writes schemas and rules for editors into a folder; empty: the present one.
ExitCode init_editor(const std::string& wanted) {
  const fs::path folder = wanted.empty() ? fs::path(".") : fs::path(wanted);
  // The user's own rules are never overwritten; they are printed to be added by hand.
  if (!fs::is_directory(folder))
    throw InputError({}, fmt::format("there is no folder '{}'", folder.string()), "the folder of your cases");
  const fs::path rules = folder / ".taplo.toml";
  if (fs::exists(rules) && !ours(rules))
    throw InputError({rules.string(), 0, 0}, "this file is there already and is yours",
                     "to add these rules to it yourself:\n" + taplo_rules(folder));
  std::string said;
  results::on_first_process([&] {
    // All schemas are those of this very program.
    make_folder(folder / ".solidus");
    const std::vector<std::pair<std::string, std::string>> files = {
        {".solidus/case.schema.json", json_schema(cases::case_keys().info(), "Solidus case")},
        {".solidus/variants.schema.json", k_variants_schema},
        {".solidus/material.schema.json",
         json_schema(material::material_section().info(), "Solidus material")},
        {".solidus/point.schema.json", json_schema(point::point_section().info(), "Solidus point")},
        {".taplo.toml", taplo_rules(folder)},
    };
    for (const auto& [name, text] : files) results::write_file(folder / name, text);
    for (const auto& [name, text] : files) said += "  " + (folder / name).lexically_normal().string() + "\n";
    // VS Code proposes the extension; a list that is there already is the user's.
    const fs::path extensions = folder / ".vscode/extensions.json";
    if (!fs::exists(extensions)) {
      make_folder(extensions.parent_path());
      results::write_file(extensions, "{\n  \"recommendations\": [\"tamasfe.even-better-toml\"]\n}\n");
      said += "  " + extensions.lexically_normal().string() + "\n";
    }
  });
  print(
      "Written:\n" + said +
      "Open this folder in VS Code with the extension Even Better TOML (tamasfe.even-better-toml), or in an\n"
      "editor with the language server Taplo: keys are completed, explained and checked as you type.\n");
  return k_done;
}

class InitEditor final : public Verb {
 public:
  explicit InitEditor(CLI::App& program)
      : Verb(program, "init-editor", "Write schemas and rules with which editors check and complete cases") {
    command().add_option("FOLDER", folder_, "Folder of the cases; default the present one");
  }
  ExitCode run() override { return init_editor(folder_); }

 private:
  std::string folder_;
};

}  // namespace

std::unique_ptr<Verb> init_editor_verb(CLI::App& program) {
  return std::make_unique<InitEditor>(program);
}

}  // namespace solidus::app
