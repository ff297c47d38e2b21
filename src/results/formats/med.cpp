/// Bodies become families, moments become steps of fields; values are put into the order of MED.
#include "results/formats/med.hpp"

#include <fmt/format.h>
#include <med.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>

#include "mesh/files/med_cells.hpp"
#include "numbers/index_casts.hpp"
#include "results/formats/field_moments.hpp"
#include "results/output/output_error.hpp"
#include "system/errors.hpp"

namespace solidus::results {

namespace {

namespace fs = std::filesystem;

constexpr const char* k_mesh = "solidus";

/// The cells of one kind: their places in the run's files, and their nodes.
struct CellBlock {
  const mesh::MedCell* kind;
  std::vector<std::size_t> cells;
  std::vector<med_int> nodes;  ///< counted from 1
};

/// A name in the width that MED has for it, with blanks behind.
std::string padded(const std::string& text, std::size_t width) {
  std::string name = text.substr(0, width);
  name.resize(width, ' ');
  return name;
}

/// The file that is written. What a call of the library says goes to check().
class Writer {
 public:
  explicit Writer(const fs::path& path) : path_(path), file_(MEDfileOpen(path.c_str(), MED_ACC_CREAT)) {
    check(file_ < 0 ? -1 : 0);
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() {
    if (file_ >= 0) MEDfileClose(file_);
  }
  void close() {
    const med_err closed = MEDfileClose(file_);
    file_ = -1;
    check(closed);
  }
  med_idt file() const { return file_; }
  void check(med_err code) const {
    if (code < 0) throw OutputError(path_.string(), "cannot be written", "is there room on the disk?");
  }

 private:
  fs::path path_;
  med_idt file_;
};

std::vector<CellBlock> cell_blocks(const FieldMoment& moment) {
  std::vector<CellBlock> blocks;
  std::size_t first_point = 0, first_cell = 0;
  // Pieces of several processes are put behind one another, with points counted through.
  for (const FieldMoment::Piece& piece : moment.pieces()) {
    const mesh::CellTable table = read_cells(*piece.file, *piece.tree, piece.n_cells, piece.n_points);
    std::size_t begin = 0;
    // Cells of one kind go into one block, their nodes in the order of MED and counted from one.
    for (std::size_t c = 0; c < piece.n_cells; ++c) {
      const auto kind = std::find_if(mesh::med_cells().begin(), mesh::med_cells().end(),
                                     [&](const mesh::MedCell& k) { return k.vtk == table.types[c]; });
      if (kind == mesh::med_cells().end() || table.offsets[c] - begin != kind->order.size())
        piece.file->fail(
            fmt::format("the file has a cell of type {} that Solidus does not write", table.types[c]));
      auto block =
          std::find_if(blocks.begin(), blocks.end(), [&](const CellBlock& b) { return b.kind == &*kind; });
      if (block == blocks.end()) block = blocks.insert(block, CellBlock{&*kind, {}, {}});
      block->cells.push_back(first_cell + c);
      for (const int i : kind->order)
        block->nodes.push_back(static_cast<med_int>(first_point) + 1 + table.corners[begin + as_size(i)]);
      begin = table.offsets[c];
    }
    first_point += piece.n_points;
    first_cell += piece.n_cells;
  }
  return blocks;
}

/// A family and a group a body: MED's way to say which elements belong together. Families of elements have
/// negative numbers, 0 is that of everything else.
void write_bodies(const Writer& writer, const FieldMoment& moment, const std::vector<CellBlock>& blocks,
                  const std::vector<std::string>& bodies) {
  writer.check(MEDfamilyCr(writer.file(), k_mesh, "FAMILLE_ZERO", 0, 0, ""));
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::string family = fmt::format("body_{}", i), group = padded(bodies[i], MED_LNAME_SIZE);
    writer.check(
        MEDfamilyCr(writer.file(), k_mesh, family.c_str(), -1 - static_cast<med_int>(i), 1, group.c_str()));
  }
  const std::vector<double> of_cell = values_of(moment, {"CellData", "body", "", 1});
  for (const CellBlock& block : blocks) {
    std::vector<med_int> families;
    for (const std::size_t cell : block.cells) families.push_back(-1 - static_cast<med_int>(of_cell[cell]));
    writer.check(MEDmeshEntityFamilyNumberWr(writer.file(), k_mesh, MED_NO_DT, MED_NO_IT, MED_CELL,
                                             block.kind->med, static_cast<med_int>(families.size()),
                                             families.data()));
  }
}

void write_mesh(const Writer& writer, const FieldMoment& moment, const std::vector<CellBlock>& blocks) {
  // A mesh of a plane analysis has cells of two dimensions in a space of three.
  const bool solid = std::any_of(blocks.begin(), blocks.end(),
                                 [](const CellBlock& block) { return block.kind->dimension == 3; });
  std::string axes, units;
  for (const char* axis : {"x", "y", "z"}) {
    axes += padded(axis, MED_SNAME_SIZE);
    units += padded("m", MED_SNAME_SIZE);
  }
  writer.check(MEDmeshCr(writer.file(), k_mesh, 3, solid ? 3 : 2, MED_UNSTRUCTURED_MESH, "fields of Solidus",
                         "s", MED_SORT_DTIT, MED_CARTESIAN, axes.c_str(), units.c_str()));
  // The points of all pieces follow one another, then the blocks refer to them.
  std::vector<double> points;
  for (const FieldMoment::Piece& piece : moment.pieces()) {
    const std::vector<double> part =
        piece.file->numbers(points_array(*piece.file, *piece.tree), 3 * piece.n_points);
    points.insert(points.end(), part.begin(), part.end());
  }
  writer.check(MEDmeshNodeCoordinateWr(writer.file(), k_mesh, MED_NO_DT, MED_NO_IT, 0.0, MED_FULL_INTERLACE,
                                       static_cast<med_int>(points.size() / 3), points.data()));
  // Each kind of cell is written by itself.
  for (const CellBlock& block : blocks)
    writer.check(MEDmeshElementConnectivityWr(writer.file(), k_mesh, MED_NO_DT, MED_NO_IT, 0.0, MED_CELL,
                                              block.kind->med, MED_NODAL, MED_FULL_INTERLACE,
                                              static_cast<med_int>(block.cells.size()), block.nodes.data()));
}

/// Components in the order of VTK: of vectors x, y, z; of symmetric tensors xx, yy, zz, xy, yz, xz.
std::string component_names(std::size_t n) {
  static constexpr std::array<const char*, 3> k_vector = {"x", "y", "z"};
  static constexpr std::array<const char*, 6> k_tensor = {"xx", "yy", "zz", "xy", "yz", "xz"};
  std::string names;
  for (std::size_t i = 0; i < n; ++i)
    names += padded(n == 3 ? k_vector[i] : n == 6 ? k_tensor[i] : fmt::format("{}", i + 1), MED_SNAME_SIZE);
  return names;
}

void make_field(const Writer& writer, const std::string& name, std::size_t components,
                const std::string& unit) {
  std::string units;
  for (std::size_t i = 0; i < components; ++i) units += padded(unit, MED_SNAME_SIZE);
  const std::string names = components == 1 ? padded(name, MED_SNAME_SIZE) : component_names(components);
  writer.check(MEDfieldCr(writer.file(), name.c_str(), MED_FLOAT64, static_cast<med_int>(components),
                          names.c_str(), units.c_str(), "s", k_mesh));
}

/// A moment as the file names it.
struct Moment {
  med_int number;  ///< counted from 1
  double time;     ///< [s]
};

void write_values(const Writer& writer, const std::string& field, const Moment& moment,
                  med_entity_type entity, med_geometry_type geometry, std::size_t n,
                  std::span<const double> values) {
  writer.check(MEDfieldValueWr(writer.file(), field.c_str(), moment.number, MED_NO_IT, moment.time, entity,
                               geometry, MED_FULL_INTERLACE, MED_ALL_CONSTITUENT, static_cast<med_int>(n),
                               reinterpret_cast<const unsigned char*>(values.data())));
}

void write_cell_values(const Writer& writer, const std::string& field, const Moment& moment,
                       const std::vector<CellBlock>& blocks, std::size_t components,
                       std::span<const double> values) {
  std::vector<double> some;
  for (const CellBlock& block : blocks) {
    some.clear();
    for (const std::size_t cell : block.cells)
      for (std::size_t i = 0; i < components; ++i) some.push_back(values[cell * components + i]);
    write_values(writer, field, moment, MED_CELL, block.kind->med, block.cells.size(), some);
  }
}

MedReport write_all(const std::vector<PvdCollection::Entry>& moments, const fs::path& root,
                    const std::vector<std::string>& bodies, const fs::path& path) {
  // The first moment gives mesh, bodies and the list of fields. Every later one has to be of the same mesh,
  // since MED keeps one mesh for all times.
  Writer writer(path);
  MedReport report;
  std::vector<FieldArray> columns;
  std::vector<CellBlock> blocks;
  bool has_absent = false;
  for (const PvdCollection::Entry& entry : moments) {
    // Files are read one after the other, since all moments would not fit into memory.
    const FieldMoment files(root / entry.file);
    if (report.times == 0) {
      if (files.pieces().empty()) throw InputError({entry.file}, "the file holds no grid");
      report.points = files.n_points(), report.cells = files.n_cells();
      blocks = cell_blocks(files);
      write_mesh(writer, files, blocks);
      write_bodies(writer, files, blocks, bodies);
      for (const FieldArray& column : columns_of(files.pieces().front())) {
        if (column.is_of_mesh()) continue;
        make_field(writer, column.name, column.components, column.unit);
        columns.push_back(column);
      }
    }
    check_same_mesh(files, report.points, report.cells, root / entry.file);
    const Moment moment{static_cast<med_int>(report.times) + 1, entry.time};
    // Values are written moment by moment, nodes and cells apart.
    for (const FieldArray& column : columns) {
      const std::vector<double> values = values_of(files, column);
      if (column.of_points())
        write_values(writer, column.name, moment, MED_NODE, MED_NONE, report.points, values);
      else
        write_cell_values(writer, column.name, moment, blocks, column.components, values);
    }
    // Cells of absent bodies get a field of their own, made when the first of them is met.
    const std::vector<std::uint8_t> hidden = hidden_cells(files);
    if (std::any_of(hidden.begin(), hidden.end(), [](std::uint8_t h) { return h != 0; })) {
      if (!has_absent) make_field(writer, "absent", 1, "1");
      has_absent = true;
      std::vector<double> absent;
      for (const std::uint8_t h : hidden) absent.push_back(h != 0 ? 1.0 : 0.0);
      write_cell_values(writer, "absent", moment, blocks, 1, absent);
    }
    ++report.times;
  }
  report.fields = columns.size() + (has_absent ? 1 : 0);
  writer.close();
  return report;
}

}  // namespace

bool has_med() {
  return true;
}

MedReport write_med(const fs::path& collection, const std::vector<std::string>& bodies,
                    const fs::path& file) {
  const std::vector<PvdCollection::Entry> moments = body_moments(collection);
  const fs::path part = file.string() + ".part";
  try {
    const MedReport report = write_all(moments, collection.parent_path(), bodies, part);
    fs::rename(part, file);
    return report;
  } catch (...) {
    std::error_code none;
    fs::remove(part, none);
    throw;
  }
}

}  // namespace solidus::results
