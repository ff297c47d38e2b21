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
#include "model/case_keys.hpp"

namespace solidus::app {

void print(const std::string& text) {
  int rank = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  if (rank != 0) return;
  const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!whole || std::fflush(stdout) != 0) throw InputError({"standard output", 0, 0}, std::strerror(errno));
}

ExitCode explain(const std::string& key, bool manual) {
  const SectionInfo& keys = model::case_keys().info();
  print(manual ? reference_manual(keys, "Reference: the case file") : solidus::explain(keys, key));
  return k_done;
}

ExitCode schema() {
  print(json_schema(model::case_keys().info(), "Solidus case"));
  return k_done;
}

ExitCode version() {
  char petsc[128] = "";
  PetscGetVersion(petsc, sizeof petsc);
  print(fmt::format("Solidus {}\n{}\nGmsh {}\n", SOLIDUS_VERSION, petsc, GMSH_API_VERSION));
  return k_done;
}

}  // namespace solidus::app
