#include "results/run_folder.hpp"

#include <array>
#include <fstream>
#include <regex>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "results/output_file.hpp"

namespace solidus::results {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view k_marker = "# Written by Solidus: the case as it was run, all defaults filled in.";
constexpr std::array<const char*, 4> k_files = {"history.csv", "steps.csv", "summary.json", "fields.pvd"};

bool written_by_us(const fs::path& case_file) {
  std::ifstream file(case_file);
  std::string line;
  return std::getline(file, line) && line == k_marker;
}

void check_owner(const fs::path& root) {
  if (written_by_us(root / "case.toml")) return;
  // A link is the user's wish to have the file elsewhere (it is written through), not a stranger's file.
  const auto foreign = [&](const char* name) {
    return fs::exists(root / name) && !fs::is_symlink(root / name);
  };
  std::vector<const char*> names(k_files.begin(), k_files.end());
  names.insert(names.begin(), "case.toml");
  for (const char* name : names)
    if (foreign(name))
      throw OutputError(root.string(),
                        std::string("this folder holds a ") + name + " that Solidus did not write",
                        "choose another folder with -o, or move that file away");
}

void remove_old(const fs::path& root) {
  static const std::regex k_field_file(R"((fields|surface_.+)_\d{5,}(_p\d+)?\.p?vtu(\.part)?)");
  for (const char* name : k_files) {
    if (!fs::is_symlink(root / name)) fs::remove(root / name);
    fs::remove(root / (std::string(name) + ".part"));
  }
  for (const char* name : {"state.h5", "previous.h5", "state.h5.part"})
    fs::remove(root / "checkpoint" / name);
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(root / "fields"))
    if (std::regex_match(entry.path().filename().string(), k_field_file)) old.push_back(entry.path());
  for (const fs::path& path : old) fs::remove(path);
}

}  // namespace

fs::path default_run_folder(const fs::path& case_file) {
  const fs::path full = fs::absolute(case_file).lexically_normal();
  const std::string variant = full.stem().string();
  return fs::path("results") / full.parent_path().filename() / (variant == "case" ? "default" : variant);
}

RunFolder::RunFolder(fs::path root, std::string_view resolved_case, bool go_on) : root_(std::move(root)) {
  on_first_process([&] {
    try {
      check_owner(root_);
      fs::create_directories(fields());
      if (!go_on) remove_old(root_);
    } catch (const fs::filesystem_error& error) {
      throw OutputError(root_.string(), "cannot make the results folder: " + error.code().message(),
                        "choose another folder with -o");
    }
    write_file(root_ / "case.toml", std::string(k_marker) + "\n" + std::string(resolved_case));
  });
}

}  // namespace solidus::results
