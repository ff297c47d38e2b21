/// The part of HDF5 that a checkpoint needs: tables of numbers and texts in one file, read by one process,
/// written by one or by all together.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>

namespace solidus::results {

/// Owns one HDF5 handle.
class Hdf5Handle {
 public:
  using Id = std::int64_t;  ///< hid_t of HDF5, whose header is not needed here
  using Close = int (*)(Id);
  Hdf5Handle(Id id, Close closing) : id_(id), close_(closing) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  operator Id() const { return id_; }  // NOLINT: passes as HDF5's type
  /// Closes now; false when HDF5 reports a failure.
  bool close();

 private:
  Id id_;
  Close close_;
};

/// An open HDF5 file. Names may hold slashes; the groups they imply are made. Everything throws OutputError
/// with the path when it does not work (writing: no room; reading: damaged, or not what is expected).
class Hdf5File {
 public:
  enum class Mode { create, read };
  /// The processes that create the file: all of them call everything but write_rows() alike, and each writes
  /// rows of its own.
  enum class Writers { this_process, all };
  Hdf5File(std::filesystem::path path, Mode mode, Writers writers = Writers::this_process);
  /// Abandons a file that was not closed: data that could not be written to it are dropped.
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  void write_text(const std::string& name, const std::string& text);
  std::string read_text(const std::string& name) const;

  /// A table of `rows` × `width` numbers, whose values are undefined until they are written.
  template <class T>
  void create_table(const std::string& name, std::int64_t rows, std::int64_t width);
  /// Rows from `first` on; the span holds whole rows.
  template <class T>
  void write_rows(const std::string& name, std::int64_t first, std::span<const T> values);
  template <class T>
  void read_rows(const std::string& name, std::int64_t first, std::span<T> values) const;
  /// Throws for a table that is not as create_table() makes it: packed, in another file, or with more numbers
  /// than the file has bytes for.
  std::int64_t rows(const std::string& name) const;
  std::int64_t width(const std::string& name) const;

  /// Brings everything to the disk and closes.
  void close();

 private:
  [[noreturn]] void fail(const std::string& what) const;
  Hdf5Handle dataset(const std::string& name) const;

  std::filesystem::path path_;
  Mode mode_;
  bool first_ = true;  ///< among the writers
  Hdf5Handle file_;
};

}  // namespace solidus::results
