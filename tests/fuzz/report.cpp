/// Any bytes as what a run left, for `solidus report`: case.toml, summary.json, history.csv, fields.pvd and a
/// field, one behind the other, with lines of "====" between them.
#include <array>
#include <string_view>

#include "input.hpp"
#include "results/report/report_page.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace solidus;
  constexpr std::array<const char*, 5> k_files = {"case.toml", "summary.json", "history.csv", "fields.pvd",
                                                  "a.vtu"};
  std::string_view rest(reinterpret_cast<const char*>(data), size);  // NOLINT: bytes are bytes
  for (const char* name : k_files) {
    const std::size_t end = rest.find("\n====\n");
    const std::string_view text = rest.substr(0, end);
    fuzz::as_file(name, reinterpret_cast<const std::uint8_t*>(text.data()), text.size());  // NOLINT
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 6);
  }
  return fuzz::answer([&] {
    results::report_text({{fuzz::folder()}});
    results::body_materials(fuzz::folder());
  });
}
