/// Tables that verification tests leave for the pictures of the documentation.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace solidus::verification {

/// A CSV file of a verification, for the plots of the documentation.
inline std::ofstream csv(const std::string& name, const std::string& header) {
  const std::filesystem::path folder = std::filesystem::path(SOLIDUS_BINARY_DIR) / "verification";
  std::filesystem::create_directories(folder);
  std::ofstream file(folder / (name + ".csv"));
  file.precision(10);
  file << header << '\n';
  return file;
}

}  // namespace solidus::verification
