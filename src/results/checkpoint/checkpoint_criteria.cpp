/// Columns of the criteria go by nodes or elements, so that another number of processes can read them.
#include "results/checkpoint/checkpoint_criteria.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <vector>

#include "numbers/index_casts.hpp"
#include "system/processes.hpp"

namespace solidus::results {

namespace {

using criteria::CriterionColumn;
using criteria::CriterionRecord;

std::string path(const CriterionRecord& record, const std::string& name) {
  return "criteria/" + record.name + "/" + name;
}

std::string element_path(std::size_t block, const std::string& name) {
  return "criteria/block_" + std::to_string(block) + "/" + name;
}

/// Rows of a column that belong to all nodes, or to the elements of a block.
struct Part {
  std::size_t first = 0, owned = 0;                ///< rows of the column; those that this process writes
  std::size_t here = 0;                            ///< rows that this process has
  std::function<GlobalIndex(std::size_t)> number;  ///< of a row, in the input
  std::string keys, values;                        ///< tables of the file
};

std::vector<Part> parts(const mesh::Mesh& mesh, const CriterionRecord& record,
                        const CriterionColumn& column) {
  const std::string values = path(record, column.name);
  // A column of nodes is one part; one of elements has a part for each block.
  if (column.place == mesh::FieldPlace::node)
    return {{0, as_size(mesh.n_owned_nodes), mesh.input_node.size(),
             [&mesh](std::size_t row) { return mesh.input_node[row]; }, "node", values}};
  std::vector<Part> result;
  // Blocks are numbered through, with all rows of this process, of which the counted ones are
  // written.
  std::size_t first = 0;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const mesh::ElementBlock& block = mesh.blocks[b];
    result.push_back({first, as_size(block.n_counted), block.input_element.size(),
                      [&block](std::size_t row) { return block.input_element[row]; },
                      element_path(b, "element"), element_path(b, record.name + "_" + column.name)});
    first += block.input_element.size();
  }
  return result;
}

bool has_cells(const criteria::CriteriaState& state) {
  return std::any_of(state.records.begin(), state.records.end(), [](const CriterionRecord& r) {
    return std::any_of(r.columns.begin(), r.columns.end(),
                       [](const CriterionColumn& c) { return c.place == mesh::FieldPlace::cell; });
  });
}

void take_part(TableReader& in, const Part& part, CriterionColumn& column) {
  std::unordered_map<std::int64_t, std::size_t> places;
  for (std::size_t i = 0; i < part.here; ++i) places.emplace(part.number(i), i);
  const auto width = as_size(column.components);
  in.each(part.keys, part.values, {}, [&](std::int64_t number, std::span<const double> row) {
    const auto place = places.find(number);
    if (place == places.end() || row.size() != width) return;
    std::copy(row.begin(), row.end(),
              column.values.begin() + static_cast<std::ptrdiff_t>((part.first + place->second) * width));
    places.erase(place);  // a second row of a place is not one of another
  });
  in.require(places.empty(), part.values);
}

}  // namespace

// Numbers of the elements once for all columns that are stored by them.
void write_criteria(TableWriter& out, const mesh::Mesh& mesh, const criteria::CriteriaState& state) {
  if (has_cells(state))
    for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
      out.rows<std::int64_t>(element_path(b, "element"), 1,
                             mesh.blocks[b].input_element.part(0, as_size(mesh.blocks[b].n_counted)));
  for (const CriterionRecord& record : state.records) {
    // Columns of nodes or elements first, then tables whose rows belong to no place.
    for (const criteria::CriterionColumn& column : record.columns) {
      const auto width = as_size(column.components);
      for (const Part& part : parts(mesh, record, column))
        out.rows<double>(part.values, column.components,
                         std::span(column.values).subspan(part.first * width, part.owned * width));
    }
    for (const criteria::CriterionTable& table : record.tables) {
      // Every process holds all rows: the first writes them.
      const std::size_t n = processes::rank() == 0 ? table.values.size() : 0;
      std::vector<std::int64_t> rows(n / as_size(table.width));
      std::iota(rows.begin(), rows.end(), 0);
      out.rows<std::int64_t>(path(record, table.name) + "_row", 1, rows);
      out.rows<double>(path(record, table.name), table.width, std::span(table.values).first(n));
    }
  }
}

void take_criteria(TableReader& in, const mesh::Mesh& mesh, criteria::CriteriaState& state) {
  for (CriterionRecord& record : state.records) {
    for (criteria::CriterionColumn& column : record.columns)
      for (const Part& part : parts(mesh, record, column)) take_part(in, part, column);
    for (criteria::CriterionTable& table : record.tables) {
      table.values.clear();
      in.each(path(record, table.name) + "_row", path(record, table.name), {},
              [&](std::int64_t, std::span<const double> row) {
                if (row.size() != as_size(table.width))
                  in.refuse("its '" + path(record, table.name) + "' has rows of another width");
                table.values.insert(table.values.end(), row.begin(), row.end());
              });
    }
  }
}

}  // namespace solidus::results
