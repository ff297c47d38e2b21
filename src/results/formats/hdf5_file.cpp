/// Thin functions around HDF5: open, create a table, write or read rows, each with its error as text.
#include "results/formats/hdf5_file.hpp"

#include <fcntl.h>
#include <hdf5.h>
#include <mpi.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <type_traits>
#include <utility>

#include "results/formats/file_checksum.hpp"
#include "results/output/output_error.hpp"
#include "system/processes.hpp"

namespace solidus::results {

namespace {

template <class T>
hid_t number_type() {
  if constexpr (std::is_same_v<T, double>)
    return H5T_NATIVE_DOUBLE;
  else
    return H5T_NATIVE_INT64;
}

static_assert(std::is_same_v<hid_t, Hdf5Handle::Id> && std::is_same_v<herr_t, int>);

hid_t open_file(const std::filesystem::path& path, Hdf5File::Mode mode, Hdf5File::Writers writers) {
  // Failures are ours to report; HDF5 would print its own account.
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  if (mode == Hdf5File::Mode::read) return H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose),
      creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_userblock(creation, k_user_block);
  if (writers == Hdf5File::Writers::all && processes::count() > 1)
    H5Pset_fapl_mpio(access, MPI_Comm_f2c(processes::communicator()), MPI_INFO_NULL);
  return H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access);
}

Hdf5Handle make_groups() {
  Hdf5Handle properties(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(properties, 1);
  return properties;
}

/// Equal runs leave equal files: without the time at which a table was made.
Hdf5Handle table_properties() {
  Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties, false);
  return properties;
}

/// Whether the file holds numbers of the kind that is asked for: another size would not fit the memory.
template <class T>
bool holds(hid_t dataset) {
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose);
  return H5Tget_class(type) == (std::is_same_v<T, double> ? H5T_FLOAT : H5T_INTEGER) &&
         H5Tget_size(type) == sizeof(T);
}

/// Lets HDF5 complete the writing of a file after an error. Data that it could not write stay in its caches,
/// and it would try once more when the program ends, which crashes. So its descriptor is redirected to
/// memory, where there is room.
void let_writing_end(hid_t file) {
  void* handle = nullptr;
  const Hdf5Handle access(H5Fget_access_plist(file), H5Pclose);
  if (access < 0 || H5Pget_driver(access) != H5FD_SEC2) return;
  if (H5Fget_vfd_handle(file, access, &handle) < 0 || handle == nullptr) return;
  const int memory = memfd_create("discarded", MFD_CLOEXEC);
  if (memory < 0) return;
  dup2(memory, *static_cast<int*>(handle));
  ::close(memory);
}

std::array<hsize_t, 2> extent(hid_t dataset) {
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  std::array<hsize_t, 2> size{0, 0};
  if (H5Sget_simple_extent_ndims(space) == 2) H5Sget_simple_extent_dims(space, size.data(), nullptr);
  return size;
}

/// Links to other files are not followed, whatever a file says.
herr_t refuse_link(const char*, const char*, const char*, const char*, unsigned*, hid_t, void*) {
  return -1;
}

Hdf5Handle access_within_the_file() {
  Hdf5Handle properties(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  H5Pset_elink_cb(properties, refuse_link, nullptr);
  return properties;
}

/// Whether all numbers of a table lie one behind the other in the file itself, as create_table() makes them:
/// neither packed, nor in another file, nor more than the file has bytes for.
bool is_plain(hid_t file, hid_t dataset) {
  const Hdf5Handle made(H5Dget_create_plist(dataset), H5Pclose), type(H5Dget_type(dataset), H5Tclose);
  hsize_t bytes_of_file = 0;
  if (H5Pget_layout(made) != H5D_CONTIGUOUS || H5Pget_external_count(made) != 0 ||
      H5Fget_filesize(file, &bytes_of_file) < 0)
    return false;
  const hsize_t bytes = H5Dget_storage_size(dataset), of_number = H5Tget_size(type);
  const auto [rows, width] = extent(dataset);
  if (rows == 0 || width == 0) return true;
  return bytes <= bytes_of_file && width <= bytes && of_number > 0 && bytes % (width * of_number) == 0 &&
         bytes / (width * of_number) == rows;
}

// The part of a table that the rows from `first` on are; negative where it does not fit.
hid_t select_rows(hid_t dataset, std::int64_t first, std::size_t n_values, std::array<hsize_t, 2>& count) {
  const auto [rows, width] = extent(dataset);
  count = {width > 0 ? n_values / width : 0, width};
  const std::array<hsize_t, 2> start{static_cast<hsize_t>(first), 0};
  if (start[0] + count[0] > rows || count[0] * width != n_values) return -1;
  const hid_t space = H5Dget_space(dataset);
  if (count[0] > 0 &&
      H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) < 0) {
    H5Sclose(space);
    return -1;
  }
  return space;
}

}  // namespace

bool Hdf5Handle::close() {
  return close_(std::exchange(id_, -1)) >= 0;
}

Hdf5File::Hdf5File(std::filesystem::path path, Mode mode, Writers writers)
    : path_(std::move(path)),
      mode_(mode),
      first_(writers == Writers::this_process || processes::rank() == 0),
      file_(open_file(path_, mode, writers), H5Fclose) {
  if (file_ < 0) fail(mode == Mode::create ? "cannot be written" : "is not a whole HDF5 file");
}

Hdf5File::~Hdf5File() {
  if (mode_ == Mode::create && file_ >= 0) let_writing_end(file_);
}

void Hdf5File::fail(const std::string& what) const {
  throw OutputError(path_.string(), what, mode_ == Mode::create ? "is there room on the disk?" : "");
}

Hdf5Handle Hdf5File::dataset(const std::string& name) const {
  const Hdf5Handle within = access_within_the_file();
  Hdf5Handle found(H5Dopen2(file_, name.c_str(), within), H5Dclose);
  if (found < 0) fail("holds no '" + name + "'");
  return found;
}

void Hdf5File::write_text(const std::string& name, const std::string& text) {
  const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose),
      groups = make_groups();
  H5Tset_size(type, text.size() + 1);
  const Hdf5Handle set(H5Dcreate2(file_, name.c_str(), type, space, groups, table_properties(), H5P_DEFAULT),
                       H5Dclose);
  if (set < 0 || (first_ && H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.c_str()) < 0))
    fail("cannot write '" + name + "'");
}

std::string Hdf5File::read_text(const std::string& name) const {
  const Hdf5Handle set = dataset(name), type(H5Dget_type(set), H5Tclose);
  const Hdf5Handle space(H5Dget_space(set), H5Sclose);
  constexpr std::size_t k_longest = 1 << 20;
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 || H5Tget_size(type) > k_longest ||
      H5Sget_simple_extent_npoints(space) != 1)
    fail("holds no text '" + name + "'");
  std::string text(H5Tget_size(type), '\0');
  if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0) fail("cannot read '" + name + "'");
  text.resize(text.find('\0') == std::string::npos ? text.size() : text.find('\0'));
  return text;
}

template <class T>
void Hdf5File::create_table(const std::string& name, std::int64_t rows, std::int64_t width) {
  const std::array<hsize_t, 2> size{static_cast<hsize_t>(rows), static_cast<hsize_t>(width)};
  const Hdf5Handle space(H5Screate_simple(2, size.data(), nullptr), H5Sclose), groups = make_groups();
  // Every row is written: several writers would fill the table with zeros first.
  const Hdf5Handle values = table_properties();
  H5Pset_fill_time(values, H5D_FILL_TIME_NEVER);
  const Hdf5Handle set(H5Dcreate2(file_, name.c_str(), number_type<T>(), space, groups, values, H5P_DEFAULT),
                       H5Dclose);
  if (set < 0) fail("cannot write '" + name + "'");
}

template <class T>
void Hdf5File::write_rows(const std::string& name, std::int64_t first, std::span<const T> values) {
  if (values.empty()) return;
  const Hdf5Handle set = dataset(name);
  std::array<hsize_t, 2> count{};
  const Hdf5Handle where(select_rows(set, first, values.size(), count), H5Sclose),
      memory(H5Screate_simple(2, count.data(), nullptr), H5Sclose);
  if (where < 0 || H5Dwrite(set, number_type<T>(), memory, where, H5P_DEFAULT, values.data()) < 0)
    fail("cannot write '" + name + "'");
}

template <class T>
void Hdf5File::read_rows(const std::string& name, std::int64_t first, std::span<T> values) const {
  if (values.empty()) return;
  const Hdf5Handle set = dataset(name);
  if (!holds<T>(set)) fail("holds other numbers in '" + name + "'");
  std::array<hsize_t, 2> count{};
  const Hdf5Handle where(select_rows(set, first, values.size(), count), H5Sclose),
      memory(H5Screate_simple(2, count.data(), nullptr), H5Sclose);
  if (where < 0 || H5Dread(set, number_type<T>(), memory, where, H5P_DEFAULT, values.data()) < 0)
    fail("cannot read '" + name + "'");
}

std::int64_t Hdf5File::rows(const std::string& name) const {
  const Hdf5Handle set = dataset(name);
  if (!is_plain(file_, set)) fail("holds no plain table '" + name + "'");
  return static_cast<std::int64_t>(extent(set)[0]);
}

std::int64_t Hdf5File::width(const std::string& name) const {
  return static_cast<std::int64_t>(extent(dataset(name))[1]);
}

void Hdf5File::close() {
  if (mode_ == Mode::create && H5Fflush(file_, H5F_SCOPE_GLOBAL) < 0) {
    let_writing_end(file_);
    fail("cannot be written");
  }
  if (!file_.close()) fail("cannot be closed");
  if (mode_ != Mode::create) return;
  const int descriptor = ::open(path_.c_str(), O_RDONLY);
  if (descriptor < 0) fail("cannot be read again");
  ::fsync(descriptor);
  ::close(descriptor);
}

template void Hdf5File::create_table<double>(const std::string&, std::int64_t, std::int64_t);
template void Hdf5File::create_table<std::int64_t>(const std::string&, std::int64_t, std::int64_t);
template void Hdf5File::write_rows<double>(const std::string&, std::int64_t, std::span<const double>);
template void Hdf5File::write_rows<std::int64_t>(const std::string&, std::int64_t,
                                                 std::span<const std::int64_t>);
template void Hdf5File::read_rows<double>(const std::string&, std::int64_t, std::span<double>) const;
template void Hdf5File::read_rows<std::int64_t>(const std::string&, std::int64_t,
                                                std::span<std::int64_t>) const;

}  // namespace solidus::results
