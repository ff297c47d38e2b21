#include "results/formats/field_output.hpp"

#include <algorithm>

namespace solidus::results {

FieldOutput::FieldOutput(const RunFolder& folder, const mesh::Mesh& mesh,
                         const std::vector<std::string>& formats, std::optional<double> from)
    : last_(from) {
  for (const FieldFormat& format : field_formats())
    if (format.doc.empty() || std::ranges::find(formats, format.name) != formats.end())
      writers_.push_back(format.make(folder, mesh, from));
}

void FieldOutput::write(double time, const FieldSet& fields,
                        const std::map<std::string, FieldSet>& surfaces) {
  if (last_ == time) return;
  for (const auto& writer : writers_) writer->write(time, fields, surfaces);
  last_ = time;
}

void FieldOutput::end() {
  if (!last_) return;
  for (const auto& writer : writers_) writer->end();
}

}  // namespace solidus::results
