/// Skins of triangles (.stl).
#include "mesh/files/file_format.hpp"

namespace solidus::mesh {

namespace {

bool begins(std::string_view head) {
  constexpr std::size_t k_binary = 84;  // a title, and the number of triangles
  return head.starts_with("solid") || head.size() >= k_binary;
}

}  // namespace

FileFormat format_stl() {
  return {.name = "STL",
          .place = 130,
          .endings = {".stl", ".STL"},
          .begins = &begins,
          .begins_with = "'solid', or 80 bytes and the number of triangles",
          .holds = FileHolds::skin,
          .read_skin = &read_stl};
}

}  // namespace solidus::mesh
