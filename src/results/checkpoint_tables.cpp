#include "results/checkpoint_tables.hpp"

#include <mpi.h>
#include <petscsys.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "algebra/parallel.hpp"
#include "results/file_checksum.hpp"
#include "results/output_error.hpp"

namespace solidus::results {

namespace {

constexpr std::int64_t k_rows_at_once = 1 << 16;
constexpr std::size_t k_widest = 1 << 14;  ///< numbers in a row: of the points of one element

std::string from_first(std::string text) {
  int length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, PETSC_COMM_WORLD);
  text.resize(static_cast<std::size_t>(length));
  MPI_Bcast(text.data(), length, MPI_CHAR, 0, PETSC_COMM_WORLD);
  return text;
}

}  // namespace

TableWriter::TableWriter(std::filesystem::path path) : path_(std::move(path)) {
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank_);
  attempt([&] { file_.emplace(path_, Hdf5File::Mode::create, PETSC_COMM_WORLD); });
}

TableWriter::~TableWriter() {
  file_.reset();
  if (finished_ || rank_ != 0) return;
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

/// Goes on after a failure: the others would wait in what they do together.
void TableWriter::attempt(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::exception&) {
    if (!error_) error_ = std::current_exception();
  }
}

void TableWriter::text(const std::string& name, const std::string& of_first) {
  // Its length is part of what the processes create together.
  const std::string text = from_first(of_first);
  if (file_) attempt([&] { file_->write_text(name, text); });
}

void TableWriter::numbers(const std::string& name, const std::vector<double>& n) {
  if (!file_) return;
  attempt([&] { file_->create_table<double>(name, static_cast<std::int64_t>(n.size()), 1); });
  if (rank_ == 0) attempt([&] { file_->write_rows<double>(name, 0, n); });
}

template <class T>
void TableWriter::rows(const std::string& name, int width, std::span<const T> own) {
  MPI_Allreduce(MPI_IN_PLACE, &width, 1, MPI_INT, MPI_MAX, PETSC_COMM_WORLD);
  if (width == 0) return;
  const auto mine = static_cast<std::int64_t>(own.size()) / width;
  std::int64_t all = 0, first = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT64_T, MPI_SUM, PETSC_COMM_WORLD);
  MPI_Exscan(&mine, &first, 1, MPI_INT64_T, MPI_SUM, PETSC_COMM_WORLD);
  if (rank_ == 0) first = 0;
  if (!file_) return;
  attempt([&] { file_->create_table<T>(name, all, width); });
  attempt([&] { file_->write_rows<T>(name, first, own); });
}

template void TableWriter::rows<double>(const std::string&, int, std::span<const double>);
template void TableWriter::rows<std::int64_t>(const std::string&, int, std::span<const std::int64_t>);

void TableWriter::finish(const std::function<void()>& last) {
  if (file_) attempt([&] { file_->close(); });
  together([&] {
    if (error_) std::rethrow_exception(error_);
  });
  on_first_process([&] { write_checksum(path_); });
  on_first_process(last);
  finished_ = true;
}

TableReader::TableReader(std::filesystem::path path) : path_(std::move(path)) {
  on_first_process([&] { check_checksum(path_); });
  together([&] { file_.emplace(path_, Hdf5File::Mode::read); });
}

std::string TableReader::text(const std::string& name) {
  std::string text;
  together([&] { text = file_->read_text(name); });
  return text;
}

std::vector<double> TableReader::numbers(const std::string& name, std::size_t n) {
  std::vector<double> values(n);
  together([&] {
    if (file_->rows(name) != static_cast<std::int64_t>(n) || file_->width(name) != 1)
      throw OutputError(path_.string(), "its '" + name + "' are not as many as they should be");
    file_->read_rows<double>(name, 0, values);
  });
  return values;
}

void TableReader::each(const std::string& keys, const std::string& values,
                       const std::function<void(std::int64_t, std::span<const double>)>& take) {
  together([&] {
    const std::int64_t n_rows = file_->rows(values);
    const auto width = static_cast<std::size_t>(file_->width(values));
    if (file_->rows(keys) != n_rows || file_->width(keys) != 1 || width > k_widest)
      throw OutputError(path_.string(), "its '" + values + "' does not fit its '" + keys + "'");
    std::vector<std::int64_t> number;
    std::vector<double> row;
    for (std::int64_t first = 0; first < n_rows; first += k_rows_at_once) {
      const auto n = static_cast<std::size_t>(std::min(k_rows_at_once, n_rows - first));
      number.resize(n);
      row.resize(n * width);
      file_->read_rows<std::int64_t>(keys, first, number);
      file_->read_rows<double>(values, first, row);
      for (std::size_t i = 0; i < n; ++i)
        take(number[i], std::span<const double>(row).subspan(i * width, width));
    }
  });
}

void TableReader::require(bool complete, const std::string& name) const {
  if (algebra::any_process(!complete))
    throw OutputError(path_.string(), "its '" + name + "' does not fit this mesh");
}

}  // namespace solidus::results
