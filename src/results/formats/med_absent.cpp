// Replaces med.cpp where the MED library is not there.
#include "results/formats/med.hpp"
#include "system/errors.hpp"

namespace solidus::results {

bool has_med() {
  return false;
}

MedReport write_med(const std::filesystem::path&, const std::vector<std::string>&,
                    const std::filesystem::path& file) {
  throw InputError({file.string()}, "this program was built without the MED library",
                   "--vtkhdf, or a program that was built where libmedc-dev is installed");
}

}  // namespace solidus::results
