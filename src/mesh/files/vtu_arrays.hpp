/// The arrays of a VTK XML file as they are read.
#pragma once

#include <boost/property_tree/ptree.hpp>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace solidus::mesh {

/// The XML of a file, and its data section that need not be XML.
class VtuFile {
 public:
  /// Throws InputError: a file that cannot be read, or is no VTK XML file of little endian.
  explicit VtuFile(const std::filesystem::path& file);

  const boost::property_tree::ptree& root() const { return *root_; }  ///< <VTKFile>
  const std::string& type() const { return type_; }                   ///< "UnstructuredGrid", ...
  /// The numbers of a <DataArray>. Throws InputError where they are damaged or not `n` in number.
  std::vector<double> numbers(const boost::property_tree::ptree& array, std::size_t n) const;
  [[noreturn]] void fail(const std::string& what, const std::string& allowed = {}) const;

 private:
  std::string bytes(const boost::property_tree::ptree& array, std::size_t n) const;
  std::string stored(std::string_view data, bool base64, std::size_t n) const;

  std::filesystem::path file_;
  std::string content_;
  boost::property_tree::ptree document_;
  const boost::property_tree::ptree* root_ = nullptr;
  std::string type_;
  bool wide_header_ = false, compressed_ = false, base64_ = false;
  std::string_view appended_;  ///< of content_
};

}  // namespace solidus::mesh
