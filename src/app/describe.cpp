/// The verbs that need no case: explain, schema, version.
#include <fmt/format.h>
#include <gmsh.h>
#include <petscsys.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "app/verbs.hpp"
#include "base/errors.hpp"
#include "base/key_docs.hpp"
#include "material/library.hpp"
#include "model/case_keys.hpp"

namespace solidus::app {

void print(const std::string& text) {
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  if (rank != 0) return;
  const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!whole || std::fflush(stdout) != 0) throw InputError({"standard output", 0, 0}, std::strerror(errno));
}

namespace {

const SectionInfo& keys_of(FileKind file) {
  return file == FileKind::case_file ? model::case_keys().info() : material::material_section().info();
}

}  // namespace

ExitCode explain(FileKind file, const std::string& key, bool manual) {
  const std::string title =
      file == FileKind::case_file ? "Reference: the case file" : "Reference: the material file";
  print(manual ? reference_manual(keys_of(file), title) : solidus::explain(keys_of(file), key));
  return k_done;
}

ExitCode schema(FileKind file) {
  print(json_schema(keys_of(file), file == FileKind::case_file ? "Solidus case" : "Solidus material"));
  return k_done;
}

ExitCode version() {
  char petsc[128] = "";
  PetscGetVersion(petsc, sizeof petsc);
  print(fmt::format("Solidus {}\n{}\nGmsh {}\n", SOLIDUS_VERSION, petsc, GMSH_API_VERSION));
  return k_done;
}

}  // namespace solidus::app
