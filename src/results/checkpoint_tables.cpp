#include "results/checkpoint_tables.hpp"

#include <mpi.h>
#include <petscsys.h>

#include <algorithm>
#include <system_error>
#include <type_traits>
#include <utility>

#include "algebra/parallel.hpp"
#include "results/output_error.hpp"

namespace solidus::results {

namespace {

constexpr std::int64_t k_rows_at_once = 1 << 16;

template <class T>
MPI_Datatype message_type() {
  return std::is_same_v<T, double> ? MPI_DOUBLE : MPI_INT64_T;
}

}  // namespace

TableWriter::TableWriter(std::filesystem::path path) : path_(std::move(path)) {
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank_);
  MPI_Comm_size(PETSC_COMM_WORLD, &size_);
  attempt([&] { file_.emplace(path_, Hdf5File::Mode::create); });
}

TableWriter::~TableWriter() {
  if (!file_) return;
  file_.reset();
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

void TableWriter::attempt(const std::function<void()>& work) {
  if (rank_ != 0 || error_) return;
  try {
    work();
  } catch (const std::exception&) {
    error_ = std::current_exception();
  }
}

void TableWriter::text(const std::string& name, const std::string& text) {
  attempt([&] { file_->write_text(name, text); });
}

void TableWriter::numbers(const std::string& name, const std::vector<double>& n) {
  attempt([&] {
    file_->create_table<double>(name, static_cast<std::int64_t>(n.size()), 1);
    file_->write_rows<double>(name, 0, n);
  });
}

template <class T>
void TableWriter::rows(const std::string& name, int width, std::span<const T> own) {
  MPI_Allreduce(MPI_IN_PLACE, &width, 1, MPI_INT, MPI_MAX, PETSC_COMM_WORLD);
  if (width == 0) return;
  const auto n_own = static_cast<int>(own.size());
  std::vector<int> counts(static_cast<std::size_t>(size_));
  MPI_Gather(&n_own, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, PETSC_COMM_WORLD);
  if (rank_ != 0) {
    MPI_Send(own.data(), n_own, message_type<T>(), 0, 0, PETSC_COMM_WORLD);
    return;
  }
  std::int64_t all = 0, first = 0;
  for (const int n : counts) all += n;
  attempt([&] { file_->create_table<T>(name, all / width, width); });
  std::vector<T> received;
  for (int p = 0; p < size_; ++p) {
    const int n = counts[static_cast<std::size_t>(p)];
    std::span<const T> part = own;
    if (p > 0) {
      received.resize(static_cast<std::size_t>(n));
      MPI_Recv(received.data(), n, message_type<T>(), p, 0, PETSC_COMM_WORLD, MPI_STATUS_IGNORE);
      part = received;
    }
    attempt([&] { file_->write_rows<T>(name, first, part); });
    first += n / width;
  }
}

template void TableWriter::rows<double>(const std::string&, int, std::span<const double>);
template void TableWriter::rows<std::int64_t>(const std::string&, int, std::span<const std::int64_t>);

void TableWriter::finish(const std::function<void()>& last) {
  on_first_process([&] {
    if (error_) std::rethrow_exception(error_);
    file_->close();
    last();
    file_.reset();
  });
}

TableReader::TableReader(std::filesystem::path path) : path_(std::move(path)) {
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank_);
  on_first_process([&] { file_.emplace(path_, Hdf5File::Mode::read); });
}

std::string TableReader::text(const std::string& name) {
  std::string text;
  on_first_process([&] { text = file_->read_text(name); });
  int length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, PETSC_COMM_WORLD);
  text.resize(static_cast<std::size_t>(length));
  MPI_Bcast(text.data(), length, MPI_CHAR, 0, PETSC_COMM_WORLD);
  return text;
}

std::vector<double> TableReader::numbers(const std::string& name, std::size_t n) {
  std::vector<double> values(n);
  on_first_process([&] { file_->read_rows<double>(name, 0, values); });
  MPI_Bcast(values.data(), static_cast<int>(n), MPI_DOUBLE, 0, PETSC_COMM_WORLD);
  return values;
}

void TableReader::each(const std::string& keys, const std::string& values,
                       const std::function<void(std::int64_t, std::span<const double>)>& take) {
  std::int64_t size[2] = {0, 0};  // rows, width
  on_first_process([&] {
    size[0] = file_->rows(values);
    size[1] = file_->width(values);
  });
  MPI_Bcast(size, 2, MPI_INT64_T, 0, PETSC_COMM_WORLD);
  const auto width = static_cast<std::size_t>(size[1]);
  std::vector<std::int64_t> number;
  std::vector<double> row;
  for (std::int64_t first = 0; first < size[0]; first += k_rows_at_once) {
    const auto n = static_cast<std::size_t>(std::min(k_rows_at_once, size[0] - first));
    number.resize(n);
    row.resize(n * width);
    on_first_process([&] {
      file_->read_rows<std::int64_t>(keys, first, number);
      file_->read_rows<double>(values, first, row);
    });
    MPI_Bcast(number.data(), static_cast<int>(n), MPI_INT64_T, 0, PETSC_COMM_WORLD);
    MPI_Bcast(row.data(), static_cast<int>(n * width), MPI_DOUBLE, 0, PETSC_COMM_WORLD);
    for (std::size_t i = 0; i < n; ++i)
      take(number[i], std::span<const double>(row).subspan(i * width, width));
  }
}

void TableReader::require(bool complete, const std::string& name) const {
  if (algebra::any_process(!complete))
    throw OutputError(path_.string(), "its '" + name + "' does not fit this mesh");
}

}  // namespace solidus::results
