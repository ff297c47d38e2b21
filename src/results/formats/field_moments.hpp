/// The field files of a run's moments, read again: what vtkhdf.hpp and med.hpp gather.
#pragma once

#include <boost/property_tree/ptree.hpp>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mesh/files/vtu_pieces.hpp"
#include "results/formats/pvd.hpp"

namespace solidus::results {

/// A .vtu, or the parts that a .pvtu lists, one a process. Throws InputError where a file is missing or
/// damaged.
class FieldMoment {
 public:
  explicit FieldMoment(const std::filesystem::path& path) { add(path); }

  struct Piece {
    const mesh::VtuFile* file;
    const boost::property_tree::ptree* tree;
    std::size_t n_points, n_cells;
  };
  const std::vector<Piece>& pieces() const { return pieces_; }
  std::size_t n_points() const;
  std::size_t n_cells() const;

 private:
  /// @param part  the file is in a list of parts, and is none itself
  void add(const std::filesystem::path& path, bool part = false);

  std::vector<std::unique_ptr<mesh::VtuFile>> files_;
  std::vector<Piece> pieces_;
};

/// An array of the grid's points or cells.
struct FieldArray {
  const char* section;  ///< "PointData" or "CellData"
  std::string name, unit;
  std::size_t components = 1;

  bool of_points() const;
  /// Numbers of nodes, elements, bodies or processes, the same at every moment.
  bool is_of_mesh() const;
};

/// All arrays of a piece but that which hides cells (hidden_cells).
std::vector<FieldArray> columns_of(const FieldMoment::Piece& piece);

/// Values of all pieces, one behind the other, components of an entity together. Throws InputError where a
/// piece has no such array.
std::vector<double> values_of(const FieldMoment& moment, const FieldArray& column);

/// VTK's array for cells that are not drawn, those of bodies that have left: 0 where a cell is there.
constexpr const char* k_hidden_cells = "vtkGhostType";
std::vector<std::uint8_t> hidden_cells(const FieldMoment& moment);

/// The moments of the bodies that fields.pvd lists. Throws InputError where there are none.
std::vector<PvdCollection::Entry> body_moments(const std::filesystem::path& collection);

/// Throws InputError where a moment has other numbers of points or cells than the first of the run.
void check_same_mesh(const FieldMoment& moment, std::size_t n_points, std::size_t n_cells,
                     const std::filesystem::path& file);

}  // namespace solidus::results
