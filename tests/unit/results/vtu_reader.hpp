/// Reads a VTU file back, independently of the writer: finds arrays by name, decodes offsets and zlib blocks.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace solidus::test {

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

class VtuFile {
 public:
  explicit VtuFile(const std::filesystem::path& path) {
    const std::string text = read_text(path);
    const std::size_t appended = text.find("<AppendedData encoding=\"raw\">");
    if (appended == std::string::npos) throw std::runtime_error("no appended data");
    xml = text.substr(0, appended);
    data_ = text.substr(text.find('_', appended) + 1);
    const std::regex array("<DataArray ([^>]*)format=\"appended\" offset=\"(\\d+)\">");
    for (std::sregex_iterator it(xml.begin(), xml.end(), array), end; it != end; ++it) {
      std::smatch name;
      const std::string attributes = (*it)[1];
      std::regex_search(attributes, name, std::regex("Name=\"([^\"]*)\""));
      attributes_[name[1]] = attributes;
      offsets_[name[1]] = std::stoul((*it)[2]);
    }
  }

  bool has(const std::string& name) const { return offsets_.count(name) > 0; }
  const std::string& attributes(const std::string& name) const { return attributes_.at(name); }

  template <class T>
  std::vector<T> array(const std::string& name) const {
    const std::size_t offset = offsets_.at(name);
    const auto number = [&](std::size_t i) {
      std::uint64_t value = 0;
      std::memcpy(&value, data_.data() + offset + 8 * i, 8);
      return value;
    };
    const std::uint64_t blocks = number(0), size = number(1), last = number(2);
    std::string bytes;
    std::size_t at = offset + 8 * (3 + blocks);
    for (std::uint64_t b = 0; b < blocks; ++b) {
      uLongf want = b + 1 == blocks && last != 0 ? last : size;
      std::string block(want, '\0');
      if (uncompress(reinterpret_cast<Bytef*>(block.data()), &want,
                     reinterpret_cast<const Bytef*>(data_.data() + at), number(3 + b)) != Z_OK)
        throw std::runtime_error("zlib");
      bytes += block;
      at += number(3 + b);
    }
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }

  std::string xml;

 private:
  std::string data_;
  std::map<std::string, std::size_t> offsets_;
  std::map<std::string, std::string> attributes_;
};

}  // namespace solidus::test
