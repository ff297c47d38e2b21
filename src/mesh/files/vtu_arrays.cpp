/// Arrays as text, base64 or appended bytes, packed or not, are all read to exactly the length that the
/// grid asks for; size and depth are bounded before anything is parsed.
#include "mesh/files/vtu_arrays.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <boost/property_tree/xml_parser.hpp>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include "system/errors.hpp"
#include "system/input_file.hpp"

namespace solidus::mesh {

namespace {

namespace pt = boost::property_tree;

/// Up to `n` bytes of base64 text, which may be several encodings one behind the other; blanks are skipped.
std::string decode_base64(std::string_view text, std::size_t n) {
  static const std::array<int, 256> k_value = [] {
    std::array<int, 256> value{};
    value.fill(-1);
    constexpr std::string_view k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < k_digits.size(); ++i)
      value[static_cast<unsigned char>(k_digits[i])] = static_cast<int>(i);
    return value;
  }();
  std::string out;
  std::uint32_t group = 0;
  // Four digits make three bytes; padding ends one encoding, another one may follow.
  int digits = 0, padding = 0;
  for (const char c : text) {
    if (out.size() >= n) break;
    const int value = k_value[static_cast<unsigned char>(c)];
    if (c == '=')
      ++padding;
    else if (value < 0)
      continue;
    // Blanks and line ends between digits are no digits.
    group = (group << 6U) | static_cast<std::uint32_t>(value < 0 ? 0 : value);
    if (++digits < 4) continue;
    for (int k = 0; k < 3 - padding; ++k)
      out += static_cast<char>((group >> static_cast<unsigned>(16 - 8 * k)) & 0xffU);
    group = 0;
    digits = padding = 0;
  }
  return out.substr(0, std::min(n, out.size()));
}

std::uint64_t header_word(const std::string& bytes, std::size_t i, bool wide) {
  if (wide) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + 8 * i, 8);
    return word;
  }
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + 4 * i, 4);
  return word;
}

template <class T>
void convert(const std::string& bytes, std::vector<double>& numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    T value{};
    std::memcpy(&value, bytes.data() + i * sizeof value, sizeof value);
    numbers[i] = static_cast<double>(value);
  }
}

struct NumberType {
  std::string_view name;
  std::size_t size;
  void (*convert)(const std::string&, std::vector<double>&);
};
constexpr std::array k_types{
    NumberType{"Float64", 8, convert<double>},     NumberType{"Float32", 4, convert<float>},
    NumberType{"Int64", 8, convert<std::int64_t>}, NumberType{"UInt64", 8, convert<std::uint64_t>},
    NumberType{"Int32", 4, convert<std::int32_t>}, NumberType{"UInt32", 4, convert<std::uint32_t>},
    NumberType{"Int16", 2, convert<std::int16_t>}, NumberType{"UInt16", 2, convert<std::uint16_t>},
    NumberType{"Int8", 1, convert<std::int8_t>},   NumberType{"UInt8", 1, convert<std::uint8_t>},
};

std::string attribute(const pt::ptree& element, const std::string& name) {
  return element.get<std::string>("<xmlattr>." + name, "");
}

/// Whether elements lie in each other deeper than `most`: the parser of XML calls itself for each.
bool nested_deeper(std::string_view xml, int most) {
  int depth = 0;
  // Where the text behind a mark goes on, or the end of the file.
  const auto behind = [&](std::size_t from, std::string_view end) {
    const std::size_t at = xml.find(end, from);
    return at == std::string_view::npos ? xml.size() : at + end.size();
  };
  // Comments, instructions and the texts between quotes hold marks that mean nothing.
  for (std::size_t at = xml.find('<'); at < xml.size(); at = xml.find('<', at)) {
    const std::string_view rest = xml.substr(at);
    if (rest.starts_with("<!--")) {
      at = behind(at, "-->");
    } else if (rest.starts_with("<![CDATA[")) {
      at = behind(at, "]]>");
    } else if (rest.starts_with("<?")) {
      at = behind(at, "?>");
    } else if (rest.starts_with("<!")) {
      at = behind(at, ">");
    } else if (rest.starts_with("</")) {
      --depth;
      at = behind(at, ">");
    } else {
      char quote = 0;
      for (++at; at < xml.size() && (quote != 0 || xml[at] != '>'); ++at) {
        if (quote != 0)
          quote = xml[at] == quote ? '\0' : quote;
        else if (xml[at] == '"' || xml[at] == '\'')
          quote = xml[at];
      }
      if (at >= xml.size() || xml[at - 1] != '/') ++depth;
      if (depth > most) return true;
    }
  }
  return false;
}

/// deflate packs at most 1 032 bytes into one.
constexpr std::size_t k_most_packed = 1032;

}  // namespace

void VtuFile::fail(const std::string& what, const std::string& allowed) const {
  throw InputError({file_.string(), 0, 0}, what, allowed);
}

VtuFile::VtuFile(const std::filesystem::path& file) : file_(file) {
  // Size and depth are bounded before anything is parsed: files come from anywhere.
  require_readable(file, {file.string(), 0, 0}, k_most_field);
  std::ifstream in(file, std::ios::binary);
  if (!in) fail("the file cannot be read");
  content_.assign(std::istreambuf_iterator<char>(in), {});
  // The bytes after the underscore of the appended data need not be text.
  std::string xml = content_;
  // Appended data begin behind an underscore and are cut off before the XML is parsed.
  const std::size_t tag = content_.find("<AppendedData");
  if (tag != std::string::npos) {
    const std::size_t close = content_.find('>', tag), begin = content_.find('_', close);
    if (begin == std::string::npos) fail("the file has no data behind <AppendedData>");
    const std::string head = content_.substr(tag, close - tag);
    base64_ = head.find("base64") != std::string::npos;
    appended_ = std::string_view(content_).substr(begin + 1);
    xml = content_.substr(0, tag) + "</VTKFile>";
  }
  constexpr int k_deepest = 50;
  if (nested_deeper(xml, k_deepest))
    fail("the elements of the file lie deeper in each other than those of a grid");
  try {
    std::istringstream text(xml);
    pt::read_xml(text, document_);
  } catch (const pt::xml_parser_error& error) {
    fail(fmt::format("the file is no XML: {} in line {}", error.message(), error.line()));
  }
  // What the head says of all arrays: order of bytes, width of lengths, compression.
  const auto root = document_.get_child_optional("VTKFile");
  // The head decides how arrays are stored.
  if (!root) fail("the file is no VTK XML file", "an unstructured grid, .vtu or .pvtu");
  root_ = &*root;
  type_ = attribute(*root_, "type");
  if (attribute(*root_, "byte_order") == "BigEndian") fail("the file is of big endian", "little endian");
  wide_header_ = attribute(*root_, "header_type") == "UInt64";
  const std::string compressor = attribute(*root_, "compressor");
  compressed_ = !compressor.empty();
  if (compressed_ && compressor != "vtkZLibDataCompressor")
    fail(fmt::format("the file is compressed by {}", compressor), "vtkZLibDataCompressor, or no compression");
}

std::string VtuFile::stored(std::string_view data, bool base64, std::size_t n) const {
  std::string out = base64 ? decode_base64(data, n) : std::string(data.substr(0, n));
  if (out.size() < n) fail("the file ends before its data do");
  return out;
}

std::string VtuFile::bytes(const pt::ptree& array, std::size_t n) const {
  // An array is in the text, or at an offset of the data appended to the file; in the text it is in
  // base64.
  const std::string format = attribute(array, "format");
  std::string inline_text;
  std::string_view data = appended_;
  bool base64 = base64_;
  if (format == "appended") {
    const auto offset = array.get<std::size_t>("<xmlattr>.offset", 0);
    if (offset > appended_.size()) fail("the file ends before its data do");
    data = appended_.substr(offset);
  } else {
    inline_text = array.data();
    data = inline_text;
    base64 = true;
  }
  // Without compression a word gives the number of bytes that follow.
  const std::size_t word = wide_header_ ? 8 : 4;
  if (!compressed_) {
    const std::string all = stored(data, base64, word + n);
    if (header_word(all, 0, wide_header_) < n) fail("an array of the file is shorter than its grid");
    return all.substr(word);
  }
  // With it a head gives the number of blocks, their size unpacked, that of the last one, and the size of
  // each packed. Sums are checked against the file before memory is taken for them.
  const std::size_t n_blocks = header_word(stored(data, base64, word), 0, wide_header_);
  if (n_blocks > data.size()) fail("the file is damaged: an array has too many blocks");
  const std::size_t n_head = (3 + n_blocks) * word;
  std::string head = stored(data, base64, n_head);
  std::size_t packed = 0;
  for (std::size_t b = 0; b < n_blocks; ++b) {
    const std::size_t size = header_word(head, 3 + b, wide_header_);
    if (size > content_.size() - packed) fail("the file is damaged: a block is longer than the file");
    packed += size;
  }
  // Blocks are unpacked one after the other, and may not give more than the grid needs.
  const std::string all = stored(data, base64, n_head + packed);
  const std::size_t block_size = header_word(head, 1, wide_header_),
                    last = header_word(head, 2, wide_header_);
  std::string out;
  std::size_t at = n_head;
  for (std::size_t b = 0; b < n_blocks; ++b) {
    const std::size_t size = header_word(head, 3 + b, wide_header_);
    uLongf unpacked = b + 1 == n_blocks && last > 0 ? last : block_size;
    if (unpacked > n - out.size()) fail("an array of the file is longer than its grid");
    std::string block(unpacked, '\0');
    if (uncompress(reinterpret_cast<Bytef*>(block.data()), &unpacked,
                   reinterpret_cast<const Bytef*>(all.data() + at), size) != Z_OK)
      fail("the file is damaged: a block cannot be unpacked");
    out.append(block, 0, unpacked);
    at += size;
  }
  if (out.size() < n) fail("an array of the file is shorter than its grid");
  return out;
}

std::vector<double> VtuFile::numbers(const pt::ptree& array, std::size_t n) const {
  // A number takes a byte at least, or what deflate makes of it: no memory is taken for more than the file
  // holds.
  if (n / (compressed_ ? k_most_packed : 1) > content_.size())
    fail("an array of the file is shorter than its grid");
  std::vector<double> result;
  if (n == 0) return result;
  // Arrays as text, one number after the other.
  if (attribute(array, "format") == "ascii") {
    if (n > array.data().size()) fail("an array of the file is shorter than its grid");
    result.resize(n);
    std::istringstream text(array.data());
    std::string word;
    for (double& number : result) {
      if (!(text >> word)) fail("an array of the file is shorter than its grid");
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
      if (error != std::errc() || end != word.data() + word.size())
        fail(fmt::format("'{}' in the file is no number", word));
    }
    return result;
  }
  // Arrays of bytes by their type, unpacked to exactly the length that the grid needs.
  const std::string type = attribute(array, "type");
  for (const NumberType& each : k_types)
    if (each.name == type) {
      const std::string stored = bytes(array, n * each.size);
      result.resize(n);
      each.convert(stored, result);
      return result;
    }
  fail(fmt::format("numbers of the type '{}' are not read", type));
}

}  // namespace solidus::mesh
