/// Where results go, and where data of the installation lie.
#include "app/places.hpp"

#include <cstdlib>
#include <fstream>
#include <system_error>

#include "system/processes.hpp"
#include "system/program_path.hpp"

namespace solidus::app {

namespace fs = std::filesystem;

fs::path results_root() {
  const fs::path here = fs::current_path();
  std::error_code error;
  for (fs::path folder = here; folder.has_relative_path(); folder = folder.parent_path())
    if (fs::exists(folder / ".git", error)) return folder;
  return here;
}

fs::path shared_folder() {
  return program_path().parent_path().parent_path() / "share/solidus";
}

void note_folder(const fs::path& folder) {
  const char* note = std::getenv("SOLIDUS_RESULTS_NOTE");
  if (processes::rank() == 0 && note != nullptr)
    std::ofstream(note) << fs::absolute(folder).lexically_normal().string() << "\n";
}

}  // namespace solidus::app
