#include "app/places.hpp"

#include <petscsys.h>

#include <cstdlib>
#include <fstream>
#include <system_error>

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
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path().parent_path() / "share/solidus";
}

void note_folder(const fs::path& folder) {
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  const char* note = std::getenv("SOLIDUS_RESULTS_NOTE");
  if (rank == 0 && note != nullptr)
    std::ofstream(note) << fs::absolute(folder).lexically_normal().string() << "\n";
}

}  // namespace solidus::app
