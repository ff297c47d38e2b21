#include "results/vtk_data.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace solidus::results {

namespace {

// Fields are written often and read seldom; higher levels cost several times more for some percent.
constexpr int k_compression = 1;
constexpr std::size_t k_block_bytes = std::size_t{1} << 17;

void append_number(std::string& out, std::uint64_t value) {
  out.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

std::string xml_text(std::string_view text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  return out;
}

std::string array_attributes(const ArrayHead& head, std::string_view type) {
  std::string out = fmt::format(R"(type="{}" Name="{}")", type, xml_text(head.name));
  if (head.components == 1) return out;
  out += fmt::format(R"( NumberOfComponents="{}")", head.components);
  static constexpr std::array<std::string_view, 6> k_tensor = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
  if (head.components == 6)
    for (std::size_t i = 0; i < k_tensor.size(); ++i)
      out += fmt::format(R"( ComponentName{}="{}")", i, k_tensor[i]);
  return out;
}

std::string array_information(const ArrayHead& head) {
  if (head.unit.empty()) return {};
  return fmt::format(R"(<InformationKey name="UNITS_LABEL" location="vtkDataArray">{}</InformationKey>)",
                     xml_text(head.unit));
}

// [number of blocks][bytes of a block][bytes of the last block if it is shorter, else 0][compressed bytes of
// each block ...][blocks ...]
std::string AppendedData::add_bytes(const ArrayHead& head, std::string_view type,
                                    std::span<const std::byte> values) {
  const std::size_t offset = bytes_.size();
  const std::size_t n_blocks = (values.size() + k_block_bytes - 1) / k_block_bytes;
  append_number(bytes_, n_blocks);
  append_number(bytes_, k_block_bytes);
  append_number(bytes_, values.size() % k_block_bytes);
  const std::size_t sizes = bytes_.size();
  bytes_.resize(sizes + n_blocks * sizeof(std::uint64_t));

  for (std::size_t b = 0; b < n_blocks; ++b) {
    const auto block =
        values.subspan(b * k_block_bytes, std::min(k_block_bytes, values.size() - b * k_block_bytes));
    uLongf size = compressBound(static_cast<uLong>(block.size()));
    const std::size_t start = bytes_.size();
    bytes_.resize(start + size);
    if (compress2(reinterpret_cast<Bytef*>(bytes_.data() + start), &size,
                  reinterpret_cast<const Bytef*>(block.data()), static_cast<uLong>(block.size()),
                  k_compression) != Z_OK)
      throw std::runtime_error("zlib could not compress field '" + head.name + "'");
    bytes_.resize(start + size);
    const std::uint64_t compressed = size;
    std::copy_n(reinterpret_cast<const char*>(&compressed), sizeof compressed,
                bytes_.begin() + static_cast<std::ptrdiff_t>(sizes + b * sizeof compressed));
  }
  return fmt::format("        <DataArray {} format=\"appended\" offset=\"{}\">{}</DataArray>\n",
                     array_attributes(head, type), offset, array_information(head));
}

}  // namespace solidus::results
