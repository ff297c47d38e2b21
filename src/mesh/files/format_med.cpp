/// MED files of Salome and Code_Aster (.med), read in mesh/med.
#include "mesh/files/file_format.hpp"

namespace solidus::mesh {

namespace {

bool begins(std::string_view head) {
  return head.starts_with("\x89HDF\r\n\x1a\n");
}

}  // namespace

FileFormat format_med() {
  return {.name = "MED",
          .place = 80,
          .endings = {".med", ".MED", ".rmed"},
          .begins = &begins,
          .begins_with = "the signature of HDF5",
          .told = ".med",
          .by_library = true};
}

}  // namespace solidus::mesh
