/// The properties of a material as CSV tables, for plots and spreadsheets.
#pragma once

#include <filesystem>

#include "material/material.hpp"

namespace solidus::app {

/// Writes FOLDER/properties.csv (every property over temperature, at the points of all tables and between
/// them) and, when the material yields, FOLDER/flow_curves.csv (the stress of slow tensile tests over plastic
/// strain at several temperatures). Makes the folder. Throws results::OutputError.
void write_material_tables(const material::Material& material, const std::filesystem::path& folder);

}  // namespace solidus::app
