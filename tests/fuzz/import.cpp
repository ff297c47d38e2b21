/// Any bytes as a table of a thermodynamic program that becomes a material card.
#include "input.hpp"
#include "input/column_table.hpp"
#include "material/cards/card_import.hpp"
#include "material/cards/library.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace solidus;
  static const material::Material base = material::find_material(
      "aluminium_alsi9cu3", std::vector<std::filesystem::path>{SOLIDUS_MATERIALS_DIR});
  material::ImportOptions options;
  options.like = "aluminium_alsi9cu3";
  const std::string text(reinterpret_cast<const char*>(data), size);  // NOLINT: bytes are bytes
  return fuzz::answer([&] { material::import_card(parse_column_table(text, "table.csv"), options, &base); });
}
