/// Tables of a checkpoint: every process writes its rows into one file and reads those it needs, so that none
/// holds more than its share.
#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/formats/hdf5_file.hpp"
#include "results/formats/hdf5_reader.hpp"

namespace solidus::results {

/// All calls are collective. A failure is kept, so that no process waits for another, and thrown by finish().
///
/// Room on the disk is reserved before anything goes into the file: neither HDF5 nor MPI-IO survives a disk
/// that fills up under them (one crashes when the program ends, the other waits for ever).
class TableWriter {
 public:
  explicit TableWriter(std::filesystem::path path);
  ~TableWriter();
  TableWriter(const TableWriter&) = delete;
  TableWriter& operator=(const TableWriter&) = delete;
  void text(const std::string& name, const std::string& of_first);      ///< of process 0
  void numbers(const std::string& name, const std::vector<double>& n);  ///< of process 0; as many on all
  /// The rows of all processes, in their order. `width` may differ where a process has no row.
  template <class T>
  void rows(const std::string& name, int width, std::span<const T> own);
  /// Closes the file and runs `last` on process 0. Throws OutputError on every process; no part of the file
  /// stays then.
  void finish(const std::function<void()>& last);

 private:
  void attempt(const std::function<void()>& work);
  /// Room for so many more bytes [bytes]; false, on every process, where the disk has none: nothing more is
  /// written then.
  bool reserve(std::int64_t more);

  std::filesystem::path path_;
  int rank_ = 0;
  bool finished_ = false;
  int descriptor_ = -1;  ///< of process 0, to reserve with
  std::int64_t reserved_ = 0;
  bool full_ = false;  ///< the disk has no room: the same on every process
  std::optional<Hdf5File> file_;
  std::exception_ptr error_;
};

/// Values that a table may hold: numbers, and of these those that mean something.
struct AllowedValues {
  double lowest = std::numeric_limits<double>::lowest(), highest = std::numeric_limits<double>::max();
  bool contains(double value) const { return value >= lowest && value <= highest; }
};

/// Every process reads by itself, a number of rows at a time. All calls are collective and throw on every
/// process.
class TableReader {
 public:
  explicit TableReader(std::filesystem::path path);
  std::string text(const std::string& name);
  std::vector<double> numbers(const std::string& name, std::size_t n);
  /// Calls `take` with every row of the table `values` and its number in the table `keys`, on all processes.
  /// Throws OutputError for a value that is not allowed, with its table, row and column.
  void each(const std::string& keys, const std::string& values, const AllowedValues& allowed,
            const std::function<void(std::int64_t, std::span<const double>)>& take);
  /// Throws OutputError for something in the file that is not as it should be.
  [[noreturn]] void refuse(const std::string& what) const;
  /// Throws OutputError unless `complete` on all processes.
  void require(bool complete, const std::string& name) const;

 private:
  std::filesystem::path path_;
  std::optional<Hdf5Reader> file_;
};

}  // namespace solidus::results
