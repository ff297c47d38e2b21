/// Any text as what --set says, a line each, over a case that is right.
#include <sstream>
#include <string_view>

#include "input.hpp"
#include "setup/case_file.hpp"

namespace {

constexpr std::string_view k_case = R"(title = "A block"
[analysis]
kind = "plane_strain"
physics = "heat"
[mesh]
shape = "block"
[mesh.block]
size = ["10 mm", "10 mm"]
divisions = [2, 2]
[time]
end = "10 s"
step = "1 s"
[[body]]
name = "block"
material = "copper_chill"
initial_temperature = "20 degC"
)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace solidus;
  static const auto file =
      fuzz::as_file("case.toml", reinterpret_cast<const std::uint8_t*>(k_case.data()),  // NOLINT
                    k_case.size());
  std::istringstream text(std::string(reinterpret_cast<const char*>(data), size));  // NOLINT: bytes are bytes
  std::vector<std::string> overrides;
  for (std::string line; std::getline(text, line);) overrides.push_back(line);
  return fuzz::answer([&] { setup::load_case(file, overrides); });
}
