/// The list of formats that have described themselves.
#include "results/output/field_format.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "results/output/built_in_field_formats.hpp"

namespace solidus::results {

namespace {

bool share_a_file(const FieldFormat& one, const FieldFormat& other) {
  return std::ranges::any_of(one.files, [&](std::string_view file) {
    return std::ranges::find(other.files, file) != other.files.end();
  });
}

void insert(std::vector<FieldFormat>& formats, FieldFormat format) {
  if (format.make == nullptr)
    throw std::logic_error("nothing writes the format '" + std::string(format.name) + "' of fields");
  for (const FieldFormat& other : formats)
    if (other.name == format.name || other.place == format.place || share_a_file(other, format))
      throw std::logic_error("the formats '" + std::string(format.name) + "' and '" +
                             std::string(other.name) + "' of fields share a name, a place or a file");
  const auto next = std::ranges::upper_bound(formats, format.place, {}, &FieldFormat::place);
  formats.insert(next, std::move(format));
}

/// Made when it is first asked for: objects at namespace scope add to it before main() begins.
std::vector<FieldFormat>& formats() {
  static std::vector<FieldFormat> all = [] {
    std::vector<FieldFormat> built_in;
    for (FieldFormat& format : built_in_field_formats()) insert(built_in, std::move(format));
    return built_in;
  }();
  return all;
}

}  // namespace

const std::vector<FieldFormat>& field_formats() {
  return formats();
}

void add_field_format(FieldFormat format) {
  insert(formats(), std::move(format));
}

AddFieldFormat::AddFieldFormat(FieldFormat format) {
  add_field_format(std::move(format));
}

}  // namespace solidus::results
