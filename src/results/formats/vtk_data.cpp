/// Arrays are packed in blocks behind the XML, whose offsets are known once all are written.
#include "results/formats/vtk_data.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace solidus::results {

namespace {

// Fields are written often and read seldom; higher levels cost several times more for some percent.
constexpr int k_compression = 1;

}  // namespace

std::string xml_text(std::string_view text) {
  // Four characters have a meaning in XML; names of fields and groups may have any of them.
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
  using Names = std::array<std::string_view, 6>;
  static constexpr Names k_cartesian = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"},
                         k_cylindrical = {"RR", "ZZ", "TT", "RZ", "ZT", "RT"};
  const Names& names = head.cylindrical ? k_cylindrical : k_cartesian;
  if (head.components == 6)
    for (std::size_t i = 0; i < names.size(); ++i)
      out += fmt::format(R"( ComponentName{}="{}")", i, names[i]);
  return out;
}

std::string array_information(const ArrayHead& head) {
  if (head.unit.empty()) return {};
  return fmt::format(R"(<InformationKey name="UNITS_LABEL" location="vtkDataArray">{}</InformationKey>)",
                     xml_text(head.unit));
}

// [number of blocks][bytes of a block][bytes of the last block if it is shorter, else 0][compressed bytes of
// each block ...][blocks ...]
void AppendedData::begin(std::size_t n_bytes) {
  const std::size_t n_blocks = (n_bytes + k_block_bytes - 1) / k_block_bytes;
  const std::array<std::uint64_t, 3> head = {n_blocks, k_block_bytes, n_bytes % k_block_bytes};
  to_.write(std::as_bytes(std::span(head)));
  sizes_at_ = to_.size();
  sizes_.assign(n_blocks, 0);
  to_.write(std::as_bytes(std::span(sizes_)));
  sizes_.clear();
  filled_ = 0;
  left_ = n_bytes;
}

void AppendedData::write_block() {
  compressed_.resize(compressBound(static_cast<uLong>(k_block_bytes)));
  uLongf size = static_cast<uLongf>(compressed_.size());
  if (compress2(reinterpret_cast<Bytef*>(compressed_.data()), &size,
                reinterpret_cast<const Bytef*>(block_.data()), static_cast<uLong>(filled_),
                k_compression) != Z_OK)
    throw std::runtime_error("zlib could not compress a field");
  to_.write(std::span<const std::byte>(compressed_).first(size));
  sizes_.push_back(size);
  left_ -= std::min(left_, filled_);
  filled_ = 0;
}

void AppendedData::end() {
  if (left_ != filled_)
    throw std::logic_error("an array has another number of values than it was said to have");
  if (filled_ > 0) write_block();
  to_.overwrite(sizes_at_, std::as_bytes(std::span(sizes_)));
}

std::string AppendedData::element(const ArrayHead& head, std::string_view type, std::uint64_t offset) {
  return fmt::format("        <DataArray {} format=\"appended\" offset=\"{}\">{}</DataArray>\n",
                     array_attributes(head, type), offset, array_information(head));
}

}  // namespace solidus::results
