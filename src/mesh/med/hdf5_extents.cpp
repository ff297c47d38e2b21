/// All links of a file are visited without reading a data set; the largest extent is what a library would
/// allocate.
#include "mesh/med/hdf5_extents.hpp"

#include <hdf5.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "system/errors.hpp"

namespace solidus::mesh {

namespace {

/// A handle of HDF5, given back by `close` whatever happens; negative: none.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }  // NOLINT: stands for the number

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

struct Found {
  std::size_t largest = 0;
  bool elsewhere = false;  ///< something lies in another file
};

void look_at_data(hid_t data, Found& found) {
  const Handle properties(H5Dget_create_plist(data), H5Pclose), space(H5Dget_space(data), H5Sclose),
      type(H5Dget_type(data), H5Tclose);
  if (properties < 0 || space < 0 || type < 0) return;  // the library fails to read it
  const H5D_layout_t layout = H5Pget_layout(properties);
  if (layout == H5D_VIRTUAL || H5Pget_external_count(properties) > 0) found.elsewhere = true;
  const auto n = static_cast<std::uint64_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space), 0));
  const std::uint64_t size = std::max<std::uint64_t>(H5Tget_size(type), sizeof(double));
  constexpr std::uint64_t k_most = std::numeric_limits<std::size_t>::max() / 2;
  found.largest = std::max(found.largest, n > k_most / size ? k_most : n * size);
}

herr_t look_at_link(hid_t group, const char* name, const H5L_info_t* info, void* data) {
  Found& found = *static_cast<Found*>(data);
  // What a soft link points to has a hard one, too.
  if (info->type == H5L_TYPE_SOFT) return 0;
  if (info->type != H5L_TYPE_HARD) {
    found.elsewhere = true;
    return 0;
  }
  const Handle object(H5Oopen(group, name, H5P_DEFAULT), H5Oclose);
  if (object >= 0 && H5Iget_type(object) == H5I_DATASET) look_at_data(object, found);
  return 0;
}

}  // namespace

std::size_t largest_data_set(const std::string& path) {
  // Failures are told below; HDF5 would print its own account.
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  Found found;
  if (file < 0 || H5Lvisit(file, H5_INDEX_NAME, H5_ITER_NATIVE, look_at_link, &found) < 0)
    throw InputError({path}, "the file is no whole HDF5 file: cut off or damaged", "a MED file");
  if (found.elsewhere)
    throw InputError({path}, "the file takes data from other files", "a MED file that holds its mesh itself");
  return found.largest;
}

}  // namespace solidus::mesh
