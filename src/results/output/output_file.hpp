/// Files that are written whole or not at all, and files that grow line by line; both report every failure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "results/output/output_error.hpp"

namespace solidus::results {

/// A file open for writing. Every member throws OutputError with the path and the system's reason.
class OutputFile {
 public:
  enum class Mode { replace, append };
  explicit OutputFile(std::filesystem::path path, Mode mode = Mode::replace);
  /// @param shown  the file that errors name, where `path` is its part
  OutputFile(std::filesystem::path path, Mode mode, std::filesystem::path shown);

  void write(std::string_view bytes);
  void write(std::span<const std::byte> bytes);
  /// Hands all data to the system: flushed data survive a kill of the program.
  void flush();
  /// Flushes and closes. Errors that only show here (quota, network disk) would be lost in the destructor.
  void close();
  const std::filesystem::path& path() const { return path_; }

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::filesystem::path path_, shown_;
  std::unique_ptr<std::FILE, Closer> file_;
};

/// Bytes reserved on disk until the data before them are known. The file has no name, so nothing is left of
/// it whatever happens. Every member throws OutputError with the path.
class SpoolFile {
 public:
  /// @param path  where it is made; tells the disk
  explicit SpoolFile(std::filesystem::path path);

  void write(std::span<const std::byte> bytes);
  /// Overwrites the data at `at`.
  void overwrite(std::uint64_t at, std::span<const std::byte> bytes);
  std::uint64_t size() const { return size_; }
  /// Everything, from the start.
  void copy_to(OutputFile& out);

 private:
  struct Closer {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void seek(std::uint64_t at);

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Closer> file_;
  std::uint64_t size_ = 0;
};

/// Writes to `path`.part and gives it its name when whole: a program that opens `path` sees the old file or
/// the new one. Without commit() (an exception on the way) the part is removed and an older file stays as it
/// was.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  OutputFile& file() { return file_; }
  void write(std::string_view bytes) { file_.write(bytes); }
  void commit();

 private:
  std::filesystem::path path_;
  OutputFile file_;
  bool committed_ = false;
};

/// Writes a whole text at once, atomically.
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace solidus::results
