/// Reads an HDF5 file by a process of its own: a copy of this one, which answers requests through a socket
/// and may neither write a file, start a program nor open a connection (system/sandbox.hpp). A file on which
/// HDF5 crashes, hangs or asks for memory without end is an error of that file, and what HDF5 does in the
/// copy stays there.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace solidus::results {

/// Everything throws OutputError with the path, as Hdf5File does, and where the copy ends or does not answer
/// within `patience` and a second per megabyte of the file.
class Hdf5Reader {
 public:
  /// @param patience  for each answer [s]
  explicit Hdf5Reader(std::filesystem::path path, double patience = 15);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  // As Hdf5File has them. T: double or std::int64_t.
  std::string read_text(const std::string& name);
  template <class T>
  void read_rows(const std::string& name, std::int64_t first, std::span<T> values);
  std::int64_t rows(const std::string& name);
  std::int64_t width(const std::string& name);

  pid_t process() const { return copy_; }  ///< that reads; negative: has ended

 private:
  struct Request;
  /// Sends it and takes the head of the answer: the number of bytes that follow.
  std::size_t ask(const Request& request, const std::string& name);
  std::int64_t ask_number(const Request& request, const std::string& name);
  void put(const void* bytes, std::size_t n);
  void take(void* bytes, std::size_t n);
  /// How the copy ended.
  [[noreturn]] void ended();
  [[noreturn]] void fail(const std::string& what) const;
  void end_copy();

  std::filesystem::path path_;
  double seconds_ = 0;  ///< for an answer
  std::string doing_;   ///< "reading 'temperature'"
  pid_t copy_ = -1;     ///< negative: has ended
  int to_copy_ = -1;    ///< a socket, for requests and answers
};

}  // namespace solidus::results
