/// Universal files of I-DEAS (.unv).
#include "mesh/files/file_format.hpp"
#include "mesh/files/format_signs.hpp"
#include "mesh/files/universal_file.hpp"

namespace solidus::mesh {

namespace {

bool begins(std::string_view head) {
  return is_text(head) && without_blanks(head).starts_with("-1");
}

std::optional<RawMesh> read(const std::string& path, double unit_in_metres) {
  return read_universal_file(path, unit_in_metres);
}

}  // namespace

FileFormat format_universal() {
  return {.name = "universal",
          .place = 70,
          .endings = {".unv", ".UNV"},
          .begins = &begins,
          .begins_with = "'-1'",
          .told = ".unv",
          .read = &read};
}

}  // namespace solidus::mesh
