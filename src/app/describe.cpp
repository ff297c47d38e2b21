/// The verbs that need no case: explain, schema, version.
#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "app/verbs.hpp"
#include "case/case_keys.hpp"
#include "input/key_docs.hpp"
#include "material/library.hpp"
#include "parallel/petsc_options.hpp"
#include "point/spec.hpp"
#include "system/errors.hpp"
#include "system/input_file.hpp"
#include "system/processes.hpp"
#include "system/version.hpp"

namespace solidus::app {

void print(const std::string& given) {
  const std::string text = printable(given);
  if (processes::rank() != 0) return;
  const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!whole || std::fflush(stdout) != 0) {
    if (errno == EPIPE) return;  // no process reads on, as with `| head`
    throw InputError({"standard output", 0, 0}, std::strerror(errno));
  }
}

namespace {

struct DeclaredFile {
  const SectionInfo& keys;
  const char *reference, *schema;  ///< titles
};

DeclaredFile declared(FileKind file) {
  switch (file) {
    case FileKind::material_file:
      return {material::material_section().info(), "Reference: the material file", "Solidus material"};
    case FileKind::point_file:
      return {point::point_section().info(), "Reference: the point file", "Solidus point"};
    case FileKind::case_file:
      break;
  }
  return {model::case_keys().info(), "Reference: the case file", "Solidus case"};
}

}  // namespace

ExitCode explain(FileKind file, const std::string& key, bool manual) {
  const DeclaredFile of = declared(file);
  print(manual ? reference_manual(of.keys, of.reference) : solidus::explain(of.keys, key));
  return k_done;
}

ExitCode schema(FileKind file) {
  const DeclaredFile of = declared(file);
  print(json_schema(of.keys, of.schema));
  return k_done;
}

ExitCode version() {
  print(fmt::format("Solidus {}\n{}\nGmsh {}\n", program_version(), petsc::version(), SOLIDUS_GMSH_VERSION));
  return k_done;
}

}  // namespace solidus::app
