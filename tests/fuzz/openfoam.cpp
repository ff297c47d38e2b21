/// Any bytes as a case of OpenFOAM: points, faces, owner, neighbour and a field, one behind the other, with
/// lines of "====" between them.
#include <array>
#include <string_view>

#include "input.hpp"
#include "results/formats/openfoam_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace solidus;
  constexpr std::array<const char*, 5> k_files = {"constant/polyMesh/points", "constant/polyMesh/faces",
                                                  "constant/polyMesh/owner", "constant/polyMesh/neighbour",
                                                  "1/T"};
  std::filesystem::create_directories(fuzz::folder() / "constant/polyMesh");
  std::filesystem::create_directories(fuzz::folder() / "1");
  std::string_view rest(reinterpret_cast<const char*>(data), size);  // NOLINT: bytes are bytes
  for (const char* name : k_files) {
    const std::size_t end = rest.find("\n====\n");
    const std::string_view text = rest.substr(0, end);
    fuzz::as_file(name, reinterpret_cast<const std::uint8_t*>(text.data()), text.size());  // NOLINT
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 6);
  }
  return fuzz::answer([&] { results::read_openfoam(fuzz::folder() / "1", "T", 0.001, {}); });
}
