/// A folder is taken over only if it is empty or of a run of this case; old results go before new ones
/// come.
#include "results/output/run_folder.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "results/output/field_format.hpp"
#include "results/output/output_file.hpp"
#include "system/processes.hpp"

namespace solidus::results {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view k_marker = "# Written by Solidus: the case as it was run, all defaults filled in.";
constexpr std::array<const char*, 8> k_tables = {"history.csv",  "steps.csv",        "pools.csv",
                                                 "feeding.csv",  "shots.csv",        "stages.csv",
                                                 "summary.json", "sensitivities.csv"};

/// All files that a run may write directly in its folder, but for case.toml and the tables of profiles.
std::vector<std::string> own_files() {
  std::vector<std::string> names(k_tables.begin(), k_tables.end());
  for (const FieldFormat& format : field_formats())
    names.insert(names.end(), format.files.begin(), format.files.end());
  return names;
}

bool written_by_us(const fs::path& case_file) {
  std::ifstream file(case_file);
  std::string line;
  return std::getline(file, line) && line == k_marker;
}

/// The tables NAME.csv of [[profile]] sections that the earlier run of this folder wrote.
std::vector<std::string> tables_of(const fs::path& case_file) {
  std::vector<std::string> tables;
  if (!written_by_us(case_file)) return tables;
  constexpr std::string_view k_name = "name = \"";
  std::ifstream file(case_file);
  bool in_profile = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("[")) in_profile = line == "[[profile]]";
    if (in_profile && line.starts_with(k_name) && line.ends_with("\""))
      tables.push_back(line.substr(k_name.size(), line.size() - k_name.size() - 1) + ".csv");
  }
  return tables;
}

/// @param ours    tables that the earlier run of this folder wrote
/// @param tables  those that this run writes
void check_owner(const fs::path& root, const std::vector<std::string>& ours,
                 std::span<const std::string> tables) {
  // A link is the user's wish to have the file elsewhere (it is written through), not a stranger's file.
  const auto foreign = [&](const std::string& name) {
    return fs::exists(root / name) && !fs::is_symlink(root / name);
  };
  std::vector<std::string> names;
  if (!written_by_us(root / "case.toml")) {
    names = own_files();
    names.insert(names.begin(), "case.toml");
  }
  for (const std::string& table : tables)
    if (std::find(ours.begin(), ours.end(), table) == ours.end()) names.push_back(table);
  for (const std::string& name : names)
    if (foreign(name))
      throw OutputError(root.string(), "this folder holds a " + name + " that Solidus did not write",
                        "choose another folder with -o, or move that file away");
}

bool is_field_file(const std::string& name) {
  return std::ranges::any_of(field_formats(), [&](const FieldFormat& format) {
    return format.is_field_file != nullptr && format.is_field_file(name);
  });
}

/// A report of our own, by its second line: one that another program wrote stays.
bool is_report(const fs::path& file) {
  std::ifstream page(file);
  std::string line;
  return std::getline(page, line) && std::getline(page, line) &&
         line.starts_with("<!-- Written by Solidus: a report.");
}

// Checkpoints first: a run that is killed in between must not seem to have one.
void remove_old(const fs::path& root, const std::vector<std::string>& tables) {
  for (const char* name : {"state.h5", "previous.h5", "state.h5.part"})
    fs::remove(root / "checkpoint" / name);
  std::vector<std::string> names = own_files();
  names.insert(names.end(), tables.begin(), tables.end());
  for (const std::string& name : names) {
    if (!fs::is_symlink(root / name)) fs::remove(root / name);
    fs::remove(root / (name + ".part"));
  }
  if (is_report(root / "report.html") && !fs::is_symlink(root / "report.html"))
    fs::remove(root / "report.html");
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(root / "fields"))
    if (is_field_file(entry.path().filename().string())) old.push_back(entry.path());
  for (const fs::path& path : old) fs::remove(path);
}

}  // namespace

fs::path default_run_folder(const fs::path& case_file, const std::string& variant) {
  const fs::path full = fs::absolute(case_file).lexically_normal();
  const std::string name = variant.empty() ? full.stem().string() : variant;
  return fs::path("results") / full.parent_path().filename() / (name == "case" ? "default" : name);
}

bool is_finished(const fs::path& folder) {
  int finished = 0;
  on_first_process([&] {
    std::ifstream file(folder / "summary.json");
    for (std::string line; std::getline(file, line);)
      if (line.find("\"outcome\": \"finished\"") != std::string::npos) finished = 1;
  });
  processes::broadcast(std::span(&finished, 1));
  return finished != 0;
}

bool RunFolder::is_taken(std::string_view file) {
  const std::vector<std::string> names = own_files();
  return std::ranges::find(names, file) != names.end();
}

RunFolder::RunFolder(fs::path root, std::string_view resolved_case, bool continued,
                     std::span<const std::string> tables)
    : root_(std::move(root)) {
  on_first_process([&] {
    try {
      // First it is made sure that the folder may be used; only then is anything removed.
      const std::vector<std::string> ours = tables_of(root_ / "case.toml");
      check_owner(root_, ours, tables);
      fs::create_directories(fields());
      if (!continued) remove_old(root_, ours);
      // It is that of a finished run until this one has finished too.
      if (continued && !fs::is_symlink(summary())) fs::remove(summary());
    } catch (const fs::filesystem_error& error) {
      throw OutputError(root_.string(), "cannot make the results folder: " + error.code().message(),
                        "choose another folder with -o");
    }
    write_file(root_ / "case.toml", std::string(k_marker) + "\n" + std::string(resolved_case));
  });
}

}  // namespace solidus::results
