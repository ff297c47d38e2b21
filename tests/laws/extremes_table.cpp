// A format of fields that no file of src/, python/ and web/ names: a run writes the least and the largest
// value of each scalar field at its nodes into a table.
#include <algorithm>
#include <limits>

#include "results/fields/field.hpp"
#include "results/output/csv.hpp"
#include "results/output/field_format.hpp"
#include "results/output/output_error.hpp"
#include "results/output/run_folder.hpp"
#include "system/processes.hpp"

namespace solidus::results {
namespace {

constexpr std::string_view k_file = "extremes.csv";

class ExtremesTable final : public FieldWriter {
 public:
  ExtremesTable(const RunFolder& folder, std::optional<double> from)
      : path_(folder.root() / k_file), from_(from) {}

  void write(double time, const FieldSet& bodies, const std::map<std::string, FieldSet>&) override {
    std::vector<CsvColumn> columns{{"time", "s"}};
    std::vector<double> row{time};
    for (const Field& field : bodies.all()) {
      if (field.components > 1 || field.place != mesh::FieldPlace::node) continue;
      std::vector<double> storage;
      const std::span<const double> values = field.read(storage);
      // The largest of all processes, of the values and of their negatives.
      std::vector<double> both(2, -std::numeric_limits<double>::infinity());
      for (const double value : values) both = {std::max(both[0], -value), std::max(both[1], value)};
      processes::largest(std::span(both));
      row.insert(row.end(), {-both[0], both[1]});
      columns.insert(columns.end(),
                     {{field.name + "_least", field.unit}, {field.name + "_largest", field.unit}});
    }
    on_first_process([&] {
      if (!table_ && from_)
        table_.emplace(path_, columns, *from_);
      else if (!table_)
        table_.emplace(path_, columns);
      table_->add(row);
    });
  }

 private:
  std::filesystem::path path_;
  std::optional<double> from_;
  std::optional<CsvTable> table_;  ///< on process 0, from the first moment on
};

std::unique_ptr<FieldWriter> make(const RunFolder& folder, const mesh::Mesh&, std::optional<double> from) {
  return std::make_unique<ExtremesTable>(folder, from);
}

FieldFormat extremes() {
  return {.name = "extremes",
          .place = 15,
          .doc = "The least and largest value of each field at each output time in a table extremes.csv too.",
          .files = {k_file},
          .make = &make};
}

const AddFieldFormat k_extremes{extremes()};

}  // namespace
}  // namespace solidus::results
