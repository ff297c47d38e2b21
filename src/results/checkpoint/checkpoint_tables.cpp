/// Writers reserve their rows together and fill in their own part; readers go through a table in pieces.
#include "results/checkpoint/checkpoint_tables.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "numbers/index_casts.hpp"
#include "parallel/parallel.hpp"
#include "results/formats/file_checksum.hpp"
#include "results/output/output_error.hpp"
#include "system/processes.hpp"

namespace solidus::results {

namespace {

constexpr std::int64_t k_rows_at_once = 1 << 16;
constexpr std::size_t k_widest = 1 << 14;  ///< numbers in a row: of the points of one element
/// Upper bounds of the bytes that HDF5 writes besides the numbers, for a file and for a table [bytes].
constexpr std::int64_t k_of_file = 1 << 16, k_of_table = 1 << 12;

/// Reserves the first bytes of a file; an error number where there is no room for them, else zero. A file
/// system that cannot reserve is believed to have it.
int reserve_bytes(int descriptor, std::int64_t bytes) {
  rlimit limit{};
  if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
      static_cast<std::uint64_t>(bytes) > limit.rlim_cur)
    return EFBIG;
  while (fallocate(descriptor, FALLOC_FL_KEEP_SIZE, 0, bytes) != 0) {
    if (errno == EINTR) continue;
    return errno == ENOSPC || errno == EDQUOT || errno == EFBIG ? errno : 0;
  }
  return 0;
}

}  // namespace

TableWriter::TableWriter(std::filesystem::path path) : path_(std::move(path)), rank_(processes::rank()) {
  if (rank_ == 0) descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (!reserve(k_of_file)) return;
  attempt([&] { file_.emplace(path_, Hdf5File::Mode::create, Hdf5File::Writers::all); });
  reserve(0);  // making the file has emptied it
}

TableWriter::~TableWriter() {
  file_.reset();
  if (descriptor_ >= 0) ::close(descriptor_);
  if (finished_ || rank_ != 0) return;
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

/// Continues after a failure: the other processes would wait in collective calls.
void TableWriter::attempt(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::exception&) {
    if (!error_) error_ = std::current_exception();
  }
}

bool TableWriter::reserve(std::int64_t more) {
  int failed = 0;
  reserved_ += more;
  if (descriptor_ >= 0 && !error_) failed = reserve_bytes(descriptor_, reserved_);
  processes::broadcast(std::span(&failed, 1));
  if (failed == 0) return true;
  attempt([&] {
    throw OutputError(path_.string(),
                      fmt::format("cannot write a checkpoint of {:.3g} MB or more: {}",
                                  1e-6 * static_cast<double>(reserved_), std::strerror(failed)),
                      "is there room on the disk?");
  });
  full_ = true;
  return false;
}

void TableWriter::text(const std::string& name, const std::string& of_first) {
  // Its length is needed in the collective creation of the table.
  std::string text = of_first;
  processes::broadcast(text);
  if (full_ || !reserve(static_cast<std::int64_t>(text.size()) + k_of_table)) return;
  if (file_) attempt([&] { file_->write_text(name, text); });
}

void TableWriter::numbers(const std::string& name, const std::vector<double>& n) {
  if (full_ || !reserve(static_cast<std::int64_t>(n.size() * sizeof(double)) + k_of_table) || !file_) return;
  attempt([&] { file_->create_table<double>(name, static_cast<std::int64_t>(n.size()), 1); });
  if (rank_ == 0) attempt([&] { file_->write_rows<double>(name, 0, n); });
}

template <class T>
void TableWriter::rows(const std::string& name, int width, std::span<const T> own) {
  processes::largest(std::span(&width, 1));
  if (width == 0) return;
  const auto mine = static_cast<std::int64_t>(own.size()) / width;
  const std::int64_t first = processes::sum_before(mine);
  std::int64_t all = mine;
  processes::sum(std::span(&all, 1));
  if (full_ || !reserve(all * width * static_cast<std::int64_t>(sizeof(T)) + k_of_table) || !file_) return;
  attempt([&] { file_->create_table<T>(name, all, width); });
  attempt([&] { file_->write_rows<T>(name, first, own); });
}

template void TableWriter::rows<double>(const std::string&, int, std::span<const double>);
template void TableWriter::rows<std::int64_t>(const std::string&, int, std::span<const std::int64_t>);

void TableWriter::finish(const std::function<void()>& last) {
  if (file_) attempt([&] { file_->close(); });
  struct stat written {};
  if (descriptor_ >= 0 && fstat(descriptor_, &written) == 0 && S_ISREG(written.st_mode) &&
      ftruncate(descriptor_, written.st_size) != 0)
    attempt(
        [&] { throw OutputError(path_.string(), std::string("cannot be cut: ") + std::strerror(errno)); });
  run_collectively([&] {
    if (error_) std::rethrow_exception(error_);
  });
  on_first_process([&] { write_checksum(path_); });
  on_first_process(last);
  finished_ = true;
}

TableReader::TableReader(std::filesystem::path path) : path_(std::move(path)) {
  on_first_process([&] { check_checksum(path_); });
  run_collectively([&] { file_.emplace(path_); });
}

std::string TableReader::text(const std::string& name) {
  std::string text;
  run_collectively([&] { text = file_->read_text(name); });
  return text;
}

std::vector<double> TableReader::numbers(const std::string& name, std::size_t n) {
  std::vector<double> values(n);
  run_collectively([&] {
    if (file_->rows(name) != static_cast<std::int64_t>(n) || file_->width(name) != 1)
      throw OutputError(path_.string(), "its '" + name + "' are not as many as they should be");
    file_->read_rows<double>(name, 0, values);
  });
  return values;
}

void TableReader::refuse(const std::string& what) const {
  throw OutputError(path_.string(), what);
}

void TableReader::each(const std::string& keys, const std::string& values, const AllowedValues& allowed,
                       const std::function<void(std::int64_t, std::span<const double>)>& take) {
  run_collectively([&] {
    // How many rows and columns there are is in the file.
    const std::int64_t n_rows = file_->rows(values);
    const auto width = as_size(file_->width(values));
    // Keys and values must have as many rows; a damaged file may claim anything.
    if (file_->rows(keys) != n_rows || file_->width(keys) != 1 || width > k_widest)
      throw OutputError(path_.string(), "its '" + values + "' does not fit its '" + keys + "'");
    // A block of rows at a time; numbers out of their range are refused, for the file may be damaged.
    std::vector<std::int64_t> number;
    std::vector<double> row;
    for (std::int64_t first = 0; first < n_rows; first += k_rows_at_once) {
      const auto n = as_size(std::min(k_rows_at_once, n_rows - first));
      number.resize(n);
      row.resize(n * width);
      file_->read_rows<std::int64_t>(keys, first, number);
      file_->read_rows<double>(values, first, row);
      for (std::size_t i = 0; i < row.size(); ++i)
        if (!allowed.contains(row[i]))
          refuse(fmt::format("its '{}' has {} in row {}, column {} (number {} of '{}')", values, row[i],
                             first + static_cast<std::int64_t>(i / width), i % width, number[i / width],
                             keys));
      for (std::size_t i = 0; i < n; ++i)
        take(number[i], std::span<const double>(row).subspan(i * width, width));
    }
  });
}

void TableReader::require(bool complete, const std::string& name) const {
  if (parallel::any_process(!complete))
    throw OutputError(path_.string(), "its '" + name + "' does not fit this mesh");
}

}  // namespace solidus::results
