#include "results/formats/openfoam_reader.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>
#include <optional>

#include "input/keys.hpp"
#include "numbers/index_casts.hpp"

namespace solidus::results {

namespace {

namespace fs = std::filesystem;
using mesh::Point;

/// The words, numbers and brackets of one of OpenFOAM's files.
class FoamFile {
 public:
  /// Reads the file, or its compressed form with .gz behind its name; nothing where neither is there.
  static std::optional<FoamFile> open(const fs::path& path) {
    for (const fs::path& file : {path, fs::path(path.string() + ".gz")})
      if (fs::is_regular_file(file)) return FoamFile(file);
    return std::nullopt;
  }

  [[noreturn]] void fail(const std::string& what, const std::string& allowed = {}) const {
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(at_, text_.size()));
    throw InputError({path_.string(), 1 + static_cast<int>(std::count(text_.begin(), end, '\n')), 0}, what,
                     allowed);
  }

  /// The kind of data that the header names, `class`; refuses binary files. Goes behind the header.
  std::string header() {
    std::string kind, format = "ascii";
    if (token() != "FoamFile") fail("the file does not begin with the header FoamFile");
    expect("{");
    for (std::string_view name = token(); name != "}"; name = token()) {
      const std::string value = statement();
      if (name == "class") kind = value;
      if (name == "format") format = value;
    }
    if (format != "ascii")
      fail("the file is " + format,
           "text: foamFormatConvert, with `writeFormat ascii` in system/controlDict");
    return kind;
  }
  /// Returns the text before the next semicolon.
  std::string statement() {
    std::string value;
    for (std::string_view word = token(); word != ";"; word = token())
      value += (value.empty() ? "" : " ") + std::string(word);
    return value;
  }

  std::string_view token() {
    skip_blanks();
    if (at_ >= text_.size()) fail("the file ends too early");
    const std::size_t first = at_;
    constexpr std::string_view k_single = "(){}[];";
    if (k_single.find(text_[at_]) != std::string_view::npos) {
      ++at_;
    } else if (text_[at_] == '"') {
      at_ = text_.find('"', at_ + 1);
      if (at_ == std::string::npos) fail("a text does not end");
      ++at_;
    } else {
      while (at_ < text_.size() && !blank(text_[at_]) && k_single.find(text_[at_]) == std::string_view::npos)
        ++at_;
    }
    return std::string_view(text_).substr(first, at_ - first);
  }
  void expect(std::string_view word) {
    if (const std::string_view found = token(); found != word)
      fail(fmt::format("'{}' is where '{}' belongs", found.substr(0, 40), word));
  }
  template <class T>
  T number() {
    const std::string_view word = token();
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size())
      fail(fmt::format("'{}' is no number of the kind that belongs here", word.substr(0, 40)));
    return value;
  }
  /// The number of entries of a list; each takes two bytes or more.
  std::size_t count() {
    const auto n = number<std::int64_t>();
    if (n < 0 || static_cast<std::uint64_t>(n) > (text_.size() - at_) / 2 + 1)
      fail(fmt::format("a list of {} entries, more than the file has room for", n));
    return as_size(n);
  }

 private:
  explicit FoamFile(fs::path path) : path_(std::move(path)) {
    const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path_.c_str(), "rb"), gzclose);
    if (!file) throw InputError({path_.string()}, "the file cannot be read");
    std::vector<char> piece(std::size_t{1} << 20);
    int n = 0;
    // Texts of numbers shrink to a quarter or so; what is made to fill the memory shrinks to a thousandth.
    constexpr double k_free = 64e6, k_most_times = 100;
    const double most = k_free + k_most_times * static_cast<double>(fs::file_size(path_));
    while ((n = gzread(file.get(), piece.data(), static_cast<unsigned>(piece.size()))) > 0) {
      text_.append(piece.data(), as_size(n));
      if (static_cast<double>(text_.size()) > most)
        throw InputError({path_.string()}, "the compressed file holds more than 100 times its size");
    }
    if (n < 0) throw InputError({path_.string()}, "the compressed file is damaged");
  }
  static bool blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  void skip_blanks() {
    while (at_ < text_.size()) {
      if (blank(text_[at_])) {
        ++at_;
      } else if (text_.compare(at_, 2, "//") == 0) {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (text_.compare(at_, 2, "/*") == 0) {
        const std::size_t end = text_.find("*/", at_ + 2);
        at_ = end == std::string::npos ? text_.size() : end + 2;
      } else {
        return;
      }
    }
  }

  fs::path path_;
  std::string text_;
  std::size_t at_ = 0;
};

struct PolyMesh {
  std::vector<Point> points;  ///< [m]
  /// Face f has the points first[f] … first[f + 1] − 1 of `corners`, counter-clockwise seen from behind it:
  /// the normal points out of its owner.
  std::vector<std::size_t> first = {0};
  std::vector<Index> corners;
  std::vector<Index> owner, neighbour;  ///< [face]; faces of the boundary have no neighbour
  std::size_t n_cells = 0;

  std::size_t n_faces() const { return owner.size(); }
};

FoamFile open_of_mesh(const fs::path& folder, const char* name, const SourceLocation& where) {
  std::optional<FoamFile> file = FoamFile::open(folder / name);
  if (!file)
    throw InputError(where, fmt::format("'{}' has no file '{}'", folder.string(), name),
                     "a case of OpenFOAM; of several processes, reconstructPar first");
  return std::move(*file);
}

std::vector<Index> read_labels(FoamFile file) {
  file.header();
  std::vector<Index> labels(file.count());
  file.expect("(");
  for (Index& label : labels) label = file.number<Index>();
  file.expect(")");
  return labels;
}

PolyMesh read_mesh(const fs::path& folder, double length, const SourceLocation& where) {
  // A mesh of OpenFOAM is four lists: points, faces, and the cell on either side of each face. Points are
  // converted to metres.
  PolyMesh mesh;
  FoamFile points = open_of_mesh(folder, "points", where);
  points.header();
  mesh.points.resize(points.count());
  points.expect("(");
  for (Point& x : mesh.points) {
    points.expect("(");
    for (double& coordinate : x) coordinate = length * points.number<double>();
    points.expect(")");
  }
  FoamFile faces = open_of_mesh(folder, "faces", where);
  if (const std::string kind = faces.header(); kind != "faceList")
    faces.fail("the faces are a '" + kind + "'", "a faceList");
  const std::size_t n_faces = faces.count();
  // Faces are kept as one list of corners with the place where each begins; corners that are no points are
  // refused at once.
  faces.expect("(");
  for (std::size_t f = 0; f < n_faces; ++f) {
    const std::size_t n = faces.count();
    if (n < 3) faces.fail("a face has fewer than three points");
    faces.expect("(");
    for (std::size_t k = 0; k < n; ++k) {
      mesh.corners.push_back(faces.number<Index>());
      if (mesh.corners.back() < 0 || as_size(mesh.corners.back()) >= mesh.points.size())
        faces.fail("a face has a corner that is no point");
    }
    faces.expect(")");
    mesh.first.push_back(mesh.corners.size());
  }
  // The lists of cells have to fit the faces. The number of cells is the largest one that a face names.
  mesh.owner = read_labels(open_of_mesh(folder, "owner", where));
  mesh.neighbour = read_labels(open_of_mesh(folder, "neighbour", where));
  if (mesh.owner.size() != n_faces || mesh.neighbour.size() > n_faces)
    throw InputError({folder.string()}, "faces, owner and neighbour of the mesh do not fit each other");
  for (const std::vector<Index>* cells : {&mesh.owner, &mesh.neighbour})
    for (const Index cell : *cells) {
      if (cell < 0 || as_size(cell) > n_faces)
        throw InputError({folder.string()}, "a face of the mesh belongs to no cell");
      mesh.n_cells = std::max(mesh.n_cells, as_size(cell) + 1);
    }
  if (mesh.n_cells == 0) throw InputError({folder.string()}, "the mesh has no cells");
  return mesh;
}

/// Calls use(cell, a, b, c) for the triangles of each cell's faces, as seen from outside of the cell
/// counter-clockwise.
template <class F>
void for_each_triangle(const PolyMesh& mesh, const F& use) {
  for (std::size_t f = 0; f < mesh.n_faces(); ++f)
    for (std::size_t k = mesh.first[f] + 2; k < mesh.first[f + 1]; ++k) {
      const Index a = mesh.corners[mesh.first[f]], b = mesh.corners[k - 1], c = mesh.corners[k];
      use(as_size(mesh.owner[f]), a, b, c);
      if (f < mesh.neighbour.size()) use(as_size(mesh.neighbour[f]), a, c, b);
    }
}

/// det[b − a, c − a, d − a]/6
double tetrahedron(const Point& a, const Point& b, const Point& c, const Point& d) {
  std::array<Point, 3> e{};
  for (std::size_t i = 0; i < 3; ++i) e[0][i] = b[i] - a[i], e[1][i] = c[i] - a[i], e[2][i] = d[i] - a[i];
  return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
          e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
          e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
         6;
}

/// The mean of the corners of each cell's triangles.
std::vector<Point> centres(const PolyMesh& mesh) {
  std::vector<Point> centre(mesh.n_cells, Point{});
  std::vector<double> count(mesh.n_cells, 0.0);
  for_each_triangle(mesh, [&](std::size_t cell, Index a, Index b, Index c) {
    for (const Index node : {a, b, c})
      for (std::size_t i = 0; i < 3; ++i) centre[cell][i] += mesh.points[as_size(node)][i];
    count[cell] += 3;
  });
  for (std::size_t c = 0; c < centre.size(); ++c)
    for (double& x : centre[c]) x /= std::max(count[c], 1.0);
  return centre;
}

std::string unit_of(const std::array<double, 7>& powers) {
  constexpr std::array<const char*, 7> k_units = {"kg", "m", "s", "K", "mol", "A", "cd"};
  std::string unit;
  for (std::size_t i = 0; i < powers.size(); ++i)
    if (powers[i] != 0)
      unit += (unit.empty() ? "" : " ") +
              (powers[i] == 1 ? std::string(k_units[i]) : fmt::format("{}^{:g}", k_units[i], powers[i]));
  return unit.empty() ? "1" : unit;
}

struct FoamField {
  bool of_points = false;
  std::string unit;
  std::vector<double> values;
};

FoamField read_values(FoamFile file, const PolyMesh& mesh) {
  // A field says its dimensions, then its values: one for all, or one for each cell or point.
  FoamField field;
  const std::string kind = file.header();
  if (kind != "volScalarField" && kind != "pointScalarField")
    file.fail("the field is a '" + kind + "'", "a volScalarField or a pointScalarField");
  field.of_points = kind == "pointScalarField";
  const std::size_t n = field.of_points ? mesh.points.size() : mesh.n_cells;
  while (true) {
    const std::string key(file.token());
    if (key == "dimensions") {
      std::array<double, 7> powers{};
      file.expect("[");
      std::size_t i = 0;
      for (std::string_view word = file.token(); word != "]"; word = file.token(), ++i) {
        double power = 0;
        if (i >= powers.size() ||
            std::from_chars(word.data(), word.data() + word.size(), power).ec != std::errc())
          file.fail("the dimensions are no powers of kg, m, s, K, mol, A, cd");
        powers[i] = power;
      }
      file.expect(";");
      field.unit = unit_of(powers);
    } else if (key == "internalField") {
      if (const std::string_view form = file.token(); form == "uniform") {
        field.values.assign(n, file.number<double>());
      } else if (form == "nonuniform") {
        file.expect("List<scalar>");
        if (const std::size_t found = file.count(); found != n)
          file.fail(fmt::format("the field has {} values, the mesh {} {}", found, n,
                                field.of_points ? "points" : "cells"));
        file.expect("(");
        field.values.resize(n);
        for (double& value : field.values) value = file.number<double>();
        file.expect(")");
      } else {
        file.fail(fmt::format("the field is '{}'", form), "uniform or nonuniform");
      }
      for (const double value : field.values)
        if (!std::isfinite(value)) file.fail("the field is not finite somewhere");
      return field;
      // Entries that are not needed (boundary fields and others) are skipped, whole groups with their
      // brackets.
    } else if (const std::string_view next = file.token(); next == "{") {
      for (int depth = 1; depth > 0;) {
        const std::string_view word = file.token();
        depth += word == "{" ? 1 : word == "}" ? -1 : 0;
      }
    } else if (next != ";") {
      file.statement();
    }
  }
}

/// Opens the file of a field. Throws InputError with the names of those that are there.
FoamFile open_field(const fs::path& folder, const std::string& name, const SourceLocation& where) {
  std::optional<FoamFile> file = FoamFile::open(folder / name);
  if (!file) {
    std::vector<std::string> there;
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.is_regular_file()) there.push_back(entry.path().stem().string());
    std::sort(there.begin(), there.end());
    throw InputError(where, fmt::format("the folder has no field '{}'", name),
                     there.empty() ? "" : one_of(there, name));
  }
  return std::move(*file);
}

/// Gives points and centres of cells their values: cells take part in their points' values by their volumes,
/// and points in those of their cells alike.
/// @param read  has the mesh and the volumes of cells
void spread_to_points(const FoamField& field, const PolyMesh& poly, ReadField& read) {
  const mesh::Mesh& mesh = read.mesh;
  const auto n_points = as_index(poly.points.size());
  const std::vector<double>& given = field.values;
  std::vector<double> sum(mesh.x.size(), 0.0), weight(mesh.x.size(), 0.0);
  read.values.assign(mesh.x.size(), 0.0);
  if (field.of_points) {
    std::copy(given.begin(), given.end(), read.values.begin());
    for_each_triangle(poly, [&](std::size_t cell, Index a, Index b, Index c) {
      const std::size_t at = poly.points.size() + cell;
      for (const Index node : {a, b, c}) sum[at] += given[as_size(node)], weight[at] += 1;
    });
  } else {
    for_each_triangle(poly, [&](std::size_t cell, Index a, Index b, Index c) {
      for (const Index node : {a, b, c}) {
        sum[as_size(node)] += read.cell_volumes[cell] * given[cell];
        weight[as_size(node)] += read.cell_volumes[cell];
      }
    });
    std::copy(given.begin(), given.end(), read.values.begin() + n_points);
    read.cell_values = given;
  }
  for (std::size_t i = 0; i < mesh.x.size(); ++i)
    if (weight[i] > 0) read.values[i] = sum[i] / weight[i];
  if (field.of_points) read.cell_volumes.clear();  // values are of points: sums go by the tetrahedra
}

}  // namespace

ReadField read_openfoam(const fs::path& time, const std::string& name, double length,
                        const SourceLocation& where) {
  const fs::path folder = fs::weakly_canonical(time);
  const fs::path poly_mesh = folder.parent_path() / "constant/polyMesh";
  if (!fs::is_directory(poly_mesh))
    throw InputError(where, fmt::format("'{}' is a folder, but no time of a case of OpenFOAM", time.string()),
                     "a folder of a time, with constant/polyMesh next to it; or a .csv, .vtu or .pvtu file");
  FoamFile file = open_field(folder, name, where);
  const PolyMesh poly = read_mesh(poly_mesh, length, where);
  const FoamField field = read_values(std::move(file), poly);

  // Each cell becomes tetrahedra between its centre and the triangles of its faces.
  ReadField read;
  read.unit = field.unit;
  read.cell_volumes.assign(poly.n_cells, 0.0);
  mesh::Mesh& mesh = read.mesh;
  mesh.x = poly.points;
  const std::vector<Point> centre = centres(poly);
  mesh.x.insert(mesh.x.end(), centre.begin(), centre.end());
  const auto n_points = as_index(poly.points.size());
  mesh::ElementBlock block{.shape = mesh::Shape::tet4, .body = 0, .nodes = {}, .input_element = {}};
  for_each_triangle(poly, [&](std::size_t cell, Index a, Index b, Index c) {
    const auto corner = [&](Index node) -> const Point& { return poly.points[as_size(node)]; };
    read.cell_volumes[cell] += tetrahedron(centre[cell], corner(a), corner(b), corner(c));
    block.nodes.insert(block.nodes.end(), {n_points + as_index(cell), a, b, c});
    block.input_element.push_back(static_cast<GlobalIndex>(cell) + 1);
  });
  for (std::size_t cell = 0; cell < poly.n_cells; ++cell)
    if (!(read.cell_volumes[cell] > 0))
      throw InputError({poly_mesh.string()}, fmt::format("cell {} of the mesh has no positive volume", cell));

  spread_to_points(field, poly, read);

  mesh.dimension = 3;
  mesh.n_owned_nodes = as_index(mesh.x.size());
  mesh.n_global_nodes = mesh.n_owned_nodes;
  mesh.bodies.push_back({"body"});
  block.n_counted = block.size();
  mesh.blocks.push_back(std::move(block));
  return read;
}

}  // namespace solidus::results
