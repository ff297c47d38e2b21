/// Any bytes as a checkpoint: whatever is not, bit for bit, what the program wrote is refused before HDF5
/// sees it.
#include "input.hpp"
#include "results/formats/file_checksum.hpp"
#include "results/output/output_error.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace solidus;
  const auto file = fuzz::as_file("state.h5", data, size);
  try {
    results::check_checksum(file);
  } catch (const results::OutputError&) {
  }
  return 0;
}
