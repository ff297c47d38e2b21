/// The keys of [granular] in a material file.
#pragma once

#include "input/keys.hpp"
#include "material/granular_data.hpp"

namespace solidus::material {

struct Material;

const Section<GranularData>& granular_section();

/// The law of the material from [granular]. Throws InputError where the material has no elastic properties,
/// melts, or has another law; and as make_granular_law.
void add_granular(Material& material, const GranularData& data);

}  // namespace solidus::material
