/// All fields of a run in one file of VTKHDF, gathered from its VTU files when it ends or stops.
#include "results/fields/field.hpp"
#include "results/formats/pvd.hpp"
#include "results/formats/vtkhdf.hpp"
#include "results/output/field_format.hpp"
#include "results/output/output_error.hpp"
#include "results/output/run_folder.hpp"

namespace solidus::results {

namespace {

constexpr std::string_view k_file = "fields.vtkhdf";

class VtkHdfWriter final : public FieldWriter {
 public:
  explicit VtkHdfWriter(std::filesystem::path root) : root_(std::move(root)) {}
  void write(double, const FieldSet&, const std::map<std::string, FieldSet>&) override {}
  void end() override {
    on_first_process([&] { write_vtkhdf(root_ / k_collection, root_ / k_file); });
  }

 private:
  std::filesystem::path root_;
};

std::unique_ptr<FieldWriter> make(const RunFolder& folder, const mesh::Mesh&, std::optional<double>) {
  return std::make_unique<VtkHdfWriter>(folder.root());
}

}  // namespace

FieldFormat format_vtkhdf() {
  return {.name = "vtkhdf",
          .place = 20,
          .doc =
              "All fields of the run in one file fields.vtkhdf too, for ParaView 5.12 or newer; written when "
              "the run ends or stops.",
          .files = {k_file},
          .make = &make};
}

}  // namespace solidus::results
