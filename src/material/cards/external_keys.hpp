/// The keys of [external] in a material file.
#pragma once

#include "input/keys.hpp"
#include "material/external_law.hpp"

namespace solidus::material {

const Section<ExternalData>& external_section();

/// Checks the data against each other and the rest of the material, whose other properties are there already,
/// and adds the law, not loaded. Throws InputError with the place.
void add_external(Material& material, ExternalData data);

}  // namespace solidus::material
