#include "results/hdf5_trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <system_error>
#include <vector>

#include "results/hdf5_file.hpp"
#include "results/output_error.hpp"
#include "system/trial.hpp"

namespace solidus::results {

namespace {

constexpr std::int64_t k_numbers_at_once = 1 << 20;

template <class T>
void read_numbers(const Hdf5File& file, const std::string& name) {
  const std::int64_t rows = file.rows(name), width = std::max<std::int64_t>(file.width(name), 1);
  std::vector<T> values;
  for (std::int64_t first = 0, n = 0; first < rows; first += n) {
    n = std::min(std::max<std::int64_t>(k_numbers_at_once / width, 1), rows - first);
    values.resize(static_cast<std::size_t>(n * width));
    file.read_rows<T>(name, first, values);
  }
}

/// Reads it as whatever it is.
void read(const Hdf5File& file, const std::string& name) {
  constexpr void (*k_kinds[])(const Hdf5File&, const std::string&) = {
      read_numbers<double>, read_numbers<std::int64_t>,
      [](const Hdf5File& of, const std::string& text) { of.read_text(text); }};
  for (const auto& as_kind : k_kinds) {
    try {
      as_kind(file, name);
      return;
    } catch (const OutputError&) {  // NOLINT: of another kind, or of none
    }
  }
}

}  // namespace

void try_to_read(const std::filesystem::path& file) {
  std::error_code error;
  const auto bytes = static_cast<double>(std::filesystem::file_size(file, error));
  const double seconds = 15 + (error ? 0.0 : 1e-6 * bytes);
  const auto all_of_it = [&](const trial::Note& note) {
    note("opening it");
    const Hdf5File opened(file, Hdf5File::Mode::read);
    note("looking for what it holds");
    for (const std::string& name : opened.names()) {
      note("reading '" + name + "'");
      read(opened, name);
    }
    note("closing it");
  };
  if (const std::string fault = trial::fault_of(all_of_it, seconds); !fault.empty())
    throw OutputError(file.string(), "HDF5 cannot read it: in a trial " + fault);
}

}  // namespace solidus::results
