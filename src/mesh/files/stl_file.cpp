/// The length of the file tells binary from text; text is read word by word with the state of the facet at
/// hand.
#include "mesh/files/stl_file.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>

#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

static_assert(std::endian::native == std::endian::little, "binary STL files are little-endian");

constexpr std::size_t k_head = 84, k_record = 50, k_normal = 12;

std::uint32_t count_of(const std::string& bytes) {
  std::uint32_t n = 0;
  if (bytes.size() >= k_head) std::memcpy(&n, bytes.data() + k_head - sizeof n, sizeof n);
  return n;
}

bool is_binary(const std::string& bytes) {
  // Binary titles may begin with "solid" too; their length tells them apart.
  return bytes.size() >= k_head && bytes.size() == k_head + k_record * std::size_t{count_of(bytes)};
}

std::vector<Facets> read_binary(const std::string& path, const std::string& bytes) {
  Facets facets;
  facets.triangles.resize(count_of(bytes));
  const char* at = bytes.data() + k_head;
  for (std::size_t t = 0; t < facets.triangles.size(); ++t, at += k_record) {
    std::array<float, 9> x{};
    std::memcpy(x.data(), at + k_normal, sizeof x);
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!std::isfinite(x[i]))
        throw InputError({path}, "triangle " + std::to_string(t + 1) + " has a coordinate that is no number");
      facets.triangles[t][i / 3][i % 3] = x[i];
    }
  }
  return {facets};
}

/// The words of a line.
std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

class TextReader {
 public:
  TextReader(const std::string& path, const std::string& text) : path_(path), stream_(text) {}

  std::vector<Facets> read() {
    for (std::string line; std::getline(stream_, line);) {
      ++line_;
      const std::vector<std::string> words = words_of(line);
      if (!words.empty()) take(words);
    }
    if (in_solid_ || n_corners_ > 0) refuse("the file ends within a solid: it is cut off");
    if (solids_.empty()) refuse("the file has no solid");
    return std::move(solids_);
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError({path_, line_}, what,
                     "solid NAME, facet normal, outer loop, three times vertex, endloop, endfacet, endsolid");
  }

  void take(const std::vector<std::string>& words) {
    // Only solids, facets and vertices say something; any other word is an error.
    const std::string& word = words.front();
    if (word == "solid") {
      if (in_solid_) refuse("a solid begins within a solid");
      in_solid_ = true;
      solids_.emplace_back();
      for (std::size_t i = 1; i < words.size(); ++i) solids_.back().name += (i > 1 ? " " : "") + words[i];
    } else if (!in_solid_) {
      refuse("'" + word + "' outside of a solid");
    } else if (word == "endsolid") {
      if (n_corners_ > 0) refuse("a solid ends within a facet");
      in_solid_ = false;
    } else if (word == "vertex") {
      add_vertex(words);
    } else if (word == "endfacet") {
      if (n_corners_ != 3) refuse("a facet with " + std::to_string(n_corners_) + " vertices");
      solids_.back().triangles.push_back(corners_);
      n_corners_ = 0;
    } else if (word != "facet" && word != "outer" && word != "endloop") {
      refuse("'" + word + "' is no word of an STL file");
    }
  }

  void add_vertex(const std::vector<std::string>& words) {
    if (words.size() != 4) refuse("a vertex without three coordinates");
    if (n_corners_ == 3) refuse("a facet with more than three vertices");
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string& text = words[i + 1];
      char* end = nullptr;
      const double x = std::strtod(text.c_str(), &end);
      if (*end != 0 || !std::isfinite(x)) refuse("'" + text + "' is no coordinate");
      corners_[n_corners_][i] = x;
    }
    ++n_corners_;
  }

  const std::string& path_;
  std::istringstream stream_;
  int line_ = 0;
  std::vector<Facets> solids_;
  bool in_solid_ = false;
  std::array<Point, 3> corners_{};
  std::size_t n_corners_ = 0;
};

}  // namespace

std::vector<Facets> read_stl(const std::string& path) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  const std::string bytes = content.str();
  if (is_binary(bytes)) return read_binary(path, bytes);
  if (std::string_view(bytes).substr(0, 5) != "solid")
    throw InputError({path},
                     "the file has " + std::to_string(bytes.size()) + " bytes, but says that it holds " +
                         std::to_string(count_of(bytes)) + " triangles: it is cut off or no STL file",
                     "84 bytes and 50 for each triangle, or a text that begins with 'solid'");
  return TextReader(path, bytes).read();
}

}  // namespace solidus::mesh
