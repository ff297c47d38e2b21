/// Common part of the fuzz targets: the fuzzer's bytes as a file, and the exceptions that are valid answers.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

#include "system/errors.hpp"

namespace solidus::fuzz {

/// A folder of this process in memory, where the system has one.
inline const std::filesystem::path& folder() {
  static const std::filesystem::path path = [] {
    const std::filesystem::path memory = "/dev/shm";
    const auto root = std::filesystem::exists(memory) ? memory : std::filesystem::temp_directory_path();
    const auto made = root / ("solidus_fuzz_" + std::to_string(getpid()));
    std::filesystem::create_directories(made);
    return made;
  }();
  return path;
}

/// Writes the bytes to a file of this name and returns its path.
inline std::filesystem::path as_file(const std::string& name, const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path path = folder() / name;
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data),  // NOLINT: bytes are bytes
             static_cast<std::streamsize>(size));
  return path;
}

/// Reads; an InputError is an answer, everything else that is thrown is a bug and ends the process.
template <class Read>
int answer(const Read& read) {
  try {
    read();
  } catch (const InputError&) {
  }
  return 0;
}

}  // namespace solidus::fuzz
