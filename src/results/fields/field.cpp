/// Fields are found and selected by name; each is read when it is asked for.
#include "results/fields/field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "numbers/index_casts.hpp"
#include "system/errors.hpp"

namespace solidus::results {

std::span<const double> Field::read(std::vector<double>& storage, int body) const {
  if (!compute) return values;
  storage = body >= 0 && compute_of ? compute_of(body) : compute();
  return storage;
}

void FieldSet::add(Field field) {
  if (find(field.name) != nullptr) throw std::invalid_argument("two fields named '" + field.name + "'");
  fields_.push_back(std::move(field));
  fields_.back().cylindrical = fields_.back().cylindrical || cylindrical_;  // a selection of a set keeps it
}

const Field* FieldSet::find(std::string_view name) const {
  const auto found =
      std::find_if(fields_.begin(), fields_.end(), [&](const Field& f) { return f.name == name; });
  return found == fields_.end() ? nullptr : &*found;
}

FieldSet FieldSet::select(const std::vector<std::string>& names) const {
  // Without names all but those on request; a name that there is not is an error.
  if (names.empty()) {
    FieldSet usual;
    usual.active_ = active_;
    usual.there_ = there_;
    for (const Field& field : fields_)
      if (!field.on_request) usual.add(field);
    return usual;
  }
  // The message lists the fields that there are.
  std::string known;
  for (const Field& field : fields_) known += (known.empty() ? "" : ", ") + field.name;
  // Every name is checked before the first field is taken.
  for (const std::string& name : names)
    if (find(name) == nullptr)
      throw InputError({}, "this analysis has no field '" + name + "'", "fields: " + known);
  FieldSet chosen;
  chosen.active_ = active_;
  chosen.there_ = there_;
  for (const Field& field : fields_)
    if (std::find(names.begin(), names.end(), field.name) != names.end()) chosen.add(field);
  return chosen;
}

std::size_t value_count(const mesh::Mesh& mesh, mesh::FieldPlace place, int components) {
  std::size_t n = 0;
  if (place == mesh::FieldPlace::node)
    n = mesh.x.size();
  else
    for (const mesh::ElementBlock& block : mesh.blocks) n += as_size(block.size());
  return n * as_size(components);
}

void check_size(const mesh::Mesh& mesh, const Field& field, std::size_t n_values) {
  const std::size_t needed = value_count(mesh, field.place, field.components);
  if (n_values != needed)
    throw std::invalid_argument(
        fmt::format("field '{}' has {} values, the mesh needs {}", field.name, n_values, needed));
}

}  // namespace solidus::results
