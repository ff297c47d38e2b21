/// Mesh and fields of all moments as extendable tables, with the offsets that the format asks for.
#include "results/formats/vtkhdf.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "results/formats/field_moments.hpp"
#include "results/formats/hdf5_file.hpp"
#include "results/output/output_error.hpp"
#include "system/errors.hpp"

namespace solidus::results {

namespace {

namespace fs = std::filesystem;

/// The file that is written: groups, attributes, and tables that grow by rows.
class Writer {
 public:
  explicit Writer(const fs::path& path) : path_(path), file_(create(path), H5Fclose) {
    if (file_ < 0) fail();
  }

  void group(const std::string& name) {
    const Hdf5Handle made(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    if (made < 0) fail();
  }
  void text_attribute(const std::string& of, const char* name, const std::string& text) {
    const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
    H5Tset_size(type, text.size());
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    H5Tset_cset(type, H5T_CSET_ASCII);
    const Hdf5Handle made(
        H5Acreate_by_name(file_, of.c_str(), name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
    if (made < 0 || H5Awrite(made, type, text.c_str()) < 0) fail();
  }
  void integer_attribute(const std::string& of, const char* name, const std::vector<std::int64_t>& values,
                         bool scalar = false) {
    const hsize_t n = values.size();
    const Hdf5Handle space(scalar ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &n, nullptr), H5Sclose);
    const Hdf5Handle made(H5Acreate_by_name(file_, of.c_str(), name, H5T_NATIVE_INT64, space, H5P_DEFAULT,
                                            H5P_DEFAULT, H5P_DEFAULT),
                          H5Aclose);
    if (made < 0 || H5Awrite(made, H5T_NATIVE_INT64, values.data()) < 0) fail();
  }

  /// Adds rows to a table, which is made by the first.
  /// @param width  of a row; 0: the table has one dimension
  template <class T>
  void append(const std::string& name, const std::vector<T>& values, std::size_t width = 0) {
    const int dimensions = width == 0 ? 1 : 2;
    std::array<hsize_t, 2> count{values.size() / std::max<std::size_t>(width, 1), width}, before{0, width};
    if (H5Lexists(file_, name.c_str(), H5P_DEFAULT) <= 0) make<T>(name, dimensions, width);
    const Hdf5Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
    {
      const Hdf5Handle space(H5Dget_space(set), H5Sclose);
      H5Sget_simple_extent_dims(space, before.data(), nullptr);
    }
    if (count[0] == 0) return;
    const std::array<hsize_t, 2> after{before[0] + count[0], width}, start{before[0], 0};
    if (H5Dset_extent(set, after.data()) < 0) fail();
    const Hdf5Handle space(H5Dget_space(set), H5Sclose),
        memory(H5Screate_simple(dimensions, count.data(), nullptr), H5Sclose);
    if (H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) < 0 ||
        H5Dwrite(set, type<T>(), memory, space, H5P_DEFAULT, values.data()) < 0)
      fail();
  }

  void close() {
    if (!file_.close()) fail();
  }

 private:
  template <class T>
  static hid_t type() {
    if constexpr (std::is_same_v<T, double>)
      return H5T_NATIVE_DOUBLE;
    else if constexpr (std::is_same_v<T, std::uint8_t>)
      return H5T_NATIVE_UINT8;
    else
      return H5T_NATIVE_INT64;
  }
  template <class T>
  void make(const std::string& name, int dimensions, std::size_t width) {
    constexpr hsize_t k_chunk = std::size_t{1} << 14;  // rows
    const std::array<hsize_t, 2> none{0, width}, most{H5S_UNLIMITED, width}, chunk{k_chunk, width};
    const Hdf5Handle space(H5Screate_simple(dimensions, none.data(), most.data()), H5Sclose),
        properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose), links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_chunk(properties, dimensions, chunk.data());
    H5Pset_shuffle(properties);
    H5Pset_deflate(properties, 1);
    H5Pset_obj_track_times(properties, false);
    H5Pset_create_intermediate_group(links, 1);
    const Hdf5Handle made(H5Dcreate2(file_, name.c_str(), type<T>(), space, links, properties, H5P_DEFAULT),
                          H5Dclose);
    if (made < 0) fail();
  }
  static hid_t create(const fs::path& path) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    return H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  }
  [[noreturn]] void fail() const {
    throw OutputError(path_.string(), "cannot be written", "is there room on the disk?");
  }

  fs::path path_;
  Hdf5Handle file_;
};

std::vector<std::int64_t> whole(const std::vector<double>& numbers) {
  std::vector<std::int64_t> all;
  for (const double number : numbers) all.push_back(mesh::whole_number(number));
  return all;
}

std::string path_of(const FieldArray& column) {
  return fmt::format("VTKHDF/{}/{}", column.section, column.name);
}

void write_mesh(Writer& writer, const FieldMoment& moment, const std::vector<FieldArray>& columns,
                VtkHdfReport& report) {
  // The whole mesh as one part, whatever the number of processes that have written it.
  std::vector<std::int64_t> connectivity, offsets = {0};
  std::vector<std::uint8_t> types;
  // Corners and offsets of each piece count on from those before it.
  for (const FieldMoment::Piece& piece : moment.pieces()) {
    const mesh::CellTable cells = read_cells(*piece.file, *piece.tree, piece.n_cells, piece.n_points);
    for (const Index corner : cells.corners)
      connectivity.push_back(static_cast<std::int64_t>(report.points) + corner);
    const std::int64_t before = offsets.back();
    for (const std::size_t end : cells.offsets) offsets.push_back(before + static_cast<std::int64_t>(end));
    for (const int type : cells.types) types.push_back(static_cast<std::uint8_t>(type));
    writer.append("VTKHDF/Points",
                  piece.file->numbers(points_array(*piece.file, *piece.tree), 3 * piece.n_points), 3);
    report.points += piece.n_points;
    report.cells += piece.n_cells;
  }
  // Counts first, then the lists that they describe.
  const auto number = [](std::size_t n) { return std::vector<std::int64_t>{static_cast<std::int64_t>(n)}; };
  writer.append("VTKHDF/NumberOfPoints", number(report.points));
  writer.append("VTKHDF/NumberOfCells", number(report.cells));
  writer.append("VTKHDF/NumberOfConnectivityIds", number(connectivity.size()));
  writer.append("VTKHDF/Connectivity", connectivity);
  writer.append("VTKHDF/Offsets", offsets);
  writer.append("VTKHDF/Types", types);
  // Columns of the mesh do not change, and are written once.
  for (const FieldArray& column : columns)
    if (column.is_of_mesh()) writer.append(path_of(column), whole(values_of(moment, column)));
}

VtkHdfReport write_all(const std::vector<PvdCollection::Entry>& moments, const fs::path& root,
                       const fs::path& path) {
  // The file has one mesh and, for each step, the place in the long lists where its values begin. The first
  // moment gives mesh and columns, and later ones have to be of the same mesh.
  Writer writer(path);
  VtkHdfReport report;
  writer.group("VTKHDF");
  writer.integer_attribute("VTKHDF", "Version", {2, 0});
  writer.text_attribute("VTKHDF", "Type", "UnstructuredGrid");
  std::vector<FieldArray> columns;
  std::vector<double> times;
  for (const PvdCollection::Entry& entry : moments) {
    const FieldMoment moment(root / entry.file);
    if (report.times == 0) {
      if (moment.pieces().empty()) throw InputError({entry.file}, "the file holds no grid");
      columns = columns_of(moment.pieces().front());
      write_mesh(writer, moment, columns, report);
    }
    check_same_mesh(moment, report.points, report.cells, root / entry.file);
    const auto step = static_cast<std::int64_t>(report.times);
    // Columns of the mesh (numbers, materials) are written once; for them every step points to the beginning.
    for (const FieldArray& column : columns) {
      const auto n = static_cast<std::int64_t>(column.of_points() ? report.points : report.cells);
      const std::int64_t offset = column.is_of_mesh() ? 0 : step * n;
      writer.append(fmt::format("VTKHDF/Steps/{}Offsets/{}", column.section, column.name),
                    std::vector<std::int64_t>{offset});
      if (!column.is_of_mesh())
        writer.append(path_of(column), values_of(moment, column),
                      column.components == 1 ? 0 : column.components);
    }
    writer.append(fmt::format("VTKHDF/CellData/{}", k_hidden_cells), hidden_cells(moment));
    writer.append(fmt::format("VTKHDF/Steps/CellDataOffsets/{}", k_hidden_cells),
                  std::vector<std::int64_t>{step * static_cast<std::int64_t>(report.cells)});
    times.push_back(entry.time);
    ++report.times;
  }
  // Units as attributes, where readers look for them.
  for (const FieldArray& column : columns) {
    if (column.is_of_mesh()) continue;
    ++report.fields;
    if (!column.unit.empty()) writer.text_attribute(path_of(column), "UNITS_LABEL", column.unit);
  }
  // The remaining lists of steps are the same for a mesh that does not change.
  writer.append("VTKHDF/Steps/Values", times);
  const std::vector<std::int64_t> zeros(times.size(), 0), ones(times.size(), 1);
  for (const char* name : {"PartOffsets", "PointOffsets"})
    writer.append(fmt::format("VTKHDF/Steps/{}", name), zeros);
  for (const char* name : {"CellOffsets", "ConnectivityIdOffsets"})
    writer.append(fmt::format("VTKHDF/Steps/{}", name), zeros, 1);
  writer.append("VTKHDF/Steps/NumberOfParts", ones);
  writer.integer_attribute("VTKHDF/Steps", "NSteps", {static_cast<std::int64_t>(times.size())}, true);
  writer.close();
  return report;
}

}  // namespace

VtkHdfReport write_vtkhdf(const fs::path& collection, const fs::path& file) {
  const std::vector<PvdCollection::Entry> moments = body_moments(collection);
  const fs::path part = file.string() + ".part";
  try {
    const VtkHdfReport report = write_all(moments, collection.parent_path(), part);
    fs::rename(part, file);
    return report;
  } catch (...) {
    std::error_code none;
    fs::remove(part, none);
    throw;
  }
}

}  // namespace solidus::results
