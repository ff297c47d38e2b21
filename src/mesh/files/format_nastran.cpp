/// Bulk data of Nastran (.bdf, .nas).
#include "mesh/files/file_format.hpp"
#include "mesh/files/format_signs.hpp"
#include "mesh/files/nastran_input.hpp"

namespace solidus::mesh {

namespace {

bool begins(std::string_view head) {
  return is_text(head);
}

std::optional<RawMesh> read(const std::string& path, double unit_in_metres) {
  return read_nastran(path, unit_in_metres);
}

}  // namespace

FileFormat format_nastran() {
  return {.name = "Nastran",
          .place = 90,
          .endings = {".bdf", ".BDF", ".nas", ".NAS"},
          .begins = &begins,
          .begins_with = "text",
          .told = ".bdf",
          .read = &read};
}

}  // namespace solidus::mesh
