// "VTK File Formats", in: The VTK User's Guide, 11th edition, section 19.3; version 5.1 as VTK 9 writes it:
// the cells as a list of offsets and one of points.
#include "mesh/files/vtk_legacy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/files/vtk_grid.hpp"
#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

std::string lower(std::string_view text) {
  std::string small(text);
  std::ranges::transform(small, small.begin(), [](unsigned char c) { return std::tolower(c); });
  return small;
}

/// A type of numbers by the name that a file gives it.
struct NumberType {
  const char* name;
  std::size_t bytes;
  enum Kind { whole, natural, real } kind;
};
constexpr std::array<NumberType, 18> k_types{{{"char", 1, NumberType::whole},
                                              {"signed_char", 1, NumberType::whole},
                                              {"unsigned_char", 1, NumberType::natural},
                                              {"short", 2, NumberType::whole},
                                              {"unsigned_short", 2, NumberType::natural},
                                              {"int", 4, NumberType::whole},
                                              {"unsigned_int", 4, NumberType::natural},
                                              {"long", 8, NumberType::whole},
                                              {"unsigned_long", 8, NumberType::natural},
                                              {"float", 4, NumberType::real},
                                              {"double", 8, NumberType::real},
                                              {"vtkidtype", 4, NumberType::whole},
                                              {"vtktypeint8", 1, NumberType::whole},
                                              {"vtktypeuint8", 1, NumberType::natural},
                                              {"vtktypeint32", 4, NumberType::whole},
                                              {"vtktypeuint32", 4, NumberType::natural},
                                              {"vtktypeint64", 8, NumberType::whole},
                                              {"vtktypeuint64", 8, NumberType::natural}}};

/// A number of the file's bytes, whose highest comes first.
template <class Number>
double number_at(const char* bytes) {
  std::array<char, sizeof(Number)> turned{};
  std::reverse_copy(bytes, bytes + sizeof(Number), turned.begin());
  Number number{};
  std::memcpy(&number, turned.data(), sizeof number);
  return static_cast<double>(number);
}

double decode(const NumberType& type, const char* bytes) {
  static_assert(std::endian::native == std::endian::little);
  if (type.kind == NumberType::real)
    return type.bytes == 4 ? number_at<float>(bytes) : number_at<double>(bytes);
  const bool sign = type.kind == NumberType::whole;
  switch (type.bytes) {
    case 1:
      return sign ? number_at<std::int8_t>(bytes) : number_at<std::uint8_t>(bytes);
    case 2:
      return sign ? number_at<std::int16_t>(bytes) : number_at<std::uint16_t>(bytes);
    case 4:
      return sign ? number_at<std::int32_t>(bytes) : number_at<std::uint32_t>(bytes);
    default:
      return sign ? number_at<std::int64_t>(bytes) : number_at<std::uint64_t>(bytes);
  }
}

class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {
    std::ifstream file(path, std::ios::binary);
    text_.assign(std::istreambuf_iterator<char>(file), {});
  }
  std::optional<RawMesh> mesh(double unit);

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& allowed = "") const {
    const auto line =
        1 + std::count(text_.begin(),
                       text_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.size())), '\n');
    if (binary_) throw InputError({path_}, fmt::format("at byte {}: {}", at_, what), allowed);
    throw InputError({path_, static_cast<int>(line), 0}, what, allowed);
  }
  std::string_view line();
  bool skip_blanks();
  void skip_metadata();
  std::string word();
  std::size_t count();
  const NumberType& type(const std::string& name) const;
  std::vector<double> numbers(const NumberType& type, std::size_t n);
  void header();
  void points();
  void cells();
  void types();
  void attributes();
  bool attribute(const std::string& kind, std::size_t n, bool of_cells);
  void field(bool of_cells, std::size_t n);
  void keep(const std::string& name, std::vector<double> values, std::size_t components, bool of_cells);

  const std::string& path_;
  std::string text_;
  std::size_t at_ = 0;
  bool binary_ = false;
  std::vector<double> offsets_, corners_, types_;
  VtkGrid grid_;
};

std::string_view Reader::line() {
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  std::string_view found(text_.data() + at_, end - at_);
  at_ = std::min(end + 1, text_.size());
  if (found.ends_with('\r')) found.remove_suffix(1);
  return found;
}

/// False at the end of the file.
bool Reader::skip_blanks() {
  while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  return at_ < text_.size();
}

/// Behind its keyword, up to an empty line.
void Reader::skip_metadata() {
  line();
  while (at_ < text_.size() && !line().empty()) {
  }
}

std::string Reader::word() {
  if (!skip_blanks()) fail("the file ends where a word or a number should be");
  const std::size_t first = at_;
  while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) == 0) ++at_;
  return text_.substr(first, at_ - first);
}

std::size_t Reader::count() {
  const std::string text = word();
  std::size_t n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  constexpr std::size_t k_most = std::size_t{1} << 33U;
  if (error != std::errc{} || end != text.data() + text.size() || n > k_most)
    fail("'" + text.substr(0, 40) + "' is no number of entries");
  return n;
}

const NumberType& Reader::type(const std::string& name) const {
  const std::string small = lower(name);
  const auto found = std::ranges::find_if(k_types, [&](const NumberType& t) { return t.name == small; });
  if (found == k_types.end())
    fail("'" + name.substr(0, 40) + "' is no type of numbers that is read", "float, int, …");
  return *found;
}

/// Behind a line that tells them. In binary files they begin with the next line.
std::vector<double> Reader::numbers(const NumberType& type, std::size_t n) {
  std::vector<double> values;
  if (binary_) {
    // In binary the size is known at once, and compared with what the file still has.
    line();
    if (n > (text_.size() - at_) / type.bytes) fail("the file is cut off inside of its data");
    values.reserve(n);
    for (std::size_t i = 0; i < n; ++i, at_ += type.bytes) values.push_back(decode(type, text_.data() + at_));
    return values;
  }
  // In text each number takes two bytes at least: so many cannot be there.
  if (n > text_.size() - at_) fail("the file is cut off: there are fewer numbers than it says");
  values.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::string text = word();
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
      fail("'" + text.substr(0, 40) + "' is no number");
    values.push_back(value);
  }
  return values;
}

void Reader::header() {
  line();  // "# vtk DataFile Version 5.1"
  line();  // a title
  const std::string kind = lower(word());
  binary_ = kind == "binary";
  if (!binary_ && kind != "ascii") fail("the third line is neither ASCII nor BINARY");
  if (lower(word()) != "dataset") fail("there is no DATASET");
}

void Reader::points() {
  const std::size_t n = count();
  const std::string name = word();
  grid_.points = numbers(type(name), 3 * n);
  for (const double x : grid_.points)
    if (!std::isfinite(x)) fail("a coordinate is no number");
}

// Up to version 5.0 the number of corners is before those of each cell.
void Reader::cells() {
  const std::size_t n = count(), size = count(), before = at_;
  // From version 5.1 on offsets and corners are two arrays with a head each.
  if (lower(word()) == "offsets") {
    const NumberType& of_offsets = type(word());
    std::vector<double> bounds = numbers(of_offsets, n);
    if (lower(word()) != "connectivity") fail("the cells have no CONNECTIVITY");
    const NumberType& of_corners = type(word());
    corners_ = numbers(of_corners, size);
    if (!bounds.empty()) offsets_.assign(bounds.begin() + 1, bounds.end());
    return;
  }
  // Older files have the number of corners before those of each cell, all in one list.
  at_ = before;
  const std::vector<double> all = numbers(type("int"), size);
  for (std::size_t i = 0; i < all.size();) {
    const double n_corners = all[i++];
    if (!(n_corners >= 0 && n_corners <= static_cast<double>(all.size() - i)))
      fail("the cells are damaged: a cell has more corners than there are numbers");
    const auto end = i + static_cast<std::size_t>(n_corners);
    for (; i < end; ++i) corners_.push_back(all[i]);
    offsets_.push_back(static_cast<double>(corners_.size()));
  }
  if (offsets_.size() != n) fail(fmt::format("there are {} cells where {} are declared", offsets_.size(), n));
}

void Reader::types() {
  const std::size_t n = count();
  types_ = numbers(type("int"), n);
}

/// Names have %20 for a blank.
std::string decoded(const std::string& name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    unsigned code = 0;
    if (name[i] == '%' && i + 2 < name.size() &&
        std::from_chars(name.data() + i + 1, name.data() + i + 3, code, 16).ptr == name.data() + i + 3) {
      text += static_cast<char>(code);
      i += 2;
    } else {
      text += name[i];
    }
  }
  return text;
}

void Reader::keep(const std::string& name, std::vector<double> values, std::size_t components,
                  bool of_cells) {
  if (of_cells && components == 1) grid_.data.push_back({decoded(name), std::move(values)});
}

void Reader::field(bool of_cells, std::size_t n) {
  const std::size_t n_arrays = count();
  for (std::size_t k = 0; k < n_arrays; ++k) {
    std::string name = word();
    if (lower(name) == "metadata") {
      skip_metadata();
      name = word();
    }
    const std::size_t components = count(), tuples = count();
    std::vector<double> values = numbers(type(word()), components * tuples);
    keep(name, std::move(values), components, of_cells && tuples == n);
  }
}

/// The components of an attribute whose line is NAME TYPE; 0 for others.
std::size_t components_of(const std::string& kind) {
  if (kind == "vectors" || kind == "normals") return 3;
  if (kind == "tensors") return 9;
  if (kind == "tensors6") return 6;
  if (kind == "global_ids" || kind == "pedigree_ids") return 1;
  return 0;
}

/// False for what is none.
bool Reader::attribute(const std::string& kind, std::size_t n, bool of_cells) {
  // Only scalars are kept; vectors and others are read over, as their lengths follow from their kind.
  if (kind == "field") {
    // The block of fields has its own form, each with a name and a type.
    word();
    field(of_cells, n);
  } else if (kind == "scalars") {
    const std::string name = word();
    const NumberType& of_numbers = type(word());
    const std::string rest(line());
    const std::size_t components =
        rest.find_first_of("1234") == std::string::npos ? 1 : as_size(rest[rest.find_first_of("1234")] - '0');
    const std::size_t before = at_;
    if (skip_blanks() && lower(text_.substr(at_, 12)) == "lookup_table") {
      word();
      word();
    } else {
      at_ = before - 1;  // numbers() goes on to the next line
    }
    keep(name, numbers(of_numbers, components * n), components, of_cells);
  } else if (kind == "lookup_table" || kind == "color_scalars") {
    word();
    const std::size_t size = count();
    const bool table = kind == "lookup_table";
    numbers(type(binary_ ? "unsigned_char" : "float"), table ? 4 * size : size * n);
  } else if (kind == "texture_coordinates") {
    word();
    const std::size_t components = count();
    numbers(type(word()), components * n);
  } else if (const std::size_t components = components_of(kind); components > 0) {
    word();
    numbers(type(word()), components * n);
  } else if (kind == "metadata") {
    skip_metadata();
  } else {
    return false;
  }
  return true;
}

/// Behind the cells: data of cells and points in any order. Ends at what it does not know.
void Reader::attributes() {
  std::size_t n = 0;
  bool of_cells = false;
  while (skip_blanks()) {
    const std::string kind = lower(word());
    if (kind == "cell_data" || kind == "point_data") {
      of_cells = kind == "cell_data";
      n = count();
      if (of_cells && n != types_.size())
        fail(fmt::format("there are cell data of {} cells, and {} cells", n, types_.size()));
    } else if (!attribute(kind, n, of_cells)) {
      fail("'" + kind.substr(0, 40) + "' is no attribute that is read");
    }
  }
}

std::optional<RawMesh> Reader::mesh(double unit) {
  header();
  // The loop ends when the types of the cells are there, after which only data follow.
  if (lower(word()) != "unstructured_grid") return std::nullopt;
  // Parts come in any order until the types are read.
  while (types_.empty() && skip_blanks()) {
    const std::string kind = lower(word());
    if (kind == "points")
      points();
    else if (kind == "cells")
      cells();
    else if (kind == "cell_types")
      types();
    else if (!attribute(kind, 0, false))
      fail("'" + kind.substr(0, 40) + "' is no part of an unstructured grid");
  }
  // Cells, types and offsets must fit each other before anything is made of them.
  if (offsets_.size() != types_.size())
    fail(fmt::format("there are {} cells with {} types", offsets_.size(), types_.size()));
  grid_.cells = cell_table(types_, offsets_, corners_, grid_.points.size() / 3,
                           [&](const std::string& what) { fail(what); });
  attributes();
  return mesh_of_grid(path_, grid_, unit);
}

}  // namespace

std::optional<RawMesh> read_legacy_vtk(const std::string& path, double unit_in_metres) {
  return Reader(path).mesh(unit_in_metres);
}

}  // namespace solidus::mesh
