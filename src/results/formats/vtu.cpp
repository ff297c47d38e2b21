/// The part of this process is written as points, cells and fields; process 0 writes the list of parts.
#include "results/formats/vtu.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "mesh/files/vtk_cells.hpp"
#include "numbers/index_casts.hpp"
#include "results/formats/vtk_data.hpp"
#include "results/output/output_file.hpp"
#include "system/processes.hpp"

namespace solidus::results {

using mesh::ElementBlock;
using mesh::Mesh;
using mesh::Shape;
using mesh::vtk_cell_type;
using mesh::vtk_node_order;

namespace {

// Contents of one file: the counted cells of some blocks and the nodes they touch.
struct Part {
  const Mesh& mesh;
  std::span<const ElementBlock> blocks;
  bool volume;                // the blocks are Mesh::blocks: cell fields belong to them
  std::vector<Index> nodes;   // local numbers, in the order of the file
  std::vector<Index> number;  // the inverse; -1 elsewhere
  std::size_t n_cells = 0, n_corners = 0;
};

Part make_part(const Mesh& mesh, std::span<const ElementBlock> blocks, bool volume) {
  Part part{mesh, blocks, volume, {}, std::vector<Index>(mesh.x.size(), -1)};
  // Nodes that the elements of this part use, numbered in the order of the mesh.
  for (const ElementBlock& block : blocks) {
    const auto n = as_size(block.n_counted);
    part.n_cells += n;
    part.n_corners += n * as_size(mesh::node_count(block.shape));
    for (Index e = 0; e < block.n_counted; ++e)
      for (int a = 0; a < mesh::node_count(block.shape); ++a) part.number[as_size(block.element(e)[a])] = 0;
  }
  // Numbers of the file follow from the marks.
  part.nodes.reserve(part.number.size() -
                     as_size(std::count(part.number.begin(), part.number.end(), Index{-1})));
  for (std::size_t node = 0; node < part.number.size(); ++node)
    if (part.number[node] == 0) {
      part.number[node] = as_index(part.nodes.size());
      part.nodes.push_back(as_index(node));
    }
  return part;
}

int file_components(const Field& field) {
  return field.components == 2 ? 3 : field.components;
}

ArrayHead head_of(const Field& field) {
  return {field.name, file_components(field), field.unit, field.cylindrical};
}

std::string near(const Mesh& mesh, Index node) {
  const mesh::Point& x = mesh.x[as_size(node)];
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x[0], x[1], x[2]);
}

// The file's values of a field: those of the part's nodes or cells, two components padded to three. Throws
// NotFiniteError with the place.
std::string add_field(AppendedData& data, const Part& part, const Field& field) {
  std::vector<double> storage;
  // Values are read when they are needed, since all fields of a large mesh at once would not fit.
  const std::span<const double> values = field.read(storage);
  const Mesh& mesh = part.mesh;
  check_size(mesh, field, values.size());
  const auto nc = as_size(field.components);
  const auto pad = as_size(file_components(field)) - nc;
  // Values at nodes go by the file's order of nodes, values of cells by the order of blocks.
  const bool at_nodes = field.place == mesh::FieldPlace::node;
  const std::size_t n = (at_nodes ? part.nodes.size() : part.n_cells) * (nc + pad);
  return data.add<double>(head_of(field), n, [&](const auto& put) {
    const auto take = [&](std::size_t entity, const auto& where) {
      for (const double value : values.subspan(entity * nc, nc)) {
        if (!std::isfinite(value)) throw NotFiniteError("field '" + field.name + "'", where());
        put(value);
      }
      for (std::size_t i = 0; i < pad; ++i) put(0.0);
    };
    // A value that is not finite is told with the node or the element, and where that is.
    if (at_nodes)
      for (const Index node : part.nodes)
        take(as_size(node),
             [&] { return fmt::format("node {} {}", mesh.input_node[as_size(node)], near(mesh, node)); });
    std::size_t first = 0;
    for (const ElementBlock& block : at_nodes ? std::span<const ElementBlock>() : part.blocks) {
      for (Index e = 0; e < block.n_counted; ++e)
        take(first + as_size(e), [&] {
          return fmt::format("element {} near {}", block.input_element[as_size(e)],
                             near(mesh, block.element(e)[0]));
        });
      first += as_size(block.size());
    }
  });
}

// VTK's vtkGhostType: readers keep the cell, filters and views pass over it.
constexpr std::uint8_t k_hidden_cell = 32;
constexpr const char* k_ghost_type = "vtkGhostType";

template <class T, class F>
std::string add_of_cells(AppendedData& data, const Part& part, const std::string& name, const F& value) {
  return data.add<T>({name}, part.n_cells, [&](const auto& put) {
    for (const ElementBlock& block : part.blocks)
      for (Index e = 0; e < block.n_counted; ++e) put(static_cast<T>(value(block, e)));
  });
}

std::string add_points(AppendedData& data, const Part& part) {
  return data.add<double>({"Points", 3, "m"}, 3 * part.nodes.size(), [&](const auto& put) {
    for (const Index node : part.nodes)
      for (const double x : part.mesh.x[as_size(node)]) put(x);
  });
}

// The data in the order in which they have always been in the file.
std::string add_cells(AppendedData& data, const Part& part) {
  const std::string types = add_of_cells<std::uint8_t>(
      data, part, "types", [](const ElementBlock& block, Index) { return vtk_cell_type(block.shape); });
  std::int64_t end = 0;
  const std::string offsets = add_of_cells<std::int64_t>(
      data, part, "offsets",
      [&](const ElementBlock& block, Index) { return end += mesh::node_count(block.shape); });
  const std::string connectivity =
      data.add<std::int64_t>({"connectivity"}, part.n_corners, [&](const auto& put) {
        for (const ElementBlock& block : part.blocks) {
          const auto order = vtk_node_order(block.shape);
          for (Index e = 0; e < block.n_counted; ++e)
            for (const int a : order) put(part.number[as_size(block.element(e)[a])]);
        }
      });
  return connectivity + offsets + types;
}

// Returns ' Scalars="temperature" Vectors="displacement"', the fields that ParaView shows first.
std::string active(const FieldSet& fields, mesh::FieldPlace place) {
  std::string scalars, vectors;
  for (const Field& field : fields.all()) {
    if (field.place != place) continue;
    if (field.components == 1 && scalars.empty()) scalars = field.name;
    if (file_components(field) == 3 && vectors.empty()) vectors = field.name;
  }
  return (scalars.empty() ? "" : fmt::format(R"( Scalars="{}")", xml_text(scalars))) +
         (vectors.empty() ? "" : fmt::format(R"( Vectors="{}")", xml_text(vectors)));
}

std::string vtk_head(std::string_view type) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\" "
      "compressor=\"vtkZLibDataCompressor\">\n",
      type, std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian");
}

void write_part(const std::filesystem::path& path, const Part& part, const FieldSet& fields, double time) {
  // Values are written to a spool file while the XML head is composed, since the head has to know where each
  // array begins.
  SpoolFile spool(path.string() + ".spool");
  AppendedData data(spool);
  std::string xml = vtk_head("UnstructuredGrid");
  xml += "  <UnstructuredGrid>\n    <FieldData>\n";
  xml += fmt::format(
      "      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}"
      "</DataArray>\n    </FieldData>\n",
      time);
  xml += fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", part.nodes.size(),
                     part.n_cells);

  // Fields of nodes come first, then those of cells with the numbers of element, body and process.
  xml += fmt::format("      <PointData{}>\n", active(fields, mesh::FieldPlace::node));
  for (const Field& field : fields.all())
    if (field.place == mesh::FieldPlace::node) xml += add_field(data, part, field);
  xml += data.add<std::int64_t>({"node"}, part.nodes.size(), [&part](const auto& put) {
    for (const Index node : part.nodes) put(part.mesh.input_node[as_size(node)]);
  });
  xml += "      </PointData>\n";

  xml += fmt::format("      <CellData{}>\n", part.volume ? active(fields, mesh::FieldPlace::cell) : "");
  if (part.volume)
    for (const Field& field : fields.all())
      if (field.place == mesh::FieldPlace::cell) xml += add_field(data, part, field);
  // Numbers of the input, bodies and processes as columns of the cells.
  const int rank = processes::rank();
  xml += add_of_cells<std::int64_t>(data, part, "element", [](const ElementBlock& block, Index e) {
    return block.input_element[as_size(e)];
  });
  xml += add_of_cells<std::int32_t>(data, part, "body",
                                    [](const ElementBlock& block, Index) { return block.body; });
  xml +=
      add_of_cells<std::int32_t>(data, part, "process", [rank](const ElementBlock&, Index) { return rank; });
  // Cells of absent bodies are marked, so that viewers hide them.
  if (const linear::ActiveSet* active_set = fields.active())
    xml += add_of_cells<std::uint8_t>(data, part, k_ghost_type, [&](const ElementBlock& block, Index e) {
      const bool there =
          block.body < 0 || (active_set->body(block.body) && fields.there(block.input_element[as_size(e)]));
      return there ? std::uint8_t{0} : k_hidden_cell;
    });
  xml += "      </CellData>\n";
  xml += "      <Points>\n" + add_points(data, part) + "      </Points>\n";
  xml += "      <Cells>\n" + add_cells(data, part) + "      </Cells>\n";
  xml += "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n   _";

  // The file appears whole under its name, or not at all.
  AtomicFile file(path);
  file.write(xml);
  spool.copy_to(file.file());
  file.write("\n  </AppendedData>\n</VTKFile>\n");
  file.commit();
}

}  // namespace

void write_vtu(const std::filesystem::path& path, const Mesh& mesh, const FieldSet& fields, double time) {
  write_part(path, make_part(mesh, mesh.blocks, true), fields, time);
}

void write_surface_vtu(const std::filesystem::path& path, const Mesh& mesh, const mesh::Surface& surface,
                       const FieldSet& fields, double time) {
  write_part(path, make_part(mesh, surface.faces, false), fields, time);
}

void write_pvtu(const std::filesystem::path& path, const std::vector<std::string>& parts,
                const FieldSet& fields, bool surface) {
  const auto array = [](const ArrayHead& head, std::string_view type) {
    // Heads of arrays alone: types, components and units.
    return fmt::format("      <PDataArray {}>{}</PDataArray>\n", array_attributes(head, type),
                       array_information(head));
  };
  std::string xml = vtk_head("PUnstructuredGrid") + "  <PUnstructuredGrid GhostLevel=\"0\">\n";
  // The same arrays as in the parts, without values.
  xml += fmt::format("    <PPointData{}>\n", active(fields, mesh::FieldPlace::node));
  for (const Field& field : fields.all())
    if (field.place == mesh::FieldPlace::node) xml += array(head_of(field), vtk_type<double>());
  xml += array({"node"}, vtk_type<std::int64_t>());
  xml += fmt::format("    </PPointData>\n    <PCellData{}>\n",
                     surface ? "" : active(fields, mesh::FieldPlace::cell));
  if (!surface)
    for (const Field& field : fields.all())
      if (field.place == mesh::FieldPlace::cell) xml += array(head_of(field), vtk_type<double>());
  xml += array({"element"}, vtk_type<std::int64_t>()) + array({"body"}, vtk_type<std::int32_t>()) +
         array({"process"}, vtk_type<std::int32_t>());
  if (fields.active() != nullptr) xml += array({k_ghost_type}, vtk_type<std::uint8_t>());
  xml += "    </PCellData>\n    <PPoints>\n" + array({"Points", 3, "m"}, vtk_type<double>()) +
         "    </PPoints>\n";
  for (const std::string& part : parts) xml += fmt::format("    <Piece Source=\"{}\"/>\n", xml_text(part));
  xml += "  </PUnstructuredGrid>\n</VTKFile>\n";
  write_file(path, xml);
}

}  // namespace solidus::results
